// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamps.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <opencv2/core/utility.hpp>

namespace rakelight {
namespace {

using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Vector9 = Eigen::Matrix<double, 9, 1>;

/// Two unit vectors that span the plane across `direction`.
Eigen::Matrix<float, 3, 2> tangents_of(const Eigen::Vector3f& direction) {
  Eigen::Matrix<float, 3, 2> tangents;
  tangents.col(0) = direction.unitOrthogonal();
  tangents.col(1) = direction.cross(tangents.col(0));
  return tangents;
}

struct LampFit {
  Matrix9 A = Matrix9::Zero();
  Vector9 b = Vector9::Zero();
  double energy = 0;
  double samples = 0;
};

/// A channel's shading depends on the position through one number v.n, and on its own strength and ambient share
/// alone: d S_c = e_c (z_0, z_1, z_2) + z_3 d e_c + z_4 d phi_c. Sums of w rho^2 z z' and w rho r z.
struct ChannelSums {
  Eigen::Matrix<double, 5, 5> A = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 5, 1> b = Eigen::Matrix<double, 5, 1>::Zero();
};

void add_channel(const ChannelSums& sums, int c, double strength, LampFit& fit) {
  Eigen::Matrix<double, 5, 1> scale;
  scale << strength, strength, strength, 1, 1;
  const std::array<int, 5> unknowns{0, 1, 2, 3 + c, 6 + c};
  for (int i = 0; i < 5; ++i) {
    fit.b[unknowns[static_cast<size_t>(i)]] += scale[i] * sums.b[i];
    for (int j = 0; j < 5; ++j) {
      fit.A(unknowns[static_cast<size_t>(i)], unknowns[static_cast<size_t>(j)]) +=
          scale[i] * scale[j] * sums.A(std::max(i, j), std::min(i, j));
    }
  }
}

LampFit fit_equations(const Observations& images, const SurfaceState& state, int image, const Lamp& lamp,
                      int pixels_used, bool derivatives) {
  LampFit fit;
  const int stride = std::max(1, images.pixels / pixels_used);
  std::array<ChannelSums, 3> sums;
  const auto tangents = tangents_of(lamp.direction);
  const float* weight = state.weight.data() + static_cast<size_t>(image) * static_cast<size_t>(images.pixels);
  for (int p = 0; p < images.pixels; p += stride) {
    if (weight[p] == 0.0f) continue;
    const Eigen::Vector3f offset = state.points.col(p) - state.scene.center;
    const Incidence incidence =
        incidence_of(lamp, tangents, offset, state.normals.col(p), state.scene.lobe_exponent, derivatives);
    Eigen::Matrix<double, 5, 1> z;
    z << incidence.derivative.cast<double>(), static_cast<double>(incidence.value), 1;
    const auto w = static_cast<double>(weight[p]);
    for (int c = 0; c < 3; ++c) {
      if (!images.usable_in(image, c)[p]) continue;
      const float rho = state.albedo(c, p);
      const float S = lamp.strength[c] * incidence.value + lamp.phi[c];
      const auto r = static_cast<double>(images.channel(image, c)[p] - rho * S);
      fit.energy += w * r * r;
      fit.samples += w;
      if (!derivatives) continue;
      ChannelSums& sum = sums[static_cast<size_t>(c)];
      const double wrho = w * static_cast<double>(rho);
      sum.b += wrho * r * z;
      for (int j = 0; j < 5; ++j)
        for (int i = j; i < 5; ++i) sum.A(i, j) += wrho * static_cast<double>(rho) * z[i] * z[j];
    }
  }
  for (int c = 0; c < 3; ++c)
    add_channel(sums[static_cast<size_t>(c)], c, static_cast<double>(lamp.strength[c]), fit);
  return fit;
}

Lamp moved(const Lamp& lamp, const Vector9& step, float max_inverse_distance) {
  Lamp result = lamp;
  const Eigen::Matrix<float, 9, 1> s = step.cast<float>();
  result.direction = (lamp.direction + tangents_of(lamp.direction) * s.head<2>()).normalized();
  result.inverse_distance = std::clamp(lamp.inverse_distance + s[2], 0.0f, max_inverse_distance);
  result.strength += s.segment<3>(3);
  result.phi += s.tail<3>();
  return result;
}

/// Locks unknowns: the position if it is given, the distance at the bound of the far lamp if it would go beyond.
void lock_unknowns(LampFit& fit, bool lock_direction, bool lock_distance) {
  for (int k = 0; k < 3; ++k) {
    if (k < 2 ? !lock_direction : !lock_distance) continue;
    fit.A.row(k).setZero();
    fit.A.col(k).setZero();
    fit.A(k, k) = 1;
    fit.b[k] = 0;
  }
}

Lamp fit_lamp(const Observations& images, const SurfaceState& state, int image,
              const NearLampOptions& options) {
  Lamp lamp = state.lamps[static_cast<size_t>(image)];
  if (!lamp.near) return lamp;
  double damping = 1e-4;
  for (int step = 0; step < options.steps; ++step) {
    LampFit fit = fit_equations(images, state, image, lamp, options.pixels, true);
    const bool at_infinity = lamp.inverse_distance <= 0 && fit.b[2] < 0;
    lock_unknowns(fit, options.fixed_positions, options.fixed_positions || at_infinity);
    for (int attempt = 0; attempt < 4; ++attempt, damping *= 10) {
      Matrix9 damped = fit.A;
      damped.diagonal() *= 1 + damping;
      damped.diagonal().array() += 1e-9 * fit.A.trace() + 1e-12;
      const Vector9 delta = damped.ldlt().solve(fit.b);
      if (!delta.allFinite()) continue;
      const Lamp candidate = moved(lamp, delta, options.max_inverse_distance);
      if (fit_equations(images, state, image, candidate, options.pixels, false).energy > fit.energy) continue;
      lamp = candidate;
      damping = std::max(damping * 0.1, 1e-8);
      break;
    }
  }
  return lamp;
}

}  // namespace

Incidence incidence_of(const Lamp& lamp, const Eigen::Matrix<float, 3, 2>& tangents,
                       const Eigen::Vector3f& offset, const Eigen::Vector3f& normal, float m,
                       bool derivatives) {
  const Eigen::Vector3f u = lamp.direction - lamp.inverse_distance * offset;
  const float u2 = u.squaredNorm(), du = lamp.direction.dot(u), un = u.dot(normal);
  if (un <= 0.0f || du <= 0.0f) return {};
  // v.n = (u.n) k with k = (d.u)^m |u|^-(3+m); change of u and d gives d(v.n) = k (du.n) + (u.n) dk.
  const float k = m == 1.0f ? du / (u2 * u2) : std::pow(du / std::sqrt(u2), m) / (u2 * std::sqrt(u2));
  Incidence result;
  result.value = un * k;
  if (!derivatives) return result;
  const auto change = [&](const Eigen::Vector3f& change_u, const Eigen::Vector3f& change_d) {
    const float dk =
        k * (m * (lamp.direction.dot(change_u) + u.dot(change_d)) / du - (3 + m) * u.dot(change_u) / u2);
    return k * change_u.dot(normal) + un * dk;
  };
  for (int t = 0; t < 2; ++t) result.derivative[t] = change(tangents.col(t), tangents.col(t));
  result.derivative[2] = change(-offset, Eigen::Vector3f::Zero());
  return result;
}

Lamp near_from_far(const Lamp& far, float inverse_distance) {
  Lamp lamp = far;
  lamp.near = true;
  const Eigen::Vector3f sum = far.l.colwise().sum().transpose();
  if (sum.norm() > 0) lamp.direction = sum.normalized();
  lamp.strength = far.l.rowwise().norm();
  lamp.inverse_distance = inverse_distance;
  return lamp;
}

std::vector<Lamp> estimate_near_lamps(const Observations& images, const SurfaceState& state,
                                      const NearLampOptions& options) {
  std::vector<Lamp> lamps(state.lamps.size());
  cv::parallel_for_(cv::Range(0, images.images), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
      lamps[static_cast<size_t>(i)] = fit_lamp(images, state, i, options);
  });
  return lamps;
}

