// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/lighting.h"

#include <Eigen/Dense>
#include <algorithm>
#include <opencv2/core/utility.hpp>

namespace rakelight {
namespace {

/// Normal equations of one image and channel.
struct LightEquations {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
};

/// Sums run in float over short runs of pixels, in double over the runs, in a fixed order.
LightEquations light_equations(const Observations& images, int image, int channel, const SurfaceState& state,
                               const Lamp& lamp, bool clamp) {
  const float* radiance = images.channel(image, channel);
  const unsigned char* usable = images.usable_in(image, channel);
  const float* weight = state.weight.data() + static_cast<size_t>(image) * static_cast<size_t>(images.pixels);
  constexpr Eigen::Index kRun = 256;
  LightEquations sum;
  const Eigen::Vector3f l = lamp.l.row(channel).transpose();
  for (Eigen::Index begin = 0; begin < state.normals.cols(); begin += kRun) {
    const Eigen::Index end = std::min(begin + kRun, state.normals.cols());
    Eigen::Matrix3f nn = Eigen::Matrix3f::Zero();
    Eigen::Vector3f n1 = Eigen::Vector3f::Zero(), nI = Eigen::Vector3f::Zero();
    float ones = 0, I1 = 0;
    for (Eigen::Index p = begin; p < end; ++p) {
      const auto n = state.normals.col(p);
      const float rho = state.albedo(channel, p);
      const float trust = weight[p] * static_cast<float>(usable[p]);
      const float w = trust * rho * rho, wI = trust * rho * radiance[p];
      ones += w;
      I1 += wI;
      const float lit = clamp && l.dot(n) <= 0.0f ? 0.0f : 1.0f;
      nn += (lit * w) * n * n.transpose();
      n1 += (lit * w) * n;
      nI += (lit * wI) * n;
    }
    sum.A.topLeftCorner<3, 3>() += nn.cast<double>();
    sum.A.topRightCorner<3, 1>() += n1.cast<double>();
    sum.A(3, 3) += static_cast<double>(ones);
    sum.b.head<3>() += nI.cast<double>();
    sum.b[3] += static_cast<double>(I1);
  }
  sum.A.bottomLeftCorner<1, 3>() = sum.A.topRightCorner<3, 1>().transpose();
  return sum;
}

}  // namespace

std::vector<Lamp> estimate_far_lamps(const Observations& images, const SurfaceState& state) {
  std::vector<Lamp> lamps(static_cast<size_t>(images.images));
  const bool first = state.lamps.empty();
  cv::parallel_for_(cv::Range(0, images.images), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      const Lamp old = first ? Lamp{} : state.lamps[static_cast<size_t>(i)];
      Lamp& lamp = lamps[static_cast<size_t>(i)] = old;
      lamp.near = false;
      for (int c = 0; c < 3; ++c) {
        const bool clamp = state.attached_shadows && !first;
        const LightEquations sum = light_equations(images, i, c, state, old, clamp);
        const double ridge = 1e-9 * sum.A.trace() + 1e-12;
        const auto factor = (sum.A + ridge * Eigen::Matrix4d::Identity()).eval().ldlt();
        const Eigen::Vector4d s = factor.solve(sum.b);
        if (factor.info() != Eigen::Success || !s.allFinite()) continue;
        lamp.l.row(c) = s.head<3>().cast<float>().transpose();
        lamp.phi[c] = static_cast<float>(s[3]);
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
