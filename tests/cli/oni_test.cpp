// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include <opencv2/core.hpp>

#include "stack/stack_io.h"
#include "tests/support/file_edits.h"
#include "tests/support/run_program.h"
#include "tests/support/small_stack.h"
#include "tests/support/temporary_folder.h"

namespace rakelight::test {
namespace {

using testing::HasSubstr;

/// A dark frame and one of a lamp, depth in units of 0.1 mm as a recording has it.
LightStack two_frames() {
  LightStack stack;
  stack.created = "2026-01-02T03:04:05Z";
  stack.color_camera = stack.depth_camera = {64, 48, 57, 57, 32, 24, {}};
  stack.depth_unit_m = 1e-4;
  stack.lights = {{"left", LampColor::white, {}, {}}};
  cv::RNG random(3);
  for (int k = 0; k < 2; ++k) {
    Frame frame;
    frame.index = k;
    if (k == 1) frame.light = "left";
    frame.color.create(48, 64, CV_8UC3);
    random.fill(frame.color, cv::RNG::UNIFORM, 0, 256);
    frame.depth.create(48, 64);
    random.fill(frame.depth, cv::RNG::UNIFORM, 5000, 15000);
    frame.color_time.device_us = 1000000 + 100000 * k;
    frame.depth_time.device_us = 1007000 + 100000 * k;
    stack.frames.push_back(frame);
  }
  return stack;
}

TEST(Oni, ExportedAndImportedAgainKeepsPixelsAndTakesTheLampsItIsTold) {
  const TemporaryFolder home;
  const LightStack before = two_frames();
  write_stack(before, home / "scan");
  const Ran exported = run({"export", "oni", home / "scan", "-o", home / "scan.oni"});
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_THAT(exported.out, HasSubstr("scan.oni"));
  const Ran imported =
      run({"import", "oni", home / "scan.oni", "-o", home / "again", "--lights", "dark,left"});
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_EQ(run({"verify", home / "again"}).exit_code, 0);
  const LightStack after = read_stack(home / "again");
  ASSERT_EQ(after.frames.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(after.frames[k].light, before.frames[k].light);
    EXPECT_TRUE(same_pixels(after.frames[k].color, before.frames[k].color)) << k;
    EXPECT_TRUE(same_pixels(after.frames[k].depth, before.frames[k].depth)) << k;
  }
}

TEST(Oni, WhatIsNoRecordingIsRefusedByName) {
  const TemporaryFolder home;
  set_text(home / "notes.oni", "mine");
  const Ran ran = run({"import", "oni", home / "notes.oni", "-o", home / "stack"});
  EXPECT_NE(ran.exit_code, 0);
  EXPECT_THAT(ran.err, HasSubstr("notes.oni"));
  EXPECT_FALSE(std::filesystem::exists(home / "stack"));
  EXPECT_EQ(run({"export", "oni", home / "nowhere", "-o", home / "x.oni"}).exit_code, 3);
  EXPECT_EQ(run({"export", "tape", home / "nowhere", "-o", home / "x"}).exit_code, 2);
}

}  // namespace
}  // namespace rakelight::test
