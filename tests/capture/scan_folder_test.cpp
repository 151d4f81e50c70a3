// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/scan_folder.h"

#include <gmock/gmock.h>

#include <fstream>

#include "capture/capture.h"
#include "stack/errors.h"
#include "stack/stack_io.h"
#include "tests/capture/simulated_rig.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace rakelight {
namespace {

namespace fs = std::filesystem;
using test::simulated_rig;
using test::SimulatedRig;
using test::SimulatedRigOptions;

/// Scans into `folder`; whatever ends the scan is passed on when all frames are written.
ScanResult scan_into(ScanFolder& folder, SimulatedRig& simulated, const Rig& rig,
                     const ScanProgressCallback& progress = {}) {
  ScanOptions options;
  options.resume = folder.unfinished();
  options.on_frame = [&](const ScanState& state, const Frame& frame) { folder.record(state, frame); };
  try {
    return capture_stack({simulated.source(), simulated.lights(), simulated.clock}, rig, options, progress);
  } catch (...) {
    folder.flush();
    throw;
  }
}

SimulatedRigOptions unplugged_in_the_sequence() {
  SimulatedRigOptions world;
  world.noise = 0;
  world.unplug_at_frame = 115;
  return world;
}

class ScanFolderTest : public testing::Test {
 protected:
  SimulatedRigOptions world = unplugged_in_the_sequence();
  Rig rig = simulated_rig(world);
  test::TemporaryFolder temporary;
  fs::path target = temporary.path() / "scan";
};

std::string names_of(const LightStack& stack) {
  std::string names;
  for (const Frame& frame : stack.frames) {
    names += std::to_string(frame.index) + ":" + frame.light.value_or("dark") +
             (frame.color.empty() ? " " : "c") + (frame.depth.empty() ? " " : "d") + " ";
  }
  return names;
}

TEST_F(ScanFolderTest, AnUnpluggedScanKeepsItsFramesAndResumingCompletesItToTheSameStack) {
  SimulatedRig simulated(rig, world);
  {
    ScanFolder folder(target, false);
    EXPECT_THROW(scan_into(folder, simulated, rig), SensorLost);
    EXPECT_THAT(folder.frames_kept(), testing::AllOf(testing::Gt(3), testing::Lt(17)));
  }
  EXPECT_TRUE(simulated.lit_now().empty());
  EXPECT_FALSE(fs::exists(target / "stack.json"));
  simulated.plug_in();
  {
    ScanFolder folder(target, true);
    ASSERT_TRUE(folder.unfinished());
    folder.finish(scan_into(folder, simulated, rig).stack);
  }
  const LightStack resumed = read_stack(target);

  world.unplug_at_frame = -1;
  SimulatedRig whole(rig, world);
  ScanFolder folder(temporary.path() / "whole", false);
  const LightStack expected = scan_into(folder, whole, rig).stack;
  EXPECT_EQ(names_of(resumed), names_of(expected));
  for (std::size_t i = 0; i < expected.frames.size(); ++i) {
    EXPECT_EQ(cv::norm(resumed.frames[i].color, expected.frames[i].color, cv::NORM_INF), 0) << i;
    EXPECT_EQ(cv::norm(resumed.frames[i].depth, expected.frames[i].depth, cv::NORM_INF), 0) << i;
  }
  EXPECT_EQ(resumed.exposure_us, expected.exposure_us);
}

TEST_F(ScanFolderTest, TheLossIsNoticedWithinTwoSeconds) {
  world.unplug_at_frame = 60;
  SimulatedRig simulated(rig, world);
  std::int64_t last_frame_us = 0;
  int frames = 0;
  const auto watch = [&](const ScanProgress&) {
    if (simulated.frames_delivered() != frames) last_frame_us = simulated.clock.now_us();
    frames = simulated.frames_delivered();
    return true;
  };
  ScanFolder folder(target, false);
  EXPECT_THROW(scan_into(folder, simulated, rig, watch), SensorLost);
  EXPECT_LT(simulated.clock.now_us() - last_frame_us, 2'000'000);
  EXPECT_TRUE(simulated.lit_now().empty());
}

TEST_F(ScanFolderTest, AScanThatIsStoppedAtAnyMomentLeavesTheLampsOffAndCanBeResumed) {
  world.unplug_at_frame = -1;
  SimulatedRig simulated(rig, world);
  for (int asked_at = 20; asked_at < 4000; asked_at += 397) {
    int asked = 0;
    ScanFolder folder(target, true);
    try {
      folder.finish(
          scan_into(folder, simulated, rig, [&](const ScanProgress&) { return ++asked < asked_at; }).stack);
      break;
    } catch (const Cancelled&) { EXPECT_TRUE(simulated.lit_now().empty()); }
  }
  EXPECT_EQ(read_stack(target).frames.size(), 34U);
}

TEST_F(ScanFolderTest, AFinishedStackIsReplacedOnlyWhenTheNewOneIsWhole) {
  world.unplug_at_frame = -1;
  SimulatedRig first(rig, world);
  {
    ScanFolder folder(target, false);
    folder.finish(scan_into(folder, first, rig).stack);
  }
  const std::string before = read_stack(target).created;
  world.unplug_at_frame = 115;
  SimulatedRig second(rig, world);
  {
    ScanFolder folder(target, false);
    EXPECT_THROW(scan_into(folder, second, rig), SensorLost);
  }
  EXPECT_EQ(read_stack(target).frames.size(), 34U);
  second.plug_in();
  ScanFolder folder(target, true);
  folder.finish(scan_into(folder, second, rig).stack);
  EXPECT_EQ(read_stack(target).frames.size(), 34U);
  EXPECT_FALSE(fs::exists(folder.place()));
}

TEST_F(ScanFolderTest, SecondWritersFoldersOfOthersAndForgottenResumesAreRefused) {
  SimulatedRig simulated(rig, world);
  {
    ScanFolder folder(target, false);
    EXPECT_THROW(ScanFolder(target, true), BusyError);
    EXPECT_THROW(scan_into(folder, simulated, rig), SensorLost);
  }
  EXPECT_THAT(test::message_of<InputError>([&] { ScanFolder(target, false); }),
              testing::HasSubstr("--resume"));
  fs::create_directory(temporary.path() / "mine");
  std::ofstream(temporary.path() / "mine" / "letter.txt") << "dear";
  EXPECT_THROW(ScanFolder(temporary.path() / "mine", false), InputError);
}

TEST_F(ScanFolderTest, AScanThatKeptNothingLeavesNoFolder) {
  { ScanFolder folder(target, false); }
  EXPECT_FALSE(fs::exists(target));
}

TEST_F(ScanFolderTest, AnUnfinishedScanOfOtherLampsIsNotGoneOnWith) {
  SimulatedRig simulated(rig, world);
  {
    ScanFolder folder(target, false);
    EXPECT_THROW(scan_into(folder, simulated, rig), SensorLost);
  }
  simulated.plug_in();
  Rig other = rig;
  other.lamps[2].id = "another";
  ScanFolder folder(target, true);
  EXPECT_THROW(scan_into(folder, simulated, other), UsageError);
}

TEST_F(ScanFolderTest, ADamagedStateIsNamed) {
  SimulatedRig simulated(rig, world);
  {
    ScanFolder folder(target, false);
    EXPECT_THROW(scan_into(folder, simulated, rig), SensorLost);
  }
  fs::resize_file(target / "scan.json", fs::file_size(target / "scan.json") / 2);
  EXPECT_THAT(test::message_of<InputError>([&] { ScanFolder(target, true); }),
              testing::HasSubstr("scan.json"));
}

}  // namespace
}  // namespace rakelight
