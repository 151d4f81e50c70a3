// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
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

  bool solve(DepthSystem system, Eigen::VectorXd& x) override {
    last_ = std::make_unique<DepthSystem>(std::move(system));
    exact_has_last_ = false;
    curvature_ =
        last_->curvature.empty() ? SecondDifferences() : SecondDifferences(placement_, last_->curvature);
    StencilGrid stencil = stencil_of(*last_);
    stencil_ = curvature_.empty() ? StencilGrid() : stencil;
    set_up_ = multigrid_.setup(curvature_.empty() ? std::move(stencil)
                                                  : curvature_.bounded_by_slopes(std::move(stencil)));
    return solve_again(last_->rhs, x);
  }

  bool solve_again(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) override {
    if (last_ == nullptr) throw std::logic_error("solve_again() needs a system solved before");
    if (!exact_has_last_) {
      if (set_up_ && conjugate_gradients(*last_, rhs, x)) return true;
      last_->rhs = rhs;
      if (exact_ == nullptr) exact_ = make_cholesky_depth_solver(grid_, cells_);
      return exact_has_last_ = exact_->solve(*last_, x);
    }
    return exact_->solve_again(rhs, x);
  }

 private:
  /// The system's stencil; the sensor's K' Lambda K lumped on the diagonal (exact for cells of one pixel).
  StencilGrid stencil_of(const DepthSystem& system) const {
    StencilGrid A = placement_.stencil();
    std::vector<float> diagonal(system.diagonal);
    for_each_block(grid_.size(), [&](int begin, int end) {
      for (int p = begin; p < end; ++p) {
        const int cell = cells_.cell_of[static_cast<size_t>(p)];
        diagonal[static_cast<size_t>(p)] +=
            static_cast<float>(system.cell_weight[cell] / static_cast<double>(cells_.of(cell).size()));
      }
    });
    placement_.scatter(diagonal.data(), 1.0f, A.diagonal);
    placement_.scatter(system.right.data(), 1.0f, A.right);
    placement_.scatter(system.down.data(), 1.0f, A.down);
    placement_.scatter(system.down_right.data(), 1.0f, A.down_right);
    placement_.scatter(system.down_left.data(), 1.0f, A.down_left);
    return A;
  }

  /// product = A direction with the exact K' Lambda K. @return direction . product
  double multiply(const DepthSystem& system) {
    const StencilGrid& A = curvature_.empty() ? multigrid_.finest() : stencil_;
    const double curvature = A.multiply(direction_, product_);
    if (single_cells_ && curvature_.empty()) return curvature;
    if (!curvature_.empty()) curvature_.add_product(A, direction_, product_);
    if (!single_cells_) replace_lumped_cells(system);
    return dot(direction_, product_);
  }

  /// Each cell's own block of K' Lambda K instead of its lumped sum.
  void replace_lumped_cells(const DepthSystem& system) {
    for_each_block(cells_.size(), [&](int begin, int end) {
      for (int cell = begin; cell < end; ++cell) {
        const auto first = static_cast<size_t>(cells_.first[static_cast<size_t>(cell)]);
        const size_t count = cells_.of(cell).size();
        const int* places = cell_places_.data() + first;
        float mean = 0;
        for (size_t k = 0; k < count; ++k) mean += direction_[places[k]];
        const auto size = static_cast<float>(count);
        const float share = static_cast<float>(system.cell_weight[cell]) / size;
        for (size_t k = 0; k < count; ++k)
          product_[places[k]] += share * (mean / size - direction_[places[k]]);
      }
    });
  }

  /// Sum in double over blocks, in their order.
  double dot(const VectorXf& a, const VectorXf& b) const {
    return sum_over_blocks(static_cast<int>(a.size()), 0.0, [&](int begin, int end) {
      return a.segment(begin, end - begin).cast<double>().dot(b.segment(begin, end - begin).cast<double>());
    });
  }

  void advance(float length) {
    for_each_block(static_cast<int>(solution_.size()), [&](int begin, int end) {
      solution_.segment(begin, end - begin) += length * direction_.segment(begin, end - begin);
      residual_.segment(begin, end - begin) -= length * product_.segment(begin, end - begin);
    });
  }

  /// direction = preconditioned + share * direction
  void turn(float share) {
    for_each_block(static_cast<int>(solution_.size()), [&](int begin, int end) {
      direction_.segment(begin, end - begin) =
          preconditioned_.segment(begin, end - begin) + share * direction_.segment(begin, end - begin);
    });
  }

  /// @return false, x untouched, when it does not converge.
  bool conjugate_gradients(const DepthSystem& system, const Eigen::VectorXd& rhs, Eigen::VectorXd& x) {
    // The right-hand side is scaled to 1: a float's range then never matters.
    const double scale = rhs.cwiseAbs().maxCoeff();
    if (!std::isfinite(scale) || !rhs.allFinite()) return false;
    placement_.scatter(rhs.data(), scale > 0 ? 1 / scale : 0.0, residual_);
    solution_.setZero();
    direction_.setZero();
    multigrid_.set_sweeps(1);
    multigrid_.apply(residual_, preconditioned_);
    double rz = dot(residual_, preconditioned_);
    const double target = tolerance_ * tolerance_ * rz;
    float share = 0;
    for (int step = 0; rz > target; ++step) {
      turn(share);
      const double curvature = multiply(system);
      if (step == kMostSteps || !(curvature > 0)) return false;
      advance(static_cast<float>(rz / curvature));
      if (step == kSlow) multigrid_.set_sweeps(2);
      multigrid_.apply(residual_, preconditioned_);
      const double next = dot(residual_, preconditioned_);
      share =
          step == kSlow ? 0 : static_cast<float>(next / rz);  // another preconditioner: directions start anew
      rz = next;
    }
    if (!std::isfinite(rz)) return false;
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
  StencilGrid stencil_;  ///< with second differences: the system without them
  SecondDifferences curvature_;
  VectorXf residual_, solution_, preconditioned_, direction_, product_;
  std::unique_ptr<DepthSolver> exact_;
  std::unique_ptr<DepthSystem> last_;
  bool exact_has_last_ = false;
};

}  // namespace

std::unique_ptr<DepthSolver> make_multigrid_depth_solver(const PixelGrid& grid, const DepthCells& cells,
                                                         double tolerance) {
  return std::make_unique<MultigridDepthSolver>(grid, cells, tolerance);
}

}  // namespace rakelight
