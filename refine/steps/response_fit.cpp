// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/response_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "refine/lamp.h"
#include "stack/color_response.h"

namespace rakelight {
namespace {

constexpr int kIterations = 40, kFirstNear = 4;
constexpr double kStartInverseDistance = 1;  ///< 1/m, of near lamps
constexpr double kShadow =
    0.35;  ///< share of the pixel's largest raw value below which a sample is taken for shadow
constexpr double kDarkest = 0.04;  ///< raw value: below, quantisation and noise rule
constexpr int kLeastSamples = 5;   ///< images a pixel must be seen in: unknowns are normal (2) and albedo

constexpr double kMostInverseDistance = 10;  ///< 1/m

/// A lamp in one channel: S = e (d.u) (u.n) / |u|^4 + phi with u = d - kappa offset (refine/lamp.h, Lambertian lobe).
/// Far lamps have kappa = 0 and thus S = e d.n + phi.
struct ChannelLamp {
  double strength = 0, kappa = 0, phi = 0;
  Eigen::Vector3d direction = Eigen::Vector3d(0, 0, -1);

  /// The light vector at a point: S = vector . n + phi.
  Eigen::Vector3d vector_at(const Eigen::Vector3d& offset) const {
    if (kappa <= 0) return strength * direction;
    const Eigen::Vector3d u = direction - kappa * offset;
    const double u2 = u.squaredNorm();
    return strength * std::max(0.0, direction.dot(u)) / (u2 * u2) * u;
  }
};

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// Derivative of S by strength, direction (along two tangents), kappa and phi.
Vector5 lamp_row(const ChannelLamp& lamp, const Eigen::Matrix<double, 3, 2>& tangents,
                 const Eigen::Vector3d& offset, const Eigen::Vector3d& n) {
  const Eigen::Vector3d u = lamp.direction - lamp.kappa * offset;
  const double u2 = u.squaredNorm(), u4 = u2 * u2, du = lamp.direction.dot(u), un = u.dot(n);
  const auto along = [&](double d_du, const Eigen::Vector3d& d_u) {
    return lamp.strength * ((d_du * un + du * d_u.dot(n)) / u4 - 4 * du * un * u.dot(d_u) / (u4 * u2));
  };
  Vector5 row;
  row[0] = du * un / u4;
  for (int k = 0; k < 2; ++k) row[1 + k] = along(-lamp.kappa * tangents.col(k).dot(offset), tangents.col(k));
  row[3] = along(-lamp.direction.dot(offset), -offset);
  row[4] = 1;
  return row;
}

/// One candidate's fit: everything is [image][channel][pixel] or [pixel].
class ResponseFit {
 public:
  ResponseFit(const ResponseSamples& samples, const DecodedSamples& decoded, const std::vector<int>& images,
              ResponseLamps lamps)
      : samples_(samples),
        images_(images),
        near_(lamps == ResponseLamps::near),
        crosstalk_(samples.crosstalk),
        light_(decoded.light),
        slope_(decoded.slope),
        pixels_(samples.raw.pixels) {
    normals_ = samples.normals;
    albedo_ = Eigen::Matrix3Xd::Ones(3, pixels_);
    weight_.assign(slope_.size(), 0.0);
    for (std::size_t k = 0; k < slope_.size(); ++k) weight_[k] = samples.use[k] / (slope_[k] * slope_[k]);
    lamps_.resize(3 * images_.size());
  }

  double misfit() {
    for (int t = 0; t < kIterations; ++t) {
      if (near_ && t == kFirstNear)
        for (ChannelLamp& lamp : lamps_) lamp.kappa = kStartInverseDistance;
      fit_lamps(near_ && t >= kFirstNear);
      for (int p = 0; p < pixels_; ++p) fit_pixel(p);
      reweigh();
    }
    return std::log(scale_) + cauchy_mean();
  }

 private:
  std::size_t at(std::size_t k, int c, int p) const {
    return (static_cast<std::size_t>(images_[k]) * 3 + static_cast<std::size_t>(c)) *
               static_cast<std::size_t>(pixels_) +
           static_cast<std::size_t>(p);
  }
  const ChannelLamp& lamp(std::size_t k, int c) const { return lamps_[3 * k + static_cast<std::size_t>(c)]; }

