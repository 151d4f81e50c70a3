// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/laplacian.h"

#include <vector>

namespace rakelight {
Eigen::SparseMatrix<double> uncut_laplacian(const PixelGrid& grid) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int p = 0; p < grid.size(); ++p) {
    for (const auto& neighbors : grid.neighbor) {
      const int q = neighbors[static_cast<size_t>(p)];
      if (q < 0) continue;
      entries.emplace_back(p, q, 1.0);
      entries.emplace_back(p, p, -1.0);
    }
  }
  Eigen::SparseMatrix<double> matrix(grid.size(), grid.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace rakelight
