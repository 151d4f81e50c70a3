// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_search.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <opencv2/core/utility.hpp>

#include "refine/steps/near_lamp_incidence.h"

namespace rakelight {
namespace {

/// Calls body(direction, inverse distance) for lamps all over the camera's half of the space about the object, and far
/// ones in the direction at hand.
template <class Body>
void for_each_position(const Eigen::Vector3f& at_hand, const Body& body) {
  constexpr int kDirections = 150;  // about 12 degrees apart
  const double turn = M_PI * (3 - std::sqrt(5.0));
  for (int k = -1; k < kDirections; ++k) {
    const double z = -(k + 0.5) / kDirections, r = std::sqrt(1 - z * z);
    const Eigen::Vector3d direction(r * std::cos(turn * k), r * std::sin(turn * k), z);
    for (const float inverse_distance : {0.0f, 0.5f, 1.0f, 1.4f, 1.8f, 2.3f, 2.8f})
      body(k < 0 ? at_hand : Eigen::Vector3f(direction.cast<float>()), inverse_distance);
  }
}

/// Fits strength and ambient light of a lamp at its place. @return sum |I - rho S| over some pixels
double fit_strength(const Observations& images, const SurfaceState& state, int image, Lamp& lamp) {
  const int stride = std::max(1, images.pixels / 1000);
  std::vector<float> value;
  for (int p = 0; p < images.pixels; p += stride)
    value.push_back(incidence_of(lamp, kNoTangents, state.points.col(p) - state.scene.center,
                                 state.normals.col(p), state.scene.lobe_exponent, false)
                        .value);
  double misfit = 0;
  for (int c = 0; c < 3; ++c) {
    const ChannelSamples I = images.channel(image, c);
    Eigen::Matrix2d A = 1e-9 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    const auto row = [&](size_t k, int p) -> Eigen::Vector2d {
      return static_cast<double>(state.albedo(c, p)) * Eigen::Vector2d(static_cast<double>(value[k]), 1);
    };
    for (size_t k = 0; k < value.size(); ++k) {
      const int p = stride * static_cast<int>(k);
      if (!I.usable(p)) continue;
      const Eigen::Vector2d h = row(k, p);
      A += h * h.transpose();
      b += static_cast<double>(I[p]) * h;
    }
    Eigen::Vector2d s = A.ldlt().solve(b);
    if (s[0] < 0 || s[1] < 0)
      s = s[0] < 0 ? Eigen::Vector2d(0, b[1] / A(1, 1)) : Eigen::Vector2d(b[0] / A(0, 0), 0);
    for (size_t k = 0; k < value.size(); ++k) {
      const int p = stride * static_cast<int>(k);
      if (I.usable(p)) misfit += std::abs(s.dot(row(k, p)) - static_cast<double>(I[p]));
    }
    lamp.strength[c] = static_cast<float>(s[0]);
    lamp.phi[c] = static_cast<float>(s[1]);
  }
  return misfit;
}

}  // namespace

std::vector<Lamp> search_near_lamps(const Observations& images, const SurfaceState& state) {
  std::vector<Lamp> lamps = state.lamps;
  cv::parallel_for_(cv::Range(0, images.images), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      Lamp& lamp = lamps[static_cast<size_t>(i)];
      if (!lamp.near) continue;
      double least = std::numeric_limits<double>::infinity();
      for_each_position(Eigen::Vector3f(lamp.direction),
                        [&](const Eigen::Vector3f& direction, float inverse_distance) {
                          Lamp candidate = lamp;
                          candidate.direction = direction;
                          candidate.inverse_distance = inverse_distance;
                          const double misfit = fit_strength(images, state, i, candidate);
                          if (misfit >= least) return;
                          least = misfit;
                          lamp = candidate;
                        });
    }
  });
  return lamps;
}

}  // namespace rakelight
