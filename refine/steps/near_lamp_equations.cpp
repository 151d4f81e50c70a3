// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_equations.h"

#include <opencv2/core/utility.hpp>

#include "refine/steps/near_lamp_channel.h"
#include "refine/steps/near_lamp_shading.h"

namespace rakelight {
namespace {

constexpr Eigen::Index kShared = NearLampUnknowns::kShared, kShape = NearLampUnknowns::kShape,
                       kGloss = NearLampUnknowns::kGloss;
constexpr double kLeastShading = 1e-12;  // below, in squares: nothing is known of a pixel's albedo

/// S of each image and what is left of it without highlights.
struct RegionModel {
  std::vector<Eigen::ArrayX3d> S, matt;
  Eigen::ArrayX3d SS, SI;  ///< sum w S^2 and sum w S (I - H): the albedo is their ratio

  RegionModel(const NearLampUnknowns& at, const LampRegion& region, const std::vector<MovedPoint>& points) {
    SS = SI = Eigen::ArrayX3d::Zero(static_cast<Eigen::Index>(points.size()), 3);
    for (size_t i = 0; i < at.lamps.size(); ++i) {
      const RegionImage& image = region.images[i];
      S.push_back(region_shading(at.lamps[i], points, at.scene.lobe_exponent));
      matt.push_back(image.I - region_highlights(at.lamps[i], image, at.gloss));
      SS += image.w * S.back().square();
      SI += image.w * S.back() * matt.back();
    }
  }
};

double region_energy(const NearLampUnknowns& at, const LampRegion& region) {
  const RegionModel model(at, region, moved_points(at, region.pixels));
  double sum = 0;
  for (size_t i = 0; i < region.images.size(); ++i)
    sum += (region.images[i].w * model.matt[i].square()).sum();
  sum -= (model.SS > kLeastShading).select(model.SI.max(0.0) * model.SI / model.SS, 0.0).sum();
  for (const BroadPixel& pixel : region.pixels) {
    const double miss = prior_miss(at, pixel);
    sum += pixel.prior_weight * miss * miss;
  }
  return sum;
}

void add_channel(const NearLampUnknowns& at, const LampRegion& region, const RegionModel& model,
                 const std::vector<SampleDerivatives>& derivatives, int c, NearLampEquations& total) {
  const Eigen::ArrayXd SS = model.SS.col(c);
  const auto known = (SS > kLeastShading && model.SI.col(c) > 0).eval();
  const Eigen::ArrayXd rho = known.select(model.SI.col(c) / SS, 0.0);
  const Eigen::ArrayXd root = known.select(SS.sqrt(), 1.0);
  ChannelEquations equations(SS.size(), static_cast<Eigen::Index>(at.lamps.size()));
  for (size_t i = 0; i < at.lamps.size(); ++i) {
    const RegionImage& image = region.images[i];
    const Eigen::ArrayXd w = known.select(image.w.col(c), 0.0), S = model.S[i].col(c);
    const Eigen::ArrayXd r = model.matt[i].col(c) - rho * S;
    total.energy += (w * r.square()).sum();
    total.samples += w.sum();
    if (!at.lamps[i].near) continue;
    const auto e = static_cast<double>(at.lamps[i].strength[c]);
    SampleDerivatives J = rho.matrix().asDiagonal() * derivatives[i];
    J.leftCols<3>() *= e;
    J.rightCols<kShared>() *= e;
    J.col(3) += image.lobes * at.gloss;
    J.rightCols<kGloss>() = e * image.lobes;
    equations.add_image(static_cast<Eigen::Index>(i), w, r, w * S / root, J);
  }
  total.samples -= static_cast<double>(known.count());
  equations.add_to(at, c, total);
}

NearLampEquations region_equations(const NearLampUnknowns& at, const LampRegion& region) {
  NearLampEquations total(at.size());
  const std::vector<MovedPoint> points = moved_points(at, region.pixels);
  const RegionModel model(at, region, points);
  std::vector<SampleDerivatives> derivatives;
  for (const Lamp& lamp : at.lamps)
    derivatives.push_back(lamp.near ? shading_derivatives(lamp, points, region.pixels, at.scene.lobe_exponent)
                                    : SampleDerivatives());
  for (int c = 0; c < 3; ++c) add_channel(at, region, model, derivatives, c, total);
  for (const BroadPixel& pixel : region.pixels) {
    const double miss = prior_miss(at, pixel);
    const Eigen::Matrix<double, kShape, 1> B = pixel.B.transpose().cast<double>();
    total.energy += pixel.prior_weight * miss * miss;
    total.A.block<kShape, kShape>(at.shape_at(), at.shape_at()) += pixel.prior_weight * B * B.transpose();
    total.b.segment<kShape>(at.shape_at()) -= pixel.prior_weight * miss * B;
  }
  return total;
}

}  // namespace

NearLampEquations& NearLampEquations::operator+=(const NearLampEquations& other) {
  A += other.A;
  b += other.b;
  energy += other.energy;
  samples += other.samples;
  return *this;
}

double near_lamp_energy(const std::vector<LampRegion>& regions, const NearLampUnknowns& at) {
  std::vector<double> sums(regions.size(), 0.0);
  cv::parallel_for_(cv::Range(0, static_cast<int>(regions.size())), [&](const cv::Range& range) {
    for (auto k = static_cast<size_t>(range.start); k < static_cast<size_t>(range.end); ++k)
      sums[k] = region_energy(at, regions[k]);
  });
  double sum = 0;
  for (const double part : sums) sum += part;
  return sum;
}

std::vector<NearLampEquations> near_lamp_equations(const std::vector<LampRegion>& regions,
                                                   const NearLampUnknowns& at) {
  std::vector<NearLampEquations> result(regions.size(), NearLampEquations(0));
  cv::parallel_for_(cv::Range(0, static_cast<int>(regions.size())), [&](const cv::Range& range) {
    for (auto k = static_cast<size_t>(range.start); k < static_cast<size_t>(range.end); ++k)
      result[k] = region_equations(at, regions[k]);
  });
  return result;
}

}  // namespace rakelight
