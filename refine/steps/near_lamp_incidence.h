// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Between the lamps and surfaces of the refinement and the vector kernels that light one by the other
// (refine/kernels/near_lamp_kernels.h).
#pragma once

#include <vector>

#include "refine/kernels/near_lamp_kernels.h"
#include "refine/lamp.h"

namespace rakelight {

/// Two unit vectors that span the plane across the unit vector `direction`.
Eigen::Matrix<float, 3, 2> lamp_tangents(const Eigen::Vector3f& direction);

/// A near lamp in the kernels' terms.
kernels::NearLight near_light(const Lamp& lamp, const LampScene& scene);

/// Numbers of a run of `count` pixels: the next multiple of what the kernels read at once.
inline Eigen::Index padded(size_t count) {
  constexpr auto kAlign = static_cast<size_t>(kernels::kRunAlign);
  return static_cast<Eigen::Index>((count + kAlign - 1) / kAlign * kAlign);
}

/// Points and normals of some pixels, a column a coordinate; the rows past the last pixel repeat it.
struct SurfacePoints {
  Eigen::ArrayX3f point;   ///< metres, camera frame
  Eigen::ArrayX3f normal;  ///< unit

  explicit SurfacePoints(Eigen::Index rows) : point(rows, 3), normal(rows, 3) {}

  /// @param points, normals 3 x pixels of the whole surface  @param pixels which of them
  SurfacePoints(const Eigen::Matrix3Xf& points, const Eigen::Matrix3Xf& normals,
                const std::vector<int>& pixels);

  int rows() const { return static_cast<int>(point.rows()); }
  kernels::PointRuns runs() const;
};

/// max(0, v.n) of the near model (refine/lamp.h) at each row.
Eigen::ArrayXf near_incidence(const Lamp& lamp, const LampScene& scene, const SurfacePoints& at);

}  // namespace rakelight
