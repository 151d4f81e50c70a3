// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The multigrid solver against the exact one, on the kind of system that depth steps have: a Laplacian of widely varying
// strength, a weak pull to the sensor, a mask with a hole and frayed borders.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core/utility.hpp>
#include <random>

#include "refine/solver/depth_solver.h"
#include "refine/solver/multigrid.h"
#include "refine/steps/curvature_prior.h"
#include "refine/steps/super_resolution.h"
#include "tests/refine/dense_system.h"

namespace rakelight {
namespace {

PixelGrid frayed_grid(int width, int height) {
  cv::Mat1b mask(height, width, uchar{255});
  std::mt19937 random(3);
  for (int v = 0; v < height; ++v) {
    const int left = static_cast<int>(random() % 5), right = static_cast<int>(random() % 5);
    mask.row(v).colRange(0, left).setTo(0);
    mask.row(v).colRange(width - right, width).setTo(0);
  }
  mask(cv::Rect(width / 3, height / 3, width / 7, height / 5)).setTo(0);
  return make_pixel_grid({width, height, 500, 500, width / 2.0, height / 2.0, {}}, mask);
}

/// sum of a_k (x_p - x_q)^2 over edges and diagonals of strength 1 to `contrast`, plus the sensor's pull.
struct RoughSystem {
  PixelGrid grid;
  DepthCells cells;
  DepthSystem system;

  RoughSystem(int width, int height, int scale, double contrast)
      : grid(frayed_grid(width, height)), cells(make_cells(grid, scale)), system(grid) {
    const Placement placement(grid);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto couple = [&](Eigen::VectorXf& entries, int p, int q) {
      if (q < 0) return;
      const auto strength = static_cast<float>(std::pow(contrast, uniform(random)));
      entries[placement.place(p)] -= strength;
      system.stencil.diagonal[placement.place(p)] += strength;
      system.stencil.diagonal[placement.place(q)] += strength;
    };
    for (int p = 0; p < grid.size(); ++p) {
      const auto i = static_cast<size_t>(p);
      couple(system.stencil.right, p, grid.neighbor[kRight][i]);
      couple(system.stencil.down, p, grid.neighbor[kDown][i]);
      system.stencil.diagonal[placement.place(p)] += 1e-4f;
      system.rhs[placement.place(p)] = static_cast<float>(uniform(random) - 0.5);
    }
    add_cell_weight(grid, cells, Eigen::VectorXd::Constant(cells.size(), 1e-2), system);
  }
};

double relative_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).norm() / b.norm();
}

TEST(MultigridDepthSolver, AgreesWithTheExactSolver) {
  for (const int scale : {1, 2, 3}) {
    for (const auto& [width, height] : {std::pair(96, 61), std::pair(37, 80), std::pair(5, 4)}) {
      const RoughSystem rough(width, height, scale, 100);
      Eigen::VectorXd fast, exact;
      ASSERT_TRUE(make_multigrid_depth_solver(rough.grid, rough.cells)->solve(rough.system, fast));
      ASSERT_TRUE(make_cholesky_depth_solver(rough.grid, rough.cells)->solve(rough.system, exact));
      EXPECT_LT(relative_difference(fast, exact), 1e-3) << width << "x" << height << ", scale " << scale;
    }
  }
}

TEST(MultigridDepthSolver, SmoothsMoreWhereStrengthsVaryWildly) {
  const RoughSystem rough(150, 110, 2, 1e3);  // more than twenty steps
  Eigen::VectorXd fast, exact;
  ASSERT_TRUE(make_multigrid_depth_solver(rough.grid, rough.cells, 1e-5)->solve(rough.system, fast));
  ASSERT_TRUE(make_cholesky_depth_solver(rough.grid, rough.cells)->solve(rough.system, exact));
  EXPECT_LT(relative_difference(fast, exact), 1e-2);
}

TEST(MultigridDepthSolver, AgreesWithTheExactSolverUnderSecondDifferences) {
  for (const int scale : {1, 2}) {
    RoughSystem rough(96, 61, scale, 30);
    rough.system.curvature = reachable_differences(rough.grid, {}, {});
    rough.system.curvature.across *= 20;
    Eigen::VectorXd fast, exact;
    ASSERT_TRUE(make_multigrid_depth_solver(rough.grid, rough.cells)->solve(rough.system, fast));
    ASSERT_TRUE(make_cholesky_depth_solver(rough.grid, rough.cells)->solve(rough.system, exact));
    EXPECT_LT(relative_difference(fast, exact), 1e-3) << "scale " << scale;
  }
}

