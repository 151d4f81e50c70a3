// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/uncertainty.h"

#include <gtest/gtest.h>

#include <random>

#include "refine/steps/albedo.h"
#include "tests/refine/exact_surface.h"

namespace rakelight {
namespace {

/// A lit sphere whose images miss the model a little, the albedo fitted to them.
struct MissedSphere {
  test::ExactSurface sphere = test::exact_sphere(24);
  SurfaceState state = test::exact_state(sphere, test::varied_albedo(sphere), test::far_lamps(), true);
  Observations images = test::images_of(state);

  MissedSphere() {
    test::change_samples(images, [](PlainSamples& samples) {
      for (size_t k = 0; k < samples.radiance.size(); ++k)
        samples.radiance[k] += 0.02f * std::sin(static_cast<float>(k));
    });
    state.albedo = estimate_albedo(images, state);
  }
};

/// Minus half the gradient of the photometric energy by each normal.
Eigen::Matrix3Xf pull_on_normals(const Observations& images, const SurfaceState& state) {
  const auto tensors = accumulate_tensors(images, state);
  Eigen::Matrix3Xf pull(3, images.pixels);
  for (int p = 0; p < images.pixels; ++p) {
    const PhotometricTensor& e = tensors[static_cast<size_t>(p)];
    pull.col(p) = e.h - e.G * state.normals.col(p);
  }
  return pull;
}

TEST(Uncertainty, ScaledResidualsPullOnTheNormalsAsChangedImagesDo) {
  const MissedSphere missed;
  const std::vector<float> factor{1.0f, -0.5f, 0.3f, 2.0f, -1.2f};
  const float t = 0.05f;
  const auto pull_at = [&](float step) {
    Observations images = missed.images;
    test::change_samples(images, [&](PlainSamples& samples) {
      for (int i = 0; i < images.images; ++i) {
        for (int p = 0; p < images.pixels; ++p) {
          const Eigen::Vector3f n = missed.state.normals.col(p);
          const LocalLight light = light_at(missed.state.lamps[static_cast<size_t>(i)],
                                            missed.state.points.col(p), n, missed.state.scene);
          const Eigen::Vector3f S = shading(light, n, true);
          for (int c = 0; c < 3; ++c) {
            float& I = samples.radiance[test::sample_index(images, i, c, p)];
            I += step * factor[static_cast<size_t>(i)] * (I - missed.state.albedo(c, p) * S[c]);
          }
        }
      }
    });
    SurfaceState state = missed.state;
    state.albedo = estimate_albedo(images, state);
    return pull_on_normals(images, state);
  };
  const Eigen::Matrix3Xf difference = (pull_at(t) - pull_at(-t)) / (2 * t);
  EXPECT_TRUE(h_of_scaled_residuals(missed.images, missed.state, factor).isApprox(difference, 5e-3f));
}

/// Depth that nothing but the sensor holds.
struct SensorAlone {
  MissedSphere missed;
  CornerList corners = make_corners(missed.sphere.grid, Stencil::symmetric);
  PhotometricTensors tensors = PhotometricTensors(missed.sphere.grid.pixels.size());
  CornerWeights weights = CornerWeights(tensors.size());
  DepthPrior prior;

  explicit SensorAlone(double deviation) {
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, deviation);
    prior.cells = make_cells(missed.sphere.grid, 1);
    prior.cell_weight = Eigen::VectorXd::Constant(missed.state.zeta.size(), 1e4);
    prior.cell_target = prior.start = missed.state.zeta;
    for (double& target : prior.cell_target) target += noise(random);
    std::fill(missed.state.weight.begin(), missed.state.weight.end(), 0.0f);
  }

  Uncertainty estimate(int draws) {
    const auto solver = make_cholesky_depth_solver(missed.sphere.grid, prior.cells);
    return estimate_uncertainty({missed.sphere.grid, corners, tensors, weights, prior}, 1, missed.images,
                                missed.state, *solver, draws);
  }
};

TEST(Uncertainty, OfDepthThatOnlyTheSensorHoldsIsTheSensorsError) {
  const double deviation = 0.002;
  SensorAlone sensor(deviation);
  const double expected = deviation * sensor.missed.state.zeta.array().exp().mean();
  EXPECT_NEAR(sensor.estimate(64).depth.mean(), expected, 0.1 * expected);
}

TEST(Uncertainty, IsTheSameAtEveryCallAndEmptyWithoutDraws) {
  SensorAlone sensor(0.002);
  const Uncertainty first = sensor.estimate(4), second = sensor.estimate(4);
  EXPECT_EQ(first.depth, second.depth);
  EXPECT_EQ(first.normal, second.normal);
  EXPECT_EQ(sensor.estimate(0).depth.size(), 0);
}

}  // namespace
}  // namespace rakelight
