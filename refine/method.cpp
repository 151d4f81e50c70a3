// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/method.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "refine/kernels/depth_kernels.h"
#include "refine/pixel_blocks.h"

namespace rakelight {

SurfaceState initial_state(const RefineProblem& problem, const RefineOptions& options) {
  SurfaceState state;
  state.zeta = problem.prior.start;
  state.points = surface_points(problem.grid, state.zeta);
  state.scene = {state.points.rowwise().mean(), static_cast<float>(options.lamps.lobe_exponent)};
  state.albedo = Eigen::Matrix3Xf::Ones(3, problem.grid.size());
  state.harmonics = options.lamps.harmonics;
  state.attached_shadows = options.trust.attached_shadows && options.lamps.harmonics == 1;
  return state;
}

double rms_change_mm(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  const double sum = sum_over_blocks(static_cast<int>(before.size()), 0.0, [&](int begin, int end) {
    return kernels::squared_depth_change(before.data() + begin, after.data() + begin, end - begin);
  });
  return 1e3 * std::sqrt(sum / static_cast<double>(before.size()));
}

double typical_change_mm(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  constexpr Eigen::Index kSamples = 5000;  // good to two percent
  const Eigen::Index step = std::max<Eigen::Index>(1, before.size() / kSamples);
  std::vector<double> changes;
  for (Eigen::Index p = 0; p < before.size(); p += step)
    changes.push_back(std::abs(std::exp(after[p]) - std::exp(before[p])));
  if (changes.empty()) return 0;
  const auto middle = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
  std::nth_element(changes.begin(), middle, changes.end());
  return 1e3 * 1.4826 * *middle;
}

}  // namespace rakelight
