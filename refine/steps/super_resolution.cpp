// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/super_resolution.h"

#include <numeric>

#include "refine/pixel_blocks.h"

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

double prior_energy(const DepthPrior& prior, const Eigen::VectorXd& zeta) {
  const Eigen::VectorXd means = cell_means(prior.cells, zeta);
  const double of_cells = sum_over_blocks(prior.cells.size(), 0.0, [&](int begin, int end) {
    const auto of = [&](const Eigen::VectorXd& v) { return v.segment(begin, end - begin).array(); };
    return (of(prior.cell_weight) * (of(means) - of(prior.cell_target)).square()).sum();
  });
  const double of_pixels = sum_over_blocks(static_cast<int>(zeta.size()), 0.0, [&](int begin, int end) {
    return (zeta.segment(begin, end - begin) - prior.start.segment(begin, end - begin)).squaredNorm();
  });
  return of_cells + prior.floor * of_pixels;
}

void add_prior(const DepthPrior& prior, const Eigen::VectorXd& zeta, DepthSystem& system) {
  system.cell_weight = prior.cell_weight;
  const Eigen::VectorXd pull =
      prior.cell_weight.cwiseProduct(prior.cell_target - cell_means(prior.cells, zeta));
  for_each_block(static_cast<int>(zeta.size()), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const int cell = prior.cells.cell_of[static_cast<size_t>(p)];
      system.diagonal[static_cast<size_t>(p)] += static_cast<float>(prior.floor);
      system.rhs[p] += pull[cell] / static_cast<double>(prior.cells.of(cell).size()) +
                       prior.floor * (prior.start[p] - zeta[p]);
    }
  });
}

}  // namespace rakelight
