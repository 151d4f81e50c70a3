// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamps.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "refine/kernels/gram.h"
#include "refine/steps/matt_images.h"
#include "refine/steps/near_lamp_equations.h"
#include "refine/steps/near_lamp_incidence.h"
#include "refine/steps/near_lamp_model.h"
#include "refine/steps/near_lamp_prior.h"
#include "refine/steps/near_lamp_search.h"
#include "tests/refine/exact_surface.h"

namespace rakelight {
namespace {

Lamp near_lamp(float x, float y, float distance_m) {
  Lamp lamp;
  lamp.near = true;
  lamp.direction = Eigen::Vector3f(x, y, -1).normalized();
  lamp.inverse_distance = 1 / distance_m;
  lamp.strength << 0.8f, 0.7f, 0.6f;
  lamp.phi << 0.05f, 0.04f, 0.03f;
  return lamp;
}

/// A sphere of varied albedo under four near lamps.
struct NearlyLitSphere {
  test::ExactSurface sphere = test::exact_sphere();
  std::vector<Lamp> truth{near_lamp(0.5f, 0, 0.7f), near_lamp(0, 0.6f, 0.8f), near_lamp(-0.4f, -0.3f, 0.6f),
                          near_lamp(0.1f, -0.6f, 0.9f)};
  SurfaceState state = test::exact_state(sphere, test::varied_albedo(sphere), truth, true);
  Observations images = test::images_of(state);

  std::vector<RegionSamples> samples() const { return sample_lamp_regions(images, state); }
};

/// Strength of lamp i over that of the first, a channel: the albedo takes up a factor that all lamps share.
Eigen::Vector3f against_first(const std::vector<Lamp>& lamps, size_t i) {
  return lamps[i].strength.cwiseQuotient(lamps[0].strength);
}

/// A run of one surface point, repeated.
SurfacePoints one_point(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
  return {Eigen::Matrix3Xf(point), Eigen::Matrix3Xf(normal), {0}};
}

const LampScene kScene{Eigen::Vector3f(0.02f, -0.01f, 0.9f), 1};

/// max(0, v.n) at a point.
float incidence_at(const Lamp& lamp, const LampScene& scene, const Eigen::Vector3f& point,
                   const Eigen::Vector3f& normal) {
  return near_incidence(lamp, scene, one_point(point, normal))[0];
}

/// A region of one point, whose broad change c is: zeta + B_c, n + column c of `turned`.
struct OnePointRegion {
  RegionSamples samples{{0}, Eigen::ArrayXXf::Zero(padded(1), 3), Eigen::ArrayXXf::Zero(padded(1), 3)};
  LampRegion region;
  Eigen::Matrix<float, 1, kBroadChanges> B;
  Eigen::Matrix<float, 3, kBroadChanges> turned;

