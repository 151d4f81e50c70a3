// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/laplacian.h"

namespace rakelight {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

bool is_cut(const std::vector<unsigned char>& cuts, int p) {
  return !cuts.empty() && cuts[static_cast<size_t>(p)] != 0;
}

/// Second difference at p along one axis, if both neighbours can be reached.
void add_axis(const PixelGrid& grid, int p, Neighbor before, Neighbor after,
              const std::vector<unsigned char>& cuts, Triplets& entries) {
  const int a = grid.neighbor[before][static_cast<size_t>(p)],
            b = grid.neighbor[after][static_cast<size_t>(p)];
  if (a < 0 || b < 0 || is_cut(cuts, a) || is_cut(cuts, p)) return;
  entries.emplace_back(p, a, 1.0);
  entries.emplace_back(p, b, 1.0);
  entries.emplace_back(p, p, -2.0);
}

Eigen::SparseMatrix<double> matrix_of(const PixelGrid& grid, const Triplets& entries) {
  Eigen::SparseMatrix<double> matrix(grid.size(), grid.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

Eigen::SparseMatrix<double> second_differences(const PixelGrid& grid, Neighbor before, Neighbor after,
                                               const std::vector<unsigned char>& cuts) {
  Triplets entries;
  for (int p = 0; p < grid.size(); ++p) add_axis(grid, p, before, after, cuts, entries);
  return matrix_of(grid, entries);
}

Eigen::SparseMatrix<double> uncut_laplacian(const PixelGrid& grid) {
  Triplets entries;
  for (int p = 0; p < grid.size(); ++p) {
    for (const auto& neighbors : grid.neighbor) {
      const int q = neighbors[static_cast<size_t>(p)];
      if (q < 0) continue;
      entries.emplace_back(p, q, 1.0);
      entries.emplace_back(p, p, -1.0);
    }
  }
  return matrix_of(grid, entries);
}

}  // namespace rakelight
