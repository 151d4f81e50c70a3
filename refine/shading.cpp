// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "refine/steps/albedo.h"
#include "refine/steps/albedo_smooth.h"
#include "refine/steps/curvature_prior.h"
#include "refine/steps/depth_step.h"
#include "refine/steps/lighting.h"
#include "refine/steps/noise.h"
#include "refine/steps/robust_weights.h"
#include "refine/steps/sensor_bound.h"
#include "refine/steps/smoothness_choice.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr int kSmoothFits = 2;         // lamps and albedo are first fitted to the sensor's broad shape
constexpr double kSmoothFitSigma = 5;  // pixels
// Deviation of the mean over a block of depth readings against that of white noise, at least: a surface drawn to the
// sensor would otherwise make the sensor look better and be drawn further.
constexpr double kSensorCorrelation = 2;
// The same of the model's own error, which is alike all over a block of 4 x 4.
constexpr double kModelCorrelation = 4;
constexpr double kDepthTolerance = 1e-2;  // of a step's system: the next iteration takes up what is left
constexpr double kFloorPer = 100;         // the lambda_z that options.depth.floor goes with
constexpr float kDarkAlbedo = 0.05f;      // of the mean: below, I / rho says nothing

/// Normals averaged over their surroundings inside the mask.
Eigen::Matrix3Xf smoothed(const PixelGrid& grid, const Eigen::Matrix3Xf& normals) {
  cv::Mat3f image(grid.index.size(), cv::Vec3f::all(0));
  for (int p = 0; p < grid.size(); ++p)
    image(grid.pixels[static_cast<size_t>(p)]) = {normals(0, p), normals(1, p), normals(2, p)};
  cv::GaussianBlur(image, image, cv::Size(), kSmoothFitSigma);
  Eigen::Matrix3Xf result(3, grid.size());
  for (int p = 0; p < grid.size(); ++p) {
    const cv::Vec3f& n = image(grid.pixels[static_cast<size_t>(p)]);
    result.col(p) = Eigen::Vector3f(n[0], n[1], n[2]).normalized();
  }
  return result;
}

/// The image as it would be were the object white: I / rho; not usable where the albedo is too dark to divide by.
Observations shading_image(const Observations& image, const SurfaceState& state, ImageLight light) {
  const auto pixels = static_cast<size_t>(image.pixels);
  std::array<std::vector<float>, 3> radiance;
  std::array<std::vector<unsigned char>, 3> can_be_used;
  radiance.fill(std::vector<float>(pixels));
  can_be_used.fill(std::vector<unsigned char>(pixels));
  for (int p = 0; p < image.pixels; ++p) {
    Eigen::Vector3f usable = image.usable_channels(0, p);
    Eigen::Vector3f S;
    for (int c = 0; c < 3; ++c) {
      if (state.albedo(c, p) < kDarkAlbedo) usable[c] = 0;
      S[c] = image.channel(0, c)[p] / std::max(kDarkAlbedo, state.albedo(c, p));
    }
    if (light == ImageLight::white) {
      S.setConstant(usable.dot(S) / std::max(1.0f, usable.sum()));
      usable.setConstant(usable.maxCoeff());
    }
    for (size_t c = 0; c < 3; ++c) {
      radiance[c][static_cast<size_t>(p)] = S[static_cast<Eigen::Index>(c)];
      can_be_used[c][static_cast<size_t>(p)] = usable[static_cast<Eigen::Index>(c)] > 0;
    }
  }
  Observations out = image;
  for (size_t c = 0; c < 3; ++c)
    out.set_channel(0, static_cast<int>(c), radiance[c].data(), can_be_used[c].data());
  return out;
}

/// The state with the albedo divided out of it.
SurfaceState white_object(const SurfaceState& state) {
  SurfaceState white = state;
  white.albedo.setOnes();
  return white;
}

/// What is known of the errors: of a shading sample, and of shading and depth as means over blocks.
struct ShadingErrors {
  double sample = 0;
  MeasuredNoise broad;
};

ShadingErrors shading_errors(const RefineProblem& problem, const RefineOptions& options,
                             const Observations& white_image, const SurfaceState& white) {
  const double least = options.trust.model_error * median_radiance(white_image);
  ShadingErrors errors{residual_scale(white_image, white),
                       measure_noise(problem.grid, white_image, white, problem.prior, problem.scale)};
  errors.sample = std::max(errors.sample, least);
  errors.broad.image = std::max(errors.broad.image, kModelCorrelation * least);
  errors.broad.depth = std::max(errors.broad.depth, kSensorCorrelation * problem.depth_noise);
  return errors;
}

