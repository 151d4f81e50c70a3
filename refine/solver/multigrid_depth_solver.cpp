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
    200;  // 2 to 20 without second differences; what needs more is left to the exact solver
// A step may be counted on where the last one made the squared residual fall below the first share, and to repeat that but
// for the second factor: rates grow from step to step as smooth parts are left.
constexpr double kSteady = 0.03, kDoubt = 10;
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
        preconditioned_(residual_),
        product_(residual_),
        solution_(residual_),
        direction_(residual_),
        image_(residual_) {
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

  /// The stencil is all there is to the system.
  bool whole_matrix() const { return single_cells_ && curvature_.empty(); }

  /// Preconditions the residual, and multiplies by the system with the exact K' Lambda K.
  Products precondition_and_multiply() {
    Products products = multigrid_.apply(residual_, preconditioned_, product_);
    if (whole_matrix()) return products;
    if (!curvature_.empty()) {
      last_->stencil.multiply(preconditioned_, product_);
      curvature_.add_product(last_->stencil, preconditioned_, product_);
    }
    if (!single_cells_) replace_lumped_cells();
    products.xAx = dot(preconditioned_, product_);
    return products;
  }

  /// Each cell's own block of K' Lambda K instead of its lumped sum.
  void replace_lumped_cells() {
    for_each_block(cells_.size(), [&](int begin, int end) {
      for (int cell = begin; cell < end; ++cell) {
        const auto first = static_cast<size_t>(cells_.first[static_cast<size_t>(cell)]);
        const size_t count = cells_.of(cell).size();
        const int* places = cell_places_.data() + first;
        float mean = 0;
        for (size_t k = 0; k < count; ++k) mean += preconditioned_[places[k]];
        const auto size = static_cast<float>(count);
        const float share = static_cast<float>(last_->cell_weight[cell]) / size;
        for (size_t k = 0; k < count; ++k)
          product_[places[k]] += share * (mean / size - preconditioned_[places[k]]);
      }
    });
  }

  double dot(const VectorXf& a, const VectorXf& b) const {
    const GridLayout& rows = placement_.layout();
    return sum_over_rows(rows, [&](int y) {
      return kernels::dot_row(a.data() + rows.at(0, y), b.data() + rows.at(0, y), rows.width);
    });
  }

  template <class Body>
  void for_placed_rows(const Body& body) const {
    const GridLayout& rows = placement_.layout();
    for_rows(rows, [&](int y) { body(rows.at(0, y), rows.width); });
  }

  /// Solves for the residual, of size 1, times scale: preconditioned conjugate gradients in the form of Chronopoulos and Gear,
  /// where only preconditioned vectors are multiplied, each while it is in the cache:
  ///   p' = z + share p,  q' = A p' = A z + share q,  p' q' = z' A z - share^2 p q.
  /// Where the preconditioner is made of the very matrix and they converge fast, the last step, which by the rate so far reaches
  /// the tolerance, is taken without looking at its result. Elsewhere smooth parts fall fast at first, and others slowly.
  /// @return false, x untouched, when it does not converge
  bool conjugate_gradients(double scale, Eigen::VectorXd& x) {
    if (!std::isfinite(scale)) return false;
    multigrid_.set_sweeps(1);
    double target = 0, rz_before = 0, pq = 0;
    float last = 0;  // length of the step before
    for (int step = 0; step <= kMostSteps; ++step) {
      const Products at = precondition_and_multiply();
      const double rz = at.bx;
      if (step == 0) target = tolerance_ * tolerance_ * rz;
      if (!std::isfinite(rz)) return false;
      if (rz <= target) return finish(step, last, 0, scale, x);
      const bool anew = step == 0 || step == kSlow + 1;  // another preconditioner
      const double share = anew ? 0 : rz / rz_before;
      pq = at.xAx - share * share * pq;
      if (!(pq > 0)) return false;
      const auto length = static_cast<float>(rz / pq), turned = static_cast<float>(share);
      if (!anew && whole_matrix() && share < kSteady && kDoubt * rz * share <= target)
        return finish(step, last + length * turned, length, scale, x);
      if (step == 0)
        begin(length);
      else
        proceed(step, last, turned, length);
      if (step == kSlow) multigrid_.set_sweeps(2);
      last = length;
      rz_before = rz;
    }
    return false;
  }

  /// The first step's vectors.
  void begin(float length) {
    direction_.swap(preconditioned_);
    image_.swap(product_);
    for_placed_rows([&](Eigen::Index i, int width) {
      kernels::shorten_row(image_.data() + i, length, width, residual_.data() + i);
    });
  }

  /// Those of any other.
  void proceed(int step, float last, float share, float length) {
    if (step == 1) solution_.setZero();
    for_placed_rows([&](Eigen::Index i, int width) {
      kernels::step_row({preconditioned_.data() + i, product_.data() + i, solution_.data() + i,
                         direction_.data() + i, image_.data() + i, residual_.data() + i},
                        last, share, length, width);
    });
  }

  /// x = scale (solution + along direction + aside preconditioned)
  bool finish(int step, float along, float aside, double scale, Eigen::VectorXd& x) const {
    if (step == 0) {
      x = Eigen::VectorXd::Zero(grid_.size());
    } else {
      placement_.gather(
          [&](Eigen::Index i) {
            const float moved = along * direction_[i] + aside * preconditioned_[i];
            return scale * static_cast<double>(step == 1 ? moved : solution_[i] + moved);
          },
          x);
    }
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
  VectorXf residual_, preconditioned_, product_;  ///< r, z, A z
  VectorXf solution_, direction_, image_;         ///< x, p, A p
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
