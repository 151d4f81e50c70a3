// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/fusion_paper.h"

#include <cmath>

#include "refine/shading.h"
#include "refine/steps/albedo.h"
#include "refine/steps/laplacian.h"
#include "refine/steps/lighting.h"
#include "refine/steps/paper_albedo.h"
#include "refine/steps/paper_rows.h"

namespace rakelight {
namespace {

/// The image with its mean in all three channels.
Observations grey_image(const Observations& image) {
  std::vector<float> mean(static_cast<size_t>(image.pixels));
  const std::vector<unsigned char> usable(mean.size(), 1);
  for (int p = 0; p < image.pixels; ++p) mean[static_cast<size_t>(p)] = image.radiance_at(0, p).mean();
  Observations out = image;
  for (int c = 0; c < 3; ++c) out.set_channel(0, c, mean.data(), usable.data());
  return out;
}

Eigen::VectorXd grey(const Observations& image) {
  Eigen::VectorXd mean(image.pixels);
  for (int p = 0; p < image.pixels; ++p) mean[p] = static_cast<double>(image.radiance_at(0, p).mean());
  return mean;
}

}  // namespace

MethodResult refine_fusion_as_printed(const RefineProblem& problem, const RefineOptions& options,
                                      const FusionModel& model, const IterationCallback& after_iteration) {
  MethodResult result;
  SurfaceState& state = result.state = initial_state(problem, options);
  const Observations image = grey_image(problem.images);
  const Eigen::VectorXd I = grey(problem.images);
  const Eigen::VectorXd z0 = problem.prior.start.array().exp().matrix() / model.unit_m;
  const double k = problem.grid.camera.fx / z0.mean();
  Eigen::VectorXd z = z0;

  state.normals = orthographic_normals(problem.grid, problem.corners, z, k);
  state.lamps = estimate_far_lamps(image, state);  // Eq. (9)
  const Lamp lamp = state.lamps.front();
  Eigen::VectorXd S(z.size());
  for (int p = 0; p < problem.grid.size(); ++p) {
    const Eigen::Vector3f n = state.normals.col(p);
    S[p] = static_cast<double>(shading(light_at(lamp, state.points.col(p), n, state.scene), n, false)[0]);
  }
  Eigen::VectorXd rho = Eigen::VectorXd::Ones(z.size());
  const auto W = anisotropic_laplacian(problem.grid, I, z0, options.albedo);
  bool solved = solve_albedo(S, I, W, options.albedo.smoothness, rho);  // Eq. (10)
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(z.size());
  if (model.local_term && solved) {
    solved = solve_local_term(I - rho.cwiseProduct(S), W, options.albedo, beta);
  }

  const Smoothness smoothness(uncut_laplacian(problem.grid),
                              options.depth.smoothness * (model.slope_smoothness ? k : 1.0));
  SparseCholesky solver;
  double best = 0;
  for (int t = 1; solved && t <= options.max_iterations; ++t) {
    IterationReport report;
    report.index = t;
    GradientProblem depth{problem.grid,
                          problem.corners,
                          shading_rows(problem.grid, problem.corners, lamp, rho, I - beta, z, k),
                          options.depth.sensor_weight,
                          z0,
                          smoothness};
    report.energy_before_depth = gradient_energy(depth, z);
    if (t == 1) best = report.energy_before_depth;
    Eigen::VectorXd next = z;
    solved = solve_gradient_rows(depth, solver, next) && next.minCoeff() > 0;
    if (!solved) break;
    depth.rows = shading_rows(problem.grid, problem.corners, lamp, rho, I - beta, next, k);
    report.energy = gradient_energy(depth, next);
    report.depth_change_mm =
        1e3 * model.unit_m * std::sqrt((next - z).squaredNorm() / static_cast<double>(z.size()));
    report.sensor_weight = options.depth.sensor_weight;
    result.iterations.push_back(report);
    after_iteration(t, static_cast<double>(t) / options.max_iterations,
                    (model.unit_m * next).array().log().matrix());
    if (report.energy >= best) {  // Alg. 1, line 4
      result.termination = Termination::converged;
      result.message = "stopped as Alg. 1 does: its energy no longer fell at iteration " + std::to_string(t) +
                       "; the state before it is given";
      break;
    }
    best = report.energy;
    z = next;
  }
  if (!solved) {
    result.termination = Termination::diverged;
    result.message = "a system was singular after iteration " + std::to_string(result.iterations.size()) +
                     "; the state before it is given";
  } else if (result.termination == Termination::max_iterations) {
    result.message = "stopped at the limit of " + std::to_string(options.max_iterations) + " iterations";
  }
  state.zeta = (z * model.unit_m).array().log();
  state.normals = surface_normals(problem.grid, problem.corners, state.zeta);
  state.points = surface_points(problem.grid, state.zeta);
  for (int c = 0; c < 3; ++c) state.albedo.row(c) = rho.cast<float>().transpose();
  normalize_albedo(state);
  return result;
}

}  // namespace rakelight
