// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/depth_solver.h"

#include <gtest/gtest.h>

#include <random>

#include "refine/steps/super_resolution.h"
#include "tests/refine/dense_system.h"

namespace rakelight {
namespace {

/// A system with random stencil entries, diagonally dominant, on cells of 2 x 2.
struct RandomSystem {
  PixelGrid grid = test::bitten_grid();
  DepthCells cells = make_cells(grid, 2);
  DepthSystem system{grid.size()};

  explicit RandomSystem(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (size_t p = 0; p < system.diagonal.size(); ++p) {
      system.diagonal[p] = static_cast<float>(9 + uniform(random));
      for (auto* entries : {&system.right, &system.down, &system.down_right, &system.down_left})
        (*entries)[p] = static_cast<float>(uniform(random));
      system.rhs[static_cast<Eigen::Index>(p)] = uniform(random);
    }
    system.cell_weight = Eigen::VectorXd::NullaryExpr(cells.size(), [&] { return 2 + uniform(random); });
  }

  Eigen::MatrixXd dense() const { return test::dense_matrix(grid, cells, system); }
};

TEST(CholeskyDepthSolver, AgreesWithADenseSolve) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const RandomSystem random(seed);
    const auto solver = make_cholesky_depth_solver(random.grid, random.cells);
    Eigen::VectorXd x;
    ASSERT_TRUE(solver->solve(random.system, x));
    EXPECT_TRUE(x.isApprox(random.dense().ldlt().solve(random.system.rhs), 1e-10));
  }
}

TEST(CholeskyDepthSolver, SolvesOneSystemAfterAnother) {
  RandomSystem random(1);
  const auto solver = make_cholesky_depth_solver(random.grid, random.cells);
  Eigen::VectorXd x;
  ASSERT_TRUE(solver->solve(random.system, x));
  for (float& entry : random.system.diagonal) entry += 5;
  ASSERT_TRUE(solver->solve(random.system, x));
  EXPECT_TRUE(x.isApprox(random.dense().ldlt().solve(random.system.rhs), 1e-10));
}

TEST(CholeskyDepthSolver, RefusesWhatIsNotPositiveDefiniteAndLeavesTheUnknownsAlone) {
  RandomSystem random(2);
  const auto solver = make_cholesky_depth_solver(random.grid, random.cells);
  random.system.diagonal[7] = -20;
  Eigen::VectorXd x = Eigen::VectorXd::Constant(3, 42.0);
  EXPECT_FALSE(solver->solve(random.system, x));
  EXPECT_EQ(x, Eigen::VectorXd::Constant(3, 42.0));
  random.system.diagonal[7] = 9;
  EXPECT_TRUE(solver->solve(random.system, x));
}

TEST(CholeskyDepthSolver, RefusesNumbersThatAreNone) {
  RandomSystem random(2);
  const auto solver = make_cholesky_depth_solver(random.grid, random.cells);
  random.system.rhs[3] = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd x;
  EXPECT_FALSE(solver->solve(random.system, x));
}

}  // namespace
}  // namespace rakelight
