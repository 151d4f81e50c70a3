// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/albedo_palette.h"

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace rakelight {
namespace {

constexpr int kSamples = 4000;  // enough for modes good to a percent
constexpr int kMaxShifts = 50;
constexpr double kLeastShare = 0.003;  // of the pixels, for a colour to be one of the palette's

Eigen::Matrix3Xd every_nth(const Eigen::Matrix3Xd& points) {
  const Eigen::Index step = std::max<Eigen::Index>(1, points.cols() / kSamples);
  Eigen::Matrix3Xd samples(3, (points.cols() + step - 1) / step);
  for (Eigen::Index i = 0; i < samples.cols(); ++i) samples.col(i) = points.col(i * step);
  return samples;
}

/// Means of the samples in each occupied cube of the bandwidth's size.
std::vector<Eigen::Vector3d> seeds(const Eigen::Matrix3Xd& samples, double bandwidth) {
  std::map<std::array<long, 3>, std::pair<Eigen::Vector3d, int>> cubes;
  for (Eigen::Index i = 0; i < samples.cols(); ++i) {
    const Eigen::Vector3d x = samples.col(i);
    const auto cube = [&](int c) { return std::lround(std::floor(x[c] / bandwidth)); };
    auto& [sum, count] =
        cubes.try_emplace({cube(0), cube(1), cube(2)}, Eigen::Vector3d::Zero(), 0).first->second;
    sum += x;
    ++count;
  }
  std::vector<Eigen::Vector3d> means;
  for (const auto& [key, cube] : cubes) {
    if (cube.second >= kLeastShare * static_cast<double>(samples.cols()))
      means.push_back(cube.first / cube.second);
  }
  return means;
}

/// Moves x up the density. Flat kernel: the mean of all samples within the bandwidth.
Eigen::Vector3d shift_to_mode(const Eigen::Matrix3Xd& samples, Eigen::Vector3d x, double bandwidth) {
  for (int k = 0; k < kMaxShifts; ++k) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double total = 0;
    for (Eigen::Index i = 0; i < samples.cols(); ++i) {
      if ((samples.col(i) - x).squaredNorm() > bandwidth * bandwidth) continue;
      sum += samples.col(i);
      ++total;
    }
    if (total == 0) return x;
    const Eigen::Vector3d mean = sum / total;
    const bool still = (mean - x).norm() < 1e-3 * bandwidth;
    x = mean;
    if (still) break;
  }
  return x;
}

}  // namespace

Eigen::Matrix3Xd palette_modes(const Eigen::Matrix3Xd& log_albedo, double bandwidth) {
  const Eigen::Matrix3Xd samples = every_nth(log_albedo);
  std::vector<Eigen::Vector3d> modes;
  for (const Eigen::Vector3d& seed : seeds(samples, bandwidth)) {
    const Eigen::Vector3d mode = shift_to_mode(samples, seed, bandwidth);
    bool known = false;
    for (const Eigen::Vector3d& other : modes) known = known || (other - mode).norm() < bandwidth / 2;
    if (!known) modes.push_back(mode);
  }
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(modes.size()));
  for (size_t k = 0; k < modes.size(); ++k) result.col(static_cast<Eigen::Index>(k)) = modes[k];
  return result;
}

PalettePull palette_pull(const Eigen::Matrix3Xd& log_albedo, double bandwidth) {
  const Eigen::Matrix3Xd modes = palette_modes(log_albedo, bandwidth);
  PalettePull pull{log_albedo, Eigen::VectorXd::Zero(log_albedo.cols())};
  if (modes.cols() == 0) return pull;
  for (Eigen::Index p = 0; p < log_albedo.cols(); ++p) {
    Eigen::Index nearest = 0;
    const double squared = (modes.colwise() - log_albedo.col(p)).colwise().squaredNorm().minCoeff(&nearest);
    pull.color.col(p) = modes.col(nearest);
    pull.trust[p] = std::exp(-squared / (2 * bandwidth * bandwidth));
  }
  return pull;
}

}  // namespace rakelight