  Eigen::Vector3d light_vector(std::size_t k, int c, int p) const {
    return lamp(k, c).vector_at(samples_.offset.col(p));
  }
  double light(std::size_t index) const { return static_cast<double>(light_[index]); }

  void fit_lamps(bool near) {
    for (std::size_t k = 0; k < images_.size(); ++k)
      for (int c = 0; c < 3; ++c) near ? fit_near_lamp(k, c) : fit_far_lamp(k, c);
  }

  /// Normal equations of a lamp's unknowns; row_of(p) is d S / d unknowns, target_of(index, p) what they explain.
  template <int N, class Row, class Target>
  Eigen::Matrix<double, N, 1> solve_lamp(std::size_t k, int c, const Row& row_of,
                                         const Target& target_of) const {
    Eigen::Matrix<double, N, N> A = Eigen::Matrix<double, N, N>::Zero();
    Eigen::Matrix<double, N, 1> b = Eigen::Matrix<double, N, 1>::Zero();
    for (int p = 0; p < pixels_; ++p) {
      const std::size_t index = at(k, c, p);
      if (weight_[index] <= 0) continue;
      const Eigen::Matrix<double, N, 1> row = albedo_(c, p) * row_of(p);
      A.template selfadjointView<Eigen::Lower>().rankUpdate(row, weight_[index]);
      b += weight_[index] * target_of(index, p) * row;
    }
    A.diagonal() *= 1 + 1e-4;
    A.diagonal().array() += 1e-9 * A.trace() + 1e-30;
    return A.template selfadjointView<Eigen::Lower>().ldlt().solve(b);
  }

  void fit_far_lamp(std::size_t k, int c) {
    const auto row = [&](int p) { return Eigen::Vector4d(normals_.col(p).homogeneous()); };
    const auto target = [&](std::size_t index, int) { return light(index); };
    const Eigen::Vector4d s = solve_lamp<4>(k, c, row, target);
    if (!s.allFinite() || s.head<3>().norm() == 0) return;
    lamps_[3 * k + static_cast<std::size_t>(c)] = {s.head<3>().norm(), 0, s[3], s.head<3>().normalized()};
  }

  /// A Gauss-Newton step.
  void fit_near_lamp(std::size_t k, int c) {
    ChannelLamp& it = lamps_[3 * k + static_cast<std::size_t>(c)];
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << it.direction.unitOrthogonal(), it.direction.cross(it.direction.unitOrthogonal());
    const auto row = [&](int p) { return lamp_row(it, tangents, samples_.offset.col(p), normals_.col(p)); };
    const auto target = [&](std::size_t index, int p) {
      return light(index) -
             albedo_(c, p) * (it.vector_at(samples_.offset.col(p)).dot(normals_.col(p)) + it.phi);
    };
    const Vector5 s = solve_lamp<5>(k, c, row, target);
    if (!s.allFinite()) return;
    constexpr double kTurn = 0.2, kApproach = 0.4;  // at most, an iteration: rad, 1/m
    it.strength = std::max(0.1 * it.strength, it.strength + s[0]);
    it.direction =
        (it.direction + tangents * Eigen::Vector2d(s.segment<2>(1).cwiseMax(-kTurn).cwiseMin(kTurn)))
            .normalized();
    it.kappa = std::clamp(it.kappa + std::clamp(s[3], -kApproach, kApproach), 0.0, kMostInverseDistance);
    it.phi += s[4];
  }

