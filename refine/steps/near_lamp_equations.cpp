// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_equations.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "refine/steps/near_lamp_incidence.h"

namespace rakelight {
namespace {

constexpr int kAim = NearLampUnknowns::kAim, kShape = NearLampUnknowns::kShape,
              kShared = NearLampUnknowns::kShared;
constexpr int kOwn =
    5;  // unknowns of its lamp that a sample depends on: 3 of position, its channel's e and phi
constexpr int kSample = kOwn + kShared;

constexpr double kAmbientShare = 0.2;  // expected ambient light, share of a lamp's
constexpr double kAimDeviation =
    0.1;  // expected distance of the aim from the middle of the seen surface, metres
constexpr double kCorrelation =
    100;  // samples whose errors agree: so many count as one against what is expected

using SampleVector = Eigen::Matrix<double, kSample, 1>;

struct Place {
  Eigen::Vector3f point, offset, normal;
};

Place place(const NearLampUnknowns& at, const BroadPixel& pixel) {
  const Eigen::Matrix<float, kShape, 1> c = at.shape.cast<float>();
  const Eigen::Vector3f point = pixel.point * std::exp(pixel.B.dot(c));
  return {point, point - at.scene.center, (pixel.normal + pixel.normal_by_c * c).normalized()};
}

double prior_miss(const NearLampUnknowns& at, const BroadPixel& pixel) {
  return pixel.prior_miss + pixel.B.cast<double>().dot(at.shape);
}

/// A lamp's shading at a pixel and, for e = 1, its change with the sample's unknowns.
struct Shading {
  Eigen::Vector3d S;
  SampleVector by_unknowns = SampleVector::Zero();  ///< of v.n, and 1 for phi
};

Eigen::Vector3d shading_only(const Lamp& lamp, const Place& here, float lobe_exponent) {
  if (!lamp.near) return ((lamp.l * here.normal).cwiseMax(0.0f) + lamp.phi).cast<double>();
  const float value = incidence_of(lamp, kNoTangents, here.offset, here.normal, lobe_exponent, false).value;
  return (lamp.strength * value + lamp.phi).cast<double>();
}

Shading shading_of(const Lamp& lamp, const Place& here, const BroadPixel& pixel, float lobe_exponent) {
  if (!lamp.near) return {shading_only(lamp, here, lobe_exponent)};
  const Incidence v =
      incidence_of(lamp, lamp_tangents(lamp.direction), here.offset, here.normal, lobe_exponent);
  Shading result{(lamp.strength * v.value + lamp.phi).cast<double>()};
  SampleVector& z = result.by_unknowns;
  z << v.lamp.cast<double>(), static_cast<double>(v.value), 1, v.aim.cast<double>(),
      (v.point.dot(here.point) * pixel.B + v.normal.transpose() * pixel.normal_by_c)
          .transpose()
          .cast<double>();
  return result;
}

/// Numbers of the unknowns of channel c: 5 of each image, then the shared ones.
std::vector<Eigen::Index> channel_unknowns(const NearLampUnknowns& at, int c) {
  std::vector<Eigen::Index> numbers;
  for (size_t i = 0; i < at.lamps.size(); ++i) {
    const Eigen::Index k = at.lamp_at(static_cast<Eigen::Index>(i));
    numbers.insert(numbers.end(), {k, k + 1, k + 2, k + 3 + c, k + 6 + c});
  }
  for (int k = 0; k < kShared; ++k) numbers.push_back(at.aim_at() + k);
  return numbers;
}

/// About equally many pixels a region: bands of rows, each cut into columns. Pixels come row by row.
std::vector<std::vector<BroadPixel>> split_into_regions(std::vector<BroadPixel> pixels) {
  constexpr size_t kBands = 4, kColumns = NearLampProblem::kRegions / kBands;
  std::vector<std::vector<BroadPixel>> regions;
  const auto cut = [](size_t count, size_t k, size_t parts) {
    return static_cast<std::ptrdiff_t>(count * k / parts);
  };
  for (size_t band = 0; band < kBands; ++band) {
    const auto begin = pixels.begin() + cut(pixels.size(), band, kBands);
    const auto end = pixels.begin() + cut(pixels.size(), band + 1, kBands);
    std::sort(begin, end, [](const BroadPixel& a, const BroadPixel& b) { return a.point.x() < b.point.x(); });
    const auto count = static_cast<size_t>(end - begin);
    for (size_t k = 0; k < kColumns; ++k)
      regions.emplace_back(begin + cut(count, k, kColumns), begin + cut(count, k + 1, kColumns));
  }
  return regions;
}

}  // namespace

/// Sums of one channel over a region's pixels; w weighs a sample, r = I - rho S, J = rho dS.
struct NearLampProblem::ChannelSums {
  explicit ChannelSums(size_t images)
      : A(images, Eigen::Matrix<double, kSample, kSample>::Zero()), b(images, SampleVector::Zero()) {
    const auto size = kOwn * static_cast<Eigen::Index>(images) + kShared;
    Q = Eigen::MatrixXd::Zero(size, size);
  }