  OnePointRegion(const Eigen::Vector3f& point, const Eigen::Vector3f& normal)
      : region{&samples, one_point(point, normal), {}, {}, {}, {}, {}, {}} {
    B << 1, 0.2f, -0.1f, 0.3f, 0, 0.5f, -0.4f;
    for (int c = 0; c < kBroadChanges; ++c)
      turned.col(c) = 0.1f * Eigen::Vector3f(static_cast<float>(c), 1.0f - static_cast<float>(c), 0.5f);
    region.B = B.array().replicate(padded(1), 1);
    region.normal_by_c.resize(padded(1), 3 * kBroadChanges);
    for (int axis = 0; axis < 3; ++axis)
      region.normal_by_c.middleCols<kBroadChanges>(kBroadChanges * axis) =
          turned.row(axis).array().replicate(padded(1), 1);
  }
};

TEST(NearLampIncidence, ItsDerivativesAgreeWithFiniteDifferences) {
  const Eigen::Vector3f point = kScene.center + Eigen::Vector3f(0.1f, -0.05f, 0.08f),
                        normal = Eigen::Vector3f(0.2f, 0.3f, -1).normalized();
  const OnePointRegion at(point, normal);
  const float h = 2e-3f;
  for (const float lobe : {0.0f, 1.0f, 2.5f}) {
    const Lamp lamp = near_lamp(0.4f, -0.2f, 0.7f);
    LampScene scene = kScene;
    scene.lobe_exponent = lobe;
    const Eigen::Matrix<float, 3, 2> tangents = lamp_tangents(lamp.direction);
    const auto by_place = [&](int unknown, float change) {
      Lamp moved = lamp;
      if (unknown < 2) moved.direction = (lamp.direction + change * tangents.col(unknown)).normalized();
      if (unknown == 2) moved.inverse_distance += change;
      return incidence_at(moved, scene, point, normal);
    };
    const auto by_aim = [&](int axis, float change) {
      Lamp seen = lamp;  // the same place, seen from the moved centre
      LampScene moved = scene;
      moved.center[axis] += change;
      const Eigen::Vector3f X = lamp.direction / lamp.inverse_distance - change * Eigen::Vector3f::Unit(axis);
      seen.direction = X.normalized();
      seen.inverse_distance = 1 / X.norm();
      return incidence_at(seen, moved, point, normal);
    };
    const auto by_shape = [&](int c, float change) {
      return incidence_at(lamp, scene, point * std::exp(change * at.B[c]),
                          normal + change * at.turned.col(c));
    };
    const ShadingDerivatives found = shading_derivatives(lamp, scene, at.region, at.region.surface);
    EXPECT_FLOAT_EQ(found(0, kValue), incidence_at(lamp, scene, point, normal));
    const auto expect_slope = [&](const auto& by, int unknown, Eigen::Index column) {
      EXPECT_NEAR((by(unknown, h) - by(unknown, -h)) / (2 * h), found(0, column), 2e-3f)
          << "unknown " << unknown << ", lobe " << lobe;
    };
    for (int k = 0; k < 3; ++k) expect_slope(by_place, k, kByPlace + k);
    for (int k = 0; k < 3; ++k) expect_slope(by_aim, k, kByShared + k);
    for (int c = 0; c < kBroadChanges; ++c) expect_slope(by_shape, c, kByShared + NearLampUnknowns::kAim + c);
  }
}

TEST(NearLampIncidence, IsZeroWhereTheLampDoesNotReach) {
  const OnePointRegion away(kScene.center, {0, 0, 1});
  const ShadingDerivatives found =
      shading_derivatives(near_lamp(0, 0, 0.7f), kScene, away.region, away.region.surface);
  EXPECT_TRUE(found.isZero(0));
  EXPECT_EQ(incidence_at(near_lamp(0, 0, 0.7f), kScene, kScene.center, {0, 0, 1}), 0);
}

TEST(Highlights, AreHalfAsBrightAtTheAnglesThatTheirLobesSay) {
  Lamp lamp = near_lamp(0, 0, 0.7f);
  const Eigen::Vector3f to_eye = -kScene.center.normalized();
  lamp.direction = to_eye;  // lamp and eye in one line: half-way is the way to the eye
  constexpr float kHalves[] = {16.8f, 8.4f};
  for (int j = 0; j < kHighlightLobes; ++j) {
    const auto lobe_at = [&](float degrees) {
      const Eigen::Vector3f normal =
          Eigen::AngleAxisf(degrees * 3.14159265f / 180, to_eye.unitOrthogonal()) * to_eye;
      const SurfacePoints at = one_point(kScene.center, normal);
      Eigen::ArrayXXf values(at.rows(), kHighlightLobes);
      float* lobes[] = {values.col(0).data(), values.col(1).data()};
      kernels::highlight_lobes(near_light(lamp, kScene), at.runs(), at.rows(), lobes);
      return values(0, j);
    };
    EXPECT_NEAR(lobe_at(0), 1, 1e-4f);
    EXPECT_NEAR(lobe_at(kHalves[j]), 0.5f, 0.01f);
    EXPECT_EQ(lobe_at(100), 0) << "the lamp is behind the surface";
  }
}

TEST(Gram, IsTheProductOfAllPairsOfRuns) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  for (const Eigen::Index rows : {Eigen::Index{16}, Eigen::Index{48}, Eigen::Index{336}}) {
    Eigen::MatrixXf values(rows, 3 * kernels::kGramRuns);
    for (Eigen::Index k = 0; k < values.size(); ++k) values(k) = normal(random);
    Eigen::MatrixXf found(values.cols(), values.cols());
    kernels::gram(values.data(), rows, static_cast<int>(values.cols()), static_cast<int>(rows), found.data());
    const Eigen::MatrixXf expected = values.transpose() * values;
    for (Eigen::Index a = 0; a < found.rows(); ++a)
      for (Eigen::Index b = 0; b <= a; ++b) EXPECT_NEAR(found(a, b), expected(a, b), 1e-3f);
  }
}

/// Sensor's depth of the sphere, 2 x 2 pixels a reading, that pulls it a little away.
DepthPrior pull_on(const test::ExactSurface& sphere) {
  DepthPrior prior;
  prior.cells = make_cells(sphere.grid, 2);
  prior.cell_target = cell_means(prior.cells, sphere.zeta).array() + 0.02;
  prior.cell_weight = Eigen::VectorXd::Constant(prior.cell_target.size(), 3);
  prior.start = sphere.zeta;
  return prior;
}

TEST(NearLampEquations, TheirRightHandSideIsTheEnergysSlope) {
  NearlyLitSphere lit;
  for (Lamp& lamp : lit.state.lamps) lamp.inverse_distance *= 0.8f;
  const DepthPrior prior = pull_on(lit.sphere);
  const BroadShape shape{lit.sphere.grid, prior};
  const auto samples = sample_lamp_regions(lit.images, lit.state, lit.images.pixels);
  const auto regions = lamp_regions(samples, &shape, lit.state);
  const NearLampUnknowns at{lit.state.lamps, lit.state.scene, Gloss(0.02, 0.03)};
  Eigen::VectorXd found = Eigen::VectorXd::Zero(at.size()), slope = found;
  for (const NearLampEquations& region : near_lamp_equations(regions, at)) found -= 2 * region.b;
  constexpr double h = 1e-3;
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(at.size(), k);
    slope[k] =
        (near_lamp_energy(regions, at.moved(step, 10)) - near_lamp_energy(regions, at.moved(-step, 10))) /
        (2 * h);
  }
  EXPECT_GT(slope.head(at.aim_at()).norm(), 0.1);
  EXPECT_GT(slope.tail(NearLampUnknowns::kShared).norm(), 0.1);
  for (Eigen::Index k = 0; k < at.size(); ++k)
    EXPECT_NEAR(found[k], slope[k], 0.02 * std::abs(slope[k]) + 2e-3 * slope.norm()) << "unknown " << k;
}

