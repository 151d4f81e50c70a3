// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <optional>
#include <stdexcept>

#include "refine/solver/depth_solver.h"
#include "refine/solver/multigrid.h"
#include "refine/solver/second_differences.h"

namespace rakelight {
namespace {

using Eigen::VectorXf;

constexpr int kMostSteps =
    200;                   // 2 to 20 without second differences; what needs more is left to the exact solver
constexpr int kSlow = 20;  // steps after which the preconditioner smooths twice

class MultigridDepthSolver final : public DepthSolver {
 public:
  MultigridDepthSolver(const PixelGrid& grid, const DepthCells& cells, double tolerance)
      : grid_(grid),
        cells_(cells),
        tolerance_(tolerance),
        placement_(grid),
        single_cells_(cells.size() == grid.size()),
        residual_(placement_.zeros()),
        solution_(residual_),
        preconditioned_(residual_),
        direction_(residual_),
        product_(residual_) {
    if (single_cells_) return;
    for (const int p : cells.pixels) cell_places_.push_back(static_cast<int>(placement_.place(p)));
  }

  DepthSystem reuse_system() override {
    set_up_ = exact_has_last_ = false;
    if (!last_) return DepthSystem(grid_);
    DepthSystem system = std::move(*last_);
    last_.reset();
    return system;
  }

  bool solve(DepthSystem system, Eigen::VectorXd& x) override {
    last_ = std::move(system);
    exact_has_last_ = false;
    curvature_ =
        last_->curvature.empty() ? SecondDifferences() : SecondDifferences(placement_, last_->curvature);
    if (!curvature_.empty()) bounded_ = curvature_.bounded_by_slopes(last_->stencil);
    set_up_ = multigrid_.setup(curvature_.empty() ? last_->stencil : bounded_);
    const auto scale = static_cast<double>(last_->rhs.cwiseAbs().maxCoeff());
    residual_ = last_->rhs * static_cast<float>(inverse_or_zero(scale));
    return (set_up_ && conjugate_gradients(scale, x)) || solve_exactly(x);
  }

  bool solve_again(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) override {
    if (!last_) throw std::logic_error("solve_again() needs a system solved before");
    if (exact_has_last_) return exact_->solve_again(rhs, x);
    const double scale = rhs.cwiseAbs().maxCoeff();
    placement_.scatter(rhs, inverse_or_zero(scale), residual_);
    if (set_up_ && rhs.allFinite() && conjugate_gradients(scale, x)) return true;
    placement_.scatter(rhs, 1, last_->rhs);
    return solve_exactly(x);
  }

 private:
  bool solve_exactly(Eigen::VectorXd& x) {
    if (exact_ == nullptr) exact_ = make_cholesky_depth_solver(grid_, cells_);
    return exact_has_last_ = exact_->solve(*last_, x);
  }

  /// The right-hand side is scaled to 1: a float's range then never matters.
  static double inverse_or_zero(double scale) { return scale > 0 ? 1 / scale : 0; }

  /// product = A direction with the exact K' Lambda K. @return direction . product
  double multiply() {
    const double lumped = last_->stencil.multiply(direction_, product_);
    if (single_cells_ && curvature_.empty()) return lumped;
    if (!curvature_.empty()) curvature_.add_product(last_->stencil, direction_, product_);
    if (!single_cells_) replace_lumped_cells();
    return dot(direction_, product_);
  }

  /// Each cell's own block of K' Lambda K instead of its lumped sum.
  void replace_lumped_cells() {
    for_each_block(cells_.size(), [&](int begin, int end) {
      for (int cell = begin; cell < end; ++cell) {
        const auto first = static_cast<size_t>(cells_.first[static_cast<size_t>(cell)]);
        const size_t count = cells_.of(cell).size();
        const int* places = cell_places_.data() + first;
        float mean = 0;
        for (size_t k = 0; k < count; ++k) mean += direction_[places[k]];
        const auto size = static_cast<float>(count);
        const float share = static_cast<float>(last_->cell_weight[cell]) / size;
        for (size_t k = 0; k < count; ++k)
          product_[places[k]] += share * (mean / size - direction_[places[k]]);
      }
    });
  }

  double dot(const VectorXf& a, const VectorXf& b) const {
    const GridLayout& rows = placement_.layout();
    return sum_over_rows(rows, [&](int y) {
      return kernels::dot_row(a.data() + rows.at(0, y), b.data() + rows.at(0, y), rows.width);
    });
  }

  /// sum += factor v
  void add(const VectorXf& v, float factor, VectorXf& sum) const {
    const GridLayout& rows = placement_.layout();
    for_rows(rows, [&](int y) {
      const Eigen::Index i = rows.at(0, y);
      kernels::add_row(v.data() + i, factor, rows.width, sum.data() + i);
    });
  }

  /// solution += length direction; direction = preconditioned + share direction
  void advance_and_turn(float length, float share) {
    const GridLayout& rows = placement_.layout();
    for_rows(rows, [&](int y) {
      const Eigen::Index i = rows.at(0, y);
      kernels::turn_row(preconditioned_.data() + i, length, share, rows.width, solution_.data() + i,
                        direction_.data() + i);
    });
  }

  /// Solves for the residual, of size 1, times scale. @return false, x untouched, when it does not converge
  bool conjugate_gradients(double scale, Eigen::VectorXd& x) {
    solution_.setZero();
    direction_.setZero();
    multigrid_.set_sweeps(1);
    multigrid_.apply(residual_, preconditioned_);
    double rz = dot(residual_, preconditioned_);
    const double target = tolerance_ * tolerance_ * rz;
    float length = 0, share = 0;
    for (int step = 0; rz > target; ++step) {
      advance_and_turn(length, share);
      const double curvature = multiply();
      if (step == kMostSteps || !(curvature > 0)) return false;
      length = static_cast<float>(rz / curvature);
      add(product_, -length, residual_);
      if (step == kSlow) multigrid_.set_sweeps(2);
      multigrid_.apply(residual_, preconditioned_);
      const double next = dot(residual_, preconditioned_);
      share =
          step == kSlow ? 0 : static_cast<float>(next / rz);  // another preconditioner: directions start anew
      rz = next;
    }
    if (!std::isfinite(rz) || !std::isfinite(scale)) return false;
    add(direction_, length, solution_);
    placement_.gather(solution_, scale, x);
    return true;
  }

  const PixelGrid& grid_;
  const DepthCells& cells_;
  double tolerance_;
  Placement placement_;
  bool single_cells_;             ///< a cell is a pixel: lumped is exact
  std::vector<int> cell_places_;  ///< places of the cells' pixels, cell by cell
  Multigrid multigrid_;
  bool set_up_ = false;  ///< the last system has a preconditioner
  StencilGrid bounded_;  ///< with second differences: what the preconditioner is made of
  SecondDifferences curvature_;
  VectorXf residual_, solution_, preconditioned_, direction_, product_;
  std::unique_ptr<DepthSolver> exact_;
  std::optional<DepthSystem> last_;
  bool exact_has_last_ = false;
};

}  // namespace

std::unique_ptr<DepthSolver> make_multigrid_depth_solver(const PixelGrid& grid, const DepthCells& cells,
                                                         double tolerance) {
  return std::make_unique<MultigridDepthSolver>(grid, cells, tolerance);
}

}  // namespace rakelight
