// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "refine/solver/depth_solver.h"
#include "refine/solver/placement.h"
#include "refine/solver/sparse_cholesky.h"

namespace rakelight {
namespace {

/// Lower triangle with a fixed pattern, filled entry by entry.
class SymmetricPattern {
 public:
  SymmetricPattern(const PixelGrid& grid, const DepthCells& cells) : lower_(grid.size(), grid.size()) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto couple = [&](int a, int b) {
      if (a >= 0 && b >= 0) entries.emplace_back(std::max(a, b), std::min(a, b), 0.0);
    };
    for (int p = 0; p < grid.size(); ++p) {
      const cv::Point at = grid.pixels[static_cast<size_t>(p)];
      couple(p, p);
      couple(p, grid.neighbor[kRight][static_cast<size_t>(p)]);
      couple(p, grid.neighbor[kDown][static_cast<size_t>(p)]);
      couple(p, number_at(grid, at.x + 1, at.y + 1));
      couple(p, number_at(grid, at.x - 1, at.y + 1));
    }
    for (int cell = 0; cell < cells.size(); ++cell)
      for (const int a : cells.of(cell))
        for (const int b : cells.of(cell))
          if (b < a) couple(a, b);
    lower_.setFromTriplets(entries.begin(), entries.end());
    lower_.makeCompressed();
  }

  void clear() { std::fill_n(lower_.valuePtr(), lower_.nonZeros(), 0.0); }

  void add(int a, int b, double value) {
    const int column = std::min(a, b), row = std::max(a, b);
    const int* begin = lower_.innerIndexPtr() + lower_.outerIndexPtr()[column];
    const int* end = lower_.innerIndexPtr() + lower_.outerIndexPtr()[column + 1];
    lower_.valuePtr()[std::lower_bound(begin, end, row) - lower_.innerIndexPtr()] += value;
  }

  static int number_at(const PixelGrid& grid, int u, int v) {
    const bool inside = u >= 0 && v >= 0 && u < grid.index.cols && v < grid.index.rows;
    return inside ? grid.index(v, u) : -1;
  }

  const SparseCholesky::Matrix& lower() const { return lower_; }

 private:
  SparseCholesky::Matrix lower_;
};

class CholeskyDepthSolver final : public DepthSolver {
 public:
  CholeskyDepthSolver(const PixelGrid& grid, const DepthCells& cells)
      : grid_(grid), cells_(cells), placement_(grid), matrix_(grid, cells) {}

  DepthSystem reuse_system() override { return DepthSystem(grid_); }

  bool solve(DepthSystem system, Eigen::VectorXd& x) override {
    assemble(system);
    const bool solved =
        system.curvature.empty()
            ? cholesky_.factorize(matrix_.lower())
            : cholesky_.factorize(matrix_.lower() + curvature_lower_triangle(grid_, system.curvature));
    Eigen::VectorXd rhs;
    placement_.gather(system.rhs, 1, rhs);
    return solved && solve_again(rhs, x);
  }

  bool solve_again(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) override {
    Eigen::VectorXd solution = cholesky_.solve(rhs);
    if (!solution.allFinite()) return false;
    x = std::move(solution);
    return true;
  }

 private:
  void assemble(const DepthSystem& system) {
    matrix_.clear();
    for (int p = 0; p < grid_.size(); ++p) {
      const size_t i = static_cast<size_t>(p);
      const cv::Point at = grid_.pixels[i];
      const Eigen::Index place = placement_.place(p);
      const StencilGrid& S = system.stencil;
      matrix_.add(p, p, static_cast<double>(S.diagonal[place]));
      add_if_inside(p, grid_.neighbor[kRight][i], S.right[place]);
      add_if_inside(p, grid_.neighbor[kDown][i], S.down[place]);
      add_if_inside(p, SymmetricPattern::number_at(grid_, at.x + 1, at.y + 1), S.down_right[place]);
      add_if_inside(p, SymmetricPattern::number_at(grid_, at.x - 1, at.y + 1), S.down_left[place]);
    }
    for (int cell = 0; cell < cells_.size(); ++cell)
      if (cells_.of(cell).size() > 1) replace_lumped(cells_.of(cell), system.cell_weight[cell]);
  }

  void replace_lumped(const DepthCells::Pixels& cell, double weight) {
    const auto count = static_cast<double>(cell.size());
    for (const int a : cell) {
      matrix_.add(a, a, -weight / count);
      for (const int b : cell)
        if (b <= a) matrix_.add(a, b, weight / (count * count));
    }
  }

  void add_if_inside(int p, int q, float value) {
    if (q >= 0) matrix_.add(p, q, static_cast<double>(value));
  }

  const PixelGrid& grid_;
  const DepthCells& cells_;
  Placement placement_;
  SymmetricPattern matrix_;
  SparseCholesky cholesky_;
};

}  // namespace

std::unique_ptr<DepthSolver> make_cholesky_depth_solver(const PixelGrid& grid, const DepthCells& cells) {
  return std::make_unique<CholeskyDepthSolver>(grid, cells);
}

}  // namespace rakelight