std::vector<LampUncertainty> near_lamp_uncertainty(const Observations& images, const SurfaceState& state,
                                                   const NearLampOptions& options) {
  std::vector<LampUncertainty> result(state.lamps.size());
  for (int i = 0; i < images.images; ++i) {
    const Lamp& lamp = state.lamps[static_cast<size_t>(i)];
    LampFit fit = fit_equations(images, state, i, lamp, options.pixels, true);
    fit.A.diagonal().array() += 1e-12 * fit.A.trace() + 1e-30;
    const double variance = fit.energy / std::max(1.0, fit.samples - 9);
    const Eigen::Matrix3d position = (fit.A.inverse() * variance).topLeftCorner<3, 3>();
    const double kappa = std::max(1e-3, static_cast<double>(lamp.inverse_distance));
    Eigen::Matrix3d J;  // d X / d (tangents, kappa), X = centre + d / kappa
    J.leftCols<2>() = tangents_of(lamp.direction).cast<double>() / kappa;
    J.col(2) = -lamp.direction.cast<double>() / (kappa * kappa);
    LampUncertainty& u = result[static_cast<size_t>(i)];
    u.position_covariance = J * position * J.transpose();
    u.distance_deviation = std::sqrt(std::max(0.0, position(2, 2))) / (kappa * kappa);
    u.direction_deviation = std::sqrt(std::max(0.0, position(0, 0) + position(1, 1)));
  }
  return result;
}

Eigen::Vector3d lamp_position(const Lamp& lamp, const LampScene& scene) {
  const double kappa = std::max(1e-3, static_cast<double>(lamp.inverse_distance));
  return scene.center.cast<double>() + lamp.direction.cast<double>() / kappa;
}

}  // namespace rakelight
