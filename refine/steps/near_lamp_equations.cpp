// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_equations.h"

#include <opencv2/core/utility.hpp>

#include "refine/steps/near_lamp_channel.h"

namespace rakelight {
namespace {

constexpr Eigen::Index kShape = NearLampUnknowns::kShape;

/// zeta - z0 of a region's pixels.
Eigen::ArrayXd prior_miss(const NearLampUnknowns& at, const LampRegion& region) {
  return region.prior_miss + (region.B.cast<double>().matrix() * at.shape).array();
}

/// Weighed squares of what the model leaves of the samples.
double misfit(const LampRegion& region, const RegionModel& model) {
  double sum = 0;
  for (Eigen::Index column = 0; column < model.S.cols(); ++column)
    sum += static_cast<double>((region.w.col(column) * model.residual(column).square()).sum());
  return sum;
}

double region_energy(const NearLampUnknowns& at, const LampRegion& region) {
  const RegionModel model(at, region, moved_surface(at, region));
  return misfit(region, model) + (region.prior_weight * prior_miss(at, region).square()).sum();
}

void add_prior(const NearLampUnknowns& at, const LampRegion& region, NearLampEquations& total) {
  const Eigen::ArrayXd miss = prior_miss(at, region);
  const Eigen::MatrixXd B = region.B.cast<double>(), weighted = region.prior_weight.matrix().asDiagonal() * B;
  total.energy += (region.prior_weight * miss.square()).sum();
  total.A.block<kShape, kShape>(at.shape_at(), at.shape_at()) += weighted.transpose() * B;
  total.b.segment<kShape>(at.shape_at()) -= weighted.transpose() * miss.matrix();
}

NearLampEquations region_equations(const NearLampUnknowns& at, const LampRegion& region) {
  NearLampEquations total(at.size());
  const SurfacePoints surface = moved_surface(at, region);
  const RegionModel model(at, region, surface);
  std::vector<ChannelEquations> channels;
  for (int c = 0; c < 3; ++c) channels.emplace_back(at, region, model, c);
  for (size_t i = 0; i < at.lamps.size(); ++i) {
    if (!at.lamps[i].near) continue;
    const ShadingDerivatives derivatives = shading_derivatives(at.lamps[i], at.scene, region, surface);
    for (ChannelEquations& channel : channels) channel.add_lamp(i, derivatives);
  }
  for (ChannelEquations& channel : channels) channel.add_to(total);
  total.energy += misfit(region, model);
  const auto known = (model.rho > 0.0f).cast<float>().eval();
  for (Eigen::Index column = 0; column < region.w.cols(); ++column)
    total.samples += static_cast<double>((known.col(column % 3) * region.w.col(column)).sum());
  total.samples -= static_cast<double>(known.topRows(region.samples->pixels.size()).sum());
  add_prior(at, region, total);
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
