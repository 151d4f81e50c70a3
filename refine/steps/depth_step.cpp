// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/depth_step.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace rakelight {
namespace {

kernels::TensorRun tensor_run(const PhotometricTensors& tensors, const PixelRun& run) {
  kernels::TensorRun parts;
  for (size_t k = 0; k < PhotometricTensors::kParts; ++k)
    parts.part[k] = tensors.part(static_cast<PhotometricTensors::Part>(k)) + run.first;
  return parts;
}

const float* weights_of(const CornerWeights& weights, const PixelRun& run) {
  return weights[static_cast<size_t>(run.first)].data();
}

/// Median energy over the corners of a fixed choice of rows, enough for one good to a percent.
float median_energy(const PixelGrid& grid, const ZetaImage& image, const CornerList& corners,
                    const PhotometricTensors& tensors) {
  constexpr int kSamples = 20000;  // pixels
  const int step = std::max(1, grid.size() / kSamples);
  std::vector<float> energies, row(static_cast<size_t>(kCorners * grid.box.width));
  for (int y = 0; y < grid.box.height; y += step) {
    for_each_run(grid, y, [&](const PixelRun& run) {
      kernels::corner_energies(image.run(corners, y, run), tensor_run(tensors, run), row.data());
      for (int k = 0; k < kCorners * run.count; ++k)
        if (corners.has(run.first + k / kCorners, k % kCorners))
          energies.push_back(row[static_cast<size_t>(k)]);
    });
  }
  if (energies.empty()) return 0;
  const auto middle = energies.begin() + static_cast<std::ptrdiff_t>(energies.size() / 2);
  std::nth_element(energies.begin(), middle, energies.end());
  return *middle;
}

/// The equations of three rows in turn: what the systems' rows are gathered from.
class EquationRows {
 public:
  explicit EquationRows(const PixelGrid& grid)
      : left_(grid.box.x),
        stride_(static_cast<size_t>(grid.box.width + 2 + kVectorPadding)),
        values_(3 * kParts * stride_) {}

  /// The box's row y, from column x on.
  kernels::EquationRow row(int y, int x) {
    const size_t slot = static_cast<size_t>((y + 3) % 3);
    float* begin = values_.data() + slot * kParts * stride_ + static_cast<size_t>(x - left_ + 1);
    const auto part = [&](size_t k) { return begin + k * stride_; };
    return {{part(0), part(1)},
            {part(2), part(3)},
            {part(4), part(5)},
            {part(6), part(7)},
            {part(8), part(9), part(10), part(11)}};
  }

  /// Zeros in the columns [begin, end) of row y: there are no pixels.
  void clear(int y, int begin, int end) {
    const kernels::EquationRow at = row(y, begin);
    for (float* part : {at.xx[0], at.xx[1], at.yy[0], at.yy[1], at.bx[0], at.bx[1], at.by[0], at.by[1],
                        at.xy[0], at.xy[1], at.xy[2], at.xy[3]})
      std::fill_n(part, end - begin, 0.0f);
  }

