// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/noise.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/refine/exact_surface.h"

namespace rakelight {
namespace {

/// A flat surface whose images and depth readings miss the model by white noise.
struct NoisyPlane {
  static constexpr double kImageNoise = 0.02, kDepthNoise = 0.003;
  int scale;
  PixelGrid grid;
  SurfaceState state;
  Observations images;
  DepthPrior prior;

  explicit NoisyPlane(int times) : scale(times) {
    const int side = 96 * scale;
    const double middle = 0.5 * (side - 1);
    grid = make_pixel_grid({side, side, 2.0 * side, 2.0 * side, middle, middle, {}},
                           cv::Mat1b(side, side, uchar{255}));
    test::ExactSurface plane{
        grid, Eigen::VectorXd::Zero(grid.size()), Eigen::Matrix3Xf::Zero(3, grid.size()), {}};
    plane.normals.row(2).setConstant(-1);
    plane.points = surface_points(grid, plane.zeta);
    state = test::exact_state(plane, Eigen::Matrix3Xf::Ones(3, grid.size()), test::far_lamps(), true);
    images = test::images_of(state);
    std::mt19937 random(1);
    std::normal_distribution<double> white(0, 1);
    test::change_samples(images, [&](PlainSamples& samples) {
      for (float& radiance : samples.radiance) radiance += static_cast<float>(kImageNoise * white(random));
    });
    prior.cells = make_cells(grid, scale);
    const auto cells = prior.cells.size();
    prior.cell_weight = Eigen::VectorXd::Ones(cells);
    prior.cell_target = Eigen::VectorXd::NullaryExpr(cells, [&] { return kDepthNoise * white(random); });
  }

  MeasuredNoise measured() const { return measure_noise(grid, images, state, prior, scale); }
};

TEST(MeasureNoise, FindsTheDeviationsOfWhiteNoise) {
  for (const int scale : {1, 2}) {
    const MeasuredNoise found = NoisyPlane(scale).measured();
    EXPECT_NEAR(found.image, NoisyPlane::kImageNoise, 0.15 * NoisyPlane::kImageNoise) << "x" << scale;
    EXPECT_NEAR(found.depth, NoisyPlane::kDepthNoise, 0.15 * NoisyPlane::kDepthNoise) << "x" << scale;
  }
}

TEST(MeasureNoise, TheShapesOwnBroadErrorIsNotTheSensors) {
  NoisyPlane plane(1);
  for (int p = 0; p < plane.grid.size(); ++p)  // 100 deviations off, tilted by 6 from one side to the other
    plane.state.zeta[p] +=
        NoisyPlane::kDepthNoise * (100 + 6 * plane.grid.pixels[static_cast<size_t>(p)].x / 96.0);
  EXPECT_LT(plane.measured().depth, 1.5 * NoisyPlane::kDepthNoise);
}

TEST(MeasureNoise, ErrorsThatAgreeOverABlockCountForMore) {
  NoisyPlane plane(1);
  plane.images = test::images_of(plane.state);
  test::change_samples(plane.images, [](PlainSamples& samples) {
    for (float& radiance : samples.radiance) radiance += 0.01f;
  });
  // 4 x 4 pixels x 3 channels err alike: the mean's error is that of one sample, not a root of 48 smaller.
  EXPECT_NEAR(plane.measured().image, 1.4826 * 0.01 * std::sqrt(48.0), 1e-3);
}

TEST(MeasureNoise, CellsWithoutAReadingDoNotCount) {
  NoisyPlane plane(1);
  for (Eigen::Index cell = 0; cell < plane.prior.cell_weight.size(); cell += 3) {
    plane.prior.cell_weight[cell] = 0;
    plane.prior.cell_target[cell] = 5;
  }
  EXPECT_NEAR(plane.measured().depth, NoisyPlane::kDepthNoise, 0.15 * NoisyPlane::kDepthNoise);
}

TEST(MeasureNoise, IsZeroWhereNothingCanBeMeasured) {
  NoisyPlane plane(1);
  plane.state.weight.assign(plane.state.weight.size(), 0.0f);
  plane.prior.cell_weight.setZero();
  EXPECT_EQ(plane.measured().image, 0);
  EXPECT_EQ(plane.measured().depth, 0);
}

}  // namespace
}  // namespace rakelight
