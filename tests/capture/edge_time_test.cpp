// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/edge_time.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rakelight {
namespace {

constexpr int kBands = 60;
const FrameTiming kTiming{8000, 30000, 33333};

/// The profile of a frame whose last row closes at `closes_us`, of a light that is 0.1 before the edge and 0.5 after.
ProfiledFrame seen(std::int64_t closes_us, double edge_us) {
  ProfiledFrame frame{closes_us, {}};
  for (int band = 0; band < kBands; ++band) {
    const double closes = double(closes_us) - (1 - (band + 0.5) / kBands) * kTiming.readout_us;
    const double share = std::clamp((closes - edge_us) / kTiming.exposure_us, 0.0, 1.0);
    frame.profile.push_back(static_cast<float>(0.1 + 0.4 * share));
  }
  return frame;
}

std::optional<EdgeTime> found(double edge_us, std::vector<std::int64_t> frames) {
  std::vector<ProfiledFrame> all;
  for (const std::int64_t closes : frames) all.push_back(seen(closes, edge_us));
  return edge_time(all, RowProfile(kBands, 0.1F), RowProfile(kBands, 0.5F), kTiming);
}

TEST(EdgeTime, IsReadFromTheRowsThatWereOpenWhenTheLightChanged) {
  for (const double edge : {80000.0, 90000.0, 104000.0}) {
    const auto time = found(edge, {66666, 100000, 133333, 166666});
    ASSERT_TRUE(time);
    EXPECT_NEAR(time->earliest_us, edge, 50);
    EXPECT_EQ(time->earliest_us, time->latest_us);
  }
}

TEST(EdgeTime, LiesBetweenFramesWhereOneWasLost) {
  const double edge =
      90000;  // only rows of the frame that closes at 100000, which is missing, and of the next saw it
  const auto time = found(edge, {66666, 166666});
  ASSERT_TRUE(time);
  EXPECT_LE(time->earliest_us, edge);
  EXPECT_GE(time->latest_us, edge);
  EXPECT_GT(time->latest_us - time->earliest_us, 10000) << "and nobody can tell where";
}

TEST(EdgeTime, IsUnknownWithoutAFrameOnEachSide) {
  EXPECT_FALSE(found(0, {133333, 166666}));
  EXPECT_FALSE(found(1e6, {66666, 100000}));
}

TEST(EdgeTime, IgnoresRowsThatTheLampHardlyLights) {
  RowProfile before(kBands, 0.1F), after = before;
  std::vector<ProfiledFrame> frames = {seen(66666, 90000), seen(100000, 90000), seen(133333, 90000),
                                       seen(166666, 90000)};
  for (int band = 0; band < kBands; ++band) {
    const bool lit = band >= kBands / 2;
    after[std::size_t(band)] = lit ? 0.5F : 0.11F;
    for (ProfiledFrame& frame : frames) {
      if (!lit) frame.profile[std::size_t(band)] = 0.1F + 0.02F * float(band % 2);  // noise
    }
  }
  const auto time = edge_time(frames, before, after, kTiming);
  ASSERT_TRUE(time);
  EXPECT_NEAR(time->earliest_us, 90000, 200);
}

TEST(RowProfile, IsTheMeanLinearLightOfTheRows) {
  cv::Mat3b image(120, 64, cv::Vec3b(0, 0, 0));
  image.rowRange(60, 120).setTo(cv::Vec3b(255, 0, 0));
  const RowProfile profile = row_profile(image, ColorResponse());
  ASSERT_EQ(profile.size(), std::size_t(kBands));
  EXPECT_EQ(profile.front(), 0);
  EXPECT_EQ(profile.back(), 1);
  EXPECT_EQ(largest_difference(profile, RowProfile(kBands, 0.25F)), 0.75F);
}

}  // namespace
}  // namespace rakelight
