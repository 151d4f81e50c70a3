// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/check.h"

#include <gmock/gmock.h>

#include "stack/errors.h"
#include "stack/summary.h"
#include "tests/support/message_of.h"
#include "tests/support/small_stack.h"

namespace rakelight {
namespace {

using test::message_of;
using test::small_stack;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

class CheckStack : public testing::Test {
 protected:
  std::string refusal() const {
    return message_of<InputError>([&] { check_stack(stack); });
  }
  void fill_color(const cv::Scalar& value) {
    for (Frame& frame : stack.frames) frame.color.setTo(value);
  }

  LightStack stack = small_stack();
};

TEST_F(CheckStack, a_good_stack_passes_with_and_without_mask) {
  EXPECT_NO_THROW(check_stack(stack));
  stack.mask = cv::Mat1b();
  EXPECT_NO_THROW(check_stack(stack));
}

TEST_F(CheckStack, a_mask_of_depths_size_passes) {
  stack.mask = cv::Mat1b(8, 12, std::uint8_t{255});
  EXPECT_NO_THROW(check_stack(stack));
}

TEST_F(CheckStack, sizes_that_do_not_match_are_named) {
  stack.origin = "my-scan";
  stack.frames[2].color = cv::Mat(7, 9, CV_8UC3, cv::Scalar::all(1));
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("my-scan"), HasSubstr("frame 2"), HasSubstr("9 x 7"), HasSubstr("24 x 16")));
  stack = small_stack();
  stack.frames[1].depth = cv::Mat1w(16, 24, std::uint16_t{1});
  EXPECT_THAT(refusal(), HasSubstr("depth of frame 1"));
  stack = small_stack();
  stack.mask = cv::Mat1b(9, 9, std::uint8_t{255});
  EXPECT_THAT(refusal(), HasSubstr("mask's size 9 x 9"));
}

TEST_F(CheckStack, an_empty_or_one_pixel_mask_is_refused) {
  stack.mask.setTo(0);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("mask is empty"), HasSubstr("255")));
  stack.mask(3, 3) = 255;
  EXPECT_THAT(refusal(), HasSubstr("only 1 pixels"));
}

TEST_F(CheckStack, a_mask_where_no_depth_reaches_is_refused) {
  for (Frame& frame : stack.frames) {
    if (!frame.depth.empty()) frame.depth(cv::Rect(0, 0, 6, 8)) = 0;
  }
  stack.mask.setTo(0);
  stack.mask(cv::Rect(0, 0, 8, 16)) = 255;
  EXPECT_THAT(refusal(), HasSubstr("no readings where the mask"));
  stack.mask(cv::Rect(14, 0, 8, 16)) = 255;
  EXPECT_NO_THROW(check_stack(stack));
}

TEST_F(CheckStack, no_depth_and_zero_depth_are_told_apart) {
  for (Frame& frame : stack.frames) {
    if (!frame.depth.empty()) frame.depth.setTo(0);
  }
  EXPECT_THAT(refusal(), HasSubstr("every depth value is 0"));
  for (Frame& frame : stack.frames) frame.depth = cv::Mat1w();
  EXPECT_THAT(refusal(), HasSubstr("no depth image"));
}

TEST_F(CheckStack, images_that_are_all_black_or_all_saturated_are_refused) {
  fill_color(cv::Scalar::all(0));
  EXPECT_THAT(refusal(), HasSubstr("every image is black"));
  fill_color(cv::Scalar::all(65535));
  EXPECT_THAT(refusal(), HasSubstr("every image is saturated"));
  stack.frames[0].color.setTo(cv::Scalar::all(0));
  EXPECT_THAT(refusal(), HasSubstr("black or saturated"));
  stack.frames[1].color = small_stack().frames[1].color;
  EXPECT_NO_THROW(check_stack(stack)) << "one usable image is for the method to judge";
}

TEST_F(CheckStack, a_stack_of_dark_frames_only_is_refused) {
  for (Frame& frame : stack.frames) frame.light.reset();
  EXPECT_THAT(refusal(), HasSubstr("no colour image under a lamp"));
}

TEST_F(CheckStack, what_lies_outside_the_mask_does_not_count) {
  for (Frame& frame : stack.frames) frame.color.setTo(cv::Scalar::all(0), stack.mask);
  EXPECT_THAT(refusal(), HasSubstr("black"));
  EXPECT_TRUE(is_black(stack, stack.frames[0]));
}

TEST(Summary, counts_what_the_stack_holds) {
  const LightStack stack = small_stack(8);
  const StackSummary summary = summarise(stack);
  EXPECT_EQ(summary.color_images, 5);
  EXPECT_EQ(summary.dark_images, 1);
  EXPECT_EQ(summary.depth_images, 4);
  EXPECT_EQ(summary.color_bits, 8);
  EXPECT_EQ(summary.object_pixels, 240);
  EXPECT_GT(summary.depth_coverage, 0.9);
  EXPECT_GE(summary.nearest_m, 0.9);
  EXPECT_LE(summary.farthest_m, 1.1);
  EXPECT_EQ(summary.lit_checked, 1);
  EXPECT_EQ(summary.lit_matching, 1);
  EXPECT_TRUE(summary.warnings.empty());
}

TEST(Summary, warns_of_what_a_person_should_mind) {
  LightStack stack = small_stack(8);
  stack.frames[0].color.setTo(cv::Scalar::all(255));
  stack.frames[2].color.setTo(cv::Scalar::all(0));
  stack.frames[1].lit_check->matches = false;
  const StackSummary summary = summarise(stack);
  EXPECT_EQ(summary.worst_light, "red");
  EXPECT_DOUBLE_EQ(summary.saturated_worst, 1);
  EXPECT_THAT(summary.warnings, Contains(HasSubstr("lamp red")));
  EXPECT_THAT(summary.warnings, Contains(HasSubstr("Lamp all left no light")));
  EXPECT_THAT(summary.warnings, Contains(HasSubstr("wiring")));
  stack.mask = cv::Mat1b();
  for (Frame& frame : stack.frames) frame.depth = cv::Mat1w();
  EXPECT_THAT(summarise(stack).warnings, Contains(HasSubstr("no mask")));
  EXPECT_THAT(summarise(stack).warnings, Contains(HasSubstr("cannot be refined")));
}

}  // namespace
}  // namespace rakelight
