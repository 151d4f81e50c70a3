// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_incidence.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace rakelight {

Eigen::Matrix<float, 3, 2> lamp_tangents(const Eigen::Vector3f& direction) {
  Eigen::Matrix<float, 3, 2> tangents;
  tangents.col(0) = direction.unitOrthogonal();
  tangents.col(1) = direction.cross(tangents.col(0));
  return tangents;
}

kernels::NearLight near_light(const Lamp& lamp, const LampScene& scene) {
  kernels::NearLight light{};
  light.inverse_distance = lamp.inverse_distance;
  light.lobe_exponent = scene.lobe_exponent;
  const Eigen::Matrix<float, 3, 2> tangents = lamp_tangents(lamp.direction);
  for (Eigen::Index k = 0; k < 3; ++k) {
    light.direction[k] = lamp.direction[k];
    light.tangent[0][k] = tangents(k, 0);
    light.tangent[1][k] = tangents(k, 1);
    light.center[k] = scene.center[k];
  }
  return light;
}

SurfacePoints::SurfacePoints(const Eigen::Matrix3Xf& points, const Eigen::Matrix3Xf& normals,
                             const std::vector<int>& pixels)
    : SurfacePoints(padded(pixels.size())) {
  for (Eigen::Index k = 0; k < point.rows(); ++k) {
    const int p = pixels[std::min(static_cast<size_t>(k), pixels.size() - 1)];
    point.row(k) = points.col(p).transpose();
    normal.row(k) = normals.col(p).transpose();
  }
}

kernels::PointRuns SurfacePoints::runs() const {
  const auto column = [](const Eigen::ArrayX3f& of, Eigen::Index k) { return of.col(k).data(); };
  return {{column(point, 0), column(point, 1), column(point, 2)},
          {column(normal, 0), column(normal, 1), column(normal, 2)}};
}

Eigen::ArrayXf near_incidence(const Lamp& lamp, const LampScene& scene, const SurfacePoints& at) {
  Eigen::ArrayXf value(at.rows());
  kernels::near_incidence(near_light(lamp, scene), at.runs(), at.rows(), value.data());
  return value;
}

}  // namespace rakelight
