// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/importers/photometric_sr.h"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>

#include "stack/check.h"
#include "stack/errors.h"
#include "stack/stack_io.h"
#include "tests/support/file_edits.h"
#include "tests/support/message_of.h"
#include "tests/support/shared_data.h"
#include "tests/support/small_stack.h"
#include "tests/support/temporary_folder.h"

namespace rakelight {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using testing::AllOf;
using testing::HasSubstr;

/// A source folder of eleven 8 x 6 images, each as bright as its number, and depth at half that size.
class PhotometricSr : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(source / "RGB");
    fs::create_directory(source / "Depth");
    for (int i = 1; i <= 11; ++i) {
      const std::string name = std::to_string(i) + ".png";
      cv::imwrite((source / "RGB" / ("I_" + name)).string(), cv::Mat(6, 8, CV_8UC3, cv::Scalar(3, 2, i)));
      if (i == 10) cv::imwrite((source / "Depth" / ("z0_" + name)).string(), depth);
    }
    cv::imwrite((source / "mask.png").string(), cv::Mat1b(6, 8, std::uint8_t{255}));
    write_calibration("2,0,2000");
  }
  void write_calibration(const std::string& last_row) const {
    test::set_text(source / "K.txt", "100,0,3.5\n0,110,2.5\n0,0,1\n" + last_row);
  }
  std::string refusal() const {
    return message_of<InputError>([&] { read_stack(source.path()); });
  }

  test::TemporaryFolder source;
  cv::Mat1w depth = (cv::Mat1w(3, 4) << 0, 1, 32768, 65535, 0, 0, 0, 0, 0, 0, 0, 0);
};

TEST_F(PhotometricSr, images_come_in_natural_order_and_depth_with_its_number) {
  const LightStack stack = read_stack(source.path());
  ASSERT_EQ(stack.frames.size(), 11u);
  for (int i = 0; i < 11; ++i) {
    const Frame& frame = stack.frames[std::size_t(i)];
    EXPECT_EQ(frame.index, i + 1);
    EXPECT_EQ(frame.light, "I_" + std::to_string(i + 1));
    EXPECT_EQ(frame.color.at<cv::Vec3b>(0, 0), cv::Vec3b(std::uint8_t(i + 1), 2, 3)) << "red first";
    EXPECT_EQ(frame.depth.empty(), i != 9);
  }
  EXPECT_EQ(stack.lights.size(), 11u);
  EXPECT_EQ(stack.color_response.kind, ColorResponse::Kind::linear);
  EXPECT_EQ(stack.origin, source.path().string());
}

TEST_F(PhotometricSr, the_matrix_is_of_colour_and_depths_camera_is_binned) {
  const LightStack stack = read_stack(source.path());
  EXPECT_EQ(stack.color_camera.size(), cv::Size(8, 6));
  EXPECT_EQ(stack.color_camera.fx, 100);
  EXPECT_EQ(stack.color_camera.fy, 110);
  EXPECT_EQ(stack.depth_camera.size(), cv::Size(4, 3));
  EXPECT_EQ(stack.depth_camera.fx, 50);
  EXPECT_EQ(stack.depth_camera.cx, 1.5) << "(3.5 + 0.5) / 2 - 0.5";
  EXPECT_TRUE(stack.T_color_depth.isIdentity(0));
}

TEST_F(PhotometricSr, depth_is_in_millimetres_of_the_given_range) {
  LightStack stack = read_stack(source.path());
  EXPECT_DOUBLE_EQ(stack.frames[9].depth(0, 3) * stack.depth_unit_m, 2.0);
  EXPECT_TRUE(test::same_pixels(stack.frames[9].depth, depth)) << "min = 0: raw values are kept";
  write_calibration("2,500,2000");
  stack = read_stack(source.path());
  const cv::Mat1w& raw = stack.frames[9].depth;
  EXPECT_EQ(raw(0, 0), 0) << "no reading stays no reading";
  EXPECT_NEAR(raw(0, 1) * stack.depth_unit_m, 0.5 + 1.5 / 65535, 2e-5);
  EXPECT_NEAR(raw(0, 2) * stack.depth_unit_m, 0.5 + 1.5 * 32768 / 65535, 2e-5);
  EXPECT_NEAR(raw(0, 3) * stack.depth_unit_m, 2.0, 2e-5);
}

