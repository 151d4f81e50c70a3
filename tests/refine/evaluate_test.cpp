// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/evaluate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "refine/depth_normals.h"
#include "stack/errors.h"
#include "stack/float_tiff.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"

namespace rakelight {
namespace {

const float kNaN = std::numeric_limits<float>::quiet_NaN();

/// A plane n.p = d seen by the camera, with its exact normals; pixels outside a disc have no surface.
struct Plane {
  Camera camera{64, 48, 300.0, 310.0, 31.5, 23.5, {}};
  cv::Vec3d normal = cv::normalize(cv::Vec3d(0.3, -0.2, -1.0));
  GroundTruth truth;

  explicit Plane(double factor = 1) : camera(binned(Camera{64, 48, 300.0, 310.0, 31.5, 23.5, {}}, factor)) {
    truth.depth = cv::Mat1f(camera.size(), kNaN);
    truth.normals = cv::Mat3f(camera.size(), cv::Vec3f::all(kNaN));
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const cv::Vec3d ray((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1);
        if (std::hypot(ray[0], ray[1]) > 0.07) continue;
        truth.depth(y, x) = static_cast<float>(-0.8 / normal.dot(ray));
        truth.normals(y, x) = normal;
      }
    }
  }
};

TEST(Evaluate, FindsNoErrorInTheTruth) {
  const Plane plane;
  const Evaluation found = evaluate(plane.camera, plane.truth.depth, plane.truth.normals, plane.truth);
  EXPECT_EQ(found.rmse_mm, 0);
  EXPECT_NEAR(found.mae_deg, 0, 0.1);  // forward differences of log depth are not exact half a pixel away
  EXPECT_NEAR(found.own_normals_mae_deg, 0, 0.05);  // arc cosines of floats near 1
  EXPECT_EQ(found.completeness, 1);
}

TEST(Evaluate, CountsAnOffsetInTheErrorButNotInTheUnbiasedOne) {
  const Plane plane;
  const cv::Mat1f farther = cv::Mat(plane.truth.depth + 0.002);
  const Evaluation found = evaluate(plane.camera, farther, {}, plane.truth);
  EXPECT_NEAR(found.rmse_mm, 2, 1e-3);
  EXPECT_NEAR(found.rmse_unbiased_mm, 0, 1e-3);
  EXPECT_TRUE(std::isnan(found.own_normals_mae_deg));
}

TEST(Evaluate, MeasuresTheAngleOfTiltedNormals) {
  const Plane plane;
  cv::Mat3f tilted = plane.truth.normals.clone();
  const double angle = 5 * CV_PI / 180;
  const cv::Vec3d axis = cv::normalize(plane.normal.cross(cv::Vec3d(1, 0, 0)));
  const cv::Vec3d turned = plane.normal * std::cos(angle) + axis.cross(plane.normal) * std::sin(angle);
  for (cv::Vec3f& n : tilted) {
    if (std::isfinite(n[0])) n = turned;
  }
  EXPECT_NEAR(evaluate(plane.camera, plane.truth.depth, tilted, plane.truth).own_normals_mae_deg, 5, 1e-3);
}

TEST(Evaluate, CountsTheErrorsInsideTheErrorBars) {
  const Plane plane;
  cv::Mat1f depth = plane.truth.depth.clone();
  cv::Mat3f bars(depth.size(), cv::Vec3f(0.001f, 0.1f, 8));
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      depth(y, x) += x % 2 == 0 ? 0.0005f : -0.0005f;            // inside
      if (y % 4 == 0) bars(y, x) = cv::Vec3f(0.0001f, 0.1f, 8);  // outside: a quarter
    }
  }
  cv::Mat3f normals = plane.truth.normals.clone();
  for (int y = 0; y < depth.rows; y += 2) normals.row(y).setTo(cv::Scalar(1, 0, 0));  // outside: half
  const ErrorBarReport report = evaluate_error_bars(plane.camera, depth, normals, bars, plane.truth);
  EXPECT_NEAR(report.depth_within, 0.75, 0.03);
  EXPECT_NEAR(report.normal_within, 0.5, 0.03);
}

TEST(Evaluate, ReportsMissingPixelsInsteadOfCountingThem) {
  const Plane plane;
  cv::Mat1f depth = plane.truth.depth.clone();
  const int all = static_cast<int>(std::count_if(depth.begin(), depth.end(), [](float z) { return z > 0; }));
  depth(24, 32) = kNaN;
  depth(24, 33) = 0;
  depth(24, 34) = -1;
  depth(24, 35) = std::numeric_limits<float>::infinity();
  const Evaluation found = evaluate(plane.camera, depth, {}, plane.truth);
  EXPECT_NEAR(found.completeness, 1 - 4.0 / all, 1e-9);
  EXPECT_EQ(found.rmse_mm, 0);
}

