// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/robust_weights.h"

#include <gtest/gtest.h>

#include <random>

#include "refine/steps/photometric_tensor.h"
#include "tests/refine/exact_surface.h"

namespace rakelight {
namespace {

constexpr float kSigma = 0.02f;

/// A lit sphere whose images carry Gaussian noise of kSigma.
struct NoisySphere {
  test::ExactSurface sphere = test::exact_sphere();
  SurfaceState state = test::exact_state(sphere, test::varied_albedo(sphere), test::far_lamps(), true);
  Observations images = test::images_of(state);

  NoisySphere() {
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0, kSigma);
    test::change_samples(images, [&](PlainSamples& samples) {
      for (float& radiance : samples.radiance) radiance += noise(random);
    });
  }

  /// The state's weights by residuals of scale kSigma.
  const std::vector<float>& reweighed() {
    PhotometricTensors tensors(static_cast<size_t>(images.pixels));
    reweigh_and_accumulate(images, static_cast<double>(kSigma), AlbedoRole::held, state, tensors);
    return state.weight;
  }

  /// Brightens every fifth pixel of every image, as a highlight does.
  void add_highlights() {
    test::change_samples(images, [&](PlainSamples& samples) {
      for (int i = 0; i < images.images; ++i)
        for (int p = i; p < images.pixels; p += 5)
          for (int c = 0; c < 3; ++c) samples.radiance[test::sample_index(images, i, c, p)] += 0.5f;
    });
  }
};

TEST(ResidualScale, IsTheDeviationOfGaussianNoise) {
  const NoisySphere noisy;
  EXPECT_NEAR(residual_scale(noisy.images, noisy.state), static_cast<double>(kSigma),
              0.05 * static_cast<double>(kSigma));
}

TEST(ResidualScale, IsHardlyMovedByHighlights) {
  NoisySphere noisy;
  noisy.add_highlights();
  EXPECT_LT(residual_scale(noisy.images, noisy.state), 1.4 * static_cast<double>(kSigma));
}

TEST(ResidualScale, IgnoresClippedChannels) {
  NoisySphere noisy;
  test::change_samples(noisy.images, [](PlainSamples& samples) {
    for (size_t k = 0; k < samples.radiance.size(); ++k) {
      if (k % 5 < 3) samples.radiance[k] = 9;
      samples.usable[k] = k % 5 >= 3;
    }
  });
  EXPECT_NEAR(residual_scale(noisy.images, noisy.state), static_cast<double>(kSigma),
              0.05 * static_cast<double>(kSigma));
}

TEST(CauchyWeights, AreLowForHighlightsAndHighForTheRest) {
  NoisySphere noisy;
  noisy.add_highlights();
  const auto weights = noisy.reweighed();
  double rest = 0;
  int rest_count = 0;
  for (int i = 0; i < noisy.images.images; ++i) {
    for (int p = 0; p < noisy.images.pixels; ++p) {
      const float weight = weights[static_cast<size_t>(i * noisy.images.pixels + p)];
      if (p >= i && (p - i) % 5 == 0) {
        EXPECT_LT(weight, 0.01f);
      } else {
        rest += static_cast<double>(weight);
        ++rest_count;
      }
    }
  }
  EXPECT_GT(rest / rest_count, 0.5);
}

TEST(CauchyWeights, AreAHalfWhereTheResidualIsTheScale) {
  NoisySphere noisy;
  noisy.images = test::images_of(noisy.state);
  test::change_samples(noisy.images, [&](PlainSamples& samples) {
    for (int c = 0; c < 3; ++c) samples.radiance[test::sample_index(noisy.images, 2, c, 11)] += kSigma;
  });
  const auto weights = noisy.reweighed();
  EXPECT_LT(std::abs(weights[static_cast<size_t>(2 * noisy.images.pixels + 11)] - 0.5f), 1e-4f);
  EXPECT_LT(std::abs(weights[static_cast<size_t>(2 * noisy.images.pixels + 12)] - 1.0f), 1e-4f);
}

TEST(CauchyWeights, JudgeASampleByItsUsableChannelsAlone) {
  NoisySphere noisy;
  noisy.images = test::images_of(noisy.state);
  test::change_samples(noisy.images, [&](PlainSamples& samples) {
    const size_t clipped = test::sample_index(noisy.images, 0, 1, 3);
    samples.radiance[clipped] = 9;
    samples.usable[clipped] = 0;
    for (int c = 0; c < 3; ++c) samples.usable[test::sample_index(noisy.images, 0, c, 4)] = 0;
  });
  const auto weights = noisy.reweighed();
  EXPECT_LT(std::abs(weights[3] - 1.0f), 1e-4f);
  EXPECT_EQ(weights[4], 0);
}

TEST(CauchyWeights, AreThoseOfTheTensorsMadeWithThem) {
  NoisySphere noisy;
  noisy.add_highlights();
  PhotometricTensors tensors(static_cast<size_t>(noisy.images.pixels));
  reweigh_and_accumulate(noisy.images, static_cast<double>(kSigma), AlbedoRole::held, noisy.state, tensors);
  const PhotometricTensors again = accumulate_tensors(noisy.images, noisy.state);
  for (size_t p = 0; p < tensors.size(); ++p) {
    EXPECT_EQ(tensors[p].G, again[p].G);
    EXPECT_EQ(tensors[p].h, again[p].h);
    EXPECT_EQ(tensors[p].e0, again[p].e0);
  }
}

TEST(UsableWeights, AreOneWhereAnyChannelIsUsable) {
  NoisySphere noisy;
  test::change_samples(noisy.images, [&](PlainSamples& samples) {
    for (int c = 0; c < 3; ++c) samples.usable[test::sample_index(noisy.images, 0, c, 4)] = 0;
    samples.usable[test::sample_index(noisy.images, 0, 1, 5)] = 0;
  });
  const auto weights = usable_weights(noisy.images);
  EXPECT_EQ(weights.size(), static_cast<size_t>(noisy.images.images * noisy.images.pixels));
  EXPECT_EQ(weights[4], 0);
  EXPECT_EQ(weights[5], 1);
}

TEST(MedianRadiance, IsTheMiddleOfTheUsableSamples) {
  NoisySphere noisy;
  test::change_samples(noisy.images, [](PlainSamples& samples) {
    for (size_t k = 0; k < samples.radiance.size(); ++k)
      samples.radiance[k] = k % 3 == 0 ? 0.1f : k % 3 == 1 ? 0.3f : 0.9f;
  });
  EXPECT_NEAR(median_radiance(noisy.images), 0.3, 1e-5);
  test::change_samples(noisy.images, [](PlainSamples& samples) {
    for (size_t k = 0; k < samples.usable.size(); ++k) samples.usable[k] = k % 3 == 0;
  });
  EXPECT_NEAR(median_radiance(noisy.images), 0.1, 1e-5);
}

}  // namespace
}  // namespace rakelight
