// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/preprocess.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <opencv2/photo.hpp>

#include "refine/steps/registration.h"
#include "stack/errors.h"
#include "stack/parallel.h"

namespace rakelight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

cv::Mat1b finite_mask(const cv::Mat1f& image) { return cv::Mat(image == image); }

/// Every pixel without a value takes the nearest pixel's (by steps to the four neighbours): filters then never see
/// NaN nor another surface.
cv::Mat1f extended(const cv::Mat1f& depth) {
  cv::Mat1f full = depth.clone();
  std::vector<cv::Point> front;
  for (int v = 0; v < full.rows; ++v)
    for (int u = 0; u < full.cols; ++u)
      if (!std::isnan(full(v, u))) front.emplace_back(u, v);
  const cv::Rect image(0, 0, full.cols, full.rows);
  for (size_t next = 0; next < front.size(); ++next) {
    const cv::Point from = front[next];
    for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
      const cv::Point to = from + step;
      if (!image.contains(to) || !std::isnan(full(to))) continue;
      full(to) = full(from);
      front.push_back(to);
    }
  }
  return full;
}

float median_of(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Residual at the centre of a plane fitted to a (2r+1)^2 window of complete readings, scaled to unit variance a
/// reading: for white noise the centre's residual has variance (1 - 1/N) sigma^2.
bool plane_residual(const cv::Mat1f& depth, int u, int v, int r, float& residual) {
  double sum = 0;
  const int count = (2 * r + 1) * (2 * r + 1);
  for (int y = v - r; y <= v + r; ++y)
    for (int x = u - r; x <= u + r; ++x) {
      if (std::isnan(depth(y, x))) return false;
      sum += static_cast<double>(depth(y, x));
    }
  const double mean = sum / count;  // the window is symmetric: the plane's value at the centre is the mean
  residual = static_cast<float>((static_cast<double>(depth(v, u)) - mean) / std::sqrt(1.0 - 1.0 / count));
  return true;
}

std::vector<cv::Mat1f> registered_frames(const LightStack& stack) {
  std::vector<const Frame*> with_depth;
  for (const Frame& frame : stack.frames)
    if (!frame.depth.empty()) with_depth.push_back(&frame);
  std::vector<cv::Mat1f> frames(with_depth.size());
  in_parallel(static_cast<int>(frames.size()), [&](int k) {
    const auto at = static_cast<size_t>(k);
    frames[at] = registered_depth(stack, *with_depth[at]);
  });
  return frames;
}

std::vector<cv::Mat1f> parts(const std::vector<cv::Mat1f>& images, const cv::Rect& part) {
  std::vector<cv::Mat1f> result;
  for (const cv::Mat1f& image : images) result.push_back(image(part));
  return result;
}

cv::Rect widened(const cv::Rect& box, int margin, cv::Size image) {
  return cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
         cv::Rect({0, 0}, image);
}

/// One row of merge_depth_frames.
void merge_row(const std::vector<cv::Mat1f>& frames, size_t needed, int v, cv::Mat1f& merged) {
  std::vector<float> readings, deviations;
  for (int u = 0; u < merged.cols; ++u) {
    readings.clear();
    for (const cv::Mat1f& frame : frames)
      if (!std::isnan(frame(v, u))) readings.push_back(frame(v, u));
    if (readings.size() < needed || readings.empty()) continue;
    // The mean of the readings near the median: the mean alone would mix the two sides of an edge.
    const float middle = median_of(readings);
    deviations.clear();
    for (const float z : readings) deviations.push_back(std::abs(z - middle));
    const float limit = 3 * 1.4826f * median_of(deviations) + 1e-6f * middle;
    double sum = 0;
    int count = 0;
    for (const float z : readings) {
      if (std::abs(z - middle) > limit) continue;
      sum += static_cast<double>(z);
      ++count;
    }
    merged(v, u) = static_cast<float>(sum / count);
  }
}

}  // namespace

cv::Mat1f merge_depth_frames(const std::vector<cv::Mat1f>& frames) {
  if (frames.size() == 1) return frames.front();
  cv::Mat1f merged(frames.front().size(), kNaN);
  const size_t needed = std::max<size_t>(1, frames.size() / 3);
  in_parallel(merged.rows, [&](int v) { merge_row(frames, needed, v, merged); });
  return merged;
}

double measure_depth_noise(const cv::Mat1f& depth, double depth_unit_m) {
  constexpr int kRadius = 5;  // wide enough that the noise correlated over a few pixels is seen too
  std::vector<float> residuals;
  for (int v = kRadius; v < depth.rows - kRadius; ++v) {
    for (int u = kRadius; u < depth.cols - kRadius; ++u) {
      float residual = 0;
      if (plane_residual(depth, u, v, kRadius, residual)) residuals.push_back(std::abs(residual));
    }
  }
  const double quantization = depth_unit_m / std::sqrt(12.0);
  return residuals.empty() ? quantization
                           : std::max(quantization, 1.4826 * static_cast<double>(median_of(residuals)));
}

cv::Mat1f inpaint_depth(const cv::Mat1f& depth, const cv::Mat1b& holes) {
  const cv::Mat1f full = extended(depth);
  if (cv::countNonZero(holes) == 0) return full;
  constexpr double kRadiusPx = 3;
  cv::Mat1f filled;
  cv::inpaint(full, holes, filled, kRadiusPx, cv::INPAINT_NS);
  return filled;
}

SensorDepth preprocess_depth(const LightStack& stack, const cv::Mat1b& mask,
                             const PreprocessOptions& options) {
  SensorDepth result;
  result.camera = registered_depth_camera(stack);
  result.mask = mask;
  const std::vector<cv::Mat1f> frames = registered_frames(stack);
  if (frames.empty()) {
    throw InputError(stack.origin, "no depth frame",
                     "refinement starts from a sensor's depth: add one under depth/");
  }
  result.frames = static_cast<int>(frames.size());
  const cv::Rect object = cv::boundingRect(mask);
  result.measured = cv::Mat1f(mask.size(), kNaN);
  merge_depth_frames(parts(frames, object)).copyTo(result.measured(object));
  result.measured.setTo(kNaN, mask == 0);
  const cv::Mat1b known = finite_mask(result.measured);
  if (cv::countNonZero(known) == 0) {
    throw InputError(stack.origin, "no depth reading inside the mask",
                     "check that mask and depth show the same view");
  }
  result.inpainted = mask.clone();
  result.inpainted.setTo(0, known);
  result.noise_m = measure_depth_noise(result.measured(object), stack.depth_unit_m);

  const cv::Rect around = widened(object, static_cast<int>(2 * options.bilateral_sigma_px) + 8, mask.size());
  const cv::Mat1f filled = inpaint_depth(result.measured(around), result.inpainted(around));
  const double sigma_m = std::max(options.bilateral_sigma_noise * result.noise_m, 1e-6);
  cv::Mat1f smooth;
  cv::bilateralFilter(filled, smooth, -1, sigma_m, options.bilateral_sigma_px, cv::BORDER_REPLICATE);
  result.smooth = cv::Mat1f(mask.size(), kNaN);
  smooth.copyTo(result.smooth(around), mask(around));
  return result;
}

cv::Mat1f upsample_log_depth(const cv::Mat1f& depth, int scale) {
  cv::Mat1f zeta;
  cv::log(extended(depth), zeta);
  if (scale == 1) return zeta;
  cv::Mat1f fine;
  cv::resize(zeta, fine, cv::Size(), scale, scale, cv::INTER_CUBIC);
  return fine;
}

}  // namespace rakelight
