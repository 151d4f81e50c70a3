// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/refine.h"

#include <algorithm>
#include <limits>
#include <opencv2/core/utility.hpp>

#include "refine/fusion_like.h"
#include "refine/method.h"
#include "refine/multi_light.h"
#include "refine/problem.h"
#include "refine/rgb_ratio.h"
#include "refine/rgbd_fusion.h"
#include "refine/steps/near_lamps.h"
#include "refine/steps/quality.h"
#include "refine/steps/select_image.h"
#include "stack/check.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kPreparation = 0.1;  // share of the work before the first iteration

/// Holds OpenCV's thread count while a refinement runs.
class ThreadCount {
 public:
  explicit ThreadCount(int threads) : before_(cv::getNumThreads()) {
    if (threads > 0) cv::setNumThreads(threads);
  }
  ~ThreadCount() { cv::setNumThreads(before_); }
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

 private:
  int before_;
};

void report(const ProgressCallback& progress, const std::string& stage, double fraction, int iteration) {
  if (progress && !progress({stage, fraction, iteration, {}})) throw Cancelled();
}

SurfaceSoFar surface_so_far(const PixelGrid& grid, const Eigen::VectorXd& zeta) {
  SurfaceSoFar surface{grid.camera, cv::Mat1f(grid.index.size(), kNaN)};
  for (int p = 0; p < grid.size(); ++p)
    surface.depth(grid.pixels[static_cast<size_t>(p)]) = static_cast<float>(std::exp(zeta[p]));
  return surface;
}

cv::Mat3f scatter3(const PixelGrid& grid, const Eigen::Matrix3Xf& values) {
  cv::Mat3f image(grid.index.size(), cv::Vec3f::all(kNaN));
  for (int p = 0; p < grid.size(); ++p)
    image(grid.pixels[static_cast<size_t>(p)]) = {values(0, p), values(1, p), values(2, p)};
  return image;
}

cv::Mat1b inpainted_on_grid(const RefineProblem& problem) {
  cv::Mat1b image(problem.grid.index.size(), uchar{0});
  for (const cv::Point& at : problem.grid.pixels)
    image(at) = problem.sensor.inpainted(at.y / problem.scale, at.x / problem.scale);
  return image;
}

Eigen::Matrix<double, 3, 5> second_order_rows(const Lamp& lamp) {
  Eigen::Matrix<double, 3, 5> rows;
  for (Eigen::Index c = 0; c < 3; ++c) {
    const Eigen::Matrix3d Q = lamp.Q[static_cast<size_t>(c)].cast<double>();
    rows.row(c) << Q(0, 0), Q(1, 1), Q(0, 1), Q(0, 2), Q(1, 2);
  }
  return rows;
}

std::vector<LightEstimate> light_estimates(const Observations& images, const MethodResult& method) {
  const SurfaceState& state = method.state;
  std::vector<LightEstimate> estimates;
  for (size_t i = 0; i < state.lamps.size(); ++i) {
    const Lamp& lamp = state.lamps[i];
    const LocalLight light = light_at(lamp, state.scene.center, state.scene);
    LightEstimate estimate;
    estimate.id = images.light_ids[i];
    estimate.frame_index = images.frame_index[i];
    for (int c = 0; c < 3; ++c)
      estimate.sh_rgb.row(c) << light.l.row(c).cast<double>(), static_cast<double>(light.phi[c]);
    if (lamp.second_order) estimate.second_order_rgb = second_order_rows(lamp);
    if (lamp.near) {
      estimate.position_m = method.lamp_uncertainty[i].position;
      estimate.distance_deviation_m = method.lamp_uncertainty[i].distance_deviation;
      estimate.direction_deviation_rad = method.lamp_uncertainty[i].direction_deviation;
    }
    estimates.push_back(estimate);
  }
  return estimates;
}

/// Empty where the method gives no uncertainty.
cv::Mat3f uncertainty_image(const RefineProblem& problem, const MethodResult& method) {
  if (method.uncertainty.depth.size() == 0) return {};
  Eigen::Matrix3Xf columns(3, problem.grid.size());
  columns.row(0) = method.uncertainty.depth.cast<float>().transpose();
  columns.row(1) = method.uncertainty.normal.cast<float>().transpose();
  columns.row(2) = lit_images(problem.images, method.state).cast<float>().transpose();
  return scatter3(problem.grid, columns);
}

