// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/simulate.h"

#include <algorithm>

#include "simulate/check_options.h"
#include "simulate/depth_sensor.h"
#include "simulate/image_sensor.h"
#include "simulate/render.h"
#include "simulate/scene.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

/// OpenCV's thread count, put back on the way out.
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

cv::Mat1b mask_of(const cv::Mat1f& depth) {
  return cv::Mat1b(depth == depth);  // NaN differs from itself
}

Frame make_frame(int index, const LampSet* set, const cv::Mat& color, const cv::Mat1w& depth) {
  constexpr std::int64_t kPeriodUs = 33333;
  Frame frame;
  frame.index = index;
  if (set != nullptr && !set->lamps.empty()) frame.light = set->light.id;
  frame.color = color;
  frame.depth = depth;
  const std::int64_t time = index * kPeriodUs;
  if (!color.empty()) frame.color_time.device_us = time;
  if (!depth.empty()) frame.depth_time.device_us = time;
  return frame;
}

LightStack empty_stack(const SimulateOptions& options, const Camera& depth, const Camera& color) {
  LightStack stack;
  stack.created = "2000-01-01T00:00:00Z";  // a clock would make equal seeds differ
  stack.sensor = {"Rakelight", "synthetic rig", "", "seed " + std::to_string(options.seed), "simulate"};
  stack.depth_camera = depth;
  stack.color_camera = color;
  stack.depth_unit_m = options.depth.unit_m;
  stack.color_response = options.image.response;
  stack.color_crosstalk = crosstalk_matrix(options.image.crosstalk);
  return stack;
}

/// Relative strengths become encoded full scale.
void add_lamps(const std::vector<LampSet>& sets, double exposure, Simulated& scan) {
  for (const LampSet& set : sets) {
    if (set.lamps.empty()) continue;
    scan.stack.lights.push_back(set.light);
    for (LampTruth lamp : set.lamps) {
      lamp.strength *= exposure;
      scan.truth.lamps.push_back(lamp);
    }
  }
}

void add_frames(const std::vector<LampSet>& sets, const std::vector<cv::Mat>& colors,
                const std::vector<cv::Mat1w>& depths, LightStack& stack) {
  const std::size_t count = std::max(colors.size(), depths.size());
  for (std::size_t k = 0; k < count; ++k) {
    const bool lit = k < colors.size();
    stack.frames.push_back(make_frame(static_cast<int>(k), lit ? &sets[k] : nullptr,
                                      lit ? colors[k] : cv::Mat(),
                                      k < depths.size() ? depths[k] : cv::Mat1w()));
  }
}

}  // namespace

SimulateOptions realism_options(Realism realism) {
  SimulateOptions options;
  if (realism == Realism::real) return options;
  options.lamps.ambient = 0;
  options.lamps.dark_frame = false;
  options.image.attached_shadows = false;
  options.image.cast_shadows = false;
  options.image.highlight = 0;
  options.image.shot_noise = 0;
  options.image.read_noise = 0;
  options.image.clip_share = 0;
  options.image.bits = 16;
  return options;
}

Simulated simulate_stack(const SimulateOptions& options, const SimulateProgress& progress) {
  check_options(options);
  const ThreadCount threads(options.threads);
  const auto report = [&progress](double fraction) {
    if (progress && !progress(fraction)) throw Cancelled();
  };
  report(0);
  const Camera depth = structured_light_camera({options.width, options.height});
  const Camera color = binned(depth, 1.0 / options.color_scale);
  const RayTracer tracer(make_scene(options.scene, color));
  const ShadingContext context{options, tracer,
                               Eigen::Vector3f(0, 0, static_cast<float>(options.scene.distance_m))};
  const std::vector<LampSet> sets = make_lamp_sets(options);
  report(0.05);

  const double exposure = auto_exposure(context, color, sets);
  const RenderedImages images =
      render_images(context, color, sets, exposure, [&](double fraction) { report(0.1 + 0.8 * fraction); });
  const SurfaceMaps surface = render_surface(tracer, color);
  const int depth_frames = options.depth.frames > 0 ? options.depth.frames : static_cast<int>(sets.size());

  Simulated scan;
  scan.stack = empty_stack(options, depth, color);
  scan.stack.mask = mask_of(surface.depth);
  scan.truth = {surface.depth, surface.normals, images.albedo, {}};
  scan.truth.albedo.setTo(cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()), scan.stack.mask == 0);
  add_lamps(sets, exposure, scan);
  add_frames(sets, images.colors, sense_depth(options, depth, tracer, depth_frames), scan.stack);
  report(1);
  return scan;
}

}  // namespace rakelight
