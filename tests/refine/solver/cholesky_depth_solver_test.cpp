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
  Placement placement{grid};
  DepthSystem system{grid};

  explicit RandomSystem(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    StencilGrid& S = system.stencil;
    for (int p = 0; p < grid.size(); ++p) {
      const Eigen::Index i = placement.place(p);
      S.diagonal[i] = static_cast<float>(9 + uniform(random));
      for (auto* entries : {&S.right, &S.down, &S.down_right, &S.down_left})
        (*entries)[i] = static_cast<float>(uniform(random));
      system.rhs[i] = static_cast<float>(uniform(random));
    }
    add_cell_weight(grid, cells,
                    Eigen::VectorXd::NullaryExpr(cells.size(), [&] { return 2 + uniform(random); }), system);
  }

  Eigen::VectorXd dense_solution() const { return dense().ldlt().solve(test::pixel_rhs(grid, system)); }

  Eigen::MatrixXd dense() const { return test::dense_matrix(grid, cells, system); }
};

TEST(CholeskyDepthSolver, AgreesWithADenseSolve) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const RandomSystem random(seed);
    const auto solver = make_cholesky_depth_solver(random.grid, random.cells);
    Eigen::VectorXd x;
    ASSERT_TRUE(solver->solve(random.system, x));
    EXPECT_TRUE(x.isApprox(random.dense_solution(), 1e-10));
  }
}

TEST(CholeskyDepthSolver, SolvesOneSystemAfterAnother) {
  RandomSystem random(1);
  const auto solver = make_cholesky_depth_solver(random.grid, random.cells);
  Eigen::VectorXd x;
  ASSERT_TRUE(solver->solve(random.system, x));
  for (int p = 0; p < random.grid.size(); ++p) random.system.stencil.diagonal[random.placement.place(p)] += 5;
  ASSERT_TRUE(solver->solve(random.system, x));
  EXPECT_TRUE(x.isApprox(random.dense_solution(), 1e-10));
}

TEST(CholeskyDepthSolver, RefusesWhatIsNotPositiveDefiniteAndLeavesTheUnknownsAlone) {
  RandomSystem random(2);
  const auto solver = make_cholesky_depth_solver(random.grid, random.cells);
  random.system.stencil.diagonal[random.placement.place(7)] = -20;
  Eigen::VectorXd x = Eigen::VectorXd::Constant(3, 42.0);
  EXPECT_FALSE(solver->solve(random.system, x));
  EXPECT_EQ(x, Eigen::VectorXd::Constant(3, 42.0));
  random.system.stencil.diagonal[random.placement.place(7)] = 9;
  EXPECT_TRUE(solver->solve(random.system, x));
}

TEST(CholeskyDepthSolver, RefusesNumbersThatAreNone) {
  RandomSystem random(2);
  const auto solver = make_cholesky_depth_solver(random.grid, random.cells);
  random.system.rhs[random.placement.place(3)] = std::numeric_limits<float>::quiet_NaN();
  Eigen::VectorXd x;
  EXPECT_FALSE(solver->solve(random.system, x));
}

}  // namespace
}  // namespace rakelight
