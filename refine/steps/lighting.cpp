// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/lighting.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <limits>
#include <opencv2/core/utility.hpp>

#include "refine/kernels/image_kernels.h"
#include "refine/kernels/plain_kernels.h"
#include "refine/tiles.h"

namespace rakelight {
namespace {

/// Normal equations of one image and channel; N = 4 or 9 unknowns.
template <int N>
struct LightEquations {
  Eigen::Matrix<double, N, N> A = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, 1> b = Eigen::Matrix<double, N, 1>::Zero();
};

/// What S is linear in: n, 1 and the five harmonics that second_order_matrix puts into Q.
Eigen::Matrix<float, 9, 1> harmonics(const Eigen::Vector3f& n) {
  const float x = n.x(), y = n.y(), z = n.z();
  Eigen::Matrix<float, 9, 1> h;
  h << x, y, z, 1.0f, 2 * x * y, 2 * x * z, 2 * y * z, x * x - y * y, 3 * z * z - 1;
  return h;
}

/// Q of n' Q n = s . (the last five harmonics).
Eigen::Matrix3f second_order_matrix(const Eigen::Matrix<float, 5, 1>& s) {
  Eigen::Matrix3f Q;
  Q << s[3] - s[4], s[0], s[1], s[0], -s[3] - s[4], s[2], s[1], s[2], 2 * s[4];
  return Q;
}

/// Second order. Sums run in float over short runs of pixels, in double over the runs, in a fixed order.
LightEquations<9> second_order_equations(const Observations& images, int image, int channel,
                                         const SurfaceState& state) {
  constexpr int N = 9;
  const ChannelSamples radiance = images.channel(image, channel);
  constexpr Eigen::Index kRun = 256;
  LightEquations<N> sum;
  for (Eigen::Index begin = 0; begin < state.normals.cols(); begin += kRun) {
    const Eigen::Index end = std::min(begin + kRun, state.normals.cols());
    Eigen::Matrix<float, N, N> A = Eigen::Matrix<float, N, N>::Zero();
    Eigen::Matrix<float, N, 1> b = Eigen::Matrix<float, N, 1>::Zero();
    for (Eigen::Index p = begin; p < end; ++p) {
      const Eigen::Matrix<float, N, 1> h = harmonics(state.normals.col(p));
      const float rho = state.albedo(channel, p);
      const float trust =
          radiance.usable(static_cast<int>(p)) ? state.trust(image, static_cast<int>(p)) : 0.0f;
      A.noalias() += (trust * rho * rho) * h * h.transpose();
      b += (trust * rho * radiance[static_cast<int>(p)]) * h;
    }
    sum.A += A.cast<double>();
    sum.b += b.cast<double>();
  }
  return sum;
}

/// Solves one channel's equations into the lamp, which stays as it is when they are singular.
template <int N>
void solve_channel(const LightEquations<N>& sum, int channel, Lamp& lamp) {
  using Square = Eigen::Matrix<double, N, N>;
  const double ridge = 1e-9 * sum.A.trace() + 1e-12;
  const Eigen::LDLT<Square> factor(sum.A + ridge * Square::Identity());
  const Eigen::Matrix<double, N, 1> solution = factor.solve(sum.b);
  if (factor.info() != Eigen::Success || !solution.allFinite()) return;
  const Eigen::Matrix<float, N, 1> s = solution.template cast<float>();
  lamp.l.row(channel) = s.template head<3>().transpose();
  lamp.phi[channel] = s[3];
  if constexpr (N == 9) lamp.Q[static_cast<size_t>(channel)] = second_order_matrix(s.template tail<5>());
}

/// First order: the equations of every image and channel.
class FirstOrderSums {
 public:
  explicit FirstOrderSums(size_t images = 0) : sums_(3 * images) {}

  void add(size_t image, const float (&A)[3][10], const float (&b)[3][4]) {
    for (size_t c = 0; c < 3; ++c) {
      Numbers& sum = sums_[3 * image + c];
      for (size_t k = 0; k < 10; ++k) sum[k] += static_cast<double>(A[c][k]);
      for (size_t k = 0; k < 4; ++k) sum[10 + k] += static_cast<double>(b[c][k]);
    }
  }

  FirstOrderSums& operator+=(const FirstOrderSums& other) {
    for (size_t i = 0; i < sums_.size(); ++i)
      for (size_t k = 0; k < sums_[i].size(); ++k) sums_[i][k] += other.sums_[i][k];
    return *this;
  }