TEST(NearLampEquations, KnowNothingOfAFactorThatAlbedoAndStrengthShare) {
  const NearlyLitSphere lit;
  const auto samples = sample_lamp_regions(lit.images, lit.state, lit.images.pixels);
  const auto regions = lamp_regions(samples, nullptr, lit.state);
  const NearLampUnknowns at{lit.state.lamps, lit.state.scene};
  Eigen::VectorXd brighter = Eigen::VectorXd::Zero(at.size());
  for (size_t i = 0; i < at.lamps.size(); ++i) {
    brighter[at.lamp_at(static_cast<Eigen::Index>(i)) + 3] = static_cast<double>(at.lamps[i].strength[0]);
    brighter[at.lamp_at(static_cast<Eigen::Index>(i)) + 6] = static_cast<double>(at.lamps[i].phi[0]);
  }
  double curvature = 0, of_one_lamp = 0;
  for (const NearLampEquations& region : near_lamp_equations(regions, at)) {
    curvature += brighter.dot(region.A * brighter);
    of_one_lamp += region.A(3, 3);
  }
  EXPECT_GT(of_one_lamp, 1);
  EXPECT_NEAR(curvature / of_one_lamp, 0, 1e-5);
}

TEST(NearLamps, ShadeAsThePointSourceFormulaSays) {
  const NearlyLitSphere lit;
  const Lamp& lamp = lit.truth[2];
  const Eigen::Vector3d X = lamp_position(lamp, lit.state.scene),
                        center = lit.state.scene.center.cast<double>();
  const double R = (X - center).norm();
  for (int p = 0; p < lit.images.pixels; p += 37) {
    const Eigen::Vector3d to_lamp = X - lit.state.points.col(p).cast<double>();
    const double cosine = to_lamp.dot(X - center) / (to_lamp.norm() * R);
    const double expected = to_lamp.dot(lit.state.normals.col(p).cast<double>()) * R * R * cosine /
                            std::pow(to_lamp.norm(), 3) * static_cast<double>(lamp.strength[0]);
    const LocalLight light = light_at(lamp, lit.state.points.col(p), lit.state.scene);
    EXPECT_NEAR(static_cast<double>(light.l.row(0).dot(lit.state.normals.col(p))), expected, 1e-4);
  }
}

