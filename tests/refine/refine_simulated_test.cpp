// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the synthetic rig to a refined surface: images that were not made by the model that inverts them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "refine/evaluate.h"
#include "refine/refine.h"
#include "simulate/simulate.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

SimulateOptions rig(Realism realism, SceneKind scene, int color_scale) {
  SimulateOptions options = realism_options(realism);
  options.width = 160;
  options.height = 120;
  options.color_scale = color_scale;
  options.scene.kind = scene;
  options.lamps.count = 8;
  options.image.samples = 2;
  return options;
}

/// Errors of the start and of the result.
struct Errors {
  Evaluation before, after;
  RefineResult result;
};

Errors refine_simulated(const SimulateOptions& options, Preset preset) {
  const Simulated scan = simulate_stack(options);
  Errors errors;
  errors.result = refine_depth(scan.stack, preset_options(preset));
  const Camera& camera = errors.result.camera;
  errors.before = evaluate(camera, errors.result.initial_depth, {}, scan.truth);
  errors.after = evaluate(camera, errors.result.depth, errors.result.normals, scan.truth);
  return errors;
}

/// Relief finer than these small images' pixels is part of the error, before and after.
void expect_at_most(const Errors& errors, double rmse_share, double mae_share) {
  EXPECT_LE(errors.after.rmse_mm, rmse_share * errors.before.rmse_mm) << "before: " << errors.before.rmse_mm;
  EXPECT_LE(errors.after.mae_deg, mae_share * errors.before.mae_deg) << "before: " << errors.before.mae_deg;
  EXPECT_EQ(errors.after.completeness, 1);
}

TEST(RefineSimulated, AVaseInIdealImagesComesOutSharpInBothPresets) {
  const SimulateOptions options = rig(Realism::ideal, SceneKind::vase, 1);
  expect_at_most(refine_simulated(options, Preset::robust), 0.9, 0.68);
  expect_at_most(refine_simulated(options, Preset::paper), 0.9, 0.75);
}

TEST(RefineSimulated, AVaseWithShadowsHighlightsAndNoiseComesOutSharp) {
  expect_at_most(refine_simulated(rig(Realism::real, SceneKind::vase, 1), Preset::robust), 0.9, 0.68);
}

TEST(RefineSimulated, ACoinComesOutSharpAtTwiceTheDepthsResolution) {
  expect_at_most(refine_simulated(rig(Realism::real, SceneKind::coin, 2), Preset::robust), 1.0, 0.72);
}

/// Root mean square distance between two surfaces, mm.
double distance_mm(const cv::Mat1f& a, const cv::Mat1f& b) {
  const cv::Mat1f difference(a - b);
  const cv::Mat1b known = cv::Mat(difference == difference);  // NaN outside
  return 1000 * cv::norm(difference, cv::NORM_L2, known) / std::sqrt(cv::countNonZero(known));
}

TEST(RefineSimulated, CrosstalkThatTheStackTellsIsUndone) {
  SimulateOptions options = rig(Realism::ideal, SceneKind::vase, 1);
  options.lamps.count = 0;
  options.lamps.rgb = true;
  const RefineOptions by_ratio = preset_options(Preset::robust, Method::rgb_ratio);
  const RefineResult clean = refine_depth(simulate_stack(options).stack, by_ratio);
  options.image.crosstalk = 0.15;
  LightStack leaky = simulate_stack(options).stack;
  const RefineResult undone = refine_depth(leaky, by_ratio);
  leaky.color_crosstalk.setIdentity();
  const RefineResult ignored = refine_depth(leaky, by_ratio);
  EXPECT_LT(distance_mm(undone.depth, clean.depth), 0.5 * distance_mm(ignored.depth, clean.depth));
}