  /// Albedo of each channel, then a Gauss-Newton step of the normal on the unit sphere.
  void fit_pixel(int p) {
    const Eigen::Vector3d n = normals_.col(p);
    const Eigen::Vector3d across = n.unitOrthogonal();
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << across, n.cross(across);
    Eigen::Vector3d SI = Eigen::Vector3d::Zero(), SS = SI;
    for_each_sample(p, [&](std::size_t index, int c, const Eigen::Vector3d& l, double phi) {
      const double S = l.dot(n) + phi;
      SI[c] += weight_[index] * S * light(index);
      SS[c] += weight_[index] * S * S;
    });
    for (int c = 0; c < 3; ++c)
      if (SS[c] > 0) albedo_(c, p) = std::max(1e-4, SI[c] / SS[c]);
    Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
    Eigen::Vector2d g = Eigen::Vector2d::Zero();
    for_each_sample(p, [&](std::size_t index, int c, const Eigen::Vector3d& l, double phi) {
      const double rho = albedo_(c, p);
      const Eigen::Vector2d J = rho * tangents.transpose() * l;
      H += weight_[index] * J * J.transpose();
      g += weight_[index] * (light(index) - rho * (l.dot(n) + phi)) * J;
    });
    H.diagonal().array() += 1e-3 * H.trace() + 1e-30;
    Eigen::Vector2d step = H.ldlt().solve(g);
    constexpr double kLongest = 0.3;  // radians an iteration
    if (step.norm() > kLongest) step *= kLongest / step.norm();
    if (step.allFinite()) normals_.col(p) = (n + tangents * step).normalized();
  }

  template <class Visitor>
  void for_each_sample(int p, const Visitor& visit) const {
    for (std::size_t k = 0; k < images_.size(); ++k) {
      for (int c = 0; c < 3; ++c) {
        const std::size_t index = at(k, c, p);
        if (weight_[index] > 0) visit(index, c, light_vector(k, c, p), lamp(k, c).phi);
      }
    }
  }

  /// Cauchy weights; the scale is the likeliest one.
  void reweigh() {
    squares_.clear();
    for (std::size_t k = 0; k < images_.size(); ++k) {
      for (int p = 0; p < pixels_; ++p) {
        const Eigen::Vector3d sensor = crosstalk_ * residual(k, p);
        for (int c = 0; c < 3; ++c) {
          const std::size_t index = at(k, c, p);
          if (samples_.use[index] == 0) continue;
          const double raw = sensor[c] / slope_[index];
          weight_[index] = raw * raw;
          squares_.push_back(raw * raw);
        }
      }
    }
    find_scale();
    for (std::size_t k = 0; k < images_.size(); ++k) {
      for (std::size_t index = at(k, 0, 0); index < at(k, 2, pixels_ - 1) + 1; ++index) {
        if (samples_.use[index] == 0) continue;
        weight_[index] = 1 / ((1 + weight_[index] / (scale_ * scale_)) * slope_[index] * slope_[index]);
      }
    }
  }

  Eigen::Vector3d residual(std::size_t k, int p) const {
    Eigen::Vector3d r;
    for (int c = 0; c < 3; ++c) {
      const double S = light_vector(k, c, p).dot(normals_.col(p)) + lamp(k, c).phi;
      r[c] = albedo_(c, p) * S - light(at(k, c, p));
    }
    return r;
  }

  /// s^2 = 2 mean r^2 / (1 + r^2 / s^2), by fixed-point iteration from the median.
  void find_scale() {
    constexpr double kLeast = 1e-6;
    scale_ = kLeast;
    if (squares_.empty()) return;
    const auto middle = squares_.begin() + static_cast<std::ptrdiff_t>(squares_.size() / 2);
    std::nth_element(squares_.begin(), middle, squares_.end());
    scale_ = std::max(kLeast, std::sqrt(*middle));
    for (int step = 0; step < 12; ++step) {
      double sum = 0;
      for (const double square : squares_) sum += square / (1 + square / (scale_ * scale_));
      scale_ = std::max(kLeast, std::sqrt(2 * sum / static_cast<double>(squares_.size())));
    }
  }

  double cauchy_mean() const {
    double sum = 0;
    for (const double square : squares_) sum += std::log1p(square / (scale_ * scale_));
    return squares_.empty() ? 0 : sum / static_cast<double>(squares_.size());
  }

