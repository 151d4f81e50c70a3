// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/rgb_ratio.h"

#include <cmath>

#include "refine/shading.h"
#include "refine/steps/albedo.h"
#include "refine/steps/laplacian.h"
#include "refine/steps/lighting.h"
#include "refine/steps/paper_albedo.h"
#include "refine/steps/paper_rows.h"

namespace rakelight {
namespace {

Eigen::VectorXd channel_of(const Observations& image, int c) {
  Eigen::VectorXd radiance(image.pixels);
  for (int p = 0; p < image.pixels; ++p) radiance[p] = static_cast<double>(image.channel(0, c)[p]);
  return radiance;
}

/// Shading of the image at a pixel, without attached shadows.
Eigen::Vector3f shading_at(const SurfaceState& state, int p) {
  const Eigen::Vector3f n = state.normals.col(p);
  return shading(light_at(state.lamps.front(), state.points.col(p), n, state.scene), n, false);
}

/// The last term of Eq. (17).
double photometric_energy(const Observations& image, const SurfaceState& state) {
  double sum = 0;
  for (int p = 0; p < image.pixels; ++p) {
    const Eigen::Vector3f S = shading_at(state, p);
    for (int c = 0; c < 3; ++c)
      sum += static_cast<double>(std::pow(state.albedo(c, p) * S[c] - image.channel(0, c)[p], 2.0f));
  }
  return sum;
}

/// Eq. (10) a channel, from lamps fitted with albedo 1. @return false when singular
bool start_albedo(const RefineProblem& problem, const RefineOptions& options, SurfaceState& state) {
  for (int c = 0; c < 3; ++c) {
    const Eigen::VectorXd I = channel_of(problem.images, c);
    Eigen::VectorXd S(problem.grid.size());
    for (int p = 0; p < problem.grid.size(); ++p) S[p] = static_cast<double>(shading_at(state, p)[c]);
    const auto W = anisotropic_laplacian(problem.grid, I, state.zeta.array().exp(), options.albedo);
    Eigen::VectorXd rho;
    if (!solve_albedo(S, I, W, options.albedo.smoothness, rho)) return false;
    state.albedo.row(c) = rho.cast<float>().transpose();
  }
  return true;
}

/// Eq. (20) a channel. @return false when singular
bool diffuse(const RefineProblem& problem, const AlbedoOptions& options, SurfaceState& state) {
  for (int c = 0; c < 3; ++c) {
    Eigen::VectorXd P = state.albedo.row(c).transpose().cast<double>();
    if (!diffuse_albedo(problem.grid, channel_of(problem.images, c), options.ratio_smoothness,
                        options.ratio_sigma, P))
      return false;
    state.albedo.row(c) = P.cast<float>().transpose();
  }
  return true;
}

MethodResult ratio_as_printed(const RefineProblem& problem, const RefineOptions& options,
                              const IterationCallback& after_iteration) {
  MethodResult result;
  result.state = initial_state(problem, options);
  SurfaceState state = result.state;
  state.normals = surface_normals(problem.grid, problem.corners, state.zeta);
  state.lamps = estimate_far_lamps(problem.images, state);  // Eq. (9)
  bool solved = start_albedo(problem, options, state);
  normalize_albedo(state);
  result.state = state;
  const Smoothness smoothness(uncut_laplacian(problem.grid), options.depth.smoothness);
  SparseCholesky solver;
  double best = 0;
  for (int t = 1; solved && t <= options.max_iterations; ++t) {
    IterationReport report;
    report.index = t;
    if (!(solved = diffuse(problem, options.albedo, state))) break;  // Eq. (20)
    normalize_albedo(state);
    GradientProblem depth{problem.grid,
                          problem.corners,
                          ratio_rows(problem.grid, problem.images, state),
                          options.depth.sensor_weight,
                          problem.prior.start,
                          smoothness};
    report.energy_before_depth =
        gradient_energy(depth, state.zeta) + photometric_energy(problem.images, state);
    const Eigen::VectorXd before = state.zeta;
    if (!(solved = solve_gradient_rows(depth, solver, state.zeta))) break;  // Eq. (24)
    state.normals = surface_normals(problem.grid, problem.corners, state.zeta);
    state.lamps = estimate_far_lamps(problem.images, state);  // Eq. (9)
    depth.rows = ratio_rows(problem.grid, problem.images, state);
    report.energy = gradient_energy(depth, state.zeta) + photometric_energy(problem.images, state);
    report.depth_change_mm = rms_change_mm(before, state.zeta);
    report.sensor_weight = options.depth.sensor_weight;
    result.iterations.push_back(report);
    after_iteration(t, static_cast<double>(t) / options.max_iterations, state.zeta);
    if (t > 1 && report.energy >= best) {
      result.termination = Termination::converged;
      result.message = "stopped as Alg. 2 does: its energy rose at iteration " + std::to_string(t) +
                       "; the state before it is given";
      break;
    }
    const bool settled = t > 1 && best - report.energy <= options.tolerance * best;  // Alg. 2, line 4
    best = report.energy;
    result.state = state;
    if (settled) {
      result.termination = Termination::converged;
      result.message = "settled after " + std::to_string(t) + " iterations";
      break;
    }
  }
  if (!solved) {
    result.termination = Termination::diverged;
    result.message = "a system was singular after iteration " + std::to_string(result.iterations.size()) +
                     "; the state before it is given";
  } else if (result.termination == Termination::max_iterations) {
    result.message = "stopped at the limit of " + std::to_string(options.max_iterations) + " iterations";
  }
  result.state.normals = surface_normals(problem.grid, problem.corners, result.state.zeta);
  result.state.points = surface_points(problem.grid, result.state.zeta);
  return result;
}

}  // namespace

MethodResult refine_rgb_ratio(const RefineProblem& problem, const RefineOptions& options,
                              const IterationCallback& after_iteration) {
  if (options.preset == Preset::robust)
    return refine_by_shading(problem, options, ImageLight::colored, after_iteration);
  return ratio_as_printed(problem, options, after_iteration);
}

}  // namespace rakelight
