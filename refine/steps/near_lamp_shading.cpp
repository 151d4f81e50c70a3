// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_shading.h"

#include <cmath>

#include "refine/steps/near_lamp_incidence.h"

namespace rakelight {

std::vector<MovedPoint> moved_points(const NearLampUnknowns& at, const std::vector<BroadPixel>& pixels) {
  const Eigen::Matrix<float, kBroadChanges, 1> c = at.shape.cast<float>();
  std::vector<MovedPoint> points;
  points.reserve(pixels.size());
  for (const BroadPixel& pixel : pixels) {
    const Eigen::Vector3f point = pixel.point * std::exp(pixel.B.dot(c));
    points.push_back({point, point - at.scene.center, (pixel.normal + pixel.normal_by_c * c).normalized()});
  }
  return points;
}

double prior_miss(const NearLampUnknowns& at, const BroadPixel& pixel) {
  return pixel.prior_miss + pixel.B.cast<double>().dot(at.shape);
}

Eigen::ArrayX3d region_shading(const Lamp& lamp, const std::vector<MovedPoint>& points, float lobe_exponent) {
  Eigen::ArrayX3d S(points.size(), 3);
  for (size_t k = 0; k < points.size(); ++k) {
    const MovedPoint& here = points[k];
    Eigen::Vector3f value = lamp.phi;
    if (lamp.near)
      value += lamp.strength *
               incidence_of(lamp, kNoTangents, here.offset, here.normal, lobe_exponent, false).value;
    else
      value += (lamp.l * here.normal).cwiseMax(0.0f);
    S.row(static_cast<Eigen::Index>(k)) = value.cast<double>().transpose();
  }
  return S;
}

Eigen::ArrayX3d region_highlights(const Lamp& lamp, const RegionImage& image, const Gloss& gloss) {
  return (image.lobes * gloss * lamp.strength.cast<double>().transpose()).array();
}

SampleDerivatives shading_derivatives(const Lamp& lamp, const std::vector<MovedPoint>& points,
                                      const std::vector<BroadPixel>& pixels, float lobe_exponent) {
  const Eigen::Matrix<float, 3, 2> tangents = lamp_tangents(lamp.direction);
  SampleDerivatives Z(points.size(), kSampleUnknowns);
  for (size_t k = 0; k < points.size(); ++k) {
    const MovedPoint& here = points[k];
    const Incidence v = incidence_of(lamp, tangents, here.offset, here.normal, lobe_exponent);
    const Eigen::Matrix<float, 1, kBroadChanges> by_shape =
        v.point.dot(here.point) * pixels[k].B + v.normal.transpose() * pixels[k].normal_by_c;
    Eigen::Matrix<float, 1, kSampleUnknowns> z;
    z << v.lamp.transpose(), v.value, 1, v.aim.transpose(), by_shape, Eigen::RowVector2f::Zero();
    Z.row(static_cast<Eigen::Index>(k)) = z.cast<double>();
  }
  return Z;
}

}  // namespace rakelight
