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
  for_each_block(cells.size(), [&](int begin, int end) {
    for (int cell = begin; cell < end; ++cell) {
      double sum = 0;
      for (const int p : cells.of(cell)) sum += zeta[p];
      means[cell] = sum / static_cast<double>(cells.of(cell).size());
    }
  });
  return means;
}

double prior_energy(const DepthPrior& prior, const Eigen::VectorXd& zeta) {
  const Eigen::VectorXd miss = cell_means(prior.cells, zeta) - prior.cell_target;
  return prior.cell_weight.dot(miss.cwiseAbs2()) + prior.floor * (zeta - prior.start).squaredNorm();
}

void add_prior(const DepthPrior& prior, const Eigen::VectorXd& zeta, DepthSystem& system) {
  system.cell_weight = prior.cell_weight;
  const Eigen::VectorXd pull =
      prior.cell_weight.cwiseProduct(prior.cell_target - cell_means(prior.cells, zeta));
  for_each_block(static_cast<int>(zeta.size()), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const int cell = prior.cells.cell_of[static_cast<size_t>(p)];
      system.diagonal[static_cast<size_t>(p)] += static_cast<float>(prior.floor);
      system.rhs[p] +=
          pull[cell] / static_cast<double>(prior.cells.of(cell).size()) + prior.floor * (prior.start[p] - zeta[p]);
    }
  });
}

}  // namespace rakelight
