// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/normals.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "refine/method.h"
#include "tests/refine/exact_surface.h"

namespace rakelight {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979;

/// 24 x 18 pixels of the plane n.p = -0.8 m.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.2, -1.0).normalized();
  PixelGrid grid = make_pixel_grid({24, 18, 300.0, 310.0, 11.5, 8.5, {}}, cv::Mat1b(18, 24, uchar{255}));
  Eigen::VectorXd zeta{grid.size()};

  Plane() {
    for (int p = 0; p < grid.size(); ++p) {
      const cv::Point at = grid.pixels[static_cast<size_t>(p)];
      const Eigen::Vector3d ray((at.x - 11.5) / 300.0, (at.y - 8.5) / 310.0, 1);
      zeta[p] = std::log(-0.8 / normal.dot(ray));
    }
  }
};

double angle_deg(const Eigen::Vector3f& a, const Eigen::Vector3d& b) {
  return std::asin(std::min(1.0, a.cast<double>().cross(b).norm())) * kDegrees;
}

int corner_count(const CornerList& list, int p) {
  int count = 0;
  for (int k = 0; k < kCorners; ++k) count += list.has(p, k);
  return count;
}

TEST(SurfacePoints, LieOnTheirRaysAtTheirDepth) {
  const Plane plane;
  const Eigen::Matrix3Xf points = surface_points(plane.grid, plane.zeta);
  for (int p = 0; p < plane.grid.size(); ++p) {
    const cv::Point at = plane.grid.pixels[static_cast<size_t>(p)];
    const Eigen::Vector3d ray((at.x - 11.5) / 300.0, (at.y - 8.5) / 310.0, 1);
    EXPECT_LT((points.col(p).cast<double>() - std::exp(plane.zeta[p]) * ray).norm(), 1e-6);
    EXPECT_NEAR(plane.normal.dot(points.col(p).cast<double>()), -0.8, 1e-6);
  }
}

TEST(DepthChange, IsTheRootMeanSquareInMillimetres) {
  const Plane plane;
  Eigen::VectorXd moved = plane.zeta;
  double sum = 0;
  for (Eigen::Index p = 0; p < moved.size(); ++p) {
    moved[p] += 1e-3 * std::sin(static_cast<double>(p));
    sum += std::pow(1e3 * (std::exp(moved[p]) - std::exp(plane.zeta[p])), 2);
  }
  const double expected = std::sqrt(sum / static_cast<double>(moved.size()));
  EXPECT_NEAR(rms_change_mm(plane.zeta, moved), expected, 1e-5 * expected);
}

TEST(DepthChange, IsTypicallyThatOfMostPixels) {
  const Plane plane;
  Eigen::VectorXd moved = plane.zeta.array() + 1e-3;
  for (Eigen::Index p = 0; p < moved.size(); p += 50) moved[p] += 1;  // metres
  const double expected = 1.4826e3 * 1e-3 * plane.zeta.array().exp().mean();
  EXPECT_NEAR(typical_change_mm(plane.zeta, moved), expected, 0.1 * expected);
  EXPECT_GT(rms_change_mm(plane.zeta, moved), 10 * expected);
}

TEST(SurfaceNormals, OfAPlaneAreItsNormalEverywhere) {
  const Plane plane;
  for (const Stencil stencil : {Stencil::forward, Stencil::symmetric}) {
    const auto normals = surface_normals(plane.grid, make_corners(plane.grid, stencil), plane.zeta);
    for (int p = 0; p < plane.grid.size(); ++p) EXPECT_LT(angle_deg(normals.col(p), plane.normal), 0.1);
  }
}

TEST(SurfaceNormals, OfTheSymmetricStencilAreExactInsideAPlane) {
  const Plane plane;
  const auto normals = surface_normals(plane.grid, make_corners(plane.grid, Stencil::symmetric), plane.zeta);
  const int inside = plane.grid.index(9, 12);
  EXPECT_LT(angle_deg(normals.col(inside), plane.normal), 1e-3);  // forward differences are 0.03 degrees off
  EXPECT_LT(normals(2, inside), 0);
}

TEST(SurfaceNormals, OfASphereAreItsRadii) {
  const test::ExactSurface sphere = test::exact_sphere(96);
  const CornerList corners = make_corners(sphere.grid, Stencil::symmetric);
  const auto normals = surface_normals(sphere.grid, corners, sphere.zeta);
  double sum = 0;
  for (int p = 0; p < sphere.grid.size(); ++p) {
    const double angle = angle_deg(normals.col(p), sphere.normals.col(p).cast<double>());
    sum += angle;
    EXPECT_LT(angle, sphere.normals(2, p) < -0.6f ? 0.5 : 9.0);  // one-sided at the rim
  }
  EXPECT_LT(sum / sphere.grid.size(), 0.4);
}

