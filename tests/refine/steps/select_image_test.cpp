// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/select_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stack/errors.h"
#include "tests/support/message_of.h"

namespace rakelight {
namespace {

using test::message_of;
using testing::HasSubstr;

/// Images of two pixels, an image a lamp; radiance is 10 image + channel; frames are numbered 3, 5, 7...
struct Scan {
  LightStack stack;
  Observations images;

  explicit Scan(const std::vector<LampColor>& lamps) {
    images = Observations(2, static_cast<int>(lamps.size()));
    PlainSamples samples;
    for (size_t i = 0; i < lamps.size(); ++i) {
      const std::string id = "lamp-" + std::to_string(i);
      stack.lights.push_back({id, lamps[i], {}, {}});
      images.light_ids.push_back(id);
      images.frame_index.push_back(3 + 2 * static_cast<int>(i));
      images.colored_lamps.push_back(lamps[i] == LampColor::rgb);
      images.lamp_positions.emplace_back();
      for (int c = 0; c < 3; ++c)
        samples.radiance.insert(samples.radiance.end(), 2,
                                10.0f * static_cast<float>(i) + static_cast<float>(c));
    }
    samples.usable.assign(samples.radiance.size(), 1);
    images.set(samples);
  }
};

TEST(SelectImage, TakesTheFirstOrTheOneAskedFor) {
  const Scan scan({LampColor::white, LampColor::white});
  EXPECT_EQ(select_any_image(scan.images, -1).image.channel(0, 0)[0], 0);
  const SelectedImage second = select_any_image(scan.images, 5);
  EXPECT_EQ(second.image.images, 1);
  EXPECT_EQ(second.image.channel(0, 2)[1], 12);
  EXPECT_THAT(second.explanation, HasSubstr("frame 5 (lamp lamp-1)"));
}

TEST(SelectImage, RefusesAFrameThatIsNotThere) {
  const Scan scan({LampColor::white});
  EXPECT_THAT(message_of<UsageError>([&] { select_any_image(scan.images, 4); }), HasSubstr("frame 4"));
  EXPECT_THAT(message_of<UsageError>([&] { select_colored_image(scan.stack, scan.images, 4); }),
              HasSubstr("frame 4"));
}

TEST(SelectImage, FindsTheImageUnderThreeColouredLamps) {
  const Scan scan({LampColor::white, LampColor::rgb, LampColor::rgb});
  EXPECT_EQ(select_colored_image(scan.stack, scan.images, -1).image.frame_index.front(), 5);
  EXPECT_EQ(select_colored_image(scan.stack, scan.images, 7).image.frame_index.front(), 7);
}

TEST(SelectImage, TakesAnOnlyImageForAColourLitOne) {
  const Scan scan({LampColor::white});
  EXPECT_EQ(select_colored_image(scan.stack, scan.images, -1).image.frame_index.front(), 3);
}

TEST(SelectImage, PutsImagesUnderRedGreenAndBlueLampsTogether) {
  Scan scan({LampColor::blue, LampColor::white, LampColor::red, LampColor::green});
  PlainSamples samples = scan.images.plain();
  samples.usable[(3 * 3 + 1) * 2] = 0;  // green lamp, green channel, first pixel
  scan.images.set(samples);
  const SelectedImage chosen = select_colored_image(scan.stack, scan.images, -1);
  EXPECT_EQ(chosen.image.images, 1);
  EXPECT_EQ(chosen.image.channel(0, 0)[0], 20);
  EXPECT_FALSE(chosen.image.usable(0, 1, 0));
  EXPECT_EQ(chosen.image.channel(0, 1)[1], 31);
  EXPECT_EQ(chosen.image.channel(0, 2)[0], 2);
  EXPECT_EQ(chosen.image.usable_channels(0, 0), Eigen::Vector3f(1, 0, 1));
  EXPECT_EQ(chosen.image.usable_channels(0, 1), Eigen::Vector3f(1, 1, 1));
  EXPECT_THAT(chosen.explanation, HasSubstr("frames 7, 9, 3"));
}

TEST(SelectImage, SaysWhichMethodFitsImagesUnderWhiteLamps) {
  const Scan scan({LampColor::white, LampColor::red, LampColor::green});
  const std::string message =
      message_of<InputError>([&] { select_colored_image(scan.stack, scan.images, -1); });
  EXPECT_THAT(message, HasSubstr("multi-light"));
  EXPECT_THAT(message, HasSubstr("fusion-like"));
}

}  // namespace
}  // namespace rakelight