/// Mean over scans that err in different ways: flat and round, with and without occlusions, far lamps and near.
TEST(RefineSimulated, ErrorBarsHoldAboutTwoThirdsOfTheErrors) {
  const std::pair<SceneKind, bool> scans[] = {
      {SceneKind::vase, false}, {SceneKind::coin, false}, {SceneKind::drape, false}, {SceneKind::vase, true}};
  double depth = 0, normals = 0;
  for (const auto& [scene, near] : scans) {
    SimulateOptions options = rig(Realism::real, scene, 1);
    options.width = 320;
    options.height = 240;
    options.lamps.count = 12;
    options.lamps.near = near;
    const Simulated scan = simulate_stack(options);
    const RefineResult result = refine_depth(scan.stack, preset_options(Preset::robust));
    const ErrorBarReport bars =
        evaluate_error_bars(result.camera, result.depth, result.normals, result.uncertainty, scan.truth);
    EXPECT_GT(std::min(bars.depth_within, bars.normal_within), 0.45) << static_cast<int>(scene);
    depth += bars.depth_within / std::size(scans);
    normals += bars.normal_within / std::size(scans);
  }
  EXPECT_NEAR(depth, 0.675, 0.075);
  EXPECT_NEAR(normals, 0.675, 0.075);
}

/// Where broad lamp `k` of `count` stands.
cv::Vec3f toward_broad_lamp(size_t k, size_t count) {
  const double angle = 2 * CV_PI * static_cast<double>(k) / static_cast<double>(count);
  return cv::Vec3f(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), -1) /
         std::sqrt(2.0f);
}

/// A sphere under broad lamps of shading 0.2 + 0.4 t.n + 0.4 (t.n)^2: no shadow has an edge, and the shading bends with n.
Simulated broadly_lit_sphere() {
  SimulateOptions options = rig(Realism::ideal, SceneKind::sphere, 1);
  options.width = 320;
  options.height = 240;
  Simulated scan = simulate_stack(options);
  for (size_t k = 0; k < scan.stack.frames.size(); ++k) {
    cv::Mat_<cv::Vec3w> image(scan.truth.normals.size(), cv::Vec3w());
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        const cv::Vec3f n = scan.truth.normals(y, x);
        if (std::isnan(n[0])) continue;
        const float facing = n.dot(toward_broad_lamp(k, scan.stack.frames.size()));
        image(y, x) = 40000 * (0.2f + 0.4f * facing + 0.4f * facing * facing) * scan.truth.albedo(y, x);
      }
    }
    scan.stack.frames[k].color = image;
  }
  return scan;
}

/// Correlation of the red channel's estimated Q with the truth t t' - 1 / 3, over all lamps, and their mean ratio.
cv::Vec2d agreement_with_broad_lamps(const RefineResult& result) {
  double both = 0, found2 = 0, truth2 = 0;
  for (size_t k = 0; k < result.lights.size(); ++k) {
    const cv::Vec3d t = toward_broad_lamp(k, result.lights.size());
    const Eigen::Matrix<double, 1, 5> found = result.lights[k].second_order_rgb->row(0);
    const double truth[] = {t[0] * t[0] - 1.0 / 3, t[1] * t[1] - 1.0 / 3, t[0] * t[1], t[0] * t[2],
                            t[1] * t[2]};
    for (int j = 0; j < 5; ++j) {
      both += found[j] * truth[j];
      found2 += found[j] * found[j];
      truth2 += truth[j] * truth[j];
    }
  }
  return {both / std::sqrt(found2 * truth2), both / truth2};
}

TEST(RefineSimulated, BroadLightIsUnderstoodByItsSecondHarmonics) {
  const Simulated scan = broadly_lit_sphere();
  RefineOptions options = preset_options(Preset::robust);
  options.lamps.harmonics = 2;
  const RefineResult result = refine_depth(scan.stack, options);
  EXPECT_THAT(result.message, testing::HasSubstr("second-order harmonics"));
  const auto agreement = agreement_with_broad_lamps(result);
  EXPECT_GT(agreement[0], 0.95);
  double l = 0;
  for (const LightEstimate& light : result.lights) l += light.sh_rgb.row(0).head<3>().norm();
  EXPECT_NEAR(agreement[1] / (l / static_cast<double>(result.lights.size())), 1, 0.25);  // 0.4 to 0.4
  EXPECT_LT(evaluate(result.camera, result.depth, result.normals, scan.truth).mae_deg, 1);
}