TEST(SurfaceNormals, OfAPixelWithoutAnyCornerFacesTheCamera) {
  cv::Mat1b mask(5, 5, uchar{0});
  mask(2, 2) = 255;
  const PixelGrid grid = make_pixel_grid({5, 5, 10, 10, 2, 2, {}}, mask);
  const CornerList corners = make_corners(grid, Stencil::symmetric);
  EXPECT_EQ(corner_count(corners, 0), 0);
  EXPECT_EQ(surface_normals(grid, corners, Eigen::VectorXd::Zero(1)).col(0), Eigen::Vector3f(0, 0, -1));
}

TEST(MakeCorners, ForwardDifferencesTurnBackwardAtTheBorder) {
  const Plane plane;
  const CornerList list = make_corners(plane.grid, Stencil::forward);
  const auto first_of = [&](int u, int v) {
    const int p = plane.grid.index(v, u);
    return corner_at(plane.grid, p, list.first(p));
  };
  const Corner inside = first_of(5, 5);
  EXPECT_EQ(inside.x_neighbor, plane.grid.index(5, 6));
  EXPECT_EQ(inside.y_neighbor, plane.grid.index(6, 5));
  EXPECT_EQ(inside.x_sign, 1);
  EXPECT_EQ(inside.y_sign, 1);
  const Corner last = first_of(23, 17);
  EXPECT_EQ(last.x_neighbor, plane.grid.index(17, 22));
  EXPECT_EQ(last.y_neighbor, plane.grid.index(16, 23));
  EXPECT_EQ(last.x_sign, -1);
  EXPECT_EQ(last.y_sign, -1);
  for (int p = 0; p < plane.grid.size(); ++p) EXPECT_EQ(corner_count(list, p), 1);
}

TEST(MakeCorners, TheSymmetricStencilTakesAllCornersInTheMask) {
  const Plane plane;
  const CornerList list = make_corners(plane.grid, Stencil::symmetric);
  const auto expect = [&](int u, int v, int count) {
    const int p = plane.grid.index(v, u);
    EXPECT_EQ(corner_count(list, p), count);
    EXPECT_FLOAT_EQ(list.weight[static_cast<size_t>(p)], 1.0f / static_cast<float>(count));
  };
  expect(5, 5, 4);
  expect(0, 5, 2);
  expect(5, 17, 2);
  expect(23, 0, 1);
}

TEST(MakeCorners, NoCornerCrossesACut) {
  const Plane plane;
  std::vector<unsigned char> cut_right(static_cast<size_t>(plane.grid.size())), cut_down(cut_right);
  const int left = plane.grid.index(5, 5), right = plane.grid.index(5, 6);
  cut_right[static_cast<size_t>(left)] = 1;
  const CornerList list = make_corners(plane.grid, Stencil::symmetric, cut_right, cut_down);
  for (const auto& [p, across] : {std::pair(left, right), std::pair(right, left)}) {
    EXPECT_EQ(corner_count(list, p), 2);
    for (int k = 0; k < kCorners; ++k) {
      if (!list.has(p, k)) continue;
      EXPECT_NE(corner_at(plane.grid, p, k).x_neighbor, across);
    }
  }
}

TEST(MakeCorners, APixelCutOffKeepsItsCornersWithoutASay) {
  const Plane plane;
  std::vector<unsigned char> cut_right(static_cast<size_t>(plane.grid.size())), cut_down(cut_right);
  const int p = plane.grid.index(5, 5);
  cut_right[static_cast<size_t>(p)] = cut_right[static_cast<size_t>(plane.grid.index(5, 4))] = 1;
  const CornerList list = make_corners(plane.grid, Stencil::symmetric, cut_right, cut_down);
  EXPECT_EQ(list.weight[static_cast<size_t>(p)], 0);
  EXPECT_EQ(corner_count(list, p), 4);
}

TEST(NormalFrame, ItsJacobianIsTheChangeOfTheRawNormal) {
  const NormalFrame frame{570, 571, 31, -17};
  const Eigen::Vector3f at = frame.raw(0.01f, -0.02f);
  EXPECT_TRUE(((frame.raw(0.51f, -0.02f) - at) / 0.5f).isApprox(frame.jacobian().col(0), 1e-5f));
  EXPECT_TRUE(((frame.raw(0.01f, 0.23f) - at) / 0.25f).isApprox(frame.jacobian().col(1), 1e-5f));
}

}  // namespace
}  // namespace rakelight
