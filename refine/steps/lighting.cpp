// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/lighting.h"

#include <Eigen/Dense>
#include <algorithm>
#include <opencv2/core/utility.hpp>

namespace rakelight {
namespace {

/// Normal equations of one image and channel; N = 4 or 9 unknowns.
template <int N>
struct LightEquations {
  Eigen::Matrix<double, N, N> A = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, 1> b = Eigen::Matrix<double, N, 1>::Zero();
};

/// What S is linear in: n, 1 and, in the second order, the five harmonics that second_order_matrix puts into Q.
template <int N>
Eigen::Matrix<float, N, 1> harmonics(const Eigen::Vector3f& n) {
  Eigen::Matrix<float, N, 1> h;
  h.template head<4>() << n.x(), n.y(), n.z(), 1.0f;
  if constexpr (N == 9) {
    const float x = n.x(), y = n.y(), z = n.z();
    h.template tail<5>() << 2 * x * y, 2 * x * z, 2 * y * z, x * x - y * y, 3 * z * z - 1;
  }
  return h;
}

/// Q of n' Q n = s . (the last five harmonics).
Eigen::Matrix3f second_order_matrix(const Eigen::Matrix<float, 5, 1>& s) {
  Eigen::Matrix3f Q;
  Q << s[3] - s[4], s[0], s[1],
       s[0], -s[3] - s[4], s[2],
       s[1], s[2], 2 * s[4];
  return Q;
}

/// Sums run in float over short runs of pixels, in double over the runs, in a fixed order.
template <int N>
LightEquations<N> light_equations(const Observations& images, int image, int channel, const SurfaceState& state,
                                  const Lamp& lamp, bool clamp) {
  const float* radiance = images.channel(image, channel);
  const unsigned char* usable = images.usable_in(image, channel);
  const float* weight = state.weight.data() + static_cast<size_t>(image) * static_cast<size_t>(images.pixels);
  constexpr Eigen::Index kRun = 256;
  LightEquations<N> sum;
  const Eigen::Vector3f l = lamp.l.row(channel).transpose();
  for (Eigen::Index begin = 0; begin < state.normals.cols(); begin += kRun) {
    const Eigen::Index end = std::min(begin + kRun, state.normals.cols());
    Eigen::Matrix<float, N, N> A = Eigen::Matrix<float, N, N>::Zero();
    Eigen::Matrix<float, N, 1> b = Eigen::Matrix<float, N, 1>::Zero();
    for (Eigen::Index p = begin; p < end; ++p) {
      const Eigen::Vector3f n = state.normals.col(p);
      Eigen::Matrix<float, N, 1> h = harmonics<N>(n);
      if (clamp && l.dot(n) <= 0.0f) h.template head<3>().setZero();
      const float rho = state.albedo(channel, p);
      const float trust = weight[p] * static_cast<float>(usable[p]);
      A.noalias() += (trust * rho * rho) * h * h.transpose();
      b += (trust * rho * radiance[p]) * h;
    }
    sum.A += A.template cast<double>();
    sum.b += b.template cast<double>();
  }
  return sum;
}

template <int N>
void estimate_channel(const Observations& images, int image, int channel, const SurfaceState& state, bool clamp,
                      Lamp& lamp) {
  using Square = Eigen::Matrix<double, N, N>;
  const LightEquations<N> sum = light_equations<N>(images, image, channel, state, lamp, clamp);
  const double ridge = 1e-9 * sum.A.trace() + 1e-12;
  const Eigen::LDLT<Square> factor(sum.A + ridge * Square::Identity());
  const Eigen::Matrix<double, N, 1> solution = factor.solve(sum.b);
  if (factor.info() != Eigen::Success || !solution.allFinite()) return;
  const Eigen::Matrix<float, N, 1> s = solution.template cast<float>();
  lamp.l.row(channel) = s.template head<3>().transpose();
  lamp.phi[channel] = s[3];
  if constexpr (N == 9) lamp.Q[static_cast<size_t>(channel)] = second_order_matrix(s.template tail<5>());
}

}  // namespace

std::vector<Lamp> estimate_far_lamps(const Observations& images, const SurfaceState& state) {
  std::vector<Lamp> lamps(static_cast<size_t>(images.images));
  const bool first = state.lamps.empty();
  const bool clamp = state.attached_shadows && !first;
  cv::parallel_for_(cv::Range(0, images.images), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      Lamp& lamp = lamps[static_cast<size_t>(i)] = first ? Lamp{} : state.lamps[static_cast<size_t>(i)];
      lamp.near = false;
      lamp.second_order = state.harmonics == 2;
      for (int c = 0; c < 3; ++c) {
        if (lamp.second_order)
          estimate_channel<9>(images, i, c, state, false, lamp);
        else
          estimate_channel<4>(images, i, c, state, clamp, lamp);
      }
    }
  });
  return lamps;
}

Eigen::Vector3d lamp_singular_values(const std::vector<Lamp>& lamps, const LampScene& scene) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double count = 0;
  for (const Lamp& lamp : lamps) {
    const LocalLight light = light_at(lamp, scene.center, scene);
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d l = light.l.row(c).cast<double>().transpose();
      if (l.norm() < 1e-9) continue;
      spread += l.normalized() * l.normalized().transpose();
      ++count;
    }
  }
  if (count == 0) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d squares = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread / count).eigenvalues();
  return squares.cwiseMax(0.0).cwiseSqrt().reverse();
}

}  // namespace rakelight
