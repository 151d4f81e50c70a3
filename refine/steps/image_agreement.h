// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which of two surfaces an image supports, without knowing the paint. Where paint does not change, the logarithm of the
// image changes as that of the shading does; where it does, the two differ by far. So, with one light fitted to the
// broad shape,
//
//     D(n) = mean over pixel pairs (p, q) kLag apart of log(1 + (difference / kHalf)^2),
//     difference = log I_p - log I_q - log S(n_p) + log S(n_q)
//
// grows with noise in the normals and with relief that they lack, and paint adds about the same to it whatever the
// surface. A surface made without the image is judged without bias: the image has nothing to do with the sensor's noise.
#pragma once

#include "refine/observations.h"
#include "refine/pixel_grid.h"

namespace rakelight {

class ImageAgreement {
 public:
  /// @param image exactly one; its channels are averaged  @param broad_normals [pixel] that the light is fitted to;
  /// @param lag pixels between the two of a pair. All must outlive this but the last.
  ImageAgreement(const PixelGrid& grid, const Observations& image, const Eigen::Matrix3Xf& broad_normals,
                 int lag);

  /// D above; 0 when no pair of usable pixels exists.
  double disagreement(const Eigen::Matrix3Xf& normals) const;

 private:
  std::vector<std::pair<int, int>> pairs_;
  Eigen::VectorXf log_image_;  ///< [pixel]
  Eigen::Vector4f light_;      ///< S = light . (n, 1)
  float dim_ = 0;              ///< shading counts as at least this
};

}  // namespace rakelight