TEST(Evaluate, ComparesGridsOfDifferentSizeOnTheFinerOne) {
  const Plane coarse(2), fine(1);
  const Evaluation upwards = evaluate(coarse.camera, coarse.truth.depth, coarse.truth.normals, fine.truth);
  EXPECT_LT(upwards.rmse_mm, 0.5);  // the disc's rim has no neighbours to interpolate between
  EXPECT_LT(upwards.median_deg, 0.3);
  EXPECT_GT(upwards.completeness, 0.9);
  const Evaluation downwards = evaluate(fine.camera, fine.truth.depth, fine.truth.normals, coarse.truth);
  EXPECT_LT(downwards.rmse_mm, 0.5);
  EXPECT_LT(downwards.median_deg, 0.3);
}

TEST(Evaluate, RefusesGridsWithoutAWholeRatio) {
  const Plane plane;
  const cv::Mat1f odd(50, 64, 1.0f);
  EXPECT_THROW(evaluate(plane.camera, odd, {}, plane.truth), InputError);
  EXPECT_THROW(evaluate(plane.camera, plane.truth.depth, cv::Mat3f(3, 3), plane.truth), InputError);
}

TEST(Evaluate, RefusesAResultThatSharesNoPixelWithTheTruth) {
  const Plane plane;
  const cv::Mat1f nothing(plane.camera.size(), kNaN);
  EXPECT_THROW(evaluate(plane.camera, nothing, {}, plane.truth), InputError);
}

/// The independent judge beside the shared data, where there is one.
std::filesystem::path judge() { return test::shared_data() / "../tools/judge.py"; }

nlohmann::json judged(const std::filesystem::path& result, const std::filesystem::path& stack) {
  const std::string command =
      "/usr/bin/python3 " + judge().string() + " " + result.string() + " " + stack.string() + " --json";
  FILE* pipe = popen(command.c_str(), "r");
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return nlohmann::json::parse(output, nullptr, false);
}

/// The plane, noisy and with holes, so that every rule at borders matters.
cv::Mat1f noisy_depth(const Plane& plane) {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0.0005f, 0.001f);
  cv::Mat1f depth = plane.truth.depth.clone();
  for (float& z : depth) {
    z += noise(random);
    if (random() % 7 == 0) z = kNaN;
  }
  return depth;
}

TEST(Evaluate, AgreesWithTheIndependentJudge) {
  if (!std::filesystem::exists(judge())) GTEST_SKIP() << "no judge.py beside the shared data";
  const Plane plane;
  const cv::Mat1f depth = noisy_depth(plane);
  cv::Mat3f normals;
  normals_from_depth(plane.camera, depth).convertTo(normals, CV_32F);

  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "stack/truth");
  std::filesystem::create_directories(folder / "result");
  write_tiff(folder / "result/depth.tiff", depth);
  write_tiff(folder / "result/normals.tiff", normals);
  write_tiff(folder / "stack/truth/depth.tiff", plane.truth.depth);
  write_tiff(folder / "stack/truth/normals.tiff", plane.truth.normals);
  std::ofstream(folder / "stack/K.txt") << "300,0,31.5\n0,310,23.5\n0,0,1\n";

  const Evaluation ours = evaluate(plane.camera, depth, normals, plane.truth);
  const nlohmann::json theirs = judged(folder / "result", folder / "stack");
  EXPECT_NEAR(ours.rmse_mm, theirs.at("rmse_mm").get<double>(), 1e-4);
  EXPECT_NEAR(ours.rmse_unbiased_mm, theirs.at("rmse_unbiased_mm").get<double>(), 1e-4);
  EXPECT_NEAR(ours.mae_deg, theirs.at("mae_deg").get<double>(), 1e-4);
  EXPECT_NEAR(ours.median_deg, theirs.at("median_deg").get<double>(), 1e-4);
  EXPECT_NEAR(ours.own_normals_mae_deg, theirs.at("mae_own_normals_deg").get<double>(), 1e-2);
  EXPECT_NEAR(ours.completeness, theirs.at("complete").get<double>(), 1e-9);
}

}  // namespace
}  // namespace rakelight
