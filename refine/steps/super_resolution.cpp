// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/super_resolution.h"

#include <numeric>

#include "refine/pixel_blocks.h"
#include "refine/solver/placement.h"

namespace rakelight {

DepthCells make_cells(const PixelGrid& grid, int scale) {
  DepthCells cells;
  cells.cell_of.resize(static_cast<size_t>(grid.size()));
  cv::Mat1i number((grid.index.rows + scale - 1) / scale, (grid.index.cols + scale - 1) / scale, -1);
  for (int p = 0; p < grid.size(); ++p) {
    const cv::Point at = grid.pixels[static_cast<size_t>(p)];
    int& cell = number(at.y / scale, at.x / scale);
    if (cell < 0) {
      cell = cells.size();
      cells.first.push_back(0);
    }
    cells.cell_of[static_cast<size_t>(p)] = cell;
  }
  for (const int cell : cells.cell_of) ++cells.first[static_cast<size_t>(cell) + 1];
  std::partial_sum(cells.first.begin(), cells.first.end(), cells.first.begin());
  cells.pixels.resize(cells.cell_of.size());
  std::vector<int> next(cells.first);
  for (int p = 0; p < grid.size(); ++p)
    cells.pixels[static_cast<size_t>(next[static_cast<size_t>(cells.cell_of[static_cast<size_t>(p)])]++)] = p;
  return cells;
}

std::vector<cv::Point> cell_positions(const PixelGrid& grid, const DepthCells& cells, int scale) {
  std::vector<cv::Point> positions;
  positions.reserve(static_cast<size_t>(cells.size()));
  for (int cell = 0; cell < cells.size(); ++cell) {
    const cv::Point at = grid.pixels[static_cast<size_t>(*cells.of(cell).begin())];
    positions.emplace_back(at.x / scale, at.y / scale);
  }
  return positions;
}

Eigen::VectorXd cell_means(const DepthCells& cells, const Eigen::VectorXd& zeta) {
  Eigen::VectorXd means(cells.size());
  const bool one_pixel_each = cells.size() == static_cast<int>(zeta.size());  // and in their order
  for_each_block(cells.size(), [&](int begin, int end) {
    if (one_pixel_each) {
      means.segment(begin, end - begin) = zeta.segment(begin, end - begin);
      return;
    }
    for (int cell = begin; cell < end; ++cell) {
      double sum = 0;
      for (const int p : cells.of(cell)) sum += zeta[p];
      means[cell] = sum / static_cast<double>(cells.of(cell).size());
    }
  });
  return means;
}

PriorTerm::PriorTerm(const DepthPrior& prior, const Eigen::VectorXd& zeta)
    : prior_(prior), zeta_(zeta), single_cells_(prior.cells.size() == static_cast<int>(zeta.size())) {
  if (single_cells_) return;
  const DepthCells& cells = prior.cells;
  const Eigen::VectorXd means = cell_means(cells, zeta);
  cell_pull_.resize(cells.size());
  cell_share_.resize(cells.size());
  shared_energy_ = sum_over_blocks(cells.size(), 0.0, [&](int begin, int end) {
    double energy = 0;
    for (int cell = begin; cell < end; ++cell) {
      const double weight = prior.cell_weight[cell], miss = prior.cell_target[cell] - means[cell];
      cell_share_[cell] = weight / static_cast<double>(cells.of(cell).size());
      cell_pull_[cell] = cell_share_[cell] * miss;
      energy += weight * miss * miss;
    }
    return energy;
  });
}

double PriorTerm::energy(int first, int count) const {
  return kernels::prior_energy(run(first), single_cells_, count);
}

double PriorTerm::add(int first, int count, float* diagonal, float* rhs) const {
  if (!single_cells_) {
    for (int k = 0; k < count; ++k) {
      const int cell = prior_.cells.cell_of[static_cast<size_t>(first + k)];
      diagonal[k] += static_cast<float>(cell_share_[cell]);
      rhs[k] += static_cast<float>(cell_pull_[cell]);
    }
  }
  return kernels::add_prior(run(first), single_cells_, count, diagonal, rhs);
}

kernels::PriorRun PriorTerm::run(int first) const {
  const double* of_cells[2] = {nullptr, nullptr};
  if (single_cells_) {  // cells are numbered as their pixels
    of_cells[0] = prior_.cell_target.data() + first;
    of_cells[1] = prior_.cell_weight.data() + first;
  }
  return {zeta_.data() + first, prior_.start.data() + first, of_cells[0], of_cells[1], prior_.floor};
}

double prior_energy(const DepthPrior& prior, const Eigen::VectorXd& zeta) {
  const PriorTerm term(prior, zeta);
  return term.shared_energy() + sum_over_blocks(static_cast<int>(zeta.size()), 0.0, [&](int begin, int end) {
           return term.energy(begin, end - begin);
         });
}

void add_prior(const PixelGrid& grid, const DepthPrior& prior, const Eigen::VectorXd& zeta,
               DepthSystem& system) {
  system.cell_weight = prior.cell_weight;
  const PriorTerm term(prior, zeta);
  const Placement placement(grid);
  for (const PixelRun& run : grid.runs) {
    const Eigen::Index i = placement.place(run.first);
    term.add(run.first, run.count, system.stencil.diagonal.data() + i, system.rhs.data() + i);
  }
}

}  // namespace rakelight