RefineResult make_result(const RefineProblem& problem, MethodResult method, const RefineOptions& options) {
  const PixelGrid& grid = problem.grid;
  RefineResult result;
  result.camera = grid.camera;
  result.scale = problem.scale;
  result.depth = scatter(grid, method.state.zeta.array().exp());
  result.initial_depth = scatter(grid, problem.prior.start.array().exp());
  result.normals = scatter3(grid, method.state.normals);
  result.albedo = scatter3(grid, method.state.albedo);
  result.inpainted = inpainted_on_grid(problem);
  result.uncertainty = uncertainty_image(problem, method);
  result.lights = light_estimates(problem.images, method);
  result.iterations = std::move(method.iterations);
  result.termination = method.termination;
  result.message = std::move(method.message);
  result.warnings = std::move(method.warnings);
  result.quality = std::move(method.quality);
  QualityReport quality = assess_quality(problem, method.state);
  result.quality.merge(quality.measures);
  result.warnings.insert(result.warnings.end(), quality.warnings.begin(), quality.warnings.end());
  result.quality["coverage"] = 1.0 - static_cast<double>(cv::countNonZero(result.inpainted)) / grid.size();
  result.quality["depth_noise_m"] = problem.sensor.noise_m;
  result.thumbnails = problem.thumbnails;
  result.options = options;
  result.options.scale = problem.scale;
  return result;
}

void check_harmonics(const LampOptions& lamps) {
  if (lamps.harmonics != 1 && lamps.harmonics != 2)
    throw UsageError("harmonics of order " + std::to_string(lamps.harmonics) + ": the order is 1 or 2");
  if (lamps.harmonics == 2 && lamps.model == LampModel::near)
    throw UsageError("second-order harmonics describe far lamps: leave out --lamps near or --harmonics 2");
}

/// Leaves the problem with the image that a single-image method uses. @return which one that is, or nothing.
std::string select_images(const LightStack& stack, const RefineOptions& options, RefineProblem& problem) {
  if (options.method == Method::multi_light) return {};
  SelectedImage chosen = options.method == Method::rgb_ratio
                             ? select_colored_image(stack, problem.images, options.frame)
                             : select_any_image(problem.images, options.frame);
  problem.images = std::move(chosen.image);
  return "; " + chosen.explanation;
}

MethodResult run_method(const RefineProblem& problem, const RefineOptions& options,
                        const IterationCallback& callback) {
  switch (options.method) {
    case Method::multi_light:
      return refine_multi_light(problem, options, callback);
    case Method::rgb_ratio:
      return refine_rgb_ratio(problem, options, callback);
    case Method::fusion_like:
      return refine_fusion_like(problem, options, callback);
    case Method::rgbd_fusion:
      return refine_rgbd_fusion(problem, options, callback);
  }
  throw UsageError("unknown method");
}

/// The stack with what its images say about its colour values, where that is asked for.
struct Decoding {
  LightStack stack;
  std::optional<ResponseEstimate> estimate;
};

Decoding decide_response(const LightStack& stack, const RefineOptions& options,
                         const ProgressCallback& progress) {
  if (!options.estimate_response) return {stack, {}};
  const LightStack whole = in_memory(stack);  // every image is looked at several times
  Decoding decoding{whole, estimate_response(whole, options, [&](double fraction) {
                      report(progress, "finding the colour response", kPreparation * fraction, 0);
                      return true;
                    })};
  decoding.stack.color_response = decoding.estimate->used;
  return decoding;
}

void note_response(const Decoding& decoding, RefineResult& result) {
  result.color_response = decoding.stack.color_response;
  result.response_estimate = decoding.estimate;
  if (!decoding.estimate) return;
  result.message += "; " + decoding.estimate->message;
  if (!decoding.estimate->sure) result.warnings.push_back(decoding.estimate->message);
}

}  // namespace

RefineResult refine_depth(const LightStack& recorded, const RefineOptions& options,
                          const ProgressCallback& progress) {
  const ThreadCount threads(options.threads);
  check_harmonics(options.lamps);
  report(progress, "preparing", 0.0, 0);
  check_stack(recorded);
  const Decoding decoding = decide_response(recorded, options, progress);
  const LightStack& stack = decoding.stack;
  RefineProblem problem = make_problem(stack, options);
  const std::string which_image = select_images(stack, options, problem);
  report(progress, "refining", kPreparation, 0);
  const IterationCallback after_iteration = [&](int iteration, double fraction, const Eigen::VectorXd& zeta) {
    const auto surface = [&] { return surface_so_far(problem.grid, zeta); };
    const double done = kPreparation + (1 - kPreparation) * fraction;
    if (progress && !progress({"refining", done, iteration, surface})) throw Cancelled();
  };
  MethodResult method = run_method(problem, options, after_iteration);
  method.message += which_image;
  RefineResult result = make_result(problem, std::move(method), options);
  note_response(decoding, result);
  const std::vector<std::string> doubts = recording_warnings(stack, problem.sensor);
  result.warnings.insert(result.warnings.end(), doubts.begin(), doubts.end());
  return result;
}

}  // namespace rakelight