  LightEquations<4> of(size_t image, size_t channel) const {
    const Numbers& sum = sums_[3 * image + channel];
    LightEquations<4> equations;
    size_t k = 0;
    for (Eigen::Index row = 0; row < 4; ++row)
      for (Eigen::Index column = row; column < 4; ++column)
        equations.A(row, column) = equations.A(column, row) = sum[k++];
    for (Eigen::Index row = 0; row < 4; ++row) equations.b[row] = sum[k++];
    return equations;
  }

 private:
  using Numbers = std::array<double, 14>;  ///< A's upper triangle by rows, then b
  std::vector<Numbers> sums_;
};

/// Four unknowns a channel are known to 1e-4 from this many pixels, spread evenly over the surface; more cost time alone.
constexpr int kEnoughPixels = 1 << 17;

/// The lights' sums over a tile.
class LightsOfTile {
 public:
  explicit LightsOfTile(size_t images) : b_(images) {}

  /// @param shadows the lamps whose attached shadows are left out
  void add(Tile& tile, const std::vector<kernels::TileLamp>& shadows, FirstOrderSums& sums) {
    for (const TileStretch& stretch : tile.stretches(shadows)) {
      if (!stretch.plain.empty()) add_plain(tile, shadows, stretch, sums);
      for (const int i : stretch.others) {
        const auto at = static_cast<size_t>(i);
        kernels::LightSums of_image;
        kernels::light_sums(tile.surface(), shadows[at], tile.image(i), stretch.pixels, of_image);
        sums.add(at, of_image.A, of_image.b);
      }
    }
  }

 private:
  struct Rhs {
    float of_channel[3][4];
  };

  void add_plain(Tile& tile, const std::vector<kernels::TileLamp>& shadows, const TileStretch& stretch,
                 FirstOrderSums& sums) {
    kernels::plain_lights(tile.surface(), stretch.pixels, shared_);
    kernels::plain_light_rhs(tile.surface(), shared_, chosen(shadows, tile, stretch.plain), stretch.pixels,
                             &b_.data()->of_channel);
    for (const int i : stretch.plain)
      sums.add(static_cast<size_t>(i), shared_.A, b_[static_cast<size_t>(i)].of_channel);
  }

  kernels::PlainLights shared_;
  std::vector<Rhs> b_;  ///< [image]
};

FirstOrderSums first_order_sums(const Observations& images, const SurfaceState& state,
                                const std::vector<kernels::TileLamp>& shadows) {
  const FirstOrderSums none(shadows.size());
  const int step = kernels::kTilePixels * std::max(1, images.pixels / kEnoughPixels);
  return sum_over_blocks(images.pixels, none, [&](int begin, int end) {
    FirstOrderSums sums = none;
    Tile tile(images, state, step);
    LightsOfTile of_tile(shadows.size());
    for (int p = begin; p < end; p += step) {
      tile.move_to(p, std::min(kernels::kTilePixels, end - p));
      of_tile.add(tile, shadows, sums);
    }
    return sums;
  });
}

void estimate_first_order(const Observations& images, const SurfaceState& state, bool clamp,
                          std::vector<Lamp>& lamps) {
  std::vector<kernels::TileLamp> shadows;
  for (const Lamp& lamp : lamps) {
    shadows.push_back(tile_lamp(lamp, state));
    if (!clamp) shadows.back().least = -std::numeric_limits<float>::infinity();
  }
  const FirstOrderSums sums = first_order_sums(images, state, shadows);
  for (size_t i = 0; i < lamps.size(); ++i)
    for (int c = 0; c < 3; ++c) solve_channel(sums.of(i, static_cast<size_t>(c)), c, lamps[i]);
}

void estimate_second_order(const Observations& images, const SurfaceState& state, std::vector<Lamp>& lamps) {
  cv::parallel_for_(cv::Range(0, images.images), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
      for (int c = 0; c < 3; ++c)
        solve_channel(second_order_equations(images, i, c, state), c, lamps[static_cast<size_t>(i)]);
  });
}

}  // namespace

std::vector<Lamp> estimate_far_lamps(const Observations& images, const SurfaceState& state) {
  const bool first = state.lamps.empty();
  std::vector<Lamp> lamps = first ? std::vector<Lamp>(static_cast<size_t>(images.images)) : state.lamps;
  for (Lamp& lamp : lamps) {
    lamp.near = false;
    lamp.second_order = state.harmonics == 2;
  }
  if (state.harmonics == 2)
    estimate_second_order(images, state, lamps);
  else
    estimate_first_order(images, state, state.attached_shadows && !first, lamps);
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
  const Eigen::Vector3d squares =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread / count).eigenvalues();
  return squares.cwiseMax(0.0).cwiseSqrt().reverse();
}

}  // namespace rakelight
