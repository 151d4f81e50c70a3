// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/orbit_camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace rakelight {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kMargin = 1.04;                    ///< room around a fitted box
constexpr double kNearest = 1e-4, kFarthest = 1e3;  ///< limits of the distance, metres

/// Rows: the view's right, up and backward axis in world coordinates.
Eigen::Matrix3d view_rotation(const OrbitCamera& camera) {
  const Eigen::Matrix3d flip = Eigen::Vector3d(1, -1, -1).asDiagonal();  // sensor's axes to OpenGL's
  const auto about_y = Eigen::AngleAxisd(-camera.azimuth, Eigen::Vector3d::UnitY());
  const auto about_x = Eigen::AngleAxisd(camera.elevation, Eigen::Vector3d::UnitX());
  return (about_x * about_y).toRotationMatrix() * flip;
}

/// Half the visible height at the target, metres.
double half_height(const OrbitCamera& camera) { return camera.distance * std::tan(camera.fov_y / 2); }

Eigen::Vector3d eye(const OrbitCamera& camera) {
  return camera.target + camera.distance * view_rotation(camera).row(2).transpose();
}

Eigen::Vector3d eigen(const cv::Vec3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace

Eigen::Matrix4d view_matrix(const OrbitCamera& camera) {
  const Eigen::Matrix3d rotation = view_rotation(camera);
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.topLeftCorner<3, 3>() = rotation;
  view.topRightCorner<3, 1>() = -rotation * eye(camera);
  return view;
}

Eigen::Matrix4d projection_matrix(const OrbitCamera& camera, double aspect, const Box& scene) {
  const double reach = scene.diagonal() + (eigen(scene.center()) - camera.target).norm();
  const double far = camera.distance + reach;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  const double top = half_height(camera);
  if (camera.orthographic) {
    const double near = camera.distance - reach;
    projection.diagonal() << 1 / (aspect * top), 1 / top, -2 / (far - near), 1;
    projection(2, 3) = -(far + near) / (far - near);
    return projection;
  }
  const double near = std::max(camera.distance - reach, 1e-3 * camera.distance);
  const double cotangent = camera.distance / top;
  projection.diagonal() << cotangent / aspect, cotangent, -(far + near) / (far - near), 0;
  projection(2, 3) = -2 * far * near / (far - near);
  projection(3, 2) = -1;
  return projection;
}

void orbit(OrbitCamera& camera, double dx, double dy) {
  camera.azimuth = std::remainder(camera.azimuth - kPi * dx, 2 * kPi);
  camera.elevation = std::clamp(camera.elevation + kPi * dy, -kPi / 2, kPi / 2);
}

void pan(OrbitCamera& camera, double dx, double dy) {
  const Eigen::Matrix3d rotation = view_rotation(camera);
  const double height = 2 * half_height(camera);
  camera.target += height * (dy * rotation.row(1) - dx * rotation.row(0)).transpose();
}

void zoom(OrbitCamera& camera, double factor, double x, double y) {
  const double before = camera.distance;
  camera.distance = std::clamp(before * factor, kNearest, kFarthest);
  const double moved =
      1 - camera.distance / before;  // the point under the mouse, in the target's plane, stays
  const double height = 2 * before * std::tan(camera.fov_y / 2);
  const Eigen::Matrix3d rotation = view_rotation(camera);
  camera.target += moved * height * (x * rotation.row(0) - y * rotation.row(1)).transpose();
}

void fit(OrbitCamera& camera, const Box& box, double aspect) {
  camera.target = eigen(box.center());
  const Eigen::Matrix3d rotation = view_rotation(camera);
  const double up = std::tan(camera.fov_y / 2), right = aspect * up;
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d point(corner & 1 ? box.high[0] : box.low[0], corner & 2 ? box.high[1] : box.low[1],
                                corner & 4 ? box.high[2] : box.low[2]);
    const Eigen::Vector3d seen = rotation * (point - camera.target);
    const double needed = std::max(std::abs(seen.x()) / right, std::abs(seen.y()) / up);
    distance = std::max(distance, needed + (camera.orthographic ? 0 : seen.z()));
  }
  camera.distance = std::clamp(kMargin * distance, kNearest, kFarthest);
}

void turn_to(OrbitCamera& camera, StandardView view) {
  switch (view) {
    case StandardView::front:
      camera.azimuth = camera.elevation = 0;
      return;
    case StandardView::back:
      camera.azimuth = kPi, camera.elevation = 0;
      return;
    case StandardView::left:
      camera.azimuth = -kPi / 2, camera.elevation = 0;
      return;
    case StandardView::right:
      camera.azimuth = kPi / 2, camera.elevation = 0;
      return;
    case StandardView::top:
      camera.azimuth = 0, camera.elevation = kPi / 2;
      return;
    case StandardView::bottom:
      camera.azimuth = 0, camera.elevation = -kPi / 2;
      return;
  }
}

Ray ray_through(const OrbitCamera& camera, double aspect, double x, double y) {
  const Eigen::Matrix3d rotation = view_rotation(camera);
  const double top = half_height(camera);
  const Eigen::Vector3d aside = rotation.transpose() * Eigen::Vector3d(x * aspect * top, y * top, 0);
  if (camera.orthographic) return {eye(camera) + aside, -rotation.row(2).transpose()};
  return {eye(camera), (camera.target + aside - eye(camera)).normalized()};
}

std::optional<Eigen::Vector2d> project(const OrbitCamera& camera, double aspect,
                                       const Eigen::Vector3d& point) {
  const Eigen::Vector3d seen = view_rotation(camera) * (point - eye(camera));
  const double depth = camera.orthographic ? camera.distance : -seen.z();
  if (-seen.z() <= 0 && !camera.orthographic) return std::nullopt;
  const double top = depth * std::tan(camera.fov_y / 2);
  return Eigen::Vector2d(seen.x() / (aspect * top), seen.y() / top);
}

}  // namespace rakelight