 private:
  static constexpr size_t kParts = 12;
  int left_;
  size_t stride_;
  std::vector<float> values_;
};

/// Sum over the runs of body(y, run), a double each, in the order that Assembly has.
template <class Body>
double sum_over_strips(const PixelGrid& grid, const Body& body) {
  std::vector<double> sums(static_cast<size_t>(grid.box.height / kRowStrip + 1), 0.0);
  for_each_strip(
      grid, [&](int begin, int end) { sums[static_cast<size_t>(begin / kRowStrip)] = body(begin, end); });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// Fills a system, strip by strip; a strip computes the rows beside it once more.
class Assembly {
 public:
  Assembly(const DepthProblem& problem, const Eigen::VectorXd& zeta, Linearization linearization,
           DepthSystem& system)
      : problem_(problem),
        image_(problem.grid, zeta),
        prior_(problem.prior, zeta),
        turning_(linearization == Linearization::gauss_newton),
        system_(system) {}

  /// @return the energy of the images and the prior
  double run() const {
    return prior_.shared_energy() +
           sum_over_strips(problem_.grid, [&](int begin, int end) { return fill_rows(begin, end); });
  }

 private:
  double fill_rows(int begin, int end) const {
    EquationRows equations(problem_.grid);
    compute_row(begin - 1, equations);
    double of_row = compute_row(begin, equations), energy = 0;
    for (int y = begin; y < end; ++y) {
      const double of_next = compute_row(y + 1, equations);
      energy += of_row + gather_row(y, equations);
      of_row = of_next;
    }
    return energy;
  }

  double compute_row(int y, EquationRows& equations) const {
    const cv::Rect box = problem_.grid.box;
    double energy = 0;
    int cleared = box.x - 1;
    if (y >= 0 && y < box.height) {
      for_each_run(problem_.grid, y, [&](const PixelRun& run) {
        equations.clear(y, cleared, run.x);  // what the run before may have written past its end, too
        energy += static_cast<double>(kernels::corner_equations(
            image_.run(problem_.corners, y, run), tensor_run(problem_.tensors, run),
            weights_of(problem_.corner_weight, run), turning_, equations.row(y, run.x)));
        cleared = run.x + run.count;
      });
    }
    equations.clear(y, cleared, box.x + box.width + 1);
    return energy;
  }

  double gather_row(int y, EquationRows& equations) const {
    double energy = 0;
    for_each_run(problem_.grid, y, [&](const PixelRun& run) {
      const int x = run.x - problem_.grid.box.x;
      const kernels::EntryRow entries = system_.stencil.entries(x, y);
      float* rhs = system_.rhs.data() + system_.stencil.at(x, y);
      kernels::gather_equations(equations.row(y - 1, run.x), equations.row(y, run.x),
                                equations.row(y + 1, run.x), run.count, entries, rhs);
      energy += prior_.add(run.first, run.count, entries.diagonal, rhs);
    });
    return energy;
  }

  const DepthProblem& problem_;
  ZetaImage image_;
  PriorTerm prior_;
  bool turning_;
  DepthSystem& system_;
};

}  // namespace

CornerWeights corner_weights(const PixelGrid& grid, const CornerList& corners,
                             const PhotometricTensors& tensors, const Eigen::VectorXd& zeta,
                             double edge_weight) {
  CornerWeights weights(static_cast<size_t>(grid.size()));
  const ZetaImage image(grid, zeta);
  const float half =
      edge_weight > 0 ? static_cast<float>(edge_weight) * median_energy(grid, image, corners, tensors) : 0;
  for_each_run(grid, [&](int y, const PixelRun& run) {
    kernels::corner_weights(image.run(corners, y, run), tensor_run(tensors, run),
                            corners.weight.data() + run.first,
                            half > 0 ? half : std::numeric_limits<float>::infinity(),
                            weights[static_cast<size_t>(run.first)].data());
  });
  return weights;
}

double depth_energy(const DepthProblem& problem, const Eigen::VectorXd& zeta) {
  const ZetaImage image(problem.grid, zeta);
  const PriorTerm prior(problem.prior, zeta);
  const auto of_row = [&](int y) {
    double photometric = 0, of_prior = 0;
    for_each_run(problem.grid, y, [&](const PixelRun& run) {
      photometric += static_cast<double>(kernels::weighted_energy(image.run(problem.corners, y, run),
                                                                  tensor_run(problem.tensors, run),
                                                                  weights_of(problem.corner_weight, run)));
      of_prior += prior.energy(run.first, run.count);
    });
    return photometric + of_prior;
  };
  const double energy = prior.shared_energy() + sum_over_strips(problem.grid, [&](int begin, int end) {
                          double sum = 0;
                          for (int y = begin; y < end; ++y) sum += of_row(y);
                          return sum;
                        });
  return problem.curvature.empty() ? energy
                                   : energy + curvature_energy(problem.grid, problem.curvature, zeta);
}

double fill_depth_system(const DepthProblem& problem, const Eigen::VectorXd& zeta,
                         Linearization linearization, DepthSystem& system) {
  const double energy = Assembly(problem, zeta, linearization, system).run();
  system.cell_weight = problem.prior.cell_weight;
  system.curvature = {};
  if (problem.curvature.empty()) return energy;
  add_curvature(problem.grid, problem.curvature, zeta, system);
  return energy + curvature_energy(problem.grid, problem.curvature, zeta);
}

DepthSystem depth_system(const DepthProblem& problem, const Eigen::VectorXd& zeta,
                         Linearization linearization) {
  DepthSystem system(problem.grid);
  fill_depth_system(problem, zeta, linearization, system);
  return system;
}

DepthStepReport depth_step(const DepthProblem& problem, const DepthOptions& options, DepthSolver& solver,
                           Eigen::VectorXd& zeta) {
  DepthStepReport report;
  DepthSystem system = solver.reuse_system();
  report.energy_before = report.energy_after =
      fill_depth_system(problem, zeta, options.linearization, system);
  Eigen::VectorXd step;
  report.solved = solver.solve(std::move(system), step);
  if (!report.solved) return report;
  Eigen::VectorXd candidate;
  for (double length = 1; report.backtracks <= options.max_backtracks; length /= 2, ++report.backtracks) {
    candidate = zeta + length * step;
    report.energy_after = depth_energy(problem, candidate);
    if (report.energy_after <= report.energy_before || options.max_backtracks == 0) {
      zeta.swap(candidate);
      return report;
    }
  }
  report.energy_after = report.energy_before;
  return report;
}

}  // namespace rakelight
