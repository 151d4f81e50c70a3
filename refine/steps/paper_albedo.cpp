// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/paper_albedo.h"

#include <algorithm>
#include <cmath>

#include "refine/solver/sparse_cholesky.h"

namespace rakelight {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

double squared(double x) { return x * x; }

Sparse diagonal(const Eigen::VectorXd& values) {
  Sparse matrix(values.size(), values.size());
  matrix.reserve(Eigen::VectorXi::Constant(static_cast<int>(values.size()), 1));
  for (int p = 0; p < static_cast<int>(values.size()); ++p) matrix.insert(p, p) = values[p];
  return matrix;
}

bool solve_spd(const Sparse& A, const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  SparseCholesky solver;
  if (!solver.factorize(Sparse(A.triangularView<Eigen::Lower>()))) return false;
  const Eigen::VectorXd solution = solver.solve(b);
  if (!solution.allFinite()) return false;
  x = solution;
  return true;
}

}  // namespace

Sparse anisotropic_laplacian(const PixelGrid& grid, const Eigen::VectorXd& I, const Eigen::VectorXd& z,
                             const AlbedoOptions& options) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int p = 0; p < grid.size(); ++p) {
    for (const auto& neighbors : grid.neighbor) {
      const int q = neighbors[static_cast<size_t>(p)];
      if (q < 0) continue;
      const double difference = squared(I[p] - I[q]);
      if (options.cutoff > 0 && difference > options.cutoff) continue;
      const double w = std::exp(-difference / (2 * squared(options.edge_sigma)) -
                                squared(z[p] - z[q]) / (2 * squared(options.depth_sigma)));
      entries.emplace_back(p, p, w);
      entries.emplace_back(p, q, -w);
    }
  }
  Sparse W(grid.size(), grid.size());
  W.setFromTriplets(entries.begin(), entries.end());
  return W;
}

bool solve_albedo(const Eigen::VectorXd& S, const Eigen::VectorXd& I, const Sparse& W, double lambda,
                  Eigen::VectorXd& rho) {
  const Sparse A = diagonal(S.cwiseAbs2()) + lambda * Sparse(W.transpose() * W);
  return solve_spd(A, S.cwiseProduct(I), rho);
}

bool solve_local_term(const Eigen::VectorXd& rest, const Sparse& W, const AlbedoOptions& options,
                      Eigen::VectorXd& beta) {
  const double root = std::sqrt(1 + options.local_weight);  // Eq. (10)'s form with S^2 = 1 + lambda_b2
  return solve_albedo(Eigen::VectorXd::Constant(rest.size(), root), rest / root, W, options.local_smoothness,
                      beta);
}

bool diffuse_albedo(const PixelGrid& grid, const Eigen::VectorXd& I, double lambda, double sigma,
                    Eigen::VectorXd& P) {
  const auto step = [&](int p, Neighbor direction) {
    const int q = grid.neighbor[direction][static_cast<size_t>(p)];
    return q < 0 ? 0.0 : I[q] - I[p];
  };
  Eigen::VectorXd gradient2(grid.size());
  for (int p = 0; p < grid.size(); ++p) gradient2[p] = squared(step(p, kRight)) + squared(step(p, kDown));
  const double most = std::max(gradient2.maxCoeff(), 1e-12);
  std::vector<Eigen::Triplet<double>> entries;
  for (int p = 0; p < grid.size(); ++p) {
    entries.emplace_back(p, p, 1.0);
    const double weight = lambda * squared(std::exp(-sigma * gradient2[p] / most));
    for (const Neighbor direction : {kRight, kDown}) {
      const int q = grid.neighbor[direction][static_cast<size_t>(p)];
      if (q < 0) continue;
      entries.emplace_back(p, p, weight);
      entries.emplace_back(q, q, weight);
      entries.emplace_back(p, q, -weight);
      entries.emplace_back(q, p, -weight);
    }
  }
  Sparse A(grid.size(), grid.size());
  A.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd before = P;
  return solve_spd(A, before, P);
}

}  // namespace rakelight
