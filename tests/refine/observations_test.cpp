// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/observations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stack/color_response.h"
#include "tests/support/bump_stack.h"

namespace rakelight {
namespace {

constexpr int kPixels = 100;

/// One image whose red channel holds the numbers given, all usable.
Observations with_red(const std::vector<float>& radiance) {
  Observations images(static_cast<int>(radiance.size()), 1);
  const std::vector<unsigned char> usable(radiance.size(), 1);
  images.set_channel(0, 0, radiance.data(), usable.data());
  return images;
}

TEST(Observations, KeepRadianceToA65534thOfTheChannelsRange) {
  std::vector<float> radiance;
  for (int p = 0; p < kPixels; ++p)
    radiance.push_back(-0.02f + 0.7f * std::abs(std::sin(static_cast<float>(p))));
  const Observations images = with_red(radiance);
  for (int p = 0; p < kPixels; ++p) {
    EXPECT_TRUE(images.usable(0, 0, p));
    EXPECT_LT(std::abs(images.channel(0, 0)[p] - radiance[static_cast<size_t>(p)]), 0.51f * 0.7f / 65534.0f);
  }
}

TEST(Observations, OfOneValueAreThatValue) {
  const Observations images = with_red(std::vector<float>(7, 0.3f));
  for (int p = 0; p < 7; ++p) EXPECT_EQ(images.channel(0, 0)[p], 0.3f);
}

TEST(Observations, ASampleThatCannotBeUsedReadsAsJustAboveTheBrightest) {
  Observations images(3, 1);
  const float radiance[] = {0.1f, 9.0f, 0.5f};
  const unsigned char usable[] = {1, 0, 1};
  images.set_channel(0, 2, radiance, usable);
  EXPECT_EQ(images.usable_channels(0, 1), Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(images.usable_channels(0, 2), Eigen::Vector3f(0, 0, 1));
  EXPECT_GE(images.channel(0, 2)[1], images.channel(0, 2)[2]);
  EXPECT_LT(images.channel(0, 2)[1], 0.501f);
  EXPECT_EQ(images.channel(0, 2)[0], 0.1f);
}

TEST(Observations, ComeBackFromPlainNumbers) {
  std::vector<float> radiance(kPixels);
  for (int p = 0; p < kPixels; ++p) radiance[static_cast<size_t>(p)] = 0.01f * static_cast<float>(p);
  const Observations images = with_red(radiance);
  Observations copy(kPixels, 1);
  copy.set(images.plain());
  EXPECT_EQ(copy.plain().usable, images.plain().usable);
  for (int p = 0; p < kPixels; ++p)
    EXPECT_LT(std::abs(copy.channel(0, 0)[p] - images.channel(0, 0)[p]), 1e-6f);
}

TEST(Observations, KnowWhichPiecesAreWhole) {
  constexpr int kPieces = 11;
  const int pixels = kPieces * kernels::kPiecePixels + 5;
  const auto of_channel = static_cast<size_t>(pixels);
  const std::vector<float> radiance(of_channel, 0.5f);
  std::vector<unsigned char> usable(of_channel, 1);
  Observations images(pixels, 2);
  EXPECT_FALSE(images.whole(1, 3));  // no sample yet
  for (int c = 0; c < 3; ++c) images.set_channel(1, c, radiance.data(), usable.data());
  for (int piece = 0; piece < kPieces; ++piece) EXPECT_TRUE(images.whole(1, piece));
  EXPECT_FALSE(images.whole(1, kPieces));  // the pixels end in it
  EXPECT_FALSE(images.whole(0, 3));
  usable[4 * kernels::kPiecePixels - 1] = 0;
  images.set_channel(1, 2, radiance.data(), usable.data());
  EXPECT_FALSE(images.whole(1, 3));
  EXPECT_TRUE(images.whole(1, 4));
  Observations copy(pixels, 1);
  for (int c = 0; c < 3; ++c) copy.copy_channel(images, 1, 0, c);
  EXPECT_FALSE(copy.whole(0, 3));
  EXPECT_TRUE(copy.whole(0, 2));
  usable.assign(of_channel, 0);
  images.set_channel(1, 0, radiance.data(), usable.data());
  EXPECT_FALSE(images.whole(1, 4));
}

TEST(Observe, TakesEachPixelOfTheMaskFromItsPlaceInTheImage) {
  const LightStack stack = test::bump_stack();
  cv::Mat1b mask(stack.color_camera.size(), uchar{0});
  mask(cv::Rect(17, 23, 31, 19)).setTo(255);
  mask(70, 90) = 255;
  const PixelGrid grid = make_pixel_grid(stack.color_camera, mask);
  const Observations images = observe(stack, grid);
  int image = 0;
  for (const Frame& frame : stack.frames) {
    if (!frame.light || frame.color.empty()) continue;
    const cv::Mat3f linear = linear_color(stack, frame);
    for (int p = 0; p < grid.size(); ++p) {
      const cv::Vec3f expected = linear(grid.pixels[static_cast<size_t>(p)]);
      for (int c = 0; c < 3; ++c) {
        if (images.usable(image, c, p)) {
          EXPECT_LT(std::abs(images.channel(image, c)[p] - expected[c]), 2e-5f);
        }
      }
    }
    ++image;
  }
  EXPECT_EQ(image, images.images);
  EXPECT_GT(image, 3);
}

}  // namespace
}  // namespace rakelight
