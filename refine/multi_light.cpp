// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/multi_light.h"

#include <algorithm>
#include <cmath>

#include "refine/pixel_blocks.h"
#include "refine/steps/albedo.h"
#include "refine/steps/depth_step.h"
#include "refine/steps/lamp_estimator.h"
#include "refine/steps/lighting.h"
#include "refine/steps/noise.h"
#include "refine/steps/normals.h"
#include "refine/steps/robust_weights.h"
#include "refine/steps/uncertainty.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

/// Outer iterations in which the start's flaws still dominate every residual: measured on them, noise would tie the depth
/// to the sensor, and edge weights would take the sensor's steps for edges and tear the surface there.
constexpr int kWarmUp = 8;

/// Radiance: what rounding to 8 bits leaves. Where all is darker, a scale from the residuals would run after its own weights to 0.
constexpr double kLeastModelError = 1e-3;

/// Of a step's linear system (DepthSolver): the next step starts from where this one ends, so exact ones gain nothing.
constexpr double kStepTolerance = 0.01;

/// Factor on the Cauchy scale: wide at first, tight at the end. Judged on the start's normals, samples would be dropped
/// for good on one side of a shadow and kept on the other, and the surface would tear between them.
double cauchy_annealing(int iteration) {
  constexpr double kFirst = 4;
  return 1 + (kFirst - 1) * std::max(0, kWarmUp - iteration) / kWarmUp;
}

/// Errors of the model agree over the s x s refined pixels of a depth pixel: together they weigh as s^2 samples, but miss
/// as one.
MeasuredNoise measured_errors(const RefineProblem& problem, const SurfaceState& state, int iteration,
                              double residual_scale) {
  if (iteration <= kWarmUp) return {residual_scale, 3 * problem.depth_noise};
  const double depth = measure_sensor_noise(problem.grid, state, problem.prior, problem.scale);
  return {problem.scale * residual_scale, std::max(depth, 2 * problem.depth_noise)};
}

/// lambda_z: as given, or from the ratio of the measured error variances (refine/steps/noise.h).
double sensor_weight(const DepthOptions& options, const MeasuredNoise& noise) {
  if (options.sensor_weight > 0) return options.sensor_weight;
  const double ratio = noise.image / noise.depth;
  return options.noise_ratio * ratio * ratio;
}

/// lambda_z over the readings, `given` saying how they compare.
void weigh_sensor(double lambda, const DepthPrior& given, DepthPrior& prior) {
  for_each_block(static_cast<int>(prior.cell_weight.size()), [&](int begin, int end) {
    prior.cell_weight.segment(begin, end - begin) = lambda * given.cell_weight.segment(begin, end - begin);
  });
}

void require_enough_images(const std::string& stack, const Observations& images) {
  constexpr int kLeastImages = 4;  // as many as unknowns of a lit pixel: shape (2), albedo and ambient share
  if (images.images >= kLeastImages) return;
  throw InputError(
      stack,
      "has " + std::to_string(images.images) + (images.images == 1 ? " lit image" : " lit images") +
          ", and the multi-light method needs at least 4",
      "record more lamps, or use --method rgb-ratio for one image under red, green and blue lamps, "
      "fusion-like for any one");
}

void require_three_directions(const Observations& images, const SurfaceState& state, MethodResult& result) {
  const Eigen::Vector3d spread = lamp_singular_values(state.lamps, state.scene);
  const double ratio = spread[0] > 0 ? spread[2] / spread[0] : 0;
  result.quality["lamp_spread"] = ratio;
  if (ratio < 0.03) {
    throw InputError("the " + std::to_string(images.images) + " images",
                     "their lamps shine from directions in one plane (or all from one), which leaves the "
                     "shape undetermined",
                     "add images lit from other sides");
  }
  if (ratio < 0.1) {
    result.warnings.push_back(
        "the lamps' directions are nearly in one plane: the shape across it is poorly determined");
  }
}

/// Whether iteration reports say that the method has settled.
bool settled(const RefineProblem& problem, const RefineOptions& options,
             const std::vector<IterationReport>& reports) {
  const IterationReport& last = reports.back();
  if (options.preset == Preset::paper) {  // Alg. 3, line 2
    if (reports.size() < 2) return false;
    const double previous = reports[reports.size() - 2].energy;
    return std::abs(last.energy - previous) <= options.tolerance * previous;
  }
  return last.typical_change_mm < 1e3 * options.tolerance * problem.sensor.noise_m &&
         last.index > options.min_iterations;
}

}  // namespace