/// lambda_z: as given, or the ratio of the measured error variances (refine/steps/noise.h).
double sensor_weight(const DepthOptions& options, const ShadingErrors& errors) {
  if (options.sensor_weight > 0) return options.sensor_weight;
  const double ratio = errors.broad.image / errors.broad.depth;
  return options.noise_ratio * ratio * ratio;
}

/// How far apart the lights of the three channels are: the least singular value of their directions over the largest.
/// Three in different places are needed to tell a normal from three channels; of one white lamp it is below 0.01.
double lamp_spread(const SurfaceState& state) {
  const Eigen::Vector3d spread = lamp_singular_values(state.lamps, state.scene);
  return spread[0] > 0 ? spread[2] / spread[0] : 0;
}

/// An image under white light would have its paint carved into the shape. What the stack says of its lamps is believed.
void refuse_white_light(const RefineProblem& problem, const SurfaceState& state) {
  constexpr double kOneLight = 0.025;
  if (problem.images.colored_lamps.front() || lamp_spread(state) >= kOneLight) return;
  throw InputError(
      problem.origin,
      "the three channels of frame " + std::to_string(problem.images.frame_index.front()) +
          " are lit from the same side, as by a white lamp, and rgb-ratio needs red, green and blue "
          "lamps in different places",
      "use --method fusion-like, which takes any one image");
}

void judge_directions(const SurfaceState& state, MethodResult& result) {
  constexpr double kNearlyOneDirection = 0.1;
  result.quality["lamp_spread"] = lamp_spread(state);
  if (result.quality["lamp_spread"] >= kNearlyOneDirection) return;
  result.warnings.push_back(
      "the image's three channels are lit from nearly the same side: rgb-ratio needs red, green and blue "
      "lamps in "
      "different places; set them further apart, or use --method fusion-like");
}

/// How much of options.depth.smoothness the image bears out.
double smoothness_share(const RefineProblem& problem, const RefineOptions& options,
                        const CurvaturePrior& curvature, DepthSolver& solver, MethodResult& result) {
  if (options.depth.smoothness <= 0) return 1;
  // lambda_z / lambda_l where the floors of shading_errors hold, as they do on most stacks; the image's error cancels.
  const double deviation = kSensorCorrelation * problem.depth_noise * problem.grid.camera.fx;
  const double balance =
      options.depth.noise_ratio * std::pow(kModelCorrelation / deviation, 2) / options.depth.smoothness;
  DepthPrior prior = problem.prior;
  prior.floor /= kFloorPer;
  const Eigen::Matrix3Xf broad =
      smoothed(problem.grid, surface_normals(problem.grid, problem.corners, problem.prior.start));
  const auto choice = choose_smoothness(problem, prior, curvature, solver, broad, balance);
  if (!choice) return 1;
  result.quality["smoothness_share"] = choice->share;
  result.quality["smoothness_gain"] = choice->gain;
  return choice->share;
}

/// Keeps the surface of one equation a pixel within what the sensor's noise allows.
void hold_to_sensor(const RefineProblem& problem, double share, MethodResult& result) {
  constexpr double kMostBeyond = 0.00075;
  constexpr double kDetailed = 0.2;  // share of the smoothness below which the object has detail of its own,
  Eigen::VectorXd& zeta = result.state.zeta;
  const double beyond = result.quality["beyond_noise_share"] = share_beyond_noise(problem, zeta);
  if (beyond > kMostBeyond) {
    zeta = problem.prior.start;
    result.message += "; the smoothed sensor depth is the result";
    result.warnings.push_back(
        "one image was not enough to improve this depth: shading moved it further than the sensor's noise "
        "explains, so "
        "the result is the sensor's depth, smoothed; take more images and use --method multi-light");
  } else {
    // and a large correction takes away that detail rather than noise
    zeta = bounded_by_noise(problem, zeta, share < kDetailed);
  }
}

}  // namespace

