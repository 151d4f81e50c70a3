// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/second_differences.h"

namespace rakelight {

using Eigen::Index;
using Eigen::VectorXf;

SecondDifferences::SecondDifferences(const Placement& placement, const CurvatureWeights& weights)
    : across_(placement.zeros()), down_(across_), across_of_x_(across_), down_of_x_(across_) {
  placement.scatter(weights.across, 1, across_);
  placement.scatter(weights.down, 1, down_);
}

void SecondDifferences::add_product(const StencilGrid& A, const VectorXf& x, VectorXf& y) {
  const Index stride = A.stride();
  const auto difference = [](const VectorXf& v, Index at, Index count, Index step) {
    return v.segment(at - step, count) - 2.0f * v.segment(at, count) + v.segment(at + step, count);
  };
  for_rows(A, [&](int row) {
    const Index at = A.at(0, row);
    across_of_x_.segment(at, A.width) =
        across_.segment(at, A.width).cwiseProduct(difference(x, at, A.width, 1));
    down_of_x_.segment(at, A.width) =
        down_.segment(at, A.width).cwiseProduct(difference(x, at, A.width, stride));
  });
  for_rows(A, [&](int row) {
    const Index at = A.at(0, row);
    y.segment(at, A.width) +=
        difference(across_of_x_, at, A.width, 1) + difference(down_of_x_, at, A.width, stride);
  });
}

StencilGrid SecondDifferences::bounded_by_slopes(StencilGrid A) const {
  const auto add = [&](VectorXf& entries, const VectorXf& weights, Index i, Index step) {
    const float w = 2 * (weights[i] + weights[i + step]);
    if (w == 0.0f || A.diagonal[i] == 0.0f || A.diagonal[i + step] == 0.0f) return;
    entries[i] -= w;
    A.diagonal[i] += w;
    A.diagonal[i + step] += w;
  };
  for (int row = 0; row < A.height; ++row) {
    for (Index i = A.at(0, row); i < A.at(A.width, row); ++i) {
      add(A.right, across_, i, 1);
      add(A.down, down_, i, A.stride());
    }
  }
  return A;
}

}  // namespace rakelight
