// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command on bad input and without a display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "stack/stack_io.h"
#include "tests/support/bump_stack.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/virtual_screen.h"

namespace rakelight {
namespace {

using test::run;
using testing::HasSubstr;

class View : public testing::Test {
 protected:
  void SetUp() override {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    write_stack(test::bump_stack(), scan_);
  }
  void TearDown() override {
    unsetenv("LIBGL_DRIVERS_PATH");
    unsetenv("MESA_GL_VERSION_OVERRIDE");
    unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  }
  test::TemporaryFolder folder_;
  const std::filesystem::path scan_ = folder_ / "scan";
  test::Ran view(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "view");
    return run(arguments);
  }
  static void expect_one_line(const test::Ran& ran, int exit_code, const std::string& words) {
    EXPECT_EQ(ran.exit_code, exit_code) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(words));
  }
};

TEST_F(View, TakesAPictureWithoutADisplayAndSaysHow) {
  const auto ran = view({scan_, "--screenshot", folder_ / "p.png", "--size", "160x120"});
  if (ran.exit_code == 4) GTEST_SKIP() << "no OpenGL: " << ran.err;
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("p.png: 160x120, drawn by "));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "p.png"));
}

TEST_F(View, DrawsInAHiddenWindowWhereThereIsNoEgl) {
  if (!test::VirtualScreen::is_available()) GTEST_SKIP() << "no Xvfb or no xdotool here";
  const test::VirtualScreen screen(320, 240);
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null", 1);
  const auto ran = view({scan_, "--screenshot", folder_ / "p.png", "--size", "160x120"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("drawn by a hidden window on"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "p.png"));
}

TEST_F(View, FindsTheScanOfAResultForWhatTheResultLacks) {
  ASSERT_EQ(run({"refine", scan_, "-o", folder_ / "out", "--iterations", "1"}).exit_code, 0);
  const auto ran =
      view({folder_ / "out", "--layer", "sensor", "--screenshot", folder_ / "p.png", "--size", "160x120"});
  if (ran.exit_code == 4) GTEST_SKIP() << "no OpenGL: " << ran.err;
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  std::filesystem::rename(scan_, folder_ / "elsewhere");
  expect_one_line(view({folder_ / "out", "--layer", "sensor", "--screenshot", folder_ / "p.png"}), 2,
                  "--stack");
}

TEST_F(View, RefusesAHalfWrittenResult) {
  ASSERT_EQ(run({"refine", scan_, "-o", folder_ / "out", "--iterations", "1"}).exit_code, 0);
  std::filesystem::remove(folder_ / "out/result.json");
  expect_one_line(view({folder_ / "out", "--screenshot", folder_ / "p.png"}), 3, "is an unfinished result");
}

TEST_F(View, RefusesAFolderThatIsNeitherScanNorResult) {
  expect_one_line(view({folder_.path(), "--screenshot", folder_ / "p.png"}), 3, "is neither a stack");
}

TEST_F(View, RefusesAScanWithoutOneDepthReading) {
  LightStack stack = test::bump_stack();
  for (Frame& frame : stack.frames) frame.depth.setTo(0);
  write_stack(stack, folder_ / "blind");
  expect_one_line(view({folder_ / "blind", "--screenshot", folder_ / "p.png"}), 3, "not one pixel has depth");
}

TEST_F(View, WithoutAnOpenGlDriverSaysWhatToInstall) {
  setenv("LIBGL_DRIVERS_PATH", "/nonexistent", 1);
  expect_one_line(view({scan_, "--screenshot", folder_ / "p.png"}), 4, "install an OpenGL 3.3 driver");
}

TEST_F(View, WithTooOldAnOpenGlSaysSo) {
  setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);
  expect_one_line(view({scan_, "--screenshot", folder_ / "p.png"}), 4, "OpenGL");
}

TEST_F(View, WithoutADisplayTheWindowIsRefused) {
  expect_one_line(view({scan_}), 4, "no display for a window");
}

TEST_F(View, RefusesArgumentsThatMeanNothing) {
  const std::string picture = folder_ / "p.png";
  expect_one_line(view({scan_, "--screenshot", picture, "--size", "12"}), 2, "--size");
  expect_one_line(view({scan_, "--screenshot", picture, "--size", "5x99999"}), 2, "--size");
  expect_one_line(view({scan_, "--screenshot", picture, "--light", "10"}), 2, "--light");
  expect_one_line(view({scan_, "--screenshot", picture, "--color", "pink"}), 2, "--color");
  expect_one_line(view({scan_, "--screenshot", picture, "--color", "image:x"}), 2, "image:NUMBER");
  expect_one_line(view({scan_, "--screenshot", picture, "--color", "image:99"}), 2, "image 99");
  expect_one_line(view({scan_, "--screenshot", picture, "--layer", "refined"}), 2, "no layer refined");
  expect_one_line(view({scan_, "--screenshot", folder_ / "p.jpg"}), 2, ".png");
  expect_one_line(view({scan_, "--turntable", "4"}), 2, "--screenshot");
}

}  // namespace
}  // namespace rakelight