MethodResult refine_by_shading(const RefineProblem& problem, const RefineOptions& options, ImageLight light,
                               const IterationCallback& after_iteration) {
  MethodResult result;
  SurfaceState& state = result.state = initial_state(problem, options);
  const PixelGrid& grid = problem.grid;
  AlbedoSmoother smoother(grid, problem.images, options.albedo, options.depth.solver);
  const CurvaturePrior curvature(grid, problem.cut_right, problem.cut_down);
  const auto solver = options.depth.solver == Solver::exact
                          ? make_cholesky_depth_solver(grid, problem.prior.cells)
                          : make_multigrid_depth_solver(grid, problem.prior.cells, kDepthTolerance);
  DepthPrior prior = problem.prior;
  const double share =
      light == ImageLight::white ? smoothness_share(problem, options, curvature, *solver, result) : 1;
  ShadingErrors errors;
  const auto fail = [&](const std::string& what, int t) {
    result.termination = Termination::diverged;
    result.message = "the " + what + " system was singular at iteration " + std::to_string(t) +
                     "; the state before it is given";
  };

  for (int t = 1; t <= options.max_iterations; ++t) {
    IterationReport report;
    report.index = t;
    state.normals = surface_normals(grid, problem.corners, state.zeta);
    state.points = surface_points(grid, state.zeta);
    SurfaceState broad = white_object(state);
    if (t <= kSmoothFits) broad.normals = smoothed(grid, state.normals);

    broad.lamps = estimate_far_lamps(shading_image(problem.images, state, light), broad);  // Eq. (9)
    state.lamps = broad.lamps;  // also where the albedo fails
    broad.albedo = state.albedo;
    if (!smoother.estimate(broad, state.albedo)) {  // Eq. (10), on logarithms
      fail("albedo", t);
      break;
    }
    normalize_albedo(state);
    const Observations white_image = shading_image(problem.images, state, light);
    SurfaceState white = white_object(state);
    white.normals = broad.normals;
    white.lamps = state.lamps = estimate_far_lamps(white_image, white);
    white.normals = state.normals;
    if (light == ImageLight::colored && t == kSmoothFits) refuse_white_light(problem, state);

    errors = shading_errors(problem, options, white_image, white);
    const double weight = sensor_weight(options.depth, errors);
    prior.cell_weight = weight * problem.prior.cell_weight;
    prior.floor = problem.prior.floor * weight / kFloorPer;  // an absolute one would make the exposure count
    if (light == ImageLight::white)  // its three channels say the same thing: together they count once
      white.weight.assign(static_cast<size_t>(white_image.pixels), 1.0f / 3);
    const auto tensors = accumulate_tensors(white_image, white);
    const auto weights =
        corner_weights(grid, problem.corners, tensors, state.zeta, options.trust.edge_weight);
    CurvatureWeights smoothness;
    if (options.depth.smoothness > 0)
      smoothness = curvature.at(
          state.zeta, share * options.depth.smoothness * std::pow(errors.sample * grid.camera.fx, 2));
    const DepthProblem depth{grid, problem.corners, tensors, weights, prior, smoothness};
    const Eigen::VectorXd before = state.zeta;
    const DepthStepReport step = depth_step(depth, options.depth, *solver, state.zeta);  // Eq. (12)

    report.energy_before_depth = step.energy_before;
    report.energy = step.energy_after;
    report.backtracks = step.backtracks;
    report.depth_change_mm = rms_change_mm(before, state.zeta);
    report.residual_scale = errors.sample;
    report.sensor_weight = prior.cell_weight.maxCoeff();
    result.iterations.push_back(report);
    after_iteration(t, static_cast<double>(t) / options.max_iterations, state.zeta);
    if (!step.solved) {
      fail("depth", t);
      break;
    }
    if (t > options.min_iterations &&
        report.depth_change_mm < 1e3 * options.tolerance * problem.sensor.noise_m) {
      result.termination = Termination::converged;
      result.message = "settled after " + std::to_string(t) + " iterations";
      break;
    }
  }
  if (result.termination == Termination::max_iterations)
    result.message =
        "stopped at the limit of " + std::to_string(options.max_iterations) + " iterations, still moving";
  if (light == ImageLight::white) hold_to_sensor(problem, share, result);
  state.normals = surface_normals(grid, problem.corners, state.zeta);
  state.points = surface_points(grid, state.zeta);
  if (light == ImageLight::colored) judge_directions(state, result);
  result.quality["image_noise"] = errors.broad.image;
  result.quality["depth_noise_log"] = errors.broad.depth;
  result.quality["sensor_weight"] = prior.cell_weight.maxCoeff();
  return result;
}

}  // namespace rakelight