  void add_to(const std::vector<Eigen::Index>& number, NearLampEquations& total) const {
    const Eigen::Index shared = Q.rows() - kShared;
    for (size_t i = 0; i < A.size(); ++i) {
      const auto at = [&](Eigen::Index k) {
        return number[static_cast<size_t>(k < kOwn ? kOwn * static_cast<Eigen::Index>(i) + k
                                                   : shared + k - kOwn)];
      };
      for (Eigen::Index j = 0; j < kSample; ++j) {
        total.b[at(j)] += b[i][j];
        for (Eigen::Index k = 0; k < kSample; ++k) total.A(at(j), at(k)) += A[i](j, k);
      }
    }
    for (Eigen::Index j = 0; j < Q.rows(); ++j)
      for (Eigen::Index k = 0; k < Q.cols(); ++k)
        total.A(number[static_cast<size_t>(j)], number[static_cast<size_t>(k)]) -=
            Q(std::max(j, k), std::min(j, k));
  }

  std::vector<Eigen::Matrix<double, kSample, kSample>> A;  ///< [image] sum w J J'
  std::vector<SampleVector> b;                             ///< [image] sum w r J
  Eigen::MatrixXd Q;  ///< what the albedo takes away: sum q q' / sum w S^2, q = sum w S J; lower half
};

NearLampEquations& NearLampEquations::operator+=(const NearLampEquations& other) {
  A += other.A;
  b += other.b;
  energy += other.energy;
  samples += other.samples;
  return *this;
}

NearLampProblem::NearLampProblem(const Observations& images, const BroadShape* shape,
                                 const SurfaceState& state, int pixels)
    : images_(images), state_(state), aim_(state.points.rowwise().mean()) {
  std::vector<BroadPixel> chosen;
  const int stride = std::max(1, images.pixels / pixels);
  for (int p = 0; p < images.pixels; p += stride) chosen.push_back(broad_pixel(shape, state, p));
  regions_ = split_into_regions(std::move(chosen));
}

double NearLampProblem::weight(int image, int c, int p) const {
  if (!images_.usable(image, c, p)) return 0;
  const auto pixels = static_cast<size_t>(images_.pixels);
  return static_cast<double>(state_.weight[static_cast<size_t>(image) * pixels + static_cast<size_t>(p)]);
}

double NearLampProblem::energy(const NearLampUnknowns& at) const {
  std::vector<double> sums(regions_.size(), 0.0);
  cv::parallel_for_(cv::Range(0, static_cast<int>(regions_.size())), [&](const cv::Range& range) {
    for (auto k = static_cast<size_t>(range.start); k < static_cast<size_t>(range.end); ++k)
      for (const BroadPixel& pixel : regions_[k]) sums[k] += pixel_energy(at, pixel);
  });
  double sum = 0;
  for (const double part : sums) sum += part;
  return sum;
}

double NearLampProblem::pixel_energy(const NearLampUnknowns& at, const BroadPixel& pixel) const {
  const Place here = place(at, pixel);
  Eigen::Array3d SS = Eigen::Array3d::Zero(), SI = SS, II = SS;
  for (int i = 0; i < images_.images; ++i) {
    const Eigen::Vector3d S = shading_only(at.lamps[static_cast<size_t>(i)], here, at.scene.lobe_exponent);
    for (int c = 0; c < 3; ++c) {
      const double w = weight(i, c, pixel.p);
      const auto I = static_cast<double>(images_.channel(i, c)[pixel.p]);
      SS[c] += w * S[c] * S[c];
      SI[c] += w * S[c] * I;
      II[c] += w * I * I;
    }
  }
  const double miss = prior_miss(at, pixel);
  double sum = pixel.prior_weight * miss * miss;
  for (int c = 0; c < 3; ++c) sum += SS[c] > 1e-12 ? II[c] - std::max(0.0, SI[c]) * SI[c] / SS[c] : II[c];
  return sum;
}

void NearLampProblem::add_pixel(const NearLampUnknowns& at, const BroadPixel& pixel,
                                std::vector<ChannelSums>& sums, NearLampEquations& total) const {
  const Place here = place(at, pixel);
  std::vector<Shading> shadings;
  for (const Lamp& lamp : at.lamps) shadings.push_back(shading_of(lamp, here, pixel, at.scene.lobe_exponent));
  for (int c = 0; c < 3; ++c) {
    double SS = 0, SI = 0;
    for (int i = 0; i < images_.images; ++i) {
      const double w = weight(i, c, pixel.p), S = shadings[static_cast<size_t>(i)].S[c];
      SS += w * S * S;
      SI += w * S * static_cast<double>(images_.channel(i, c)[pixel.p]);
    }
    if (SS <= 1e-12 || SI <= 0) continue;
    const double rho = SI / SS;
    ChannelSums& sum = sums[static_cast<size_t>(c)];
    Eigen::VectorXd q = Eigen::VectorXd::Zero(sum.Q.rows());
    for (int i = 0; i < images_.images; ++i) {
      const double w = weight(i, c, pixel.p);
      if (w == 0) continue;
      const auto image = static_cast<size_t>(i);
      const double S = shadings[image].S[c],
                   r = static_cast<double>(images_.channel(i, c)[pixel.p]) - rho * S;
      const auto e = static_cast<double>(at.lamps[image].strength[c]);
      SampleVector J = rho * shadings[image].by_unknowns;
      J.head<3>() *= e;
      J.tail<kShared>() *= e;
      sum.A[image].noalias() += w * J * J.transpose();
      sum.b[image] += w * r * J;
      q.segment<kOwn>(kOwn * i) += w * S * J.head<kOwn>();
      q.tail<kShared>() += w * S * J.tail<kShared>();
      total.energy += w * r * r;
      total.samples += w;
    }
    sum.Q.selfadjointView<Eigen::Lower>().rankUpdate(q, 1 / SS);
    total.samples -= 1;
  }
  const double miss = prior_miss(at, pixel);
  total.energy += pixel.prior_weight * miss * miss;
  const Eigen::Matrix<double, kShape, 1> B = pixel.B.transpose().cast<double>();
  total.A.bottomRightCorner<kShape, kShape>() += pixel.prior_weight * B * B.transpose();
  total.b.tail<kShape>() -= pixel.prior_weight * miss * B;
}

NearLampEquations NearLampProblem::region_equations(const NearLampUnknowns& at,
                                                    const std::vector<BroadPixel>& pixels) const {
  NearLampEquations total(at.size());
  std::vector<ChannelSums> sums(3, ChannelSums(at.lamps.size()));
  for (const BroadPixel& pixel : pixels) add_pixel(at, pixel, sums, total);
  for (int c = 0; c < 3; ++c) sums[static_cast<size_t>(c)].add_to(channel_unknowns(at, c), total);
  return total;
}

std::vector<NearLampEquations> NearLampProblem::equations(const NearLampUnknowns& at) const {
  std::vector<NearLampEquations> result(regions_.size(), NearLampEquations(0));
  cv::parallel_for_(cv::Range(0, static_cast<int>(regions_.size())), [&](const cv::Range& range) {
    for (auto k = static_cast<size_t>(range.start); k < static_cast<size_t>(range.end); ++k)
      result[k] = region_equations(at, regions_[k]);
  });
  return result;
}

NearLampEquations NearLampProblem::prior(const NearLampUnknowns& at, double variance) const {
  NearLampEquations result(at.size());
  const auto add = [&](Eigen::Index k, double value, double deviation) {
    const double weight = kCorrelation * variance / (deviation * deviation + 1e-12);
    result.A(k, k) += weight;
    result.b[k] -= weight * value;
    result.energy += weight * value * value;
  };
  for (size_t i = 0; i < at.lamps.size(); ++i) {
    const Lamp& lamp = at.lamps[i];
    if (!lamp.near) continue;
    const double ambient = kAmbientShare * static_cast<double>(lamp.strength.maxCoeff());
    for (int c = 0; c < 3; ++c)
      add(at.lamp_at(static_cast<Eigen::Index>(i)) + 6 + c, static_cast<double>(lamp.phi[c]), ambient);
  }
  for (int k = 0; k < kAim; ++k)
    add(at.aim_at() + k, static_cast<double>(at.scene.center[k] - aim_[k]), kAimDeviation);
  return result;
}

}  // namespace rakelight
