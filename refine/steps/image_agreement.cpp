// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/image_agreement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace rakelight {
namespace {

constexpr float kHalf = 0.05f;  // difference of logarithms that is more likely paint than shading
constexpr int kLightFits = 10;
constexpr float kDim = 0.1f;  // of the median: below, a shading's logarithm says more of the light's error
constexpr float kDarkest = 0.02f;  // of the brightest: below, an image's logarithm says more of noise

float median_of(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// S = s . (n, 1) fitted to the grey image by iteratively reweighted least squares: paint is what does not fit.
Eigen::Vector4f fit_light(const std::vector<int>& usable, const Eigen::VectorXf& grey,
                          const Eigen::Matrix3Xf& normals) {
  std::vector<float> weight(usable.size(), 1.0f), sizes(usable.size());
  Eigen::Vector4f light = Eigen::Vector4f::Zero();
  for (int k = 0; k < kLightFits; ++k) {
    Eigen::Matrix4d A = 1e-9 * Eigen::Matrix4d::Identity();
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    for (size_t i = 0; i < usable.size(); ++i) {
      const Eigen::Vector4d h = normals.col(usable[i]).homogeneous().cast<double>();
      const auto w = static_cast<double>(weight[i]);
      A += w * h * h.transpose();
      b += w * static_cast<double>(grey[usable[i]]) * h;
    }
    light = A.ldlt().solve(b).cast<float>();
    for (size_t i = 0; i < usable.size(); ++i)
      sizes[i] = std::abs(grey[usable[i]] - light.dot(normals.col(usable[i]).homogeneous()));
    const float scale = std::max(1e-9f, 1.4826f * median_of(sizes));
    for (size_t i = 0; i < usable.size(); ++i) weight[i] = 1 / (1 + (sizes[i] / scale) * (sizes[i] / scale));
  }
  return light;
}

}  // namespace

ImageAgreement::ImageAgreement(const PixelGrid& grid, const Observations& image,
                               const Eigen::Matrix3Xf& broad_normals, int lag)
    : log_image_(image.pixels) {
  Eigen::VectorXf grey(image.pixels);
  std::vector<int> usable;
  std::vector<float> values;
  for (int p = 0; p < image.pixels; ++p) {
    grey[p] = image.radiance_at(0, p).mean();
    if (image.usable_channels(0, p).minCoeff() == 0.0f) continue;
    usable.push_back(p);
    values.push_back(grey[p]);
  }
  light_ = fit_light(usable, grey, broad_normals);
  const float darkest = std::max(1e-6f, kDarkest * grey.maxCoeff());
  log_image_ = grey.cwiseMax(darkest).array().log();
  dim_ = std::max(1e-6f, kDim * median_of(values));
  const cv::Rect view({0, 0}, grid.index.size());
  for (const int p : usable) {
    for (const cv::Point& step : {cv::Point(lag, 0), cv::Point(0, lag)}) {
      const cv::Point to = grid.pixels[static_cast<size_t>(p)] + step;
      const int q = view.contains(to) ? grid.index(to) : -1;
      if (q >= 0 && image.usable_channels(0, q).minCoeff() > 0) pairs_.emplace_back(p, q);
    }
  }
}

double ImageAgreement::disagreement(const Eigen::Matrix3Xf& normals) const {
  Eigen::VectorXf rest(normals.cols());
  for (Eigen::Index p = 0; p < normals.cols(); ++p)
    rest[p] = log_image_[p] - std::log(std::max(dim_, light_.dot(normals.col(p).homogeneous())));
  double sum = 0;
  for (const auto& [p, q] : pairs_) {
    const float r = (rest[p] - rest[q]) / kHalf;
    sum += static_cast<double>(std::log1p(r * r));
  }
  return pairs_.empty() ? 0 : sum / static_cast<double>(pairs_.size());
}

}  // namespace rakelight
