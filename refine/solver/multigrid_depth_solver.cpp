// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <stdexcept>

#include "refine/pixel_blocks.h"
#include "refine/solver/depth_solver.h"
#include "refine/solver/multigrid.h"

namespace rakelight {
namespace {

using Eigen::VectorXf;

constexpr int kMostSteps =
    200;  // 5 to 20 without second differences; what needs more is left to the exact solver

class MultigridDepthSolver final : public DepthSolver {
 public:
  MultigridDepthSolver(const PixelGrid& grid, const DepthCells& cells, double tolerance)
      : grid_(grid),
        cells_(cells),
        tolerance_(tolerance),
        box_(bounding_box(grid)),
        single_cells_(cells.pixels_of.size() == cells.cell_of.size()),
        exact_(make_cholesky_depth_solver(grid, cells)) {
    const StencilGrid layout(box_.width, box_.height);
    inside_.assign(static_cast<size_t>(layout.size()), 0);
    for (const cv::Point& at : grid.pixels) {
      place_.push_back(layout.at(at.x - box_.x, at.y - box_.y));
      inside_[static_cast<size_t>(place_.back())] = 1;
    }
  }

  bool solve(const DepthSystem& system, Eigen::VectorXd& x) override {
    last_ = std::make_unique<DepthSystem>(system);
    exact_has_last_ = false;
    const bool curved = !system.curvature.empty();
    if (curved) curvature_ = scattered(system.curvature);
    stencil_ = curved ? stencil_of(system) : StencilGrid();
    set_up_ = multigrid_.setup(curved ? bounded_by_slopes(stencil_, curvature_) : stencil_of(system));
    return solve_again(system.rhs, x);
  }

  bool solve_again(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) override {
    if (last_ == nullptr) throw std::logic_error("solve_again() needs a system solved before");
    if (exact_has_last_) return exact_->solve_again(rhs, x);
    if (set_up_ && conjugate_gradients(*last_, rhs, x)) return true;
    last_->rhs = rhs;
    return exact_has_last_ = exact_->solve(*last_, x);
  }

 private:
  static cv::Rect bounding_box(const PixelGrid& grid) {
    int left = grid.index.cols, right = -1;
    for (const cv::Point& at : grid.pixels) {
      left = std::min(left, at.x);
      right = std::max(right, at.x);
    }
    const int top = grid.pixels.front().y, bottom = grid.pixels.back().y;
    return {left, top, right - left + 1, bottom - top + 1};
  }

  /// The system's stencil; the sensor's K' Lambda K lumped on the diagonal (exact for cells of one pixel).
  StencilGrid stencil_of(const DepthSystem& system) const {
    StencilGrid A(box_.width, box_.height);
    for_each_block(grid_.size(), [&](int begin, int end) {
      for (int p = begin; p < end; ++p) {
        const auto i = static_cast<size_t>(p);
        const Eigen::Index at = place_[i];
        const auto cell = static_cast<size_t>(cells_.cell_of[i]);
        const double lumped =
            system.cell_weight[cells_.cell_of[i]] / static_cast<double>(cells_.pixels_of[cell].size());
        A.diagonal[at] = static_cast<float>(system.diagonal[i] + lumped);
        const auto couple = [&](Eigen::VectorXf& entries, int dx, int dy, double value) {
          if (inside_[static_cast<size_t>(at + dy * A.stride() + dx)])
            entries[at] = static_cast<float>(value);
        };
        couple(A.right, 1, 0, system.right[i]);
        couple(A.down, 0, 1, system.down[i]);
        couple(A.down_right, 1, 1, system.down_right[i]);
        couple(A.down_left, -1, 1, system.down_left[i]);
      }
    });
    return A;
  }

  /// Weights of second differences, [place].
  struct PlacedCurvature {
    VectorXf across, down;
  };

  PlacedCurvature scattered(const CurvatureWeights& weights) const {
    const auto size = static_cast<Eigen::Index>(inside_.size());
    PlacedCurvature placed{VectorXf::Zero(size), VectorXf::Zero(size)};
    for (int p = 0; p < grid_.size(); ++p) {
      const Eigen::Index at = place_[static_cast<size_t>(p)];
      placed.across[at] = static_cast<float>(weights.across[p]);
      placed.down[at] = static_cast<float>(weights.down[p]);
    }
    return placed;
  }

  /// A 9-point stencil that the one with second differences cannot exceed: (b - a)^2 <= 2 a^2 + 2 b^2, for the
  /// preconditioner.
  static StencilGrid bounded_by_slopes(StencilGrid A, const PlacedCurvature& curvature) {
    const auto add = [&](VectorXf& entries, const VectorXf& weights, Eigen::Index i, Eigen::Index step) {
      const float w = 2 * (weights[i] + weights[i + step]);
      if (w == 0.0f || A.diagonal[i] == 0.0f || A.diagonal[i + step] == 0.0f) return;
      entries[i] -= w;
      A.diagonal[i] += w;
      A.diagonal[i + step] += w;
    };
    for (Eigen::Index i = A.stride(); i < A.size() - A.stride(); ++i) {
      add(A.right, curvature.across, i, 1);
      add(A.down, curvature.down, i, A.stride());
    }
    return A;
  }