TEST(NearLamps, AtInfiniteDistanceAreFarLamps) {
  const NearlyLitSphere lit;
  Lamp lamp = lit.truth[0];
  lamp.inverse_distance = 0;
  for (int p = 0; p < lit.images.pixels; p += 37) {
    const LocalLight light = light_at(lamp, lit.state.points.col(p), lit.state.scene);
    EXPECT_TRUE(light.l.isApprox(lamp.strength * lamp.direction.transpose(), 1e-6f));
    EXPECT_EQ(light.phi, lamp.phi);
  }
}

TEST(NearLamps, StartFromFarOnesWithTheirDirectionAndStrength) {
  Lamp far;
  far.l.row(0) = far.l.row(1) = far.l.row(2) = Eigen::RowVector3f(0.6f, 0, -0.8f);
  far.phi << 0.1f, 0.2f, 0.3f;
  const Lamp near = near_from_far(far, 1.5f);
  EXPECT_TRUE(near.near);
  EXPECT_TRUE(near.direction.isApprox(Eigen::Vector3f(0.6f, 0, -0.8f)));
  EXPECT_TRUE(near.strength.isApprox(Eigen::Vector3f::Ones()));
  EXPECT_EQ(near.phi, far.phi);
  EXPECT_EQ(near.inverse_distance, 1.5f);
}

TEST(NearLamps, AreFoundFromTwiceTooFarAway) {
  NearlyLitSphere lit;
  for (Lamp& lamp : lit.state.lamps) lamp.inverse_distance /= 2;
  Gloss gloss = Gloss::Zero();
  for (int i = 0; i < 10; ++i) fit_near_lamps(lit.samples(), nullptr, {}, lit.state, gloss);
  for (size_t i = 0; i < lit.truth.size(); ++i) {
    const Eigen::Vector3d expected = lamp_position(lit.truth[i], lit.state.scene);
    EXPECT_LT((lamp_position(lit.state.lamps[i], lit.state.scene) - expected).norm(), 0.01)
        << "metres, lamp " << i;
    EXPECT_TRUE(against_first(lit.state.lamps, i).isApprox(against_first(lit.truth, i), 0.02f))
        << "lamp " << i;
  }
}

TEST(NearLamps, OfFarLightMoveAway) {
  NearlyLitSphere lit;
  for (Lamp& lamp : lit.state.lamps) lamp.inverse_distance = 0;
  lit.images = test::images_of(lit.state);
  for (Lamp& lamp : lit.state.lamps) lamp.inverse_distance = 1;
  Gloss gloss = Gloss::Zero();
  for (int i = 0; i < 10; ++i) fit_near_lamps(lit.samples(), nullptr, {}, lit.state, gloss);
  for (const Lamp& lamp : lit.state.lamps) EXPECT_LT(lamp.inverse_distance, 0.02f);
}

TEST(NearLamps, AtGivenPositionsKeepThemAndFitTheirStrength) {
  NearlyLitSphere lit;
  for (size_t i = 0; i < lit.truth.size(); ++i)
    lit.state.lamps[i].strength *= 0.4f + 0.2f * static_cast<float>(i);
  NearLampOptions options;
  options.fixed_positions = true;
  options.steps = 10;
  Gloss gloss = Gloss::Zero();
  fit_near_lamps(lit.samples(), nullptr, options, lit.state, gloss);
  const std::vector<Lamp>& found = lit.state.lamps;
  for (size_t i = 0; i < lit.truth.size(); ++i) {
    EXPECT_TRUE(found[i].direction.isApprox(lit.truth[i].direction, 1e-6f));
    EXPECT_FLOAT_EQ(found[i].inverse_distance, lit.truth[i].inverse_distance);
    EXPECT_TRUE(against_first(found, i).isApprox(against_first(lit.truth, i), 1e-3f)) << "lamp " << i;
  }
}

