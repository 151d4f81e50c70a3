// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/depth_sensor.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>

#include "simulate/objects/objects.h"
#include "tests/simulate/small_rig.h"

namespace rakelight {
namespace {

constexpr int kWidth = 320, kHeight = 240;

Camera camera() { return {kWidth, kHeight, 285, 285, 159.5, 119.5, {}}; }

SimulateOptions exact() {
  SimulateOptions options = test::ideal_rig(SceneKind::plane);
  options.width = kWidth;
  options.height = kHeight;
  options.depth.unit_m = 2e-5;
  return options;
}

/// A wall through (0, 0, 1), turned about the vertical.
RayTracer wall(double yaw_deg = 0) {
  SceneMesh mesh = make_plane();
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(static_cast<float>(yaw_deg * M_PI / 180), Eigen::Vector3f::UnitY())
          .toRotationMatrix();
  for (auto& v : mesh.vertices) v = turn * (2 * v) + Eigen::Vector3f(0, 0, 1);
  for (auto& n : mesh.normals) n = turn * n;
  return RayTracer(std::move(mesh));
}

cv::Mat1f millimetres(const SimulateOptions& options, const cv::Mat1w& raw) {
  cv::Mat1f result;
  raw.convertTo(result, CV_32F, 1e3 * options.depth.unit_m);
  return result;
}

double deviation(const cv::Mat& values) {
  cv::Scalar mean, result;
  cv::meanStdDev(values, mean, result);
  return result[0];
}

TEST(DepthSensor, ReadsAWallExactlyWithoutNoise) {
  const SimulateOptions options = exact();
  const cv::Mat1f depth = millimetres(options, sense_depth(options, camera(), wall(), 1).front());
  double low = 0, high = 0;
  cv::minMaxLoc(depth, &low, &high);
  EXPECT_NEAR(low, 1000, 0.05);
  EXPECT_NEAR(high, 1000, 0.05);
}

TEST(DepthSensor, NoiseHasTheDeviationAskedForAtOneMetre) {
  SimulateOptions options = exact();
  options.depth.noise_mm = 4;
  options.depth.correlation_px = 2;
  options.depth.white_noise_mm = 3;
  const auto frames = sense_depth(options, camera(), wall(), 1);
  EXPECT_NEAR(deviation(millimetres(options, frames.front())), 5.0, 0.4);
}

TEST(DepthSensor, NeighboursShareTheCorrelatedPartAndFramesDrawTheWhitePartAnew) {
  SimulateOptions options = exact();
  options.depth.noise_mm = 4;
  options.depth.correlated_drift = 0;
  const auto still = sense_depth(options, camera(), wall(), 2);
  const cv::Mat1f first = millimetres(options, still[0]);
  EXPECT_EQ(cv::countNonZero(still[0] != still[1]), 0) << "without white noise and drift frames are the same";
  const double step = deviation(cv::Mat(first.colRange(1, kWidth) - first.colRange(0, kWidth - 1)));
  EXPECT_LT(step, 0.4 * 4) << "neighbouring pixels are not correlated";

  options.depth.noise_mm = 0;
  options.depth.white_noise_mm = 2;
  const auto white = sense_depth(options, camera(), wall(), 2);
  EXPECT_NEAR(deviation(cv::Mat(millimetres(options, white[0]) - millimetres(options, white[1]))),
              2 * std::sqrt(2.0), 0.1);
}

TEST(DepthSensor, DisparityIsReadInSteps) {
  SimulateOptions options = exact();
  options.depth.white_noise_mm = 3;
  options.depth.disparity_step_px = 0.125;
  std::set<int> disparities_in_steps;
  const cv::Mat1w frame = sense_depth(options, camera(), wall(), 1).front();
  for (const std::uint16_t raw : frame) {
    const double disparity = 570 * 0.075 / (raw * options.depth.unit_m);
    const double steps = disparity / 0.125;
    ASSERT_NEAR(steps, std::round(steps), 0.01);
    disparities_in_steps.insert(static_cast<int>(std::lround(steps)));
  }
  EXPECT_GT(disparities_in_steps.size(), 3U);
  EXPECT_LT(disparities_in_steps.size(), 15U);
}

TEST(DepthSensor, AGrazedWallIsNotRead) {
  SimulateOptions options = exact();
  options.depth.unit_m = 1e-4;
  options.depth.holes = true;
  const auto share_in_the_middle = [&](double yaw_deg) {  // where the rays are nearly parallel to the axis
    const cv::Mat1w middle = sense_depth(options, camera(), wall(yaw_deg), 1).front().colRange(155, 165);
    return cv::countNonZero(middle) / (10.0 * kHeight);
  };
  EXPECT_EQ(share_in_the_middle(60), 1);
  EXPECT_LT(share_in_the_middle(86), 0.02);
  options.depth.holes = false;
  EXPECT_EQ(share_in_the_middle(86), 1);
}

/// A square of 0.2 m before a wall.
RayTracer square_before_wall() {
  SceneMesh mesh = make_plane();
  for (auto& v : mesh.vertices) v = 2 * v + Eigen::Vector3f(0, 0, 1);
  SceneMesh square = make_plane();
  for (auto& v : square.vertices) v = 0.1f * v + Eigen::Vector3f(0, 0, 0.7f);
  const auto offset = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), square.vertices.begin(), square.vertices.end());
  mesh.normals.insert(mesh.normals.end(), square.normals.begin(), square.normals.end());
  mesh.texture.insert(mesh.texture.end(), square.texture.begin(), square.texture.end());
  for (const auto& t : square.triangles)
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return RayTracer(std::move(mesh));
}

TEST(DepthSensor, TheProjectorsShadowAndDepthEdgesAreHoles) {
  SimulateOptions options = exact();
  options.depth.holes = true;
  const cv::Mat1w raw = sense_depth(options, camera(), square_before_wall(), 1).front();
  // The square spans u = 118.8 to 200.2. The projector stands to the right: its shadow lies left of the square,
  // f b (1 / 0.7 - 1) = 9 pixels wide.
  const cv::Mat1w row = raw.row(120);
  EXPECT_EQ(cv::countNonZero(row.colRange(111, 118)), 0) << "the projector's shadow";
  EXPECT_EQ(cv::countNonZero(row.colRange(20, 108)), 88) << "left of the shadow";
  EXPECT_EQ(cv::countNonZero(row.colRange(124, 196)), 72) << "the square itself";
  EXPECT_EQ(cv::countNonZero(row.colRange(204, 300)), 96) << "right of the square";
  const cv::Mat1w edge = raw(cv::Rect(198, 90, 5, 60));  // the right edge drops readings raggedly
  EXPECT_LT(cv::countNonZero(edge), 5 * 60 - 60);
  EXPECT_GT(cv::countNonZero(edge), 0);
}

TEST(CorrelatedNoise, HasUnitVarianceUpToTheBorder) {
  const cv::Mat1f noise = correlated_noise({400, 300}, 3, 1, 2);
  EXPECT_NEAR(deviation(noise), 1, 0.05);
  EXPECT_NEAR(deviation(correlated_noise({2000, 8}, 3, 1, 2)), 1, 0.12);
}

}  // namespace
}  // namespace rakelight