TEST(MultigridDepthSolver, SolvesTheLastSystemForAnotherRightHandSide) {
  RoughSystem rough(37, 80, 1, 30);
  const auto solver = make_multigrid_depth_solver(rough.grid, rough.cells);
  Eigen::VectorXd first, again, exact;
  ASSERT_TRUE(solver->solve(rough.system, first));
  const Eigen::VectorXd other = test::pixel_rhs(rough.grid, rough.system).reverse();
  ASSERT_TRUE(solver->solve_again(other, again));
  Placement(rough.grid).scatter(other, 1, rough.system.rhs);
  ASSERT_TRUE(make_cholesky_depth_solver(rough.grid, rough.cells)->solve(rough.system, exact));
  EXPECT_LT(relative_difference(again, exact), 1e-3);
  EXPECT_GT(relative_difference(again, first), 0.1);
}

/// Gives the solver's memory the system's numbers.
DepthSystem refilled(DepthSolver& solver, const DepthSystem& system) {
  DepthSystem memory = solver.reuse_system();
  memory = system;
  return memory;
}

TEST(MultigridDepthSolver, ReusedOverChangingSystemsGivesWhatAFreshOneGives) {
  for (const int scale : {1, 2}) {
    const RoughSystem first(150, 110, scale, 30), wild(150, 110, scale, 1e3);
    RoughSystem curved(150, 110, scale, 10), broken = first;
    curved.system.curvature = reachable_differences(curved.grid, {}, {});
    broken.system.stencil.diagonal[Placement(broken.grid).place(50)] = -5;
    const auto reused = make_multigrid_depth_solver(first.grid, first.cells);
    Eigen::VectorXd x;
    EXPECT_TRUE(reused->solve(first.system, x));
    EXPECT_FALSE(reused->solve(refilled(*reused, broken.system), x));
    for (const RoughSystem* each : std::initializer_list<const RoughSystem*>{&curved, &wild, &first}) {
      Eigen::VectorXd again, fresh;
      ASSERT_TRUE(reused->solve(refilled(*reused, each->system), again));
      ASSERT_TRUE(make_multigrid_depth_solver(each->grid, each->cells)->solve(each->system, fresh));
      EXPECT_EQ(again, fresh) << "scale " << scale;
    }
  }
}

TEST(MultigridDepthSolver, GivesTheSameBytesForAnyNumberOfThreads) {
  const RoughSystem rough(300, 200, 2, 30);
  const auto solve_with = [&](int threads) {
    cv::setNumThreads(threads);
    Eigen::VectorXd x;
    EXPECT_TRUE(make_multigrid_depth_solver(rough.grid, rough.cells)->solve(rough.system, x));
    return x;
  };
  const int before = cv::getNumThreads();
  const Eigen::VectorXd one = solve_with(1), three = solve_with(3);
  cv::setNumThreads(before);
  EXPECT_EQ(one, three);
}

TEST(MultigridDepthSolver, LeavesASystemItCannotSolveToTheExactOne) {
  RoughSystem rough(40, 30, 1, 10);
  rough.system.stencil.diagonal[Placement(rough.grid).place(50)] =
      -5;  // not positive definite: the exact solver refuses it too
  Eigen::VectorXd x = Eigen::VectorXd::Ones(3);
  EXPECT_FALSE(make_multigrid_depth_solver(rough.grid, rough.cells)->solve(rough.system, x));
  EXPECT_EQ(x, Eigen::VectorXd::Ones(3));
  rough.system.rhs[Placement(rough.grid).place(3)] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(make_multigrid_depth_solver(rough.grid, rough.cells)->solve(rough.system, x));
}

/// A full rectangle of the 5-point Laplacian plus a little.
StencilGrid laplacian(int width, int height, float more) {
  StencilGrid A(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      A.diagonal[A.at(x, y)] = 4 + more;
      if (x + 1 < width) A.right[A.at(x, y)] = -1;
      if (y + 1 < height) A.down[A.at(x, y)] = -1;
    }
  }
  return A;
}

void expect_symmetric(int height, int sweeps) {
  const StencilGrid A = laplacian(45, height, 0.01f);
  Multigrid multigrid;
  multigrid.set_sweeps(sweeps);
  ASSERT_TRUE(multigrid.setup(A));
  Eigen::VectorXf a = Eigen::VectorXf::Zero(A.size()), b = a, Ma, Mb;
  for (int k = 0; k < 200; ++k) {
    a[A.at(k % 45, (k * 7) % height)] = static_cast<float>(k % 13) - 6;
    b[A.at((k * 11) % 45, k % height)] = static_cast<float>(k % 7) - 3;
  }
  multigrid.apply(a, Ma);
  multigrid.apply(b, Mb);
  EXPECT_NEAR(a.dot(Mb) / b.dot(Ma), 1, 1e-4) << height << " rows, " << sweeps << " sweeps";
}

