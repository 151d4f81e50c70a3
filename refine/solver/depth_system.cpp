// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/depth_solver.h"
#include "refine/solver/placement.h"

namespace rakelight {

DepthSystem::DepthSystem(const PixelGrid& grid)
    : stencil(grid.box.width, grid.box.height), rhs(Eigen::VectorXf::Zero(stencil.size())) {}

void add_cell_weight(const PixelGrid& grid, const DepthCells& cells, const Eigen::VectorXd& cell_weight,
                     DepthSystem& system) {
  system.cell_weight = cell_weight;
  const Placement placement(grid);
  for_each_block(grid.size(), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const int cell = cells.cell_of[static_cast<size_t>(p)];
      system.stencil.diagonal[placement.place(p)] +=
          static_cast<float>(cell_weight[cell] / static_cast<double>(cells.of(cell).size()));
    }
  });
}

void add_curvature(const PixelGrid& grid, const CurvatureWeights& weights, const Eigen::VectorXd& zeta,
                   DepthSystem& system) {
  system.curvature = weights;
  Eigen::VectorXf pull = Eigen::VectorXf::Zero(system.rhs.size());
  Placement(grid).scatter(curvature_product(grid, weights, zeta), -1, pull);
  system.rhs += pull;
}

}  // namespace rakelight
