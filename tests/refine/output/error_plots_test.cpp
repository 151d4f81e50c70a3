// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/error_plots.h"

#include <gtest/gtest.h>

#include "stack/errors.h"
#include "stack/image_file.h"
#include "tests/support/bump_stack.h"
#include "tests/support/file_edits.h"
#include "tests/support/temporary_folder.h"

namespace rakelight {
namespace {

/// The truth itself, `offset_m` farther on its left half and as much nearer on its right.
ErrorMaps errors_of(float offset_m) {
  const GroundTruth truth = test::bump_truth();
  cv::Mat1f depth = truth.depth.clone();
  depth.colRange(0, depth.cols / 2) += offset_m;
  depth.colRange(depth.cols / 2, depth.cols) -= offset_m;
  return error_maps(binned(test::bump_stack().color_camera, 1), depth, truth);
}

int count_near(const cv::Mat& picture, const cv::Vec3b& color) {
  cv::Mat matches;
  cv::inRange(picture, cv::Scalar(color) - cv::Scalar::all(3), cv::Scalar(color) + cv::Scalar::all(3),
              matches);
  return cv::countNonZero(matches);
}

TEST(ErrorPlots, ShowWhereDepthIsTooFarAndTooNear) {
  const test::TemporaryFolder folder;
  write_error_plots(errors_of(0.002f), errors_of(0.0f), folder / "plots");
  const cv::Mat figure = read_color_png(folder / "plots/depth_error.png");
  const cv::Vec3b too_far(178, 24, 43), too_near(33, 102, 172), right(247, 247, 247);
  const cv::Mat before = figure.colRange(0, figure.cols / 2).rowRange(0, figure.rows * 2 / 3);
  const cv::Mat after = figure.colRange(figure.cols / 2, figure.cols).rowRange(0, figure.rows * 2 / 3);
  EXPECT_GT(count_near(before.colRange(0, before.cols / 2), too_far), 10'000);
  EXPECT_GT(count_near(before.colRange(before.cols / 2, before.cols), too_near), 10'000);
  EXPECT_GT(count_near(after, right), 50'000);
  EXPECT_EQ(count_near(after, too_far) + count_near(after, too_near), 0);
}

TEST(ErrorPlots, AreFourPicturesWideEnoughForPrint) {
  const test::TemporaryFolder folder;
  write_error_plots(errors_of(0.002f), errors_of(0.001f), folder / "plots");
  for (const char* name :
       {"depth_error.png", "normal_error.png", "depth_histogram.png", "normal_histogram.png"}) {
    const cv::Mat figure = read_color_png(folder / "plots" / name);
    EXPECT_GE(figure.cols, 1800) << name;
    EXPECT_EQ(figure.at<cv::Vec3b>(2, 2), cv::Vec3b(255, 255, 255)) << name;
  }
}

TEST(ErrorPlots, LeaveAFolderOfSomethingElseAlone) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "photos");
  test::set_text(folder / "photos/holiday.jpg", "beach");
  EXPECT_THROW(write_error_plots(errors_of(0), errors_of(0), folder / "photos"), InputError);
  EXPECT_EQ(test::text_of(folder / "photos/holiday.jpg"), "beach");
}

TEST(ErrorMaps, HoldTheErrorsThatEvaluateSumsUp) {
  const GroundTruth truth = test::bump_truth();
  const ErrorMaps maps = errors_of(0.002f);
  const Camera camera = maps.camera;
  cv::Mat1f depth = truth.depth.clone();
  depth.colRange(0, depth.cols / 2) += 0.002f;
  depth.colRange(depth.cols / 2, depth.cols) -= 0.002f;
  const Evaluation evaluation = evaluate(camera, depth, {}, truth);
  const cv::Mat1b compared(maps.depth_mm == maps.depth_mm);
  cv::Mat known;
  maps.depth_mm.copyTo(known, compared);
  EXPECT_NEAR(cv::norm(known) / std::sqrt(cv::countNonZero(compared)), evaluation.rmse_mm, 1e-4);
  EXPECT_NEAR(cv::mean(maps.normal_deg, compared)[0], evaluation.mae_deg, 1e-4);
}

}  // namespace
}  // namespace rakelight
