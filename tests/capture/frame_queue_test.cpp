// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/frame_queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "tests/support/message_of.h"

namespace rakelight {
namespace {

using std::chrono::milliseconds;

SensorFrame numbered(int index) { return {cv::Mat(), index, 0, 0}; }

TEST(FrameQueue, KeepsTheNewestAndCountsWhatItLetsGo) {
  FrameQueue queue("colour", 3, milliseconds(60000));
  for (int k = 0; k < 5; ++k) queue.push(numbered(k));
  EXPECT_EQ(queue.overruns(), 2);
  EXPECT_EQ(queue.pop(milliseconds(0))->index, 2);
}

TEST(FrameQueue, AnEmptyQueueGivesNothingAfterTheTimeOut) {
  FrameQueue queue("colour", 3, milliseconds(60000));
  EXPECT_FALSE(queue.pop(milliseconds(1)));
}

TEST(FrameQueue, ALostSensorIsReportedAfterTheLastFrame) {
  FrameQueue queue("colour", 3, milliseconds(60000));
  queue.push(numbered(0));
  queue.mark_lost();
  EXPECT_TRUE(queue.pop(milliseconds(0)));
  EXPECT_THROW(queue.pop(milliseconds(60000)), SensorLost);
}

TEST(FrameQueue, SilenceBeyondTheLimitIsALossByName) {
  FrameQueue queue("depth", 3, milliseconds(1));
  std::this_thread::sleep_for(milliseconds(3));
  EXPECT_THAT(test::message_of<SensorLost>([&] { queue.pop(milliseconds(1)); }),
              testing::HasSubstr("depth stream has fallen silent"));
}

}  // namespace
}  // namespace rakelight
