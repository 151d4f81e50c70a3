// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/importers/diligent.h"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>

#include "stack/check.h"
#include "stack/errors.h"
#include "stack/stack_io.h"
#include "tests/support/file_edits.h"
#include "tests/support/message_of.h"
#include "tests/support/small_stack.h"
#include "tests/support/temporary_folder.h"

namespace rakelight {
namespace {

using test::message_of;
using testing::AllOf;
using testing::HasSubstr;

class Diligent : public testing::Test {
 protected:
  void SetUp() override {
    // OpenCV writes blue first: red 1000, green 2000, blue 65500.
    cv::imwrite((source / "001.png").string(), cv::Mat(6, 8, CV_16UC3, cv::Scalar(65500, 2000, 1000)));
    cv::imwrite((source / "002.png").string(), cv::Mat(6, 8, CV_16UC3, cv::Scalar(500, 600, 700)));
    cv::imwrite((source / "mask.png").string(), cv::Mat1b(6, 8, std::uint8_t{255}));
    test::set_text(source / "filenames.txt", "001.png\r\n002.png\r\n");
    test::set_text(source / "light_directions.txt", "0.6 0 0.8\n0 2 0\n");
    test::set_text(source / "light_intensities.txt", "2 4 8\n1 1 1\n");
  }
  std::string refusal() const {
    return message_of<InputError>([&] { read_stack(source.path()); });
  }

  test::TemporaryFolder source;
};

TEST_F(Diligent, images_are_divided_by_their_lamps_and_saturated_codes_stay_so) {
  const LightStack stack = read_stack(source.path());
  ASSERT_EQ(stack.frames.size(), 2u);
  EXPECT_EQ(stack.frames[0].color.at<cv::Vec3w>(0, 0), cv::Vec3w(500, 500, 65535));
  EXPECT_EQ(stack.frames[1].color.at<cv::Vec3w>(0, 0), cv::Vec3w(700, 600, 500));
  EXPECT_EQ(stack.color_response.kind, ColorResponse::Kind::linear);
}

TEST_F(Diligent, images_of_8_bits_become_16) {
  cv::imwrite((source / "001.png").string(), cv::Mat(6, 8, CV_8UC3, cv::Scalar(80, 40, 20)));
  EXPECT_EQ(read_stack(source.path()).frames[0].color.at<cv::Vec3w>(0, 0),
            cv::Vec3w(10 * 257, 10 * 257, 10 * 257));
}

TEST_F(Diligent, directions_are_kept_in_camera_coordinates) {
  const LightStack stack = read_stack(source.path());
  EXPECT_THAT(stack.unknown_keys, AllOf(HasSubstr(R"("lamp-1":{"direction_to_lamp":[0.6,-0.0,-0.8]})"),
                                        HasSubstr(R"("lamp-2":{"direction_to_lamp":[0.0,-1.0,-0.0]})")));
  const test::TemporaryFolder home;
  write_stack(stack, home / "stack");
  test::expect_same(stack, read_stack(home / "stack"));
}

TEST_F(Diligent, without_a_matrix_the_published_camera_is_assumed_and_said) {
  const LightStack stack = read_stack(source.path());
  EXPECT_EQ(stack.color_camera.fx, 3772.1);
  EXPECT_EQ(stack.color_camera.fy, 3759.0);
  EXPECT_EQ(stack.color_camera.cx, 3.5);
  EXPECT_THAT(stack.sensor.name, HasSubstr("assumed"));
  test::set_text(source / "K.txt", "100 0 4\n0 101 3\n0 0 1\n");
  const LightStack calibrated = read_stack(source.path());
  EXPECT_EQ(calibrated.color_camera.fy, 101);
  EXPECT_EQ(calibrated.color_camera.cx, 4);
  EXPECT_EQ(calibrated.sensor.name, "");
}

TEST_F(Diligent, having_no_depth_is_said_by_the_check) {
  const LightStack stack = read_stack(source.path());
  EXPECT_THAT(message_of<InputError>([&] { check_stack(stack); }), HasSubstr("no depth image"));
}

TEST_F(Diligent, lists_of_different_length_are_refused) {
  test::set_text(source / "light_directions.txt", "0 0 1\n");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("light_directions.txt"), HasSubstr("1 lines for 2 images")));
  test::set_text(source / "light_directions.txt", "0 0 1\n0 1\n");
  EXPECT_THAT(refusal(), HasSubstr("three numbers"));
}

TEST_F(Diligent, useless_numbers_are_refused) {
  test::set_text(source / "light_intensities.txt", "2 4 8\n1 0 1\n");
  EXPECT_THAT(refusal(), HasSubstr("not positive"));
  test::set_text(source / "light_intensities.txt", "2 4 8\n1 x 1\n");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("line 2"), HasSubstr("'x' is no number")));
  SetUp();
  test::set_text(source / "light_directions.txt", "0 0 1\n0 0 0\n");
  EXPECT_THAT(refusal(), HasSubstr("zero direction"));
}

TEST_F(Diligent, names_may_not_leave_the_folder) {
  test::set_text(source / "filenames.txt", "001.png\n../002.png\n");
  EXPECT_THAT(refusal(), HasSubstr("leaves the folder"));
  test::set_text(source / "filenames.txt", "\n\n");
  EXPECT_THAT(refusal(), HasSubstr("1 to 4096"));
}

}  // namespace
}  // namespace rakelight