TEST(Multigrid, IsSymmetric) {
  for (const int height : {5, 31, 38, 64, 65, 130, 600})  // one strip of rows, a seam, several
    for (const int sweeps : {1, 2}) expect_symmetric(height, sweeps);
}

TEST(Multigrid, MultipliesWhatItGives) {
  for (const int height : {3, 38, 64, 97, 330}) {
    const StencilGrid A = laplacian(45, height, 0.01f);
    Multigrid multigrid;
    ASSERT_TRUE(multigrid.setup(A));
    Eigen::VectorXf r = Eigen::VectorXf::Zero(A.size()), z, alone, Az, expected;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < 45; ++x) r[A.at(x, y)] = std::sin(static_cast<float>(3 * x + 7 * y * y));
    const Products products = multigrid.apply(r, z, Az);
    multigrid.apply(r, alone);
    EXPECT_EQ(z, alone);
    const double zAz = A.multiply(z, expected);
    EXPECT_TRUE(Az.isApprox(expected, 1e-6f)) << height;
    EXPECT_NEAR(products.xAx, zAz, 1e-5 * zAz);
    const double rz = r.cast<double>().dot(z.cast<double>());
    EXPECT_NEAR(products.bx, rz, 1e-5 * rz);
  }
}

TEST(LineSolver, SolvesTheRowsTridiagonalSystems) {
  for (const int height : {1, 7, 33, 70}) {
    const StencilGrid A = laplacian(21, height, 0.1f);
    LineSolver lines;
    lines.prepare(A);
    for (int begin = 0; begin < height; begin += kGridStrip) lines.factorize_strip(A, begin);
    ASSERT_TRUE(lines.factorize_seams(A));
    StencilGrid T = A;
    T.down.setZero();
    Eigen::VectorXf truth = Eigen::VectorXf::Zero(A.size()), b, x = truth;
    for (int y = 0; y < height; ++y)
      for (int u = 0; u < A.width; ++u) truth[A.at(u, y)] = static_cast<float>((u * 5 + y * 3) % 7);
    T.multiply(truth, b);
    LineSolver::Workspace workspace(A);
    for (int begin = 0; begin < height; begin += kGridStrip)
      for (const Color color : {even, odd})
        for (const auto& group : lines.in_strip(begin, color))
          lines.solve(A, group, {0, height}, workspace, b, x);
    for (const auto& group : lines.seams(LineSolver::seam_odd))
      lines.solve(A, group, {0, height}, workspace, b, x);
    EXPECT_TRUE(x.isApprox(truth, 1e-5f)) << height;
  }
}

/// A pixel between the coarse ones hangs on two or four of them: their matrix is singular, and rounding may make it worse.
TEST(Multigrid, TakesMasksWithLonelyPixels) {
  StencilGrid A(200, 150);
  for (int k = 0; k < 200; ++k)
    A.diagonal[A.at((37 * k) % 200, (53 * k) % 150)] = 0.1f + static_cast<float>(k % 7);
  Multigrid multigrid;
  ASSERT_TRUE(multigrid.setup(A));
  Eigen::VectorXf r = (A.diagonal.array() > 0).select(Eigen::VectorXf::Ones(A.size()), 0.0f), z;
  multigrid.apply(r, z);
  for (Eigen::Index i = 0; i < A.size(); ++i) {
    if (A.diagonal[i] > 0) { EXPECT_NEAR(z[i] * A.diagonal[i], 1, 1e-3f); }
  }
}

TEST(Multigrid, OneCycleRemovesNineTenthsOfTheErrorAtAnySize) {
  for (const int size : {33, 129, 400}) {
    const StencilGrid A = laplacian(size, size - 5, 1e-3f);
    Multigrid multigrid;
    ASSERT_TRUE(multigrid.setup(A));
    Eigen::VectorXf truth = Eigen::VectorXf::Zero(A.size()), r, found;
    for (int y = 0; y < A.height; ++y)
      for (int x = 0; x < A.width; ++x)
        truth[A.at(x, y)] =
            std::sin(0.02f * static_cast<float>(x * y)) + static_cast<float>((x * 5 + y * 3) % 4);
    A.multiply(truth, r);
    multigrid.apply(r, found);
    Eigen::VectorXf miss = truth - found, A_miss;
    A.multiply(miss, A_miss);
    EXPECT_LT(std::sqrt(miss.dot(A_miss) / truth.dot(r)), 0.1f) << size;
  }
}

}  // namespace
}  // namespace rakelight
