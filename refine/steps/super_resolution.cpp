// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/super_resolution.h"

namespace rakelight {

DepthCells make_cells(const PixelGrid& grid, int scale) {
  DepthCells cells;
  cells.cell_of.resize(static_cast<size_t>(grid.size()));
  cv::Mat1i number((grid.index.rows + scale - 1) / scale, (grid.index.cols + scale - 1) / scale, -1);
  for (int p = 0; p < grid.size(); ++p) {
    const cv::Point at = grid.pixels[static_cast<size_t>(p)];
    int& cell = number(at.y / scale, at.x / scale);
    if (cell < 0) {
      cell = static_cast<int>(cells.pixels_of.size());
      cells.pixels_of.emplace_back();
    }
    cells.cell_of[static_cast<size_t>(p)] = cell;
    cells.pixels_of[static_cast<size_t>(cell)].push_back(p);
  }
  return cells;
}

std::vector<cv::Point> cell_positions(const PixelGrid& grid, const DepthCells& cells, int scale) {
  std::vector<cv::Point> positions;
  positions.reserve(cells.pixels_of.size());
  for (const auto& pixels : cells.pixels_of) {
    const cv::Point at = grid.pixels[static_cast<size_t>(pixels.front())];
    positions.emplace_back(at.x / scale, at.y / scale);
  }
  return positions;
}

Eigen::VectorXd cell_means(const DepthCells& cells, const Eigen::VectorXd& zeta) {
  Eigen::VectorXd means = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(cells.pixels_of.size()));
  for (Eigen::Index cell = 0; cell < means.size(); ++cell) {
    const auto& pixels = cells.pixels_of[static_cast<size_t>(cell)];
    for (const int p : pixels) means[cell] += zeta[p];
    means[cell] /= static_cast<double>(pixels.size());
  }
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
  for (int p = 0; p < static_cast<int>(zeta.size()); ++p) {
    const int cell = prior.cells.cell_of[static_cast<size_t>(p)];
    const auto count = static_cast<double>(prior.cells.pixels_of[static_cast<size_t>(cell)].size());
    system.diagonal[static_cast<size_t>(p)] += prior.floor;
    system.rhs[p] += pull[cell] / count + prior.floor * (prior.start[p] - zeta[p]);
  }
}

}  // namespace rakelight