  const ResponseSamples& samples_;
  std::vector<int> images_;
  bool near_;
  Eigen::Matrix3d crosstalk_;
  const std::vector<float>& light_;
  const std::vector<double>& slope_;
  int pixels_;
  std::vector<double> weight_, squares_;
  Eigen::Matrix3Xd normals_, albedo_;
  std::vector<ChannelLamp> lamps_;
  double scale_ = 1;
};

/// d radiance / d value
double slope_of(const ColorResponse& response, float value) {
  constexpr double kStep = 1e-3;
  const double v = std::clamp(static_cast<double>(value), kDarkest, 1 - kStep);
  return (decode(response, v + kStep) - decode(response, v - kStep)) / (2 * kStep);
}

/// The stack as its files have it.
LightStack undecoded(const LightStack& stack) {
  LightStack raw = stack;
  raw.color_response = {};
  raw.color_crosstalk.setIdentity();
  raw.frames.erase(
      std::remove_if(raw.frames.begin(), raw.frames.end(), [](const Frame& f) { return !f.light; }),
      raw.frames.end());
  return raw;
}

/// Which samples speak: not clipped, not dark, not in shadow, and of pixels that enough images show.
/// @param usable of the decoded images: crosstalk spreads what one channel clips
std::vector<unsigned char> samples_to_use(const Observations& raw, const std::vector<unsigned char>& usable,
                                          double shadow) {
  const std::vector<float> value = raw.plain().radiance;
  std::vector<unsigned char> use(usable.size(), 0);
  const auto pixels = static_cast<std::size_t>(raw.pixels), images = static_cast<std::size_t>(raw.images);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t p = 0; p < pixels; ++p) {
      float most = 0;
      for (std::size_t i = 0; i < images; ++i) most = std::max(most, value[(3 * i + c) * pixels + p]);
      const float least = std::max(static_cast<float>(shadow) * most, static_cast<float>(kDarkest));
      int count = 0;
      for (std::size_t i = 0; i < images; ++i) {
        const std::size_t index = (3 * i + c) * pixels + p;
        use[index] = usable[index] != 0 && value[index] > least;
        count += use[index];
      }
      for (std::size_t i = 0; count < kLeastSamples && i < images; ++i) use[(3 * i + c) * pixels + p] = 0;
    }
  }
  return use;
}

}  // namespace

ResponseSamples response_samples(const LightStack& stack, const RefineProblem& problem, int pixels,
                                 double shadow) {
  const PixelGrid& full = problem.grid;
  const int stride = std::max(1, full.size() / std::max(1, pixels));
  cv::Mat1b chosen(full.camera.size(), uchar{0});
  for (int p = 0; p < full.size(); p += stride) chosen(full.pixels[static_cast<std::size_t>(p)]) = 255;
  ResponseSamples samples;
  samples.crosstalk = stack.color_crosstalk;
  samples.grid = make_pixel_grid(full.camera, chosen);
  const Eigen::Matrix3Xf normals = surface_normals(full, problem.corners, problem.prior.start);
  const int count = samples.grid.size();
  samples.normals.resize(3, count);
  samples.offset.resize(3, count);
  const Eigen::Matrix3Xf points = surface_points(full, problem.prior.start);
  for (int p = 0; p < count; ++p) {
    const int at = full.index(samples.grid.pixels[static_cast<std::size_t>(p)]);
    samples.normals.col(p) = normals.col(at).cast<double>();
    samples.offset.col(p) = points.col(at).cast<double>();
  }
  samples.offset.colwise() -= samples.offset.rowwise().mean().eval();
  samples.raw = observe(undecoded(stack), samples.grid);
  samples.use = samples_to_use(samples.raw, observe(stack, samples.grid).plain().usable, shadow);
  return samples;
}

DecodedSamples decode_samples(const LightStack& stack, const ResponseSamples& samples,
                              const ColorResponse& response) {
  LightStack decoded = stack;
  decoded.color_response = response;
  const std::vector<float> value = samples.raw.plain().radiance;
  DecodedSamples result{observe(decoded, samples.grid).plain().radiance, std::vector<double>(value.size())};
  std::transform(value.begin(), value.end(), result.slope.begin(),
                 [&](float at) { return slope_of(response, at); });
  return result;
}

double response_misfit(const ResponseSamples& samples, const DecodedSamples& decoded,
                       const std::vector<int>& images, ResponseLamps lamps) {
  return ResponseFit(samples, decoded, images, lamps).misfit();
}

}  // namespace rakelight
