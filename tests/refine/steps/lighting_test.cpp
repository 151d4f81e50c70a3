// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/lighting.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "tests/refine/exact_surface.h"

namespace rakelight {
namespace {

/// A sphere of varied albedo under five far lamps, and the images that they make.
struct LitSphere {
  test::ExactSurface sphere = test::exact_sphere();
  std::vector<Lamp> truth = test::far_lamps();
  SurfaceState state;
  Observations images;

  explicit LitSphere(bool attached_shadows)
      : state(test::exact_state(sphere, test::varied_albedo(sphere), truth, attached_shadows)),
        images(test::images_of(state)) {}

  double worst_error() const {
    double worst = 0;
    for (size_t i = 0; i < truth.size(); ++i) {
      const float l = (state.lamps[i].l - truth[i].l).cwiseAbs().maxCoeff();
      const float phi = (state.lamps[i].phi - truth[i].phi).cwiseAbs().maxCoeff();
      worst = std::max(worst, static_cast<double>(std::max(l, phi)));
    }
    return worst;
  }
};

TEST(FarLamps, AreRecoveredFromASphereWithoutNoise) {
  LitSphere lit(false);
  lit.state.lamps.clear();
  lit.state.lamps = estimate_far_lamps(lit.images, lit.state);
  EXPECT_LT(lit.worst_error(), 1e-4);
}

TEST(FarLamps, AreRecoveredThroughAttachedShadows) {
  LitSphere lit(true);
  lit.state.lamps.clear();
  lit.state.lamps = estimate_far_lamps(lit.images, lit.state);
  EXPECT_GT(lit.worst_error(), 0.01);  // the first estimate knows no shadows
  for (int i = 0; i < 15; ++i) lit.state.lamps = estimate_far_lamps(lit.images, lit.state);
  EXPECT_LT(lit.worst_error(), 1e-3);
}

TEST(FarLamps, OfTheSecondOrderAreRecoveredFromASphereWithoutNoise) {
  LitSphere lit(false);
  lit.truth = lit.state.lamps = test::second_order_lamps();
  lit.images = test::images_of(lit.state);
  lit.state.lamps.clear();
  lit.state.harmonics = 2;
  lit.state.lamps = estimate_far_lamps(lit.images, lit.state);
  EXPECT_LT(lit.worst_error(), 3e-3);
  for (size_t i = 0; i < lit.truth.size(); ++i)
    for (size_t c = 0; c < 3; ++c)
      EXPECT_LT((lit.state.lamps[i].Q[c] - lit.truth[i].Q[c]).cwiseAbs().maxCoeff(), 3e-3f) << i << c;
  lit.state.harmonics = 1;
  lit.state.lamps = estimate_far_lamps(lit.images, lit.state);
  EXPECT_GT(lit.worst_error(), 0.03);  // the first order cannot say it
}

TEST(FarLamps, SolveTheWeightedNormalEquations) {
  LitSphere lit(false);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  test::change_samples(lit.images, [&](PlainSamples& samples) {
    for (float& radiance : samples.radiance) radiance += 0.3f * uniform(random);
    for (unsigned char& usable : samples.usable) usable = uniform(random) < 0.7f;
  });
  for (float& weight : lit.state.weight) weight = uniform(random);
  const std::vector<Lamp> lamps = estimate_far_lamps(lit.images, lit.state);
  const int pixels = lit.images.pixels;
  for (int i = 0; i < lit.images.images; ++i) {
    for (int c = 0; c < 3; ++c) {
      Eigen::MatrixXd A(pixels, 4);
      Eigen::VectorXd b(pixels);
      for (int p = 0; p < pixels; ++p) {
        const float weight = lit.state.weight[static_cast<size_t>(i * pixels + p)];
        const double root = lit.images.usable(i, c, p) ? std::sqrt(static_cast<double>(weight)) : 0;
        A.row(p) << lit.state.normals.col(p).transpose().cast<double>(), 1;
        A.row(p) *= root * static_cast<double>(lit.state.albedo(c, p));
        b[p] = root * static_cast<double>(lit.images.channel(i, c)[p]);
      }
      const Eigen::Vector4d expected = A.colPivHouseholderQr().solve(b);
      const Lamp& lamp = lamps[static_cast<size_t>(i)];
      EXPECT_TRUE(lamp.l.row(c).cast<double>().transpose().isApprox(expected.head<3>(), 1e-3));
      EXPECT_NEAR(static_cast<double>(lamp.phi[c]), expected[3], 1e-3);
    }
  }
}

TEST(FarLamps, ASampleInTheLampsShadowSpeaksForTheAmbientShareOnly) {
  LitSphere lit(true);
  Lamp& side = lit.state.lamps[0];  // from the far left: half the sphere is dark
  side.l.rowwise() = Eigen::RowVector3f(-1, 0, 0);
  lit.truth[0] = side;
  lit.images = test::images_of(lit.state);
  test::change_samples(lit.images, [&](PlainSamples& samples) {
    for (int p = 0; p < lit.images.pixels; ++p) {
      if (lit.state.normals(0, p) <= 0) continue;  // raise what the dark half shows
      for (int c = 0; c < 3; ++c)
        samples.radiance[test::sample_index(lit.images, 0, c, p)] += 0.05f * lit.state.albedo(c, p);
    }
  });
  const Lamp found = estimate_far_lamps(lit.images, lit.state).front();
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(found.phi[c], side.phi[c] + 0.03f);
    EXPECT_NEAR(static_cast<double>(found.l(c, 2)), 0, 0.05);  // the dark half bends no direction
  }
}

TEST(FarLamps, AnImageWithoutAUsableSampleGivesNoLight) {
  LitSphere lit(false);
  lit.state.weight.assign(lit.state.weight.size(), 0.0f);
  for (const Lamp& lamp : estimate_far_lamps(lit.images, lit.state)) EXPECT_EQ(lamp.l.norm(), 0);
}

Lamp from_direction(float x, float y, float z) {
  Lamp lamp;
  lamp.l.rowwise() = Eigen::RowVector3f(x, y, z);
  return lamp;
}

TEST(LampSingularValues, TellThreeDirectionsFromTwoAndOne) {
  const std::vector<Lamp> three{from_direction(2, 0, 0), from_direction(0, 1, 0),
                                from_direction(0, 0, -0.5f)};
  EXPECT_TRUE(lamp_singular_values(three, {}).isApprox(Eigen::Vector3d::Constant(std::sqrt(1.0 / 3)), 1e-6));
  const std::vector<Lamp> plane{from_direction(0.5f, 0, -1), from_direction(-0.5f, 0, -1),
                                from_direction(0.1f, 0, -1), from_direction(0, 0, -2)};
  const Eigen::Vector3d flat = lamp_singular_values(plane, {});
  EXPECT_GT(flat[1], 0.1);
  EXPECT_NEAR(flat[2], 0, 1e-6);
  const std::vector<Lamp> line(4, from_direction(0.3f, 0.2f, -1));
  EXPECT_NEAR(lamp_singular_values(line, {})[1], 0, 1e-6);
  EXPECT_EQ(lamp_singular_values({Lamp{}}, {}), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace rakelight
