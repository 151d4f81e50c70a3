// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/error_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "refine/output/table_pictures.h"

namespace rakelight {
namespace {

/// Depth 1 m; columns err by -4, -2, 0, 2, 4 mm, the last is missing.
cv::Mat1f stepped() {
  cv::Mat1f depth(3, 6, 1.0f);
  for (int x = 0; x < 5; ++x) depth.col(x) += 0.002f * static_cast<float>(x - 2);
  depth.col(5).setTo(NAN);
  return depth;
}

TEST(ErrorMap, IsBlueWhereTooNearRedWhereTooFarWhiteWhereRightAndBlackWhereNothingIs) {
  const cv::Mat3b map = error_map(stepped(), cv::Mat1f(3, 6, 1.0f), 4);
  const auto blue_minus_red = [&](int x) { return int{map(1, x)[2]} - int{map(1, x)[0]}; };
  EXPECT_GT(blue_minus_red(0), 100);
  EXPECT_GT(blue_minus_red(1), 30);
  EXPECT_LT(blue_minus_red(1), blue_minus_red(0));
  EXPECT_NEAR(blue_minus_red(2), 0, 1);
  EXPECT_GT(map(1, 2)[1], 240);
  EXPECT_LT(blue_minus_red(4), -100);
  EXPECT_EQ(map(1, 5), cv::Vec3b::all(0));
}

TEST(ErrorMap, ComparesWithATruthOnAnotherGrid) {
  EXPECT_EQ(cv::norm(error_map(stepped(), cv::Mat1f(6, 12, 1.0f), 4),
                     error_map(stepped(), cv::Mat1f(3, 6, 1.0f), 4)),
            0);
}

TEST(ErrorMap, ChoosesARoundRangeThatHoldsNineErrorsInTen) {
  const cv::Mat1f truth(10, 10, 1.0f);
  cv::Mat1f depth = truth.clone();
  depth(cv::Rect(0, 0, 10, 5)) += 0.0031f;
  depth(0, 0) = 9.0f;  // one outlier does not set the range
  EXPECT_DOUBLE_EQ(error_range_mm(depth, truth), 5);
  EXPECT_DOUBLE_EQ(error_range_mm(cv::Mat1f(2, 2, NAN), cv::Mat1f(2, 2, 1.0f)), 1);
}

TEST(ErrorScale, RunsFromBlueToRed) {
  const cv::Mat3b scale = error_scale(112, 5);
  EXPECT_EQ(scale.cols, 112);
  EXPECT_GT(scale(2, 0)[2], scale(2, 0)[0]);
  EXPECT_GT(scale(2, 111)[0], scale(2, 111)[2]);
}

TEST(PictureSheet, HasTwoRowsALineAndTheErrorsInTheFourthPanel) {
  const cv::Size size(40, 60);
  const cv::Mat1f right(size, 1.0f), far(size, 1.01f);
  const cv::Mat3f normals(size, cv::Vec3f(0, 0, -1));
  const GroundTruth truth{right, normals, {}, {}};
  const std::vector<PictureRow> rows{{"input", "input", far, normals, {}},
                                     {"truth", "truth", right, normals, {}}};
  const cv::Mat3b sheet = picture_sheet(rows, truth, 20);
  EXPECT_EQ(sheet.cols, 2 * 4 * 20);
  const int middle = 20 + 15;  // below the caption
  const cv::Vec3b too_far = sheet(middle, 3 * 20 + 10), right_there = sheet(middle, 7 * 20 + 10);
  EXPECT_GT(int{too_far[0]} - int{too_far[2]}, 50);
  EXPECT_NEAR(int{right_there[0]} - int{right_there[2]}, 0, 1);
}

}  // namespace
}  // namespace rakelight
