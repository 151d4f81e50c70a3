// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/curvature_prior.h"

#include <algorithm>
#include <cmath>

#include "refine/steps/laplacian.h"

namespace rakelight {
namespace {

constexpr double kEdge = 2;  // robust deviations of second differences at which one counts half

/// Robust deviation of the values that are not exactly zero: rows without both neighbours do not count.
double deviation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  std::vector<double> sizes;
  for (const Eigen::VectorXd* values : {&a, &b})
    for (const double value : *values)
      if (value != 0) sizes.push_back(std::abs(value));
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * *middle;
}

Eigen::SparseMatrix<double> weighted_square(const Eigen::SparseMatrix<double>& rows,
                                            const Eigen::VectorXd& difference, double half, double weight) {
  Eigen::VectorXd root(difference.size());
  for (Eigen::Index p = 0; p < root.size(); ++p) {
    const double relative = half > 0 ? difference[p] / half : 0;
    root[p] = std::sqrt(weight / (1 + relative * relative));
  }
  const Eigen::SparseMatrix<double> scaled = root.asDiagonal() * rows;
  return Eigen::SparseMatrix<double>(scaled.transpose()) * scaled;
}

}  // namespace

CurvaturePrior::CurvaturePrior(const PixelGrid& grid, const std::vector<unsigned char>& cut_right,
                               const std::vector<unsigned char>& cut_down)
    : across_(second_differences(grid, kLeft, kRight, cut_right)),
      down_(second_differences(grid, kUp, kDown, cut_down)) {}

Smoothness CurvaturePrior::at(const Eigen::VectorXd& zeta, double weight) const {
  const Eigen::VectorXd across = across_ * zeta, down = down_ * zeta;
  const double half = kEdge * deviation(across, down);
  return Smoothness(weighted_square(across_, across, half, weight) +
                    weighted_square(down_, down, half, weight));
}

}  // namespace rakelight
