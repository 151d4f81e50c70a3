// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "refine/steps/near_lamp_prior.h"

namespace rakelight {
namespace {

/// Samples whose errors agree: those of the rough shape and albedo that the search has to do with reach far.
constexpr float kSamplesThatAgree = 100;

/// Some of the surface, evenly spread.
std::vector<int> sample_of_pixels(int pixels) {
  std::vector<int> sample;
  for (int p = 0; p < pixels; p += std::max(1, pixels / 1000)) sample.push_back(p);
  return sample;
}

/// One image at the sampled pixels, a row a pixel, a column a channel; zero where a sample cannot be used and past the
/// last pixel.
struct SampledImage {
  Eigen::ArrayX3f I, rho;

  SampledImage(const Observations& images, const SurfaceState& state, int image,
               const std::vector<int>& pixels)
      : I(Eigen::ArrayX3f::Zero(padded(pixels.size()), 3)), rho(I) {
    for (size_t j = 0; j < pixels.size(); ++j) {
      const Eigen::Array3f usable = images.usable_channels(image, pixels[j]);
      const auto row = static_cast<Eigen::Index>(j);
      I.row(row) = (usable * images.radiance_at(image, pixels[j]).array()).transpose();
      rho.row(row) = (usable * state.albedo.col(pixels[j]).array()).transpose();
    }
  }
};

/// Strength and ambient light, neither below zero, that fit one channel best: A (s, phi) = b.
Eigen::Vector2f fit_strength(const Eigen::Matrix2f& A, const Eigen::Vector2f& b) {
  Eigen::Vector2f s =
      (A.cast<double>() + 1e-9 * Eigen::Matrix2d::Identity()).ldlt().solve(b.cast<double>()).cast<float>();
  if (s[0] < 0) return {0, b[1] / std::max(1e-9f, A(1, 1))};
  if (s[1] < 0) return {b[0] / std::max(1e-9f, A(0, 0)), 0};
  return s;
}

/// A lamp tried at a place.
struct Trial {
  Lamp lamp;
  float misfit = 0;     ///< mean |I - rho S|
  float log_power = 0;  ///< of refine/steps/near_lamp_prior.h
};

void try_places(const PlaceTable& table, const SampledImage& image, const Lamp& lamp,
                std::vector<Trial>& trials) {
  const auto count = static_cast<Eigen::Index>(table.places.size());
  const Eigen::MatrixX3f rho2 = image.rho.square(), rhoI = image.rho * image.I;
  const Eigen::MatrixX3f v = table.value.transpose() * rho2, vI = table.value.transpose() * rhoI;
  const Eigen::MatrixX3f vv = table.square.transpose() * rho2;
  const Eigen::RowVector3f one = rho2.colwise().sum(), I = rhoI.colwise().sum();
  for (Eigen::Index k = 0; k < count; ++k) {
    Trial trial{lamp};
    for (int c = 0; c < 3; ++c) {
      Eigen::Matrix2f A;
      A << vv(k, c), v(k, c), v(k, c), one[c];
      const Eigen::Vector2f s = fit_strength(A, {vI(k, c), I[c]});
      trial.misfit +=
          (image.rho.col(c) * (s[0] * table.value.col(k).array() + s[1]) - image.I.col(c)).abs().mean();
      trial.lamp.strength[c] = s[0];
      trial.lamp.phi[c] = s[1];
    }
    trial.lamp.direction = table.places[static_cast<size_t>(k)].direction;
    trial.lamp.inverse_distance = table.places[static_cast<size_t>(k)].inverse_distance;
    trial.log_power = static_cast<float>(log_lamp_power(trial.lamp));
    trials.push_back(trial);
  }
}

/// The trial that image and the rig's usual log power (if known) make most likely: residuals of unknown scale, of which
/// kSamplesThatAgree agree.
const Trial& best_of(const std::vector<Trial>& trials, const float* usual_log_power, size_t samples) {
  const auto score = [&](const Trial& trial) {
    const float fit = static_cast<float>(samples) / kSamplesThatAgree * std::log(trial.misfit + 1e-9f);
    if (!usual_log_power) return fit;
    const float off = (trial.log_power - *usual_log_power) / static_cast<float>(kLogPowerDeviation);
    return fit + 0.5f * off * off;
  };
  return *std::min_element(trials.begin(), trials.end(),
                           [&](const Trial& a, const Trial& b) { return score(a) < score(b); });
}

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

NearLampSearch::NearLampSearch(const Observations& images, const SurfaceState& state)
    : images_(images),
      pixels_(sample_of_pixels(images.pixels)),
      surface_(state.points, state.normals, pixels_),
      everywhere_(places_everywhere(), state.scene, surface_) {}

std::vector<Lamp> NearLampSearch::lamps(const SurfaceState& state) const {
  std::vector<std::vector<Trial>> trials(state.lamps.size());
  cv::parallel_for_(cv::Range(0, images_.images), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      const Lamp& lamp = state.lamps[static_cast<size_t>(i)];
      if (!lamp.near) continue;
      const SampledImage image(images_, state, i, pixels_);
      std::vector<LampPlace> at_hand;
      add_places(lamp.direction, at_hand);
      try_places(PlaceTable(at_hand, state.scene, surface_), image, lamp, trials[static_cast<size_t>(i)]);
      try_places(everywhere_, image, lamp, trials[static_cast<size_t>(i)]);
    }
  });
  const size_t samples = 3 * pixels_.size();
  std::vector<float> log_powers;
  for (const auto& of_lamp : trials)
    if (!of_lamp.empty()) log_powers.push_back(best_of(of_lamp, nullptr, samples).log_power);
  if (log_powers.empty()) return state.lamps;
  const float usual = median(log_powers);
  std::vector<Lamp> lamps = state.lamps;
  for (size_t i = 0; i < lamps.size(); ++i)
    if (!trials[i].empty()) lamps[i] = best_of(trials[i], &usual, samples).lamp;
  return lamps;
}

}  // namespace rakelight
