// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/paper_albedo.h"

#include <gtest/gtest.h>

#include "tests/refine/dense_system.h"

namespace rakelight {
namespace {

Eigen::VectorXd waves(const PixelGrid& grid, double phase) {
  Eigen::VectorXd values(grid.size());
  for (int p = 0; p < grid.size(); ++p) values[p] = 0.5 + 0.3 * std::sin(phase + 0.9 * p);
  return values;
}

AlbedoOptions loose() {
  AlbedoOptions options;
  options.edge_sigma = 0.4;
  options.depth_sigma = 0.5;
  return options;
}

TEST(PaperAlbedo, SolvesEquation10AsADenseSystemWould) {
  const PixelGrid grid = test::bitten_grid();
  const Eigen::VectorXd I = waves(grid, 0), S = waves(grid, 1), z = waves(grid, 2);
  const auto W = anisotropic_laplacian(grid, I, z, loose());
  const Eigen::MatrixXd dense_W(W);
  const Eigen::MatrixXd A = Eigen::MatrixXd(S.cwiseAbs2().asDiagonal()) + 3.0 * dense_W.transpose() * dense_W;
  Eigen::VectorXd rho;
  ASSERT_TRUE(solve_albedo(S, I, W, 3.0, rho));
  EXPECT_LT((rho - A.ldlt().solve(S.cwiseProduct(I))).norm(), 1e-9);
}

TEST(PaperAlbedo, WeighsNeighboursByEquation11) {
  const PixelGrid grid = test::bitten_grid();
  const Eigen::VectorXd I = waves(grid, 0), z = waves(grid, 2);
  const auto W = anisotropic_laplacian(grid, I, z, loose());
  const int p = grid.index(2, 3), q = grid.index(2, 4);
  EXPECT_NEAR(W.coeff(p, q), -std::exp(-std::pow(I[p] - I[q], 2) / 0.32 - std::pow(z[p] - z[q], 2) / 0.5),
              1e-12);
  EXPECT_LT((W * Eigen::VectorXd::Ones(grid.size())).norm(), 1e-12);  // a uniform albedo costs nothing
}

TEST(PaperAlbedo, IsNotSmoothedAcrossStepsBeyondTheCutOff) {
  const PixelGrid grid = test::bitten_grid();
  Eigen::VectorXd I = Eigen::VectorXd::Constant(grid.size(), 0.2);
  const int p = grid.index(2, 3), q = grid.index(2, 4);
  I[q] = 0.8;
  AlbedoOptions options = loose();
  EXPECT_NE(anisotropic_laplacian(grid, I, I, options).coeff(p, q), 0);
  options.cutoff = 0.05;
  EXPECT_EQ(anisotropic_laplacian(grid, I, I, options).coeff(p, q), 0);
}

TEST(PaperAlbedo, IsTheTrueOneWhenUniform) {
  const PixelGrid grid = test::bitten_grid();
  const Eigen::VectorXd S = waves(grid, 1), I = 0.4 * S;
  Eigen::VectorXd rho;
  ASSERT_TRUE(solve_albedo(S, I, anisotropic_laplacian(grid, I, I, loose()), 10, rho));
  EXPECT_LT((rho.array() - 0.4).abs().maxCoeff(), 1e-9);
}

TEST(LocalTerm, MinimisesItsEnergy) {
  const PixelGrid grid = test::bitten_grid();
  const Eigen::VectorXd rest = waves(grid, 3).array() - 0.5;
  const auto W = anisotropic_laplacian(grid, waves(grid, 0), waves(grid, 2), loose());
  AlbedoOptions options = loose();
  options.local_smoothness = 0.2;
  options.local_weight = 0.3;
  Eigen::VectorXd beta;
  ASSERT_TRUE(solve_local_term(rest, W, options, beta));
  const auto energy = [&](const Eigen::VectorXd& b) {
    return (b - rest).squaredNorm() + 0.2 * (W * b).squaredNorm() + 0.3 * b.squaredNorm();
  };
  for (int p = 0; p < grid.size(); ++p) {  // the derivative by differences vanishes
    const Eigen::VectorXd step = 1e-4 * Eigen::VectorXd::Unit(grid.size(), p);
    EXPECT_NEAR((energy(beta + step) - energy(beta - step)) / 2e-4, 0, 1e-8);
  }
}

TEST(RatioDiffusion, MinimisesEquation20) {
  const PixelGrid grid = test::bitten_grid();
  const Eigen::VectorXd I = waves(grid, 0), before = waves(grid, 1);
  constexpr double kLambda = 5, kSigma = 2;
  const auto step_of = [&](const Eigen::VectorXd& x, int p, Neighbor direction) {
    const int q = grid.neighbor[direction][static_cast<size_t>(p)];
    return q < 0 ? 0.0 : x[q] - x[p];
  };
  const auto squares = [&](const Eigen::VectorXd& x, int p) {
    return std::pow(step_of(x, p, kRight), 2) + std::pow(step_of(x, p, kDown), 2);
  };
  double most = 0;
  for (int p = 0; p < grid.size(); ++p) most = std::max(most, squares(I, p));
  const auto energy = [&](const Eigen::VectorXd& P) {
    double sum = (P - before).squaredNorm();
    for (int p = 0; p < grid.size(); ++p)
      sum += kLambda * std::pow(std::exp(-kSigma * squares(I, p) / most), 2) * squares(P, p);
    return sum;
  };
  Eigen::VectorXd P = before;
  ASSERT_TRUE(diffuse_albedo(grid, I, kLambda, kSigma, P));
  for (int p = 0; p < grid.size(); ++p) {
    const Eigen::VectorXd step = 1e-4 * Eigen::VectorXd::Unit(grid.size(), p);
    EXPECT_NEAR((energy(P + step) - energy(P - step)) / 2e-4, 0, 1e-7);
  }
}

}  // namespace
}  // namespace rakelight
