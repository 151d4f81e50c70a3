// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/method.h"

#include <cmath>

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

}  // namespace rakelight
