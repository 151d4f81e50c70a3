// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/albedo.h"

#include <gtest/gtest.h>

#include "tests/refine/exact_surface.h"

namespace rakelight {
namespace {

struct LitSphere {
  test::ExactSurface sphere = test::exact_sphere(24);
  Eigen::Matrix3Xf truth = test::varied_albedo(sphere);
  SurfaceState state = test::exact_state(sphere, truth, test::far_lamps(), true);
  Observations images = test::images_of(state);
};

TEST(Albedo, IsRecoveredFromImagesWithoutNoise) {
  LitSphere lit;
  lit.state.albedo.setOnes();
  EXPECT_TRUE(estimate_albedo(lit.images, lit.state).isApprox(lit.truth, 1e-4f));
}

TEST(Albedo, IgnoresSamplesThatAreNotTrusted) {
  LitSphere lit;
  lit.state.albedo.setOnes();
  test::change_samples(lit.images, [&](PlainSamples& samples) {
    for (int p = 0; p < lit.images.pixels; ++p) {
      for (int c = 0; c < 3; ++c) samples.radiance[test::sample_index(lit.images, 0, c, p)] = 5;
      lit.state.weight[static_cast<size_t>(p)] = 0;
      const size_t clipped = test::sample_index(lit.images, 1, 2, p);  // one channel alone
      samples.radiance[clipped] = 1;
      samples.usable[clipped] = 0;
    }
  });
  EXPECT_TRUE(estimate_albedo(lit.images, lit.state).isApprox(lit.truth, 1e-4f));
}

TEST(Albedo, IsTheWeightedLeastSquaresAnswer) {
  LitSphere lit;
  test::change_samples(lit.images, [](PlainSamples& samples) {
    for (size_t k = 0; k < samples.radiance.size(); ++k)
      samples.radiance[k] += 0.1f * static_cast<float>(k % 3);
  });
  for (size_t k = 0; k < lit.state.weight.size(); ++k)
    lit.state.weight[k] = 0.2f + 0.2f * static_cast<float>(k % 4);
  const Eigen::Matrix3Xf found = estimate_albedo(lit.images, lit.state);
  const int p = lit.images.pixels / 2;
  float numerator = 0, denominator = 0;
  for (int i = 0; i < lit.images.images; ++i) {
    const Lamp& lamp = lit.state.lamps[static_cast<size_t>(i)];
    const float S = std::max(0.0f, lamp.l.row(1).dot(lit.state.normals.col(p))) + lamp.phi[1];
    const float w = lit.state.weight[static_cast<size_t>(i * lit.images.pixels + p)];
    numerator += w * S * lit.images.channel(i, 1)[p];
    denominator += w * S * S;
  }
  EXPECT_NEAR(static_cast<double>(found(1, p)), static_cast<double>(numerator / denominator), 1e-5);
}

TEST(Albedo, OfAPixelThatNoSampleLightsStaysAsItWas) {
  LitSphere lit;
  lit.state.albedo.setConstant(0.123f);
  for (int i = 0; i < lit.images.images; ++i)
    lit.state.weight[static_cast<size_t>(i * lit.images.pixels + 7)] = 0;
  EXPECT_EQ(estimate_albedo(lit.images, lit.state).col(7), Eigen::Vector3f::Constant(0.123f));
}

TEST(NormalizeAlbedo, MakesTheMeanOneAndKeepsWhatTheImagesShow) {
  LitSphere lit;
  Lamp near;
  near.near = true;
  near.inverse_distance = 1;
  near.strength << 0.5f, 0.6f, 0.7f;
  near.phi << 0.1f, 0.1f, 0.2f;
  lit.state.lamps[0] = near;
  const Observations before = test::images_of(lit.state);
  normalize_albedo(lit.state);
  const Observations after = test::images_of(lit.state);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(static_cast<double>(lit.state.albedo.row(c).mean()), 1, 1e-5);
  for (int i = 0; i < before.images; ++i)
    for (int p = 0; p < before.pixels; ++p)
      EXPECT_LT((before.radiance_at(i, p) - after.radiance_at(i, p)).cwiseAbs().maxCoeff(), 3e-5f);
}

}  // namespace
}  // namespace rakelight
