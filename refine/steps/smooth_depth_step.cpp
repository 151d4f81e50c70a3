// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/smooth_depth_step.h"

namespace rakelight {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

int number_at(const PixelGrid& grid, int u, int v) {
  const bool inside = u >= 0 && v >= 0 && u < grid.index.cols && v < grid.index.rows;
  return inside ? grid.index(v, u) : -1;
}

void add_stencil(const PixelGrid& grid, const DepthSystem& system, Triplets& entries) {
  const auto add = [&](int p, int q, double value) {
    if (q >= 0) entries.emplace_back(std::max(p, q), std::min(p, q), value);
  };
  for (int p = 0; p < grid.size(); ++p) {
    const auto i = static_cast<size_t>(p);
    const cv::Point at = grid.pixels[i];
    add(p, p, system.diagonal[i]);
    add(p, grid.neighbor[kRight][i], system.right[i]);
    add(p, grid.neighbor[kDown][i], system.down[i]);
    add(p, number_at(grid, at.x + 1, at.y + 1), system.down_right[i]);
    add(p, number_at(grid, at.x - 1, at.y + 1), system.down_left[i]);
  }
}

void add_cells(const DepthCells& cells, const Eigen::VectorXd& cell_weight, Triplets& entries) {
  for (size_t cell = 0; cell < cells.pixels_of.size(); ++cell) {
    const auto& pixels = cells.pixels_of[cell];
    const auto count = static_cast<double>(pixels.size());
    const double weight = cell_weight[static_cast<Eigen::Index>(cell)] / (count * count);
    for (const int a : pixels)
      for (const int b : pixels)
        if (a >= b) entries.emplace_back(a, b, weight);
  }
}

}  // namespace

Smoothness::Smoothness(const Eigen::SparseMatrix<double>& laplacian, double weight)
    : matrix_(weight * (Eigen::SparseMatrix<double>(laplacian.transpose()) * laplacian)) {}

Smoothness::Smoothness(Eigen::SparseMatrix<double> matrix) : matrix_(std::move(matrix)) {}

Eigen::SparseMatrix<double> lower_triangle(const PixelGrid& grid, const DepthCells& cells,
                                           const DepthSystem& system, const Smoothness& smoothness) {
  Triplets entries;
  entries.reserve(static_cast<size_t>(6 * grid.size()));
  add_stencil(grid, system, entries);
  add_cells(cells, system.cell_weight, entries);
  Eigen::SparseMatrix<double> stencil(grid.size(), grid.size());
  stencil.setFromTriplets(entries.begin(), entries.end());
  return stencil + Eigen::SparseMatrix<double>(smoothness.matrix().triangularView<Eigen::Lower>());
}

DepthStepReport smooth_depth_step(const DepthProblem& problem, const Smoothness& smoothness,
                                  const DepthOptions& options, SparseCholesky& solver,
                                  Eigen::VectorXd& zeta) {
  const auto energy = [&](const Eigen::VectorXd& at) {
    return depth_energy(problem, at) + smoothness.energy(at);
  };
  DepthStepReport report;
  report.energy_before = report.energy_after = energy(zeta);
  const DepthSystem system = depth_system(problem, zeta, options.linearization);
  if (!solver.factorize(lower_triangle(problem.grid, problem.prior.cells, system, smoothness))) return report;
  const Eigen::VectorXd step = solver.solve(system.rhs - smoothness.matrix() * zeta);
  report.solved = step.allFinite();
  if (!report.solved) return report;
  for (double length = 1; report.backtracks <= options.max_backtracks; length /= 2, ++report.backtracks) {
    const Eigen::VectorXd candidate = zeta + length * step;
    report.energy_after = energy(candidate);
    if (report.energy_after <= report.energy_before || options.max_backtracks == 0) {
      zeta = candidate;
      return report;
    }
  }
  report.energy_after = report.energy_before;
  return report;
}

}  // namespace rakelight
