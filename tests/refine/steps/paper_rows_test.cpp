// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/paper_rows.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "refine/solver/sparse_cholesky.h"
#include "refine/steps/laplacian.h"
#include "tests/refine/exact_surface.h"

namespace rakelight {
namespace {

constexpr double kZ = 0.9, kSlopeX = 0.12, kSlopeY = -0.07;

/// Lamps of three colours from three sides.
Lamp colored_lamp() {
  Lamp lamp;
  lamp.l.row(0) << 0.5f, 0.1f, -0.8f;
  lamp.l.row(1) << -0.4f, 0.4f, -0.7f;
  lamp.l.row(2) << -0.1f, -0.5f, -0.9f;
  lamp.phi << 0.1f, 0.08f, 0.05f;
  return lamp;
}

PixelGrid small_grid() {
  return make_pixel_grid({12, 10, 300.0, 310.0, 5.2, 4.6, {}}, cv::Mat1b(10, 12, uchar{255}));
}

/// A surface of constant slope in log depth: forward differences are then exact.
struct ColorLitSlope {
  PixelGrid grid = small_grid();
  CornerList corners = make_corners(grid, Stencil::forward);
  SurfaceState state;
  Observations image;

  ColorLitSlope() {
    state.zeta.resize(grid.size());
    for (int p = 0; p < grid.size(); ++p) {
      const cv::Point at = grid.pixels[static_cast<size_t>(p)];
      state.zeta[p] = std::log(kZ) + kSlopeX / 300 * at.x + kSlopeY / 310 * at.y;
    }
    state.points = surface_points(grid, state.zeta);
    state.normals = surface_normals(grid, corners, state.zeta);
    state.albedo.resize(3, grid.size());
    for (int p = 0; p < grid.size(); ++p)
      state.albedo.col(p) << 0.4f + 0.05f * static_cast<float>(p % 5), 0.7f,
          0.3f + 0.1f * static_cast<float>(p % 3);
    state.lamps = {colored_lamp()};
    state.attached_shadows = false;
    image = test::images_of(state);
  }
};

TEST(RatioRows, VanishAtTheTruth) {
  const ColorLitSlope lit;
  const auto rows = ratio_rows(lit.grid, lit.image, lit.state);
  ASSERT_EQ(rows.size(), static_cast<size_t>(3 * lit.grid.size()));
  for (const GradientRow& row : rows)
    EXPECT_NEAR(row.a.dot(forward_gradient(lit.grid, lit.corners, row.pixel, lit.state.zeta)), row.b, 1e-5);
}

TEST(RatioRows, LeadFromAFlatStartToTheTruth) {
  const ColorLitSlope lit;
  const Smoothness none(uncut_laplacian(lit.grid), 0);
  const Eigen::VectorXd flat = Eigen::VectorXd::Constant(lit.grid.size(), lit.state.zeta.mean());
  const GradientProblem problem{lit.grid, lit.corners, ratio_rows(lit.grid, lit.image, lit.state),
                                1e-7,     flat,        none};
  SparseCholesky solver;
  Eigen::VectorXd zeta = flat;
  ASSERT_TRUE(solve_gradient_rows(problem, solver, zeta));
  EXPECT_LT((zeta - lit.state.zeta).cwiseAbs().maxCoeff(), 2e-5);
  EXPECT_LE(gradient_energy(problem, zeta), gradient_energy(problem, flat));
}

TEST(GradientRows, AreSolvedAsADenseSystemWouldBe) {
  const ColorLitSlope lit;
  const Smoothness smoothness(uncut_laplacian(lit.grid), 0.3);
  const Eigen::VectorXd start = lit.state.zeta.array().sin();
  const GradientProblem problem{lit.grid, lit.corners, ratio_rows(lit.grid, lit.image, lit.state),
                                0.5,      start,       smoothness};
  Eigen::MatrixXd A =
      0.5 * Eigen::MatrixXd::Identity(start.size(), start.size()) + Eigen::MatrixXd(smoothness.matrix());
  Eigen::VectorXd b = 0.5 * start;
  for (const GradientRow& row :
       problem.rows) {  // rows by unit vectors: nothing shared with the code but the gradient
    Eigen::VectorXd dense(start.size());
    for (Eigen::Index q = 0; q < dense.size(); ++q)
      dense[q] = row.a.dot(
          forward_gradient(lit.grid, lit.corners, row.pixel, Eigen::VectorXd::Unit(start.size(), q)));
    A += dense * dense.transpose();
    b += row.b * dense;
  }
  SparseCholesky solver;
  Eigen::VectorXd zeta = start;
  ASSERT_TRUE(solve_gradient_rows(problem, solver, zeta));
  EXPECT_LT((zeta - A.ldlt().solve(b)).norm(), 1e-8 * zeta.norm());
}

TEST(ShadingRows, VanishAtTheTruth) {
  const PixelGrid grid = small_grid();
  const CornerList corners = make_corners(grid, Stencil::forward);
  const double k = 300 / kZ;
  Eigen::VectorXd z(grid.size()), rho(grid.size());
  for (int p = 0; p < grid.size(); ++p) {
    const cv::Point at = grid.pixels[static_cast<size_t>(p)];
    z[p] = kZ + kSlopeX / k * at.x + kSlopeY / k * at.y + 1e-4 * std::sin(at.x + 2.0 * at.y);
    rho[p] = 0.5 + 0.1 * (p % 4);
  }
  Lamp lamp;
  lamp.l.row(0) << 0.3f, -0.2f, -0.8f;
  lamp.phi[0] = 0.1f;
  lamp.second_order = true;
  lamp.Q[0] << 0.05f, 0.02f, -0.03f, 0.02f, -0.01f, 0.04f, -0.03f, 0.04f, -0.04f;
  const Eigen::Matrix3Xf normals = orthographic_normals(grid, corners, z, k);
  Eigen::VectorXd I(grid.size());
  for (int p = 0; p < grid.size(); ++p) {
    const Eigen::Vector3f n = normals.col(p);
    I[p] = rho[p] * static_cast<double>(lamp.l.row(0).dot(n) + n.dot(lamp.Q[0] * n) + lamp.phi[0]);
  }
  for (const GradientRow& row : shading_rows(grid, corners, lamp, rho, I, z, k)) {
    EXPECT_NEAR(row.a.dot(forward_gradient(grid, corners, row.pixel, z)), row.b, 1e-6);
  }
}

}  // namespace
}  // namespace rakelight
