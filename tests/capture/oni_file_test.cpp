// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/oni_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "capture/replay_source.h"
#include "stack/errors.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace rakelight {
namespace {

using testing::HasSubstr;

/// Four frames, 64 x 48, depth in millimetres; frame 2 has no depth.
LightStack recorded_stack() {
  LightStack stack;
  stack.color_camera = stack.depth_camera = {64, 48, 57, 57, 30, 20, {0.1}};
  stack.depth_unit_m = 0.001;
  stack.lights = {{"red", LampColor::red, {}, {}}, {"white-0", LampColor::white, {}, {}}};
  cv::RNG random(7);
  for (int k = 0; k < 4; ++k) {
    Frame frame;
    frame.index = 3 * k;
    if (k > 0) frame.light = k == 1 ? "red" : "white-0";
    frame.color.create(48, 64, CV_8UC3);
    random.fill(frame.color, cv::RNG::UNIFORM, 0, 256);
    if (k != 2) {
      frame.depth.create(48, 64);
      random.fill(frame.depth, cv::RNG::UNIFORM, 500, 1500);
      frame.depth(0, 0) = 0;
    }
    frame.color_time.device_us = 1000000 + 100000 * k;
    frame.depth_time.device_us = 1007000 + 100000 * k;
    stack.frames.push_back(frame);
  }
  return stack;
}

class OniFile : public testing::Test {
 protected:
  OniFile() : file_(folder_ / "scan.oni") {}

  test::TemporaryFolder folder_;
  std::filesystem::path file_;
};

TEST_F(OniFile, PixelsOfFramesWithColourAndDepthSurviveTheRoundTripExactly) {
  const LightStack before = recorded_stack();
  export_oni(before, file_);
  const LightStack after = import_oni(file_, {});
  ASSERT_EQ(after.frames.size(), 3u);
  const int source_of[]{0, 1, 3};
  for (std::size_t k = 0; k < 3; ++k) {
    const Frame& frame = before.frames[static_cast<std::size_t>(source_of[k])];
    EXPECT_EQ(cv::norm(after.frames[k].color, frame.color, cv::NORM_INF), 0) << k;
    EXPECT_EQ(cv::norm(after.frames[k].depth, 10 * frame.depth, cv::NORM_INF), 0)
        << "in units of 0.1 mm, " << k;
  }
  EXPECT_DOUBLE_EQ(after.depth_unit_m, 1e-4);
}

TEST_F(OniFile, EachDepthFrameStaysBesideItsColourFrameWhereBothBearOneTime) {
  LightStack before = recorded_stack();
  before.frames.erase(before.frames.begin() + 2);  // without depth
  for (Frame& frame : before.frames) frame.depth_time = frame.color_time;
  for (int run = 0; run < 20;
       ++run) {  // the library's recorder shifted them in one of six runs on a busy machine
    export_oni(before, file_);
    const LightStack after = import_oni(file_, {});
    ASSERT_EQ(after.frames.size(), before.frames.size());
    for (std::size_t k = 0; k < before.frames.size(); ++k) {
      EXPECT_EQ(cv::norm(after.frames[k].color, before.frames[k].color, cv::NORM_INF), 0) << run << ", " << k;
      EXPECT_EQ(cv::norm(after.frames[k].depth, 10 * before.frames[k].depth, cv::NORM_INF), 0)
          << run << ", " << k;
    }
  }
}

TEST_F(OniFile, TheKnownLossesAreThese) {
  export_oni(recorded_stack(), file_);
  const LightStack after = import_oni(file_, {});
  EXPECT_NEAR(after.color_camera.fx, 57, 0.01);
  EXPECT_NEAR(after.color_camera.cx, 31.5, 0.01) << "the principal point is lost";
  EXPECT_TRUE(after.color_camera.distortion.empty());
  EXPECT_EQ(after.lights.size(), 3u) << "which lamp was lit is lost";
  EXPECT_EQ(after.frames[0].light, "frame-0000");
  EXPECT_EQ(after.frames[2].index, 2) << "gaps in the numbers are lost";
  EXPECT_EQ(after.frames[0].color_time.device_us, 0) << "each stream's clock starts at 0";
  EXPECT_EQ(after.frames[0].depth_time.device_us, 0) << "and the streams' offset is lost";
  EXPECT_EQ(after.frames[1].color_time.device_us, 100000);
}

TEST_F(OniFile, AListOfLightsNamesTheFramesAgain) {
  export_oni(recorded_stack(), file_);
  const LightStack after = import_oni(file_, {{"dark", "red", "white-0"}, 1});
  ASSERT_EQ(after.lights.size(), 2u);
  EXPECT_EQ(after.lights[0].color, LampColor::red);
  EXPECT_FALSE(after.frames[0].light);
  EXPECT_EQ(after.frames[2].light, "white-0");
  EXPECT_THAT(test::message_of<InputError>([&] {
                import_oni(file_, {{"a", "b", "c", "d"}, 1});
              }),
              HasSubstr("holds 3 pairs of frames, but 4 lights are listed"));
}

TEST_F(OniFile, RefusesWhatIsNoRecording) {
  EXPECT_THAT(test::message_of<InputError>([&] { import_oni(file_, {}); }), HasSubstr("no such file"));
  std::ofstream(file_) << "not a recording";
  EXPECT_THAT(test::message_of<InputError>([&] { import_oni(file_, {}); }),
              HasSubstr("is no OpenNI2 recording"));
}

TEST(ReplaySource, GivesTheStacksFramesInOrderWithItsTimes) {
  const auto source = open_replay_source(recorded_stack());
  EXPECT_FALSE(source->describe().live);
  source->start();
  const std::chrono::milliseconds none(0);
  EXPECT_EQ(source->next(Stream::color, none)->index, 0);
  EXPECT_EQ(source->next(Stream::color, none)->device_us, 1100000);
  for (const int index : {0, 3, 9}) EXPECT_EQ(source->next(Stream::depth, none)->index, index);
  EXPECT_FALSE(source->next(Stream::depth, none));
}

}  // namespace
}  // namespace rakelight
