// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The short sums of plain images (refine/kernels/plain_kernels.h) against the general ones: weights of 1 mean the same as none, and
// make every image a general one.
#include <gtest/gtest.h>

#include <atomic>
#include <random>

#include "refine/steps/albedo.h"
#include "refine/steps/lighting.h"
#include "refine/steps/photometric_tensor.h"
#include "refine/steps/quality.h"
#include "refine/steps/residual_draws.h"
#include "refine/tiles.h"
#include "tests/refine/exact_surface.h"

namespace rakelight {
namespace {

enum class Lamps { far, far_without_shadows, near_among_far, second_order };

/// A sphere under lamps that leave parts of it dark, its images noisy and partly unusable, its albedo not quite known.
struct PartlyPlain {
  test::ExactSurface sphere = test::exact_sphere(192);
  SurfaceState plain, general;
  Observations images;

  explicit PartlyPlain(Lamps kind) {
    std::vector<Lamp> lamps = kind == Lamps::second_order ? test::second_order_lamps() : test::far_lamps();
    if (kind == Lamps::near_among_far) {
      lamps[1].near = true;
      lamps[1].direction = Eigen::Vector3f(0.3f, 0, -1).normalized();
      lamps[1].inverse_distance = 1;
      lamps[1].strength << 0.5f, 0.6f, 0.7f;
    }
    general =
        test::exact_state(sphere, test::varied_albedo(sphere), lamps, kind != Lamps::far_without_shadows);
    general.harmonics = kind == Lamps::second_order ? 2 : 1;
    images = test::images_of(general);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    test::change_samples(images, [&](PlainSamples& samples) {
      for (float& radiance : samples.radiance) radiance += 0.1f * uniform(random);
      for (int i = 0; i < images.images; ++i) {
        for (int p = 1000 * i; p < 1000 * i + 700; ++p)  // a channel here, all of them there
          for (int c = 0; c < (p % 2 == 0 ? 1 : 3); ++c)
            samples.usable[test::sample_index(images, i, c, p)] = uniform(random) < 0.8f;
        for (int c = 0; c < 3; ++c) samples.usable[test::sample_index(images, i, c, 9000)] = 0;
      }
      for (int p = 10000; p < 10100; ++p) samples.usable[test::sample_index(images, 2, p % 3, p)] = 0;
    });
    for (Eigen::Index k = 0; k < general.albedo.size(); ++k)
      general.albedo.data()[k] *= 0.9f + 0.2f * uniform(random);
    plain = general;
    plain.weight.clear();
  }
};

class PlainImages : public testing::TestWithParam<Lamps> {};

/// Of far lamps: near ones are found another way.
class PlainLights : public testing::TestWithParam<Lamps> {};

TEST_P(PlainLights, AreThoseOfTheGeneralSums) {
  const PartlyPlain sphere(GetParam());
  const std::vector<Lamp> found = estimate_far_lamps(sphere.images, sphere.plain),
                          expected = estimate_far_lamps(sphere.images, sphere.general);
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_LT((found[i].l - expected[i].l).cwiseAbs().maxCoeff(), 1e-5f) << i;
    EXPECT_LT((found[i].phi - expected[i].phi).cwiseAbs().maxCoeff(), 1e-5f) << i;
  }
}

TEST_P(PlainImages, GiveTheAlbedoOfTheGeneralSums) {
  const PartlyPlain sphere(GetParam());
  const Eigen::Matrix3Xf found = estimate_albedo(sphere.images, sphere.plain),
                         expected = estimate_albedo(sphere.images, sphere.general);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-5f);
  EXPECT_EQ(found.col(9000), sphere.plain.albedo.col(9000));  // no sample there
}

void expect_same(const PhotometricTensors& found, const PhotometricTensors& expected) {
  for (size_t p = 0; p < expected.size(); ++p) {
    const PhotometricTensor a = found[p], b = expected[p];
    ASSERT_LT((a.G - b.G).cwiseAbs().maxCoeff(), 2e-5f) << p;
    ASSERT_LT((a.h - b.h).cwiseAbs().maxCoeff(), 2e-5f) << p;
    ASSERT_NEAR(static_cast<double>(a.e0), static_cast<double>(b.e0), 2e-5) << p;
  }
}

TEST_P(PlainImages, GiveTheTensorsOfTheGeneralSums) {
  const PartlyPlain sphere(GetParam());
  const PhotometricTensors found = accumulate_tensors(sphere.images, sphere.plain);
  expect_same(found, accumulate_tensors(sphere.images, sphere.general));
  EXPECT_EQ(found[9000].G.norm() + found[9000].h.norm() + found[9000].e0, 0);
}

TEST_P(PlainImages, GiveAlbedoAndTensorsAtOnce) {
  PartlyPlain sphere(GetParam());
  const auto pixels = static_cast<size_t>(sphere.images.pixels);
  PhotometricTensors found(pixels), weighted(pixels);
  find_albedo_and_accumulate(sphere.images, AlbedoRole::held, sphere.plain, found);
  find_albedo_and_accumulate(sphere.images, AlbedoRole::held, sphere.general, weighted);
  SurfaceState in_turn = sphere.general;
  in_turn.albedo = estimate_albedo(sphere.images, in_turn);
  EXPECT_LT((sphere.plain.albedo - in_turn.albedo).cwiseAbs().maxCoeff(), 1e-5f);
  const PhotometricTensors expected = accumulate_tensors(sphere.images, in_turn);
  expect_same(found, expected);
  expect_same(weighted, expected);
}

