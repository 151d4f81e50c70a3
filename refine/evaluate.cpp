// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "refine/depth_normals.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

bool finite(const cv::Vec3f& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

[[noreturn]] void refuse_sizes(const std::string& what, const cv::Size& size, const cv::Size& other) {
  const auto text = [](const cv::Size& s) {
    return std::to_string(s.width) + "x" + std::to_string(s.height);
  };
  throw InputError("the result's " + what,
                   "its size " + text(size) + " does not fit " + text(other) + " of what it is compared with",
                   "evaluate against the truth of the stack that was refined");
}

/// How many pixels of the fine grid lie along one of the coarse grid; 0 if that is no whole number.
int whole_ratio(const cv::Size& coarse, const cv::Size& fine) {
  if (coarse.empty() || fine.width % coarse.width != 0) return 0;
  const int ratio = fine.width / coarse.width;
  return coarse.height * ratio == fine.height ? ratio : 0;
}

/// Depth on a grid `ratio` times finer, bilinear between valid pixels; a fine pixel is valid where the coarse pixel
/// that covers it is.
cv::Mat1f finer_depth(const cv::Mat1f& depth, int ratio) {
  const cv::Size fine = depth.size() * ratio;
  cv::Mat1f value(depth.size(), 0.0f), weight(depth.size(), 0.0f), fine_value, fine_weight;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if (!std::isfinite(depth(y, x)) || depth(y, x) <= 0) continue;
      value(y, x) = depth(y, x);
      weight(y, x) = 1.0f;
    }
  }
  cv::resize(value, fine_value, fine, 0, 0, cv::INTER_LINEAR);
  cv::resize(weight, fine_weight, fine, 0, 0, cv::INTER_LINEAR);
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      const bool valid = weight(y / ratio, x / ratio) > 0;
      fine_value(y, x) = valid ? fine_value(y, x) / fine_weight(y, x) : kNaN;
    }
  }
  return fine_value;
}

/// The normal of the coarse pixel that covers each fine one.
cv::Mat3f finer_normals(const cv::Mat3f& normals, int ratio) {
  cv::Mat3f fine;
  if (!normals.empty()) cv::resize(normals, fine, normals.size() * ratio, 0, 0, cv::INTER_NEAREST);
  return fine;
}

/// Everything on one grid: the finer of the two.
struct Compared {
  Camera camera;
  cv::Mat1f depth, true_depth;
  cv::Mat3f normals, true_normals;
};

Compared on_finer_grid(const Camera& camera, const cv::Mat1f& depth, const cv::Mat3f& normals,
                       const GroundTruth& truth) {
  if (const int ratio = whole_ratio(depth.size(), truth.depth.size()); ratio >= 1) {
    if (ratio == 1) return {camera, depth, truth.depth, normals, truth.normals};
    return {binned(camera, 1.0 / ratio), finer_depth(depth, ratio), truth.depth,
            finer_normals(normals, ratio), truth.normals};
  }
  const int ratio = whole_ratio(truth.depth.size(), depth.size());
  if (ratio == 0) refuse_sizes("depth", depth.size(), truth.depth.size());
  return {camera, depth, finer_depth(truth.depth, ratio), normals, finer_normals(truth.normals, ratio)};
}

double angle_deg(const cv::Vec3d& a, const cv::Vec3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * 180.0 / CV_PI;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(values.size());
}

double root_mean_square(const std::vector<double>& values, double offset) {
  double sum = 0;
  for (const double value : values) sum += (value - offset) * (value - offset);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

/// Forgets depth where there is no truth to compare with; returns the number of pixels that have truth.
int keep_comparable(Compared& c) {
  c.depth = c.depth.clone();
  int count = 0;
  for (int y = 0; y < c.depth.rows; ++y) {
    for (int x = 0; x < c.depth.cols; ++x) {
      const bool has_truth = std::isfinite(c.true_depth(y, x)) && finite(c.true_normals(y, x));
      if (has_truth) ++count;
      if (!has_truth || !(c.depth(y, x) > 0)) c.depth(y, x) = kNaN;
    }
  }
  return count;
}

}  // namespace

