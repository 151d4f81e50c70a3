// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/problem.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "refine/steps/registration.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

int resolved_scale(const LightStack& stack, int wanted) {
  const int finest = color_to_depth_ratio(stack);
  if (wanted == 0) return finest;
  if (wanted >= 1 && wanted <= finest) return wanted;
  throw UsageError("scale " + std::to_string(wanted) + " is not possible: the colour images are " +
                   std::to_string(finest) + " times as fine as the depth; use --scale 1 to " +
                   std::to_string(finest));
}

/// The stack's mask on a grid of the colour camera's view; without a mask, where the sensor has depth.
cv::Mat1b mask_on(const LightStack& stack, const Camera& camera) {
  cv::Mat1b mask;
  if (!stack.mask.empty()) {
    cv::resize(stack.mask, mask, camera.size(), 0, 0,
               stack.mask.cols > camera.width ? cv::INTER_AREA : cv::INTER_NEAREST);
    return cv::Mat(mask >= 128);
  }
  cv::Mat1b seen;
  for (const Frame& frame : stack.frames) {
    if (frame.depth.empty()) continue;
    const cv::Mat1f depth = registered_depth(stack, frame);
    const cv::Mat1b here = cv::Mat(depth == depth);
    if (seen.empty())
      seen = here;
    else
      seen |= here;
  }
  if (!seen.empty()) cv::resize(seen, mask, camera.size(), 0, 0, cv::INTER_NEAREST);
  return mask;
}

DepthPrior make_prior(const PixelGrid& grid, const SensorDepth& sensor, int scale, bool measured_only) {
  DepthPrior prior;
  prior.cells = make_cells(grid, scale);
  const auto positions = cell_positions(grid, prior.cells, scale);
  const auto cells = static_cast<Eigen::Index>(positions.size());
  prior.cell_weight = Eigen::VectorXd::Zero(cells);
  prior.cell_target = Eigen::VectorXd::Zero(cells);
  const cv::Mat1f& target = measured_only ? sensor.measured : sensor.smooth;
  for (Eigen::Index cell = 0; cell < cells; ++cell) {
    const float z = target(positions[static_cast<size_t>(cell)]);
    if (!(z > 0)) continue;
    prior.cell_weight[cell] = 1;
    prior.cell_target[cell] = std::log(static_cast<double>(z));
  }
  prior.start = gather(grid, upsample_log_depth(sensor.smooth, scale));
  return prior;
}

/// 1 where the step to the neighbour in `direction` crosses a jump of the start: steeper than a surface seen at
/// `kGrazingSlope` would be, beyond the sensor's noise (which the start has mostly lost).
std::vector<unsigned char> depth_jumps(const PixelGrid& grid, const Eigen::VectorXd& zeta, Neighbor direction,
                                       double noise) {
  constexpr double kGrazingSlope = 5.0;  // tan 79 deg
  const double focal = direction == kRight ? grid.camera.fx : grid.camera.fy;
  const double limit = kGrazingSlope / focal + noise;
  std::vector<unsigned char> cut(static_cast<size_t>(grid.size()), 0);
  for (int p = 0; p < grid.size(); ++p) {
    const int q = grid.neighbor[direction][static_cast<size_t>(p)];
    if (q >= 0 && std::abs(zeta[q] - zeta[p]) > limit) cut[static_cast<size_t>(p)] = 1;
  }
  return cut;
}

void observe_and_shrink(const LightStack& stack, const cv::Mat1b& mask, RefineProblem& problem) {
  const std::vector<std::size_t> positions = thumbnail_frames(stack);
  problem.thumbnails.resize(positions.size());
  problem.images = observe(stack, problem.grid, [&](std::size_t at, const Frame& frame) {
    const auto place = std::lower_bound(positions.begin(), positions.end(), at);
    if (place == positions.end() || *place != at) return;
    problem.thumbnails[static_cast<std::size_t>(place - positions.begin())] =
        frame_thumbnail(at, frame, mask);
  });
}

}  // namespace

RefineProblem make_problem(const LightStack& stack, const RefineOptions& options) {
  RefineProblem problem;
  problem.origin = stack.origin;
  problem.scale = resolved_scale(stack, options.scale);
  const Camera depth_camera = registered_depth_camera(stack);
  const Camera camera = binned(depth_camera, 1.0 / problem.scale);
  cv::Mat1b mask = mask_on(stack, camera);
  if (mask.empty() || cv::countNonZero(mask) == 0) {
    throw InputError(stack.origin, "the mask is empty", "draw the object in white or leave mask.png out");
  }
  // A depth pixel belongs to the object when any refined pixel of it does.
  cv::Mat1b depth_mask;
  cv::resize(mask, depth_mask, depth_camera.size(), 0, 0, cv::INTER_AREA);
  problem.sensor = preprocess_depth(stack, cv::Mat(depth_mask > 0), options.preprocess);
  problem.grid = make_pixel_grid(camera, mask);
  const bool paper = options.preset == Preset::paper;
  problem.prior = make_prior(problem.grid, problem.sensor, problem.scale, !paper);
  problem.prior.floor = options.depth.floor;
  problem.depth_noise = problem.sensor.noise_m / std::exp(problem.prior.start.mean());
  if (paper) {
    problem.corners = make_corners(problem.grid, options.depth.stencil);
  } else {
    problem.cut_right = depth_jumps(problem.grid, problem.prior.start, kRight, problem.depth_noise);
    problem.cut_down = depth_jumps(problem.grid, problem.prior.start, kDown, problem.depth_noise);
    problem.corners = make_corners(problem.grid, options.depth.stencil, problem.cut_right, problem.cut_down);
  }
  observe_and_shrink(stack, mask, problem);
  return problem;
}

}  // namespace rakelight
