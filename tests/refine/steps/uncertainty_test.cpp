// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/uncertainty.h"

#include <gtest/gtest.h>

#include <random>

#include "refine/steps/albedo.h"
#include "refine/steps/quality.h"
#include "refine/steps/residual_draws.h"
#include "tests/refine/dense_system.h"
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
  const float t = 0.3f;  // against the rounding of the samples
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
  DrawFactors factors = DrawFactors::Zero(missed.images.images, kDrawsAtATime);
  for (size_t i = 0; i < factor.size(); ++i) factors(static_cast<Eigen::Index>(i), 3) = factor[i];
  const std::vector<DrawnPulls> pulls = pulls_of_scaled_residuals(missed.images, missed.state, factors);
  Eigen::Matrix3Xf found(3, missed.images.pixels);
  for (int p = 0; p < missed.images.pixels; ++p) found.col(p) = pulls[static_cast<size_t>(p)].col(3);
  EXPECT_TRUE(found.isApprox(difference, 5e-3f));
}

/// One pixel's pull by the definition (refine/steps/residual_draws.h).
Eigen::Vector3f pull_by_definition(const Observations& images, const SurfaceState& state, int p,
                                   const DrawFactors& factors, int draw) {
  Eigen::Vector3f q = Eigen::Vector3f::Zero(), Sr = q, SS = q;
  Eigen::Matrix3f by_rho = Eigen::Matrix3f::Zero();
  for (int i = 0; i < images.images; ++i) {
    const float w =
        state.weight[static_cast<size_t>(i) * static_cast<size_t>(images.pixels) + static_cast<size_t>(p)];
    const Eigen::Vector3f n = state.normals.col(p);
    const LocalLight light =
        light_at(state.lamps[static_cast<size_t>(i)], state.points.col(p), n, state.scene);
    const Eigen::Vector3f S = shading(light, n, state.attached_shadows);
    for (int c = 0; c < 3; ++c) {
      if (!images.usable(i, c, p)) continue;
      const float rho = state.albedo(c, p), r = images.channel(i, c)[p] - rho * S[c];
      const bool shadowed = state.attached_shadows && light.l.row(c).dot(n) <= 0;
      const Eigen::Vector3f l = shadowed ? Eigen::Vector3f::Zero() : Eigen::Vector3f(light.l.row(c));
      q += factors(i, draw) * w * rho * r * l;
      by_rho.col(c) += w * (r - rho * S[c]) * l;
      Sr[c] += factors(i, draw) * w * S[c] * r;
      SS[c] += w * S[c] * S[c];
    }
  }
  return q + by_rho * Sr.cwiseQuotient(SS.cwiseMax(1e-8f));
}

std::vector<Lamp> near_lamps() {
  std::vector<Lamp> lamps = test::far_lamps();
  for (Lamp& lamp : lamps) {
    lamp.near = true;
    lamp.direction = lamp.l.row(1).transpose().normalized();
    lamp.inverse_distance = 1.4f;
    lamp.strength = {0.8f, 0.9f, 1.1f};
  }
  return lamps;
}

TEST(Uncertainty, PullsOfEveryKindOfLampAreThoseOfTheDefinition) {
  const MissedSphere missed;
  for (const std::vector<Lamp>& lamps : {test::far_lamps(), near_lamps(), test::second_order_lamps()}) {
    SurfaceState state = missed.state;
    state.lamps = lamps;
    state.scene.center = state.points.rowwise().mean();
    for (size_t k = 0; k < state.weight.size(); ++k)
      state.weight[k] = 0.2f + 0.1f * static_cast<float>(k % 7);
    Observations images = missed.images;
    PlainSamples samples = images.plain();
    for (size_t k = 0; k < samples.usable.size(); k += 5) samples.usable[k] = 0;
    images.set(samples);
    const DrawFactors factors = DrawFactors::Random(images.images, kDrawsAtATime);
    const std::vector<DrawnPulls> pulls = pulls_of_scaled_residuals(images, state, factors);
    Eigen::Matrix3Xf found(3, images.pixels), expected(3, images.pixels);
    for (int p = 0; p < images.pixels; ++p) {
      found.col(p) = pulls[static_cast<size_t>(p)].col(6);
      expected.col(p) = pull_by_definition(images, state, p, factors, 6);
    }
    EXPECT_GT(expected.norm(), 0.01f);
    EXPECT_TRUE(found.isApprox(expected, 1e-4f));
  }
}

TEST(Uncertainty, OfTheImagesCountsTheLampsThatShineOnAPixel) {
  const MissedSphere missed;
  for (const std::vector<Lamp>& lamps : {test::far_lamps(), near_lamps()}) {
    SurfaceState state = missed.state;
    state.lamps = lamps;
    const Eigen::VectorXd lit = lit_images(missed.images, state);
    for (int p = 0; p < missed.images.pixels; ++p) {
      double expected = 0;
      for (const Lamp& lamp : lamps) {
        const LocalLight light = light_at(lamp, state.points.col(p), state.normals.col(p), state.scene);
        if ((light.l * state.normals.col(p)).maxCoeff() > 0) expected += 1;
      }
      ASSERT_EQ(lit[p], expected) << p;
    }
  }
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
    return estimate_uncertainty({missed.sphere.grid, corners, tensors, weights, prior}, 1, missed.images,
                                missed.state, draws);
  }
};

TEST(Uncertainty, PullsOnNormalsBecomeTheRightHandSideThatTheDepthStepMakesOfThem) {
  SensorAlone at(0.002);
  const int pixels = at.missed.sphere.grid.size();
  for (int p = 0; p < pixels; ++p)
    for (int k = 0; k < kCorners; ++k)
      if (at.corners.has(p, k))
        at.weights[static_cast<size_t>(p)][static_cast<size_t>(k)] = 0.1f + 0.05f * static_cast<float>(k);
  std::vector<DrawnPulls> pulls(static_cast<size_t>(pixels));
  PhotometricTensors pulled = at.tensors;
  for (int p = 0; p < pixels; ++p) {
    const auto k = static_cast<size_t>(p);
    pulls[k] = DrawnPulls::Random();
    PhotometricTensor e = at.tensors[k];
    e.h += pulls[k].col(5);
    pulled.set(k, e);
  }
  const auto rhs = [&](const PhotometricTensors& tensors) {
    const DepthProblem depth{at.missed.sphere.grid, at.corners, tensors, at.weights, at.prior};
    return test::pixel_rhs(depth.grid,
                           depth_system(depth, at.missed.state.zeta, Linearization::gauss_newton));
  };
  const Eigen::VectorXd expected = rhs(pulled) - rhs(at.tensors);
  EXPECT_GT(expected.norm(), 1);
  const DepthProblem depth{at.missed.sphere.grid, at.corners, at.tensors, at.weights, at.prior};
  EXPECT_TRUE(right_hand_sides(depth, at.missed.state.zeta, pulls).col(5).isApprox(expected, 1e-4));
}

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