TEST(NearLamps, FarOnesAreLeftAlone) {
  NearlyLitSphere lit;
  lit.state.lamps[1] = test::far_lamp(0.3f, 0.2f);
  const Eigen::Matrix3f before = lit.state.lamps[1].l;
  Gloss gloss = Gloss::Zero();
  fit_near_lamps(lit.samples(), nullptr, {}, lit.state, gloss);
  EXPECT_EQ(lit.state.lamps[1].l, before);
}

/// Adds the highlights of the true lamps to the images, and a cast shadow to the first.
void make_glossy_and_shadowed(const Gloss& gloss, NearlyLitSphere& lit) {
  const Observations matt = lit.images;
  SurfaceState dull = lit.state;
  take_off_highlights(matt, dull, -gloss, lit.images);
  test::change_samples(lit.images, [&](PlainSamples& samples) {
    for (int p = 0; p < lit.images.pixels; ++p)
      if (lit.state.points(0, p) > 0.05f && lit.state.points(1, p) > 0)
        for (int c = 0; c < 3; ++c) samples.radiance[test::sample_index(lit.images, 0, c, p)] *= 0.05f;
  });
}

/// Mean distance of the lamps found from the true ones, metres, after a fit of glossy, shadowed images from the truth on.
double error_under_gloss_and_shadow(bool highlights, Gloss& gloss) {
  NearlyLitSphere lit;
  make_glossy_and_shadowed(Gloss(0.1, 0.2), lit);
  NearLampOptions options;
  options.highlights = highlights;
  gloss.setZero();
  for (int i = 0; i < 20; ++i) fit_near_lamps(lit.samples(), nullptr, options, lit.state, gloss);
  double sum = 0;
  for (size_t i = 0; i < lit.truth.size(); ++i)
    sum +=
        (lamp_position(lit.state.lamps[i], lit.state.scene) -
         lamp_position(lit.truth[i], test::exact_state(lit.sphere, lit.state.albedo, lit.truth, true).scene))
            .norm();
  return sum / static_cast<double>(lit.truth.size());
}

TEST(NearLamps, AreFoundDespiteHighlightsAndShadows) {
  Gloss found, none;
  const double knowing = error_under_gloss_and_shadow(true, found);
  EXPECT_LT(knowing, 0.01);
  EXPECT_GT(error_under_gloss_and_shadow(false, none), 5 * knowing);
  EXPECT_NEAR(found[0], 0.1, 0.03);
  EXPECT_NEAR(found[1], 0.2, 0.06);
  EXPECT_TRUE(none.isZero(0));
}

TEST(NearLampPrior, PullsAPowerThatTheOthersDoNotShare) {
  NearlyLitSphere lit;
  lit.state.lamps[0].strength *= 5;
  const NearLampUnknowns at{lit.state.lamps, lit.state.scene};
  const NearLampEquations prior = near_lamp_prior(at, lit.state.scene.center, 1e-4);
  EXPECT_LT(prior.b[3], 0) << "weaker";
  EXPECT_GT(prior.b[2], 0) << "nearer";
  EXPECT_GT(prior.b[at.lamp_at(1) + 3], 0) << "the others stronger";
  const double h = 1e-3;
  for (const Eigen::Index k : {Eigen::Index{2}, Eigen::Index{3}, at.lamp_at(1) + 4}) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(at.size(), k);
    const double slope = (near_lamp_prior(at.moved(step, 10), lit.state.scene.center, 1e-4).energy -
                          near_lamp_prior(at.moved(-step, 10), lit.state.scene.center, 1e-4).energy) /
                         (2 * h);
    EXPECT_NEAR(-2 * prior.b[k], slope, 0.02 * std::abs(slope)) << "unknown " << k;
  }
}