TEST_P(PlainImages, LetTheAlbedoFollowAsTheGeneralSumsDo) {
  PartlyPlain sphere(GetParam());
  const auto pixels = static_cast<size_t>(sphere.images.pixels);
  PhotometricTensors found(pixels), expected(pixels);
  find_albedo_and_accumulate(sphere.images, AlbedoRole::follows_normal, sphere.plain, found);
  find_albedo_and_accumulate(sphere.images, AlbedoRole::follows_normal, sphere.general, expected);
  expect_same(found, expected);
}

/// Without shadows, lamp images are linear in the normal: what the best albedo leaves of them is known.
TEST(AlbedoThatFollowsTheNormal, GivesTheEnergyOfTheBestAlbedoToSecondOrder) {
  PartlyPlain sphere(Lamps::far_without_shadows);
  PhotometricTensors held(static_cast<size_t>(sphere.images.pixels)), following = held;
  find_albedo_and_accumulate(sphere.images, AlbedoRole::held, sphere.plain, held);
  find_albedo_and_accumulate(sphere.images, AlbedoRole::follows_normal, sphere.plain, following);
  const auto best_energy = [&](size_t p, const Eigen::Vector3f& n) {
    double energy = 0;
    for (int c = 0; c < 3; ++c) {
      double SS = 0, SI = 0, II = 0;
      for (int i = 0; i < sphere.images.images; ++i) {
        const int pixel = static_cast<int>(p);
        if (!sphere.images.usable(i, c, pixel)) continue;
        const Lamp& lamp = sphere.plain.lamps[static_cast<size_t>(i)];
        const double S = static_cast<double>(lamp.l.row(c).dot(n) + lamp.phi[c]);
        const auto I = static_cast<double>(sphere.images.radiance_at(i, pixel)[c]);
        SS += S * S;
        SI += S * I;
        II += I * I;
      }
      energy += SS > 0 ? II - SI * SI / SS : II;
    }
    return energy;
  };
  double miss = 0, miss_held = 0;
  for (size_t p = 3; p < held.size(); p += 301) {
    const Eigen::Vector3f n = sphere.plain.normals.col(static_cast<Eigen::Index>(p));
    const Eigen::Vector3f turned = n + Eigen::Vector3f(0.02f, -0.03f, 0.01f);
    EXPECT_NEAR(static_cast<double>(following[p].energy(n)), best_energy(p, n), 2e-5) << p;
    const double expected = best_energy(p, turned) - best_energy(p, n);
    miss += std::abs(static_cast<double>(following[p].energy(turned) - following[p].energy(n)) - expected);
    miss_held += std::abs(static_cast<double>(held[p].energy(turned) - held[p].energy(n)) - expected);
  }
  EXPECT_LT(miss, 0.2 * miss_held);
}

TEST_P(PlainImages, HoldNoShadowAndNoUnusableSample) {
  const PartlyPlain sphere(GetParam());
  const std::vector<kernels::TileLamp> lamps = tile_lamps(sphere.plain);
  std::atomic<long> plain{0}, general{0};
  for_each_tile(sphere.images, sphere.plain, [&](Tile& tile) {
    int end = 0;
    for (const TileStretch& stretch : tile.stretches(lamps)) {
      EXPECT_EQ(stretch.pixels.begin, end);
      end = stretch.pixels.end;
      EXPECT_EQ(stretch.plain.size() + stretch.others.size(), lamps.size());
      plain += static_cast<long>(stretch.plain.size()) * (end - stretch.pixels.begin);
      general += static_cast<long>(stretch.others.size()) * (end - stretch.pixels.begin);
      for (int k = stretch.pixels.begin; k < end; ++k) {
        for (const int i : stretch.plain) {
          const int p = tile.begin() + k;
          ASSERT_LT(k, tile.count());
          ASSERT_EQ(sphere.images.usable_channels(i, p).sum(), 3);
          const Eigen::Vector3f incidence =
              sphere.plain.lamps[static_cast<size_t>(i)].l * sphere.plain.normals.col(p);
          ASSERT_TRUE(incidence.minCoeff() > 0 || !sphere.plain.attached_shadows);
        }
      }
    }
    EXPECT_GE(end, tile.count());
  });
  EXPECT_GT(general, 2000);
  if (GetParam() == Lamps::second_order)
    EXPECT_EQ(plain, 0);
  else
    EXPECT_GT(plain, 20000);
}

TEST(StatesWithoutWeights, TrustEveryUsableSampleFully) {
  PartlyPlain sphere(Lamps::far);
  sphere.general.weight = usable_weights(sphere.images);
  EXPECT_EQ(lit_images(sphere.images, sphere.plain), lit_images(sphere.images, sphere.general));
  const DrawFactors factors = DrawFactors::Ones(sphere.images.images, kDrawsAtATime);
  const std::vector<DrawnPulls> found = pulls_of_scaled_residuals(sphere.images, sphere.plain, factors),
                                expected = pulls_of_scaled_residuals(sphere.images, sphere.general, factors);
  for (size_t p = 0; p < expected.size(); ++p) ASSERT_EQ(found[p], expected[p]) << p;
}

TEST(PlainImagesOfAState, AreNoneWhereSamplesHaveWeights) {
  const PartlyPlain sphere(Lamps::far);
  for_each_tile(sphere.images, sphere.general, [&](Tile& tile) {
    const std::vector<TileStretch>& stretches = tile.stretches(tile_lamps(sphere.general));
    ASSERT_EQ(stretches.size(), 1U);
    EXPECT_TRUE(stretches.front().plain.empty());
  });
}

INSTANTIATE_TEST_SUITE_P(Under, PlainLights,
                         testing::Values(Lamps::far, Lamps::far_without_shadows, Lamps::second_order));

INSTANTIATE_TEST_SUITE_P(Under, PlainImages,
                         testing::Values(Lamps::far, Lamps::far_without_shadows, Lamps::near_among_far,
                                         Lamps::second_order));

}  // namespace
}  // namespace rakelight
