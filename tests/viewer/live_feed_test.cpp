// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "viewer/live_view.h"

namespace rakelight {
namespace {

TEST(LiveFeed, HandsOverTheLatestOnceAndKeepsItsOwnCopy) {
  LiveFeed feed;
  cv::Mat3b picture(2, 2, cv::Vec3b(1, 2, 3));
  feed.show_color(picture);
  feed.say("lamp 1");
  picture = cv::Vec3b(9, 9, 9);
  const LiveFeed::News news = feed.take();
  EXPECT_EQ(news.color(0, 0), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(news.status, "lamp 1");
  EXPECT_TRUE(feed.take().color.empty());
}

TEST(LiveFeed, SaysWhenNobodyWatches) {
  LiveFeed feed;
  EXPECT_TRUE(feed.is_watched());
  feed.stop_watching();
  EXPECT_FALSE(feed.is_watched());
}

TEST(LiveFeed, DepthWithoutAReadingIsBlack) {
  cv::Mat1w depth(1, 3, static_cast<ushort>(500));
  depth(0, 0) = 0;
  depth(0, 2) = 900;
  const cv::Mat3b colors = depth_colors(depth, 0.001);
  EXPECT_EQ(colors(0, 0), cv::Vec3b(0, 0, 0));
  EXPECT_NE(colors(0, 1), colors(0, 2));
}

}  // namespace
}  // namespace rakelight