TEST(RefineSimulated, NearLampsAreToldFromFarOnes) {
  SimulateOptions options = rig(Realism::real, SceneKind::vase, 1);
  options.lamps.near = true;
  const Errors near = refine_simulated(options, Preset::robust);
  EXPECT_THAT(near.result.message, testing::HasSubstr("near lamps"));
  EXPECT_TRUE(near.result.lights.front().position_m.has_value());
  expect_at_most(near, 1.0, 0.8);
}

/// Mean of the refined surface's points, metres.
Eigen::Vector3d center_of(const RefineResult& result) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int v = 0; v < result.depth.rows; ++v)
    for (int u = 0; u < result.depth.cols; ++u) {
      const auto z = static_cast<double>(result.depth(v, u));
      if (!(z > 0)) continue;
      sum += z * Eigen::Vector3d((u - result.camera.cx) / result.camera.fx,
                                 (v - result.camera.cy) / result.camera.fy, 1);
    }
  return sum / cv::countNonZero(result.depth > 0);
}

TEST(RefineSimulated, PositionsOfNearLampsAreFoundAsWellAsTheyAreSaidToBe) {
  SimulateOptions options = rig(Realism::real, SceneKind::vase, 1);
  options.lamps.near = true;
  options.lamps.count = 12;
  options.lamps.write_positions = true;
  const Simulated scan = simulate_stack(options);
  const RefineResult result = refine_depth(scan.stack, {});
  double error = 0, told = 0;  // means over the lamps, shares of their distance
  for (size_t i = 0; i < result.lights.size(); ++i) {
    const LightEstimate& light = result.lights[i];
    ASSERT_TRUE(light.position_m.has_value()) << light.id;
    const Eigen::Vector3d truth = *scan.stack.lights[i].position_m;
    const double distance = (truth - center_of(result)).norm();
    error += (*light.position_m - truth).norm() / distance / static_cast<double>(result.lights.size());
    told += std::hypot(light.distance_deviation_m / distance, light.direction_deviation_rad) /
            static_cast<double>(result.lights.size());
  }
  std::cout << "lamps: error " << 100 * error << " %, told " << 100 * told << " %\n";
  EXPECT_LT(error, 0.12);
  EXPECT_GT(told, 0.3 * error);
  EXPECT_LT(told, 3 * error);
}

/// A vase under near lamps whose positions the stack tells.
Simulated scan_with_positions() {
  SimulateOptions options = rig(Realism::real, SceneKind::vase, 1);
  options.lamps.near = true;
  options.lamps.write_positions = true;
  return simulate_stack(options);
}

RefineOptions with_positions(LampPositions positions) {
  RefineOptions options;
  options.lamps.model = LampModel::near;
  options.lamps.positions = positions;
  return options;
}

TEST(RefineSimulated, LampsAreHeldAtTheStacksPositionsWhenThatIsAsked) {
  const Simulated scan = scan_with_positions();
  const RefineResult fixed = refine_depth(scan.stack, with_positions(LampPositions::fixed));
  const RefineResult started = refine_depth(scan.stack, with_positions(LampPositions::start));
  double moved = 0;
  for (size_t i = 0; i < fixed.lights.size(); ++i) {
    const Eigen::Vector3d truth = *scan.stack.lights[i].position_m;
    EXPECT_LT((*fixed.lights[i].position_m - truth).norm(), 1e-3) << fixed.lights[i].id;
    moved += (*started.lights[i].position_m - truth).norm();
  }
  EXPECT_GT(moved, 1e-2);
}

TEST(RefineSimulated, APositionThatTheStackDoesNotTellIsAskedFor) {
  Simulated scan = scan_with_positions();
  scan.stack.lights[2].position_m.reset();
  EXPECT_THROW(refine_depth(scan.stack, with_positions(LampPositions::fixed)), InputError);
}

}  // namespace
}  // namespace rakelight