TEST_F(PhotometricSr, the_response_file_is_heeded) {
  test::set_text(source / "response.txt", "srgb\r\n");
  EXPECT_EQ(read_stack(source.path()).color_response.kind, ColorResponse::Kind::srgb);
  test::set_text(source / "response.txt", "film");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("response.txt"), HasSubstr("linear, srgb")));
}

TEST_F(PhotometricSr, a_folder_without_mask_is_taken_whole) {
  fs::remove(source / "mask.png");
  EXPECT_TRUE(read_stack(source.path()).mask.empty());
}

TEST_F(PhotometricSr, bad_calibrations_are_refused) {
  for (const std::string row : {"2,0", "2,0,2000,1", "0,0,2000", "1.5,0,2000", "2,2000,500", "2,-1,2000",
                                "2,0,nan", "2,0,1e999", "2,0,two metres", "3,0,2000"}) {
    write_calibration(row);
    EXPECT_THAT(refusal(), HasSubstr("K.txt")) << row;
  }
  write_calibration("1,0,2000");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("z0_10.png"), HasSubstr("4 x 3"), HasSubstr("8 x 6")));
  test::set_text(source / "K.txt", "0,0,3.5\n0,110,2.5\n0,0,1\n2,0,2000");
  EXPECT_THAT(refusal(), HasSubstr("no camera matrix"));
  test::set_text(source / "K.txt", "");
  EXPECT_THAT(refusal(), HasSubstr("four rows"));
}

TEST_F(PhotometricSr, missing_and_odd_images_are_named) {
  cv::imwrite((source / "RGB/I_7.png").string(), cv::Mat(6, 9, CV_8UC3, cv::Scalar::all(1)));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("I_7.png"), HasSubstr("9 x 6")));
  fs::remove_all(source / "RGB");
  fs::create_directory(source / "RGB");
  EXPECT_THAT(refusal(), HasSubstr("no image I_<number>.png"));
  fs::remove_all(source / "Depth");
  cv::imwrite((source / "RGB/I_7.png").string(), cv::Mat(6, 8, CV_8UC3, cv::Scalar::all(1)));
  EXPECT_THAT(refusal(), HasSubstr("Depth"));
}

TEST_F(PhotometricSr, two_images_of_one_number_are_refused) {
  fs::copy_file(source / "RGB/I_1.png", source / "RGB/I_01.png");
  EXPECT_THAT(refusal(), HasSubstr("number of another image"));
}

TEST_F(PhotometricSr, survives_being_written_as_a_stack) {
  const LightStack stack = read_stack(source.path());
  const test::TemporaryFolder home;
  write_stack(stack, home / "stack");
  test::expect_same(stack, read_stack(home / "stack"));
}

TEST(PhotometricSrShared, mitten_has_20_colour_and_20_depth_images) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "mitten");
  const LightStack stack = read_stack(folder);
  check_stack(stack);
  EXPECT_EQ(stack.frames.size(), 20u);
  for (const Frame& frame : stack.frames) EXPECT_FALSE(frame.color.empty() || frame.depth.empty());
  EXPECT_EQ(stack.depth_camera.size(), cv::Size(640, 480));
  EXPECT_NEAR(stack.depth_camera.fx, 608.365, 1e-9);
  EXPECT_EQ(cv::countNonZero(stack.mask), 148600);
}

TEST(PhotometricSrShared, bear_x2_agrees_with_its_truth) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "bear-x2");
  const LightStack stack = read_stack(folder);
  check_stack(stack);
  const GroundTruth truth = read_truth(folder);
  ASSERT_EQ(truth.depth.size(), stack.color_camera.size());
  const cv::Mat1w& raw = stack.frames[0].depth;
  double sum = 0;
  int count = 0;
  for (int y = 0; y < raw.rows; ++y) {
    for (int x = 0; x < raw.cols; ++x) {
      const float z = truth.depth(2 * y, 2 * x);
      if (raw(y, x) == 0 || std::isnan(z)) continue;
      sum += std::abs(raw(y, x) * stack.depth_unit_m - double(z));
      ++count;
    }
  }
  EXPECT_GT(count, 9000);
  EXPECT_LT(sum / count, 0.0015) << "metres: the sensor's noise, not an error of units";
  const cv::Scalar normal = cv::mean(truth.normals, truth.depth == truth.depth);
  EXPECT_LT(normal[2], -0.6) << "normals face the camera, and z is the third channel";
}

}  // namespace
}  // namespace rakelight
