// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Smoothness of depth that spares edges: the term lambda_l |Lap z|^2 of Eq. (8) and of RGBD-Fusion, a row an axis,
//
//     E(zeta) = weight sum_p w_p (zeta_left - 2 zeta + zeta_right)^2 + the same downwards,   w = 1 / (1 + (c / (k s))^2)
//
// with c the second difference where the weights were made, s the robust deviation of all c, k = kEdge. Depth jumps that
// are too small to be told from noise beforehand are then not smoothed over: that is what a plain Laplacian pays for
// in depth error what it gains in normals.
#pragma once

#include <vector>

#include "refine/solver/curvature.h"

namespace rakelight {

/// Weight 1 where both neighbours can be reached, 0 where one is outside the mask or across a cut, so that neither
/// border nor jump is pulled flat.
/// @param cut_right, cut_down  1 where the step to that neighbour crosses a depth jump; may be empty.
CurvatureWeights reachable_differences(const PixelGrid& grid, const std::vector<unsigned char>& cut_right,
                                       const std::vector<unsigned char>& cut_down);

class CurvaturePrior {
 public:
  /// @param grid must outlive this  @param cut_right, cut_down  see reachable_differences
  CurvaturePrior(const PixelGrid& grid, const std::vector<unsigned char>& cut_right,
                 const std::vector<unsigned char>& cut_down);

  /// The term above with weights made at zeta. @param weight lambda_l
  CurvatureWeights at(const Eigen::VectorXd& zeta, double weight) const;

 private:
  const PixelGrid& grid_;
  CurvatureWeights reach_;
};

}  // namespace rakelight
