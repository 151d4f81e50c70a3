// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_shadows.h"

#include <algorithm>
#include <opencv2/core/utility.hpp>

#include "refine/steps/near_lamp_model.h"

namespace rakelight {
namespace {

constexpr float kLeastScale = 1e-3f;  // radiance: rounding to 8 bits errs so much

/// Deviation of image i, from the median of the residuals' sizes.
float robust_deviation(const std::vector<LampRegion>& regions, const std::vector<Eigen::ArrayXXf>& residuals,
                       size_t i) {
  std::vector<float> sizes;
  for (size_t k = 0; k < regions.size(); ++k)
    for (int c = 0; c < 3; ++c)
      for (Eigen::Index row = 0; row < residuals[k].rows(); ++row)
        if (regions[k].w(row, sample_column(i, c)) > 0)
          sizes.push_back(std::abs(residuals[k](row, sample_column(i, c))));
  if (sizes.empty()) return kLeastScale;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(kLeastScale, 1.4826f * *middle);
}

}  // namespace

void forget_shadows(const SurfaceState& state, const Gloss& gloss, std::vector<LampRegion>& regions) {
  const NearLampUnknowns at{state.lamps, state.scene, gloss};
  std::vector<Eigen::ArrayXXf> residuals(regions.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(regions.size())), [&](const cv::Range& range) {
    for (auto k = static_cast<size_t>(range.start); k < static_cast<size_t>(range.end); ++k) {
      const RegionModel model(at, regions[k], regions[k].surface);
      residuals[k].resizeLike(model.S);
      for (Eigen::Index column = 0; column < model.S.cols(); ++column)
        residuals[k].col(column) = model.residual(column);
    }
  });
  cv::parallel_for_(cv::Range(0, static_cast<int>(state.lamps.size())), [&](const cv::Range& range) {
    for (auto i = static_cast<size_t>(range.start); i < static_cast<size_t>(range.end); ++i) {
      const float inverse_scale = 1 / robust_deviation(regions, residuals, i);
      for (size_t k = 0; k < regions.size(); ++k) {
        auto w = regions[k].w.middleCols<3>(sample_column(i, 0));
        const auto r = residuals[k].middleCols<3>(sample_column(i, 0));
        w = (w > 0.0f).select((1 + (r * inverse_scale).square()).square().inverse(), 0.0f);
      }
    }
  });
}

}  // namespace rakelight