  /// y += C x
  void add_curvature(const VectorXf& x, VectorXf& y) {
    const auto stride = static_cast<int>(stencil_.stride()), size = static_cast<int>(stencil_.size());
    across_.resize(size);
    down_.resize(size);
    const auto inner = [&](int begin, int end, const auto& body) {
      begin = std::max(begin, stride);
      end = std::min(end, size - stride);
      if (begin < end) body(begin, end - begin);
    };
    const auto difference = [&](const VectorXf& v, int at, int count, int step) {
      return v.segment(at - step, count) - 2.0f * v.segment(at, count) + v.segment(at + step, count);
    };
    across_.head(stride).setZero();
    across_.tail(stride).setZero();
    down_.head(stride).setZero();
    down_.tail(stride).setZero();
    for_each_block(size, [&](int begin, int end) {
      inner(begin, end, [&](int at, int count) {
        across_.segment(at, count) =
            curvature_.across.segment(at, count).cwiseProduct(difference(x, at, count, 1));
        down_.segment(at, count) =
            curvature_.down.segment(at, count).cwiseProduct(difference(x, at, count, stride));
      });
    });
    for_each_block(size, [&](int begin, int end) {
      inner(begin, end, [&](int at, int count) {
        y.segment(at, count) += difference(across_, at, count, 1) + difference(down_, at, count, stride);
      });
    });
  }

  /// y = A x with the exact K' Lambda K: the stencil's product, and each cell's own block instead of its lumped sum.
  void multiply(const DepthSystem& system, const VectorXf& x, VectorXf& y) {
    if (system.curvature.empty()) {
      multigrid_.finest().multiply(x, y);
    } else {
      stencil_.multiply(x, y);
      add_curvature(x, y);
    }
    if (single_cells_) return;
    const int cells = static_cast<int>(cells_.pixels_of.size());
    for_each_block(cells, [&](int begin, int end) {
      for (int cell = begin; cell < end; ++cell) {
        const auto& pixels = cells_.pixels_of[static_cast<size_t>(cell)];
        const auto count = static_cast<float>(pixels.size());
        const auto weight = static_cast<float>(system.cell_weight[cell]);
        float mean = 0;
        for (const int p : pixels) mean += x[place_[static_cast<size_t>(p)]];
        mean /= count;
        for (const int p : pixels) {
          const Eigen::Index at = place_[static_cast<size_t>(p)];
          y[at] += weight / count * (mean - x[at]);
        }
      }
    });
  }

  /// Sum in double over rows, in their order.
  double dot(const VectorXf& a, const VectorXf& b) const {
    const StencilGrid& A = multigrid_.finest();
    return sum_over_blocks(static_cast<int>(A.size()), 0.0, [&](int begin, int end) {
      return a.segment(begin, end - begin).cast<double>().dot(b.segment(begin, end - begin).cast<double>());
    });
  }

  /// @return false, x untouched, when it does not converge.
  bool conjugate_gradients(const DepthSystem& system, const Eigen::VectorXd& rhs, Eigen::VectorXd& x) {
    const Eigen::Index size = multigrid_.finest().size();
    VectorXf solution = VectorXf::Zero(size), residual = solution, z, Ad;
    // The right-hand side is scaled to 1: a float's range then never matters.
    const double scale = rhs.cwiseAbs().maxCoeff();
    if (!std::isfinite(scale)) return false;
    for (int p = 0; p < grid_.size() && scale > 0; ++p)
      residual[place_[static_cast<size_t>(p)]] = static_cast<float>(rhs[p] / scale);
    multigrid_.apply(residual, z);
    VectorXf direction = z;
    double rz = dot(residual, z);
    const double target = tolerance_ * tolerance_ * rz;
    for (int step = 0; rz > target; ++step) {
      multiply(system, direction, Ad);
      const double curvature = dot(direction, Ad);
      if (step == kMostSteps || !(curvature > 0)) return false;
      const auto length = static_cast<float>(rz / curvature);
      solution += length * direction;
      residual -= length * Ad;
      multigrid_.apply(residual, z);
      const double next = dot(residual, z);
      direction = z + static_cast<float>(next / rz) * direction;
      rz = next;
    }
    if (!std::isfinite(rz)) return false;
    x.resize(grid_.size());
    for (int p = 0; p < grid_.size(); ++p)
      x[p] = scale * static_cast<double>(solution[place_[static_cast<size_t>(p)]]);
    return true;
  }

  const PixelGrid& grid_;
  const DepthCells& cells_;
  double tolerance_;
  cv::Rect box_;
  std::vector<Eigen::Index> place_;    ///< [pixel] in the box's vectors
  std::vector<unsigned char> inside_;  ///< [place] 1 in the mask
  bool single_cells_;                  ///< a cell is a pixel: lumped is exact
  Multigrid multigrid_;
  bool set_up_ = false;  ///< the last system has a preconditioner
  StencilGrid stencil_;  ///< with second differences: the system without them
  PlacedCurvature curvature_;
  VectorXf across_, down_;  ///< weighted second differences of a product's argument
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
