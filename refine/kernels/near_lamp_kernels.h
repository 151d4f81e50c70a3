// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a near lamp of strength 1 (refine/lamp.h) sends to many surface points, and how that changes with each unknown of the
// joint lamp fit (refine/steps/near_lamps.h). Everything planar: a run of numbers a quantity, a multiple of kRunAlign long.
#pragma once

#include <cstddef>

namespace rakelight::kernels {

constexpr int kRunAlign = 16;
constexpr int kHighlightLobes = 2;  ///< refine/steps/highlight.h
constexpr int kBroadChanges = 7;    ///< refine/steps/broad_shape.h

/// Place and lobe of a near lamp, as the object's centre sees it.
struct NearLight {
  float direction[3];   ///< d, unit
  float tangent[2][3];  ///< unit vectors that span the plane across d; for derivatives only
  float inverse_distance, lobe_exponent;
  float center[3];  ///< metres, camera frame
};

/// Surface points, metres, and unit normals, camera frame.
struct PointRuns {
  const float *point[3], *normal[3];
};

/// d zeta / d c and d n / d c of the broad changes c.
struct BroadRuns {
  const float *B[kBroadChanges], *normal_by_c[3][kBroadChanges];
};

/// max(0, v.n)
void near_incidence(const NearLight& light, const PointRuns& at, int count, float* value);

/// Value and derivatives of max(0, v.n).
struct NearDerivatives {
  float* value;
  float* place[3];  ///< by the direction along the two tangents, and by kappa
  float* aim[3];    ///< by the centre, the lamp's place held
  float* shape[kBroadChanges];
};
void near_derivatives(const NearLight& light, const PointRuns& at, const BroadRuns& broad, int count,
                      const NearDerivatives& out);

/// |v| (n.h)^m of each highlight lobe, 0 where the lamp does not reach.
void highlight_lobes(const NearLight& light, const PointRuns& at, int count,
                     float* (&lobes)[kHighlightLobes]);

}  // namespace rakelight::kernels