MethodResult refine_multi_light(const RefineProblem& problem, const RefineOptions& options,
                                const IterationCallback& after_iteration) {
  const Observations& images = problem.images;
  require_enough_images(problem.origin, images);
  MethodResult result;
  SurfaceState& state = result.state = initial_state(problem, options);
  const auto solver = options.depth.solver == Solver::exact
                          ? make_cholesky_depth_solver(problem.grid, problem.prior.cells)
                          : make_multigrid_depth_solver(problem.grid, problem.prior.cells, kStepTolerance);
  const double model_error = std::max(kLeastModelError, options.trust.model_error * median_radiance(images));
  const double most_sure_reading = problem.prior.cell_weight.maxCoeff();
  const bool robust = options.trust.cauchy_scale > 0;
  const AlbedoRole role = options.depth.linearization == Linearization::gauss_newton
                              ? AlbedoRole::follows_normal
                              : AlbedoRole::held;
  LampEstimator lamps(options.lamps);
  DepthPrior prior = problem.prior;
  MeasuredNoise noise;
  PhotometricTensors tensors(static_cast<size_t>(images.pixels));
  CornerWeights weights;

  for (int t = 1; t <= options.max_iterations; ++t) {
    IterationReport report;
    report.index = t;
    const Eigen::VectorXd before =
        state.zeta;  // the lamps carry the broad shape along, which may undo a depth step
    state.normals = surface_normals(problem.grid, problem.corners, state.zeta);

    lamps.update(problem, prior, state, t);  // Eq. (26)
    if (t == 1) require_three_directions(images, state, result);
    const Observations& matt = lamps.matt_images(images);
    if (robust)
      state.albedo = estimate_albedo(matt, state);  // Eq. (27)
    else
      find_albedo_and_accumulate(matt, role, state,
                                 tensors);  // tensors hold rho l and rho phi: the scale between them is free
    normalize_albedo(state);
    report.residual_scale = std::max(residual_scale(matt, state), model_error);
    if (robust)
      reweigh_and_accumulate(matt, cauchy_annealing(t) * options.trust.cauchy_scale * report.residual_scale,
                             role, state, tensors);

    noise = measured_errors(problem, state, t, t <= kWarmUp ? model_error : report.residual_scale);
    weigh_sensor(sensor_weight(options.depth, noise), problem.prior, prior);
    const double edge_weight = t > kWarmUp ? options.trust.edge_weight : 0;
    if (t == 1 || edge_weight > 0)
      weights = corner_weights(problem.grid, problem.corners, tensors, state.zeta, edge_weight);
    const DepthProblem depth{problem.grid, problem.corners, tensors, weights, prior};
    const DepthStepReport step = depth_step(depth, options.depth, *solver, state.zeta);  // Eq. (32), (34)

    report.energy_before_depth = step.energy_before;
    report.energy = step.energy_after;
    report.backtracks = step.backtracks;
    report.depth_change_mm = rms_change_mm(before, state.zeta);
    report.typical_change_mm = typical_change_mm(before, state.zeta);
    report.sensor_weight = sensor_weight(options.depth, noise) * most_sure_reading;
    result.iterations.push_back(report);
    after_iteration(t, static_cast<double>(t) / options.max_iterations, state.zeta);

    if (!step.solved) {
      result.termination = Termination::diverged;
      result.message = "the depth system was singular at iteration " + std::to_string(t) +
                       "; the state before it is given";
      break;
    }
    if (lamps.settled() && settled(problem, options, result.iterations)) {
      result.termination = Termination::converged;
      result.message = "settled after " + std::to_string(t) + " iterations";
      break;
    }
  }
  if (result.termination == Termination::max_iterations)
    result.message =
        "stopped at the limit of " + std::to_string(options.max_iterations) + " iterations, still moving";
  state.normals = surface_normals(problem.grid, problem.corners, state.zeta);
  state.points = surface_points(problem.grid, state.zeta);
  result.message += "; " + lamps.explanation();
  result.lamp_uncertainty = lamps.positions(problem, prior, state);
  result.uncertainty = estimate_uncertainty(
      {problem.grid, problem.corners, tensors, weights, prior}, problem.scale, lamps.matt_images(images),
      state, result.termination == Termination::diverged ? 0 : options.uncertainty_samples);
  result.quality["far_over_near_residual"] = lamps.far_over_near();
  result.quality["image_noise"] = noise.image;
  result.quality["depth_noise_log"] = noise.depth;
  result.quality["sensor_weight"] = prior.cell_weight.maxCoeff();
  return result;
}

}  // namespace rakelight
