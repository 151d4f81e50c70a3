// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/curvature_prior.h"

#include <gtest/gtest.h>

#include "refine/steps/laplacian.h"
#include "tests/refine/dense_system.h"

namespace rakelight {
namespace {

PixelGrid full_grid() {
  return make_pixel_grid({9, 8, 20.0, 20.0, 4.0, 3.5, {}}, cv::Mat1b(8, 9, uchar{255}));
}

Eigen::VectorXd plane(const PixelGrid& grid) {
  Eigen::VectorXd values(grid.size());
  for (int p = 0; p < grid.size(); ++p) {
    const cv::Point at = grid.pixels[static_cast<size_t>(p)];
    values[p] = 1 + 0.25 * at.x - 0.5 * at.y;
  }
  return values;
}

/// A step of height 1 between columns 4 and 5, and small ripples.
Eigen::VectorXd step(const PixelGrid& grid) {
  Eigen::VectorXd values(grid.size());
  for (int p = 0; p < grid.size(); ++p) {
    const cv::Point at = grid.pixels[static_cast<size_t>(p)];
    values[p] = (at.x > 4 ? 1 : 0) + 0.01 * ((at.x * 7 + at.y * 5) % 4);
  }
  return values;
}

TEST(SecondDifferences, OfAPlaneAreZeroUpToTheBorder) {
  for (const PixelGrid& grid : {full_grid(), test::bitten_grid()}) {
    const CurvatureWeights all = reachable_differences(grid, {}, {});
    EXPECT_NEAR(curvature_energy(grid, all, plane(grid)), 0, 1e-12);
    EXPECT_LT(curvature_product(grid, all, plane(grid)).norm(), 1e-12);
  }
}

TEST(SecondDifferences, OfASquareAreTwoButForTheFirstAndLastColumn) {
  const PixelGrid grid = full_grid();
  Eigen::VectorXd square(grid.size());
  for (int p = 0; p < grid.size(); ++p) square[p] = std::pow(grid.pixels[static_cast<size_t>(p)].x, 2);
  EXPECT_DOUBLE_EQ(curvature_energy(grid, reachable_differences(grid, {}, {}), square), 2 * 2 * 7 * 8);
}

TEST(SecondDifferences, DoNotReachAcrossCuts) {
  const PixelGrid grid = full_grid();
  std::vector<unsigned char> cuts(static_cast<size_t>(grid.size()), 0);
  for (int v = 0; v < 8; ++v) cuts[static_cast<size_t>(grid.index(v, 4))] = 1;
  Eigen::VectorXd jump = Eigen::VectorXd::Zero(grid.size());
  for (int p = 0; p < grid.size(); ++p) jump[p] = grid.pixels[static_cast<size_t>(p)].x > 4 ? 1 : 0;
  EXPECT_GT(curvature_energy(grid, reachable_differences(grid, {}, {}), jump), 1);
  EXPECT_EQ(curvature_energy(grid, reachable_differences(grid, cuts, {}), jump), 0);
}

TEST(SecondDifferences, ProductAndMatrixAgreeWithTheEnergy) {
  const PixelGrid grid = test::bitten_grid();
  const CurvatureWeights weights = CurvaturePrior(grid, {}, {}).at(step(grid), 3);
  const Eigen::SparseMatrix<double> lower = curvature_lower_triangle(grid, weights);
  const Eigen::VectorXd x = step(grid);
  const double energy = curvature_energy(grid, weights, x);
  EXPECT_GT(energy, 0);
  EXPECT_NEAR(x.dot(curvature_product(grid, weights, x)), energy, 1e-12 + 1e-9 * energy);
  EXPECT_NEAR(x.dot(lower.selfadjointView<Eigen::Lower>() * x), energy, 1e-12 + 1e-9 * energy);
}

TEST(UncutLaplacian, PullsTheBorderFlat) {
  const PixelGrid grid = full_grid();
  EXPECT_LT((uncut_laplacian(grid) * Eigen::VectorXd::Ones(grid.size())).norm(), 1e-12);
  EXPECT_GT((uncut_laplacian(grid) * plane(grid)).norm(), 0.1);
}

TEST(CurvaturePrior, CostsNothingOnAPlane) {
  const PixelGrid grid = full_grid();
  EXPECT_NEAR(curvature_energy(grid, CurvaturePrior(grid, {}, {}).at(step(grid), 5), plane(grid)), 0, 1e-10);
}

TEST(CurvaturePrior, SparesAStepThatNoCutForetold) {
  const PixelGrid grid = full_grid();
  const Eigen::VectorXd zeta = step(grid);
  const double plain = curvature_energy(grid, reachable_differences(grid, {}, {}), zeta);
  EXPECT_LT(curvature_energy(grid, CurvaturePrior(grid, {}, {}).at(zeta, 1), zeta), 0.05 * plain);
}

TEST(CurvaturePrior, IsInProportionToItsWeight) {
  const PixelGrid grid = test::bitten_grid();
  const Eigen::VectorXd zeta = plane(grid).array().square();
  const CurvaturePrior prior(grid, {}, {});
  const double once = curvature_energy(grid, prior.at(zeta, 1), zeta);
  EXPECT_GT(once, 0);
  EXPECT_NEAR(curvature_energy(grid, prior.at(zeta, 3), zeta), 3 * once, 1e-9);
}

}  // namespace
}  // namespace rakelight
