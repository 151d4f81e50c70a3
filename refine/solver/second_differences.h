// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curvature term C of a depth system (refine/solver/curvature.h) on the vectors of a StencilGrid.
#pragma once

#include "refine/solver/curvature.h"
#include "refine/solver/placement.h"

namespace rakelight {

class SecondDifferences {
 public:
  SecondDifferences() = default;
  SecondDifferences(const Placement& placement, const CurvatureWeights& weights);

  bool empty() const { return across_.size() == 0; }

  /// y += C x. @param A the stencil whose layout x has
  void add_product(const StencilGrid& A, const Eigen::VectorXf& x, Eigen::VectorXf& y);

  /// A with slopes added that C cannot exceed: (b - a)^2 <= 2 a^2 + 2 b^2; for the preconditioner.
  StencilGrid bounded_by_slopes(StencilGrid A) const;

 private:
  Eigen::VectorXf across_, down_;            ///< weights at their pixels' places
  Eigen::VectorXf across_of_x_, down_of_x_;  ///< weighted second differences of a product's argument
};

}  // namespace rakelight
