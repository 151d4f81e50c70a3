// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The real OpenNI2 with the virtual sensor's driver.
#include "capture/openni_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <system_error>
#include <thread>

#include "capture/open_rig.h"
#include "tests/support/message_of.h"

namespace rakelight {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::HasSubstr;

/// The virtual rig, small: it renders in a blink.
Rig small_rig() {
  Rig rig = virtual_rig();
  rig.sensor.color.width = rig.sensor.depth.width = 320;
  rig.sensor.color.height = rig.sensor.depth.height = 240;
  rig.sensor.readout_us = 10000;
  rig.virtual_rig->lamp_latency_us = 1000;
  return rig;
}

SensorFrame take(FrameSource& source, Stream stream = Stream::color) {
  auto frame = source.next(stream, milliseconds(1400));
  if (!frame) throw std::runtime_error("no frame came");
  return *std::move(frame);
}

/// The mean of the first frame that opens after all that has been done so far.
cv::Scalar settled_mean(FrameSource& source) {
  const auto now =
      std::chrono::duration_cast<std::chrono::microseconds>(steady_clock::now().time_since_epoch());
  for (;;) {
    const SensorFrame frame = take(source);
    if (frame.host_us > now.count() + 150000) return cv::mean(frame.image);
  }
}

TEST(OpenniSource, FramesOfBothStreamsComeInOrderWithoutGapsThoughTheReaderIsSlow) {
  const auto source = open_frame_source(small_rig());
  source->start();
  for (const Stream stream : {Stream::color, Stream::depth}) {
    SensorFrame before = take(*source, stream);
    for (int k = 0; k < 15; ++k) {
      if (k % 5 == 0) std::this_thread::sleep_for(milliseconds(120));
      const SensorFrame frame = take(*source, stream);
      EXPECT_EQ(frame.index, before.index + 1);
      EXPECT_NEAR(static_cast<double>(frame.device_us - before.device_us), 33333, 2);
      EXPECT_GE(frame.host_us, before.host_us);
      before = frame;
    }
    EXPECT_EQ(source->overruns(stream), 0);
  }
}

TEST(OpenniSource, SaysWhatItIs) {
  const Rig rig = small_rig();
  const auto source = open_frame_source(rig);
  const SourceDescription description = source->describe();
  EXPECT_EQ(description.color_camera.width, 320);
  EXPECT_NEAR(description.color_camera.fx, 285, 0.01);
  EXPECT_DOUBLE_EQ(description.depth_unit_m, 1e-4);
  EXPECT_TRUE(description.depth_registered_to_color);
  EXPECT_TRUE(description.T_color_depth.isIdentity());
  EXPECT_TRUE(description.live);
  EXPECT_EQ(description.sensor.vendor, "Rakelight");
}

TEST(OpenniSource, ALampLightsThePictureAndOnlyItsChannel) {
  const Rig rig = small_rig();
  const auto lights = open_lights(rig);
  const auto source = open_frame_source(rig);
  source->start();
  source->lock_exposure(8000, 100);
  const cv::Scalar dark = settled_mean(*source);
  lights->show({"green"});
  const cv::Scalar green = settled_mean(*source);
  lights->show({"white-03"});
  const cv::Scalar white = settled_mean(*source);
  lights->all_off();
  const cv::Scalar dark_again = settled_mean(*source);
  EXPECT_NEAR(green[0], dark[0], 1);
  EXPECT_GT(green[1], 3 * dark[1]);
  for (int c = 0; c < 3; ++c) EXPECT_GT(white[c], 3 * dark[c]) << c;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(dark_again[c], dark[c], 1) << c;
}

TEST(OpenniSource, TheExposureIsLockedReportedAndSeenInThePixels) {
  const Rig rig = small_rig();
  const auto lights = open_lights(rig);
  const auto source = open_frame_source(rig);
  source->start();
  lights->show({"white-00"});
  const ExposureLock lock = source->lock_exposure(8000, 100);
  EXPECT_TRUE(lock.auto_exposure_off);
  EXPECT_TRUE(lock.auto_white_balance_off);
  EXPECT_DOUBLE_EQ(lock.exposure_us.value(), 8000);
  EXPECT_DOUBLE_EQ(lock.gain.value(), 100);
  const cv::Scalar whole = settled_mean(*source);
  source->lock_exposure(4000, 100);
  EXPECT_NEAR(settled_mean(*source)[1] / whole[1], 0.5, 0.06);
  EXPECT_NEAR(source->lock_exposure(60000, 100).exposure_us.value(), 33333, 1) << "says so where it cannot";
}

TEST(OpenniSource, ASensorThatIgnoresItsExposureShowsItInThePixels) {
  Rig rig = small_rig();
  rig.virtual_rig->ignores_exposure = true;
  const auto lights = open_lights(rig);
  const auto source = open_frame_source(rig);
  source->start();
  lights->show({"white-00"});
  source->lock_exposure(8000, 100);
  const cv::Scalar whole = settled_mean(*source);
  source->lock_exposure(4000, 100);
  EXPECT_NEAR(settled_mean(*source)[1], whole[1], 2);
}

TEST(OpenniSource, AnUnpluggedSensorIsLostWithinTwoSecondsAndWhatHadComeIsKept) {
  Rig rig = small_rig();
  rig.virtual_rig->unplug_at_frame = 8;
  const auto lights = open_lights(rig);
  const auto source = open_frame_source(rig);
  source->start();
  lights->show({"white-00"});
  int frames = 0;
  auto last = steady_clock::now();
  const auto read_on = [&] {
    for (;;) {
      if (source->next(Stream::color, milliseconds(50))) ++frames, last = steady_clock::now();
    }
  };
  EXPECT_THAT(test::message_of<SensorLost>(read_on), HasSubstr("unplugged"));
  EXPECT_EQ(frames, 8);
  EXPECT_LT(steady_clock::now() - last, milliseconds(2000));
  EXPECT_NO_THROW(lights->all_off());
}

TEST(OpenniSource, AfterAnUnplugTheSensorCanBeOpenedAnew) {
  Rig rig = small_rig();
  rig.virtual_rig->unplug_at_frame = 2;
  {
    const auto source = open_frame_source(rig);
    source->start();
    EXPECT_THROW(while (true) source->next(Stream::color, milliseconds(50)), SensorLost);
  }
  rig.virtual_rig->unplug_at_frame = -1;
  const auto source = open_frame_source(rig);
  source->start();
  for (int k = 0; k < 5; ++k) take(*source);
}

TEST(OpenniSource, DroppedFramesAreJumpsOfTheIndex) {
  Rig rig = small_rig();
  rig.virtual_rig->drop_share = 0.3;
  const auto source = open_frame_source(rig);
  source->start();
  SensorFrame before = take(*source);
  int missing = 0;
  for (int k = 0; k < 30; ++k) {
    const SensorFrame frame = take(*source);
    missing += frame.index - before.index - 1;
    EXPECT_NEAR(static_cast<double>(frame.device_us - before.device_us),
                33333.3 * (frame.index - before.index), 2);
    before = frame;
  }
  EXPECT_GT(missing, 2);
}

TEST(OpenniSource, ModesThatTheSensorDoesNotHaveAreRefusedWithThoseItHas) {
  Rig rig = small_rig();
  rig.sensor.depth.fps = 60;
  EXPECT_THAT(test::message_of<std::system_error>([&] { open_frame_source(rig); }),
              HasSubstr("no depth mode 320x240@60; write one of these into the rig file: 320x240@30"));
  rig.sensor.uri = "1d27/0601@1/1";
  rig.virtual_rig.reset();
  EXPECT_THAT(test::message_of<std::system_error>([&] { open_frame_source(rig); }),
              HasSubstr("cannot open the sensor 1d27/0601@1/1"));
}

TEST(OpenniSource, WithACalibrationOfItsOwnTheDepthStaysUnregistered) {
  Rig rig = small_rig();
  const auto first_column = [](FrameSource& source) {
    source.start();
    cv::Mat1b columns;
    cv::reduce(take(source, Stream::depth).image > 0, columns, 0, cv::REDUCE_MAX);
    return std::distance(columns.begin(), std::find(columns.begin(), columns.end(), 255));
  };
  const auto registered = first_column(*open_frame_source(rig));
  rig.calibration.T_color_depth = Eigen::Matrix4d::Identity();
  (*rig.calibration.T_color_depth)(0, 3) = 0.025;
  const auto source = open_frame_source(rig);
  EXPECT_FALSE(source->describe().depth_registered_to_color);
  EXPECT_DOUBLE_EQ(source->describe().T_color_depth(0, 3), 0.025);
  // f b / z = 285 * 0.025 / 1 = 7 pixels
  EXPECT_NEAR(static_cast<double>(first_column(*source)), static_cast<double>(registered - 7), 2);
}

}  // namespace
}  // namespace rakelight
