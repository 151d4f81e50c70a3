// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Folders dropped on the window: what its drop handler does with them. Skipped aloud without Xvfb.
#include <gmock/gmock.h>

#include <memory>

#include "refine/output/result_io.h"
#include "stack/stack_io.h"
#include "tests/support/bump_stack.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/virtual_screen.h"
#include "tests/viewer/bump_result.h"
#include "viewer/window/viewer_window.h"

namespace rakelight {
namespace {

using testing::HasSubstr;

class DroppedFolder : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::VirtualScreen::is_available()) GTEST_SKIP() << "no Xvfb or no xdotool here";
    screen_ = std::make_unique<test::VirtualScreen>(320, 240);
    window_ = std::make_unique<ViewerWindow>("test", cv::Size(320, 240));
    const Scene scene = test::bump_scene();
    window_->show(scene, default_look(scene), {}, false);
  }
  test::TemporaryFolder folder_;
  std::unique_ptr<test::VirtualScreen> screen_;
  std::unique_ptr<ViewerWindow> window_;
};

TEST_F(DroppedFolder, IsOpened) {
  write_stack(test::bump_stack(), folder_ / "scan");
  window_->open(folder_ / "scan");
  EXPECT_EQ(window_->title(), folder_ / "scan");
  EXPECT_THAT(window_->status(), HasSubstr("opened"));
  EXPECT_TRUE(window_->step(0));
}

TEST_F(DroppedFolder, ThatIsNeitherScanNorResultLeavesWhatIsShown) {
  window_->open(folder_.path());
  EXPECT_EQ(window_->title(), "bump");
  EXPECT_THAT(window_->status(), HasSubstr("is neither a stack"));
  EXPECT_TRUE(window_->step(0));
}

TEST_F(DroppedFolder, WithoutADepthReadingLeavesWhatIsShown) {
  LightStack stack = test::bump_stack();
  for (Frame& frame : stack.frames) frame.depth.setTo(0);
  write_stack(stack, folder_ / "blind");
  window_->open(folder_ / "blind");
  EXPECT_EQ(window_->title(), "bump");
  EXPECT_THAT(window_->status(), HasSubstr("not one pixel has depth"));
  EXPECT_TRUE(window_->step(0));
}

}  // namespace
}  // namespace rakelight
