// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/super_resolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/refine/dense_system.h"

namespace rakelight {
namespace {

struct RandomPrior {
  PixelGrid grid = test::bitten_grid();
  DepthPrior prior;
  Eigen::VectorXd zeta;

  explicit RandomPrior(int scale) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&](Eigen::Index size) {
      return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(size, [&] { return uniform(random); }));
    };
    prior.cells = make_cells(grid, scale);
    const auto cells = prior.cells.size();
    prior.cell_weight = 2 + vector(cells).array();
    prior.cell_target = vector(cells);
    prior.start = vector(grid.size());
    prior.floor = 0.7;
    zeta = vector(grid.size());
  }

  DepthSystem system() const {
    DepthSystem result(grid);
    add_prior(grid, prior, zeta, result);
    return result;
  }
};

TEST(MakeCells, PutsEachPixelIntoTheDepthPixelThatCoversIt) {
  const PixelGrid grid = make_pixel_grid({6, 4, 10, 10, 2.5, 1.5, {}}, cv::Mat1b(4, 6, uchar{255}));
  const DepthCells cells = make_cells(grid, 2);
  ASSERT_EQ(cells.size(), 6);
  for (int cell = 0; cell < 6; ++cell) EXPECT_EQ(cells.of(cell).size(), 4U);
  const auto positions = cell_positions(grid, cells, 2);
  for (int p = 0; p < grid.size(); ++p) {
    const cv::Point at = grid.pixels[static_cast<size_t>(p)];
    const size_t cell = static_cast<size_t>(cells.cell_of[static_cast<size_t>(p)]);
    EXPECT_EQ(positions[cell], cv::Point(at.x / 2, at.y / 2));
  }
}

TEST(MakeCells, CellsAtTheBorderOfTheMaskHoldFewerPixels) {
  cv::Mat1b mask(5, 5, uchar{255});
  mask(0, 0) = 0;
  const PixelGrid grid = make_pixel_grid({5, 5, 10, 10, 2, 2, {}}, mask);
  const DepthCells cells = make_cells(grid, 2);
  ASSERT_EQ(cells.size(), 9);
  const auto size_at = [&](int u, int v) {
    return cells.of(cells.cell_of[static_cast<size_t>(grid.index(v, u))]).size();
  };
  EXPECT_EQ(size_at(1, 1), 3U);
  EXPECT_EQ(size_at(2, 2), 4U);
  EXPECT_EQ(size_at(4, 2), 2U);
  EXPECT_EQ(size_at(4, 4), 1U);
}

TEST(CellMeans, AreTheMeansOverTheCellsPixels) {
  const RandomPrior random(2);
  const Eigen::VectorXd expected = test::dense_means(random.prior.cells) * random.zeta;
  EXPECT_TRUE(cell_means(random.prior.cells, random.zeta).isApprox(expected, 1e-12));
  EXPECT_TRUE(cell_means(random.prior.cells, Eigen::VectorXd::Constant(random.grid.size(), 0.3))
                  .isApproxToConstant(0.3, 1e-12));
}

TEST(Prior, ItsEnergyIsTheFormulaOfTheHeader) {
  const RandomPrior random(2);
  const Eigen::VectorXd miss = test::dense_means(random.prior.cells) * random.zeta - random.prior.cell_target;
  const double expected = (random.prior.cell_weight.array() * miss.array().square()).sum() +
                          0.7 * (random.zeta - random.prior.start).squaredNorm();
  EXPECT_NEAR(prior_energy(random.prior, random.zeta), expected, 1e-10);
}

TEST(Prior, ItsRightSideIsMinusHalfTheGradient) {
  for (const int scale : {1, 2, 3}) {
    const RandomPrior random(scale);
    const Eigen::VectorXd rhs = test::pixel_rhs(random.grid, random.system());
    for (Eigen::Index p = 0; p < random.zeta.size(); ++p) {
      const Eigen::VectorXd h = 1e-4 * Eigen::VectorXd::Unit(random.zeta.size(), p);
      const double slope =
          (prior_energy(random.prior, random.zeta + h) - prior_energy(random.prior, random.zeta - h)) / 2e-4;
      const double rounding = 4 * static_cast<double>(std::numeric_limits<float>::epsilon());
      EXPECT_NEAR(-2 * rhs[p], slope, rounding * (1 + std::abs(slope)));
    }
  }
}

TEST(Prior, ItsMatrixLeadsToTheMinimumInOneStep) {
  const RandomPrior random(2);
  const DepthSystem system = random.system();
  const Eigen::VectorXd step = test::dense_matrix(random.grid, random.prior.cells, system)
                                   .ldlt()
                                   .solve(test::pixel_rhs(random.grid, system));
  const double lowest = prior_energy(random.prior, random.zeta + step);
  for (Eigen::Index p = 0; p < step.size(); ++p) {
    for (const double h : {-1e-3, 1e-3}) {
      const Eigen::VectorXd beside = random.zeta + step + h * Eigen::VectorXd::Unit(step.size(), p);
      EXPECT_GT(prior_energy(random.prior, beside), lowest);
    }
  }
}

TEST(Prior, AtScaleOneIsThePlainPriorOfEachPixel) {
  const RandomPrior random(1);
  ASSERT_EQ(random.prior.cell_weight.size(), random.zeta.size());
  double expected = 0.7 * (random.zeta - random.prior.start).squaredNorm();
  for (int p = 0; p < random.grid.size(); ++p) {
    const double miss = random.zeta[p] - random.prior.cell_target[p];
    expected += random.prior.cell_weight[p] * miss * miss;
  }
  EXPECT_NEAR(prior_energy(random.prior, random.zeta), expected, 1e-10);
}

}  // namespace
}  // namespace rakelight