Evaluation evaluate(const Camera& camera, const cv::Mat1f& depth, const cv::Mat3f& normals,
                    const GroundTruth& truth) {
  if (!normals.empty() && normals.size() != depth.size())
    refuse_sizes("normals", normals.size(), depth.size());
  Compared c = on_finer_grid(camera, depth, normals, truth);
  const int truth_count = keep_comparable(c);
  const cv::Mat3d depth_normals = normals_from_depth(c.camera, c.depth);

  std::vector<double> depth_errors_mm, angles, own_angles;
  for (int y = 0; y < c.depth.rows; ++y) {
    for (int x = 0; x < c.depth.cols; ++x) {
      if (!std::isfinite(c.depth(y, x))) continue;
      const cv::Vec3d true_normal = c.true_normals(y, x);
      const double z = c.depth(y, x), true_z = c.true_depth(y, x);
      depth_errors_mm.push_back((z - true_z) * 1e3);
      angles.push_back(angle_deg(depth_normals(y, x), true_normal));
      if (!c.normals.empty() && finite(c.normals(y, x))) {
        own_angles.push_back(angle_deg(c.normals(y, x), true_normal));
      }
    }
  }
  if (angles.empty()) {
    throw InputError("the result's depth", "it shares no pixel with the truth",
                     "evaluate against the truth of the stack that was refined");
  }

  Evaluation result;
  result.rmse_mm = root_mean_square(depth_errors_mm, 0);
  result.rmse_unbiased_mm = root_mean_square(depth_errors_mm, mean(depth_errors_mm));
  result.mae_deg = mean(angles);
  result.median_deg = median(angles);
  result.own_normals_mae_deg = mean(own_angles);
  result.completeness = static_cast<double>(angles.size()) / truth_count;
  return result;
}

ErrorMaps error_maps(const Camera& camera, const cv::Mat1f& depth, const GroundTruth& truth) {
  Compared c = on_finer_grid(camera, depth, {}, truth);
  keep_comparable(c);
  const cv::Mat3d depth_normals = normals_from_depth(c.camera, c.depth);
  ErrorMaps maps{c.camera, 0, cv::Mat1f(c.depth.size(), kNaN), cv::Mat1f(c.depth.size(), kNaN)};
  int count = 0;
  for (int y = 0; y < c.depth.rows; ++y) {
    for (int x = 0; x < c.depth.cols; ++x) {
      if (!std::isfinite(c.depth(y, x))) continue;
      maps.depth_mm(y, x) = 1000 * (c.depth(y, x) - c.true_depth(y, x));
      maps.normal_deg(y, x) = static_cast<float>(angle_deg(depth_normals(y, x), c.true_normals(y, x)));
      maps.mean_depth_m += static_cast<double>(c.depth(y, x));
      ++count;
    }
  }
  maps.mean_depth_m /= std::max(1, count);
  return maps;
}

ErrorBarReport evaluate_error_bars(const Camera& camera, const cv::Mat1f& depth, const cv::Mat3f& normals,
                                   const cv::Mat3f& uncertainty, const GroundTruth& truth) {
  if (uncertainty.size() != depth.size()) refuse_sizes("uncertainty", uncertainty.size(), depth.size());
  Compared c = on_finer_grid(camera, depth, normals, truth);
  keep_comparable(c);
  const cv::Mat3f bars = finer_normals(uncertainty, c.depth.cols / depth.cols);
  std::vector<double> errors, deviations;
  int angles = 0, angles_within = 0;
  for (int y = 0; y < c.depth.rows; ++y) {
    for (int x = 0; x < c.depth.cols; ++x) {
      const cv::Vec3d bar = bars(y, x);
      if (!std::isfinite(c.depth(y, x)) || !std::isfinite(bar[0])) continue;
      errors.push_back(static_cast<double>(c.depth(y, x) - c.true_depth(y, x)));
      deviations.push_back(bar[0]);
      if (!finite(c.normals(y, x))) continue;
      ++angles;
      if (angle_deg(c.normals(y, x), c.true_normals(y, x)) * CV_PI / 180 < bar[1]) ++angles_within;
    }
  }
  const double offset = median(errors);
  int within = 0;
  for (size_t i = 0; i < errors.size(); ++i) within += std::abs(errors[i] - offset) < deviations[i];
  return {within / static_cast<double>(errors.size()), angles_within / static_cast<double>(angles)};
}

}  // namespace rakelight
