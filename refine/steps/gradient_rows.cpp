// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/gradient_rows.h"

#include <array>

namespace rakelight {

Eigen::Vector2d forward_gradient(const PixelGrid& grid, const CornerList& corners, int p,
                                 const Eigen::VectorXd& x) {
  const int k = corners.first(p);
  if (k < 0) return Eigen::Vector2d::Zero();
  const Corner corner = corner_at(grid, p, k);
  return {static_cast<double>(corner.x_sign) * (x[corner.x_neighbor] - x[p]),
          static_cast<double>(corner.y_sign) * (x[corner.y_neighbor] - x[p])};
}

Eigen::SparseMatrix<double> normal_matrix(const GradientProblem& problem, Eigen::VectorXd& rhs) {
  std::vector<Eigen::Triplet<double>> entries;
  rhs = problem.prior_weight * problem.x0;
  for (int p = 0; p < static_cast<int>(rhs.size()); ++p) entries.emplace_back(p, p, problem.prior_weight);
  for (const GradientRow& row : problem.rows) {
    const int k = problem.corners.first(row.pixel);
    if (k < 0) continue;
    const Corner corner = corner_at(problem.grid, row.pixel, k);
    const double ax = static_cast<double>(corner.x_sign) * row.a.x(),
                 ay = static_cast<double>(corner.y_sign) * row.a.y();
    const std::array<std::pair<int, double>, 3> terms{
        {{corner.x_neighbor, ax}, {corner.y_neighbor, ay}, {row.pixel, -ax - ay}}};
    for (const auto& [i, ai] : terms) {
      rhs[i] += ai * row.b;
      for (const auto& [j, aj] : terms)
        if (i >= j) entries.emplace_back(i, j, ai * aj);
    }
  }
  Eigen::SparseMatrix<double> lower(rhs.size(), rhs.size());
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower + Eigen::SparseMatrix<double>(problem.smoothness.matrix().triangularView<Eigen::Lower>());
}

bool solve_gradient_rows(const GradientProblem& problem, SparseCholesky& solver, Eigen::VectorXd& x) {
  Eigen::VectorXd rhs;
  if (!solver.factorize(normal_matrix(problem, rhs))) return false;
  const Eigen::VectorXd solution = solver.solve(rhs);
  if (!solution.allFinite()) return false;
  x = solution;
  return true;
}

double gradient_energy(const GradientProblem& problem, const Eigen::VectorXd& x) {
  double sum = problem.prior_weight * (x - problem.x0).squaredNorm() + problem.smoothness.energy(x);
  for (const GradientRow& row : problem.rows) {
    const double miss = row.a.dot(forward_gradient(problem.grid, problem.corners, row.pixel, x)) - row.b;
    sum += miss * miss;
  }
  return sum;
}

}  // namespace rakelight