TEST(NearLampSearch, FindsLampsWithoutAStart) {
  NearlyLitSphere lit;
  for (Lamp& lamp : lit.state.lamps) lamp.direction = Eigen::Vector3f(0, 0, -1);
  const std::vector<Lamp> found = NearLampSearch(lit.images, lit.state).lamps(lit.state);
  for (size_t i = 0; i < lit.truth.size(); ++i) {
    EXPECT_GT(found[i].direction.dot(lit.truth[i].direction), std::cos(0.2f)) << "radians, lamp " << i;
    EXPECT_NEAR(found[i].inverse_distance, lit.truth[i].inverse_distance, 0.6f) << "1/m, lamp " << i;
  }
}

/// A lamp whose image two places explain about as well: the one of the others' power is taken.
TEST(NearLampSearch, DoesNotTakeALampOfAnotherPowerForAFartherOne) {
  NearlyLitSphere lit;
  const std::vector<Lamp> found = NearLampSearch(lit.images, lit.state).lamps(lit.state);
  for (const Lamp& lamp : found) EXPECT_NEAR(log_lamp_power(lamp), log_lamp_power(lit.truth[0]), 0.7);
}

TEST(MattImages, AreTheImagesLessTheHighlights) {
  NearlyLitSphere lit;
  const Observations before = lit.images;
  const Gloss gloss(0.1, 0.2);
  make_glossy_and_shadowed(gloss, lit);
  Observations matt = lit.images;
  take_off_highlights(lit.images, lit.state, gloss, matt);
  double brightest = 0;
  for (int p = 0; p < before.pixels; ++p) {
    EXPECT_NEAR(matt.channel(1, 2)[p], before.channel(1, 2)[p], 1e-4f);
    brightest =
        std::max(brightest, static_cast<double>(lit.images.channel(1, 2)[p] - before.channel(1, 2)[p]));
  }
  EXPECT_NEAR(brightest, 0.3 * 0.6, 0.05) << "both lobes, by the lamp's strength";
}

/// Errors of the first lamp's distance (true: 0.7), metres: deviation and mean as found over ten draws of noise, and
/// deviation as the fit foretells it. The mean is not zero: the fit is not linear,
/// and what it expects of a rig pulls.
struct Spread {
  double seen = 0, bias = 0, told = 0, told_direction = 0;
};

Spread spread_under_noise(float deviation) {
  NearlyLitSphere lit;
  const Observations clean = lit.images;
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, deviation);
  Spread spread;
  constexpr int kDraws = 10;
  Eigen::Array<double, kDraws, 1> errors;
  for (int draw = 0; draw < kDraws; ++draw) {
    lit.images = clean;
    test::change_samples(lit.images, [&](PlainSamples& samples) {
      for (float& radiance : samples.radiance) radiance += noise(random);
    });
    lit.state.lamps = lit.truth;
    Gloss gloss = Gloss::Zero();
    for (int i = 0; i < 4; ++i) fit_near_lamps(lit.samples(), nullptr, {}, lit.state, gloss);
    const double error = 1 / static_cast<double>(lit.state.lamps[0].inverse_distance) - 0.7;
    errors[draw] = error;
    const LampUncertainty told = near_lamp_uncertainty(lit.samples(), nullptr, {}, lit.state, gloss)[0];
    spread.told += told.distance_deviation / kDraws;
    spread.told_direction += told.direction_deviation / kDraws;
  }
  spread.bias = errors.mean();
  spread.seen = std::sqrt((errors - spread.bias).square().sum() / (kDraws - 1));
  return spread;
}

TEST(NearLampUncertainty, FitsTheSpreadOverDrawsOfNoise) {
  const Spread spread = spread_under_noise(0.01f);
  EXPECT_LT(std::abs(spread.bias), 0.03);
  EXPECT_GT(spread.told, 0.4 * spread.seen);
  EXPECT_LT(spread.told, 2.5 * spread.seen);
  EXPECT_GT(spread.told_direction, 0);
  EXPECT_LT(spread.told_direction, 0.05);
}

TEST(NearLampUncertainty, GrowsWithTheNoise) {
  EXPECT_NEAR(spread_under_noise(0.02f).told / spread_under_noise(0.01f).told, 2, 0.3);
}

}  // namespace
}  // namespace rakelight
