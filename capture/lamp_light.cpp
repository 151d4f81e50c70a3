// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/lamp_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rakelight {
namespace {

constexpr float kColorDominance = 2;  // a channel against the next, relative to white
constexpr float kDarkCell = 0.2F;     // of the mean light a lamp: less is too little to tell shares

using Shares = std::vector<float>;  // over the cells that count

float brightness(const cv::Vec3f& rgb) { return rgb[0] + rgb[1] + rgb[2]; }

double correlation(const Shares& a, const Shares& b) {
  if (a.empty()) return 0;
  const cv::Mat1f x(1, int(a.size()), const_cast<float*>(a.data())),
      y(1, int(b.size()), const_cast<float*>(b.data()));
  cv::Scalar mean_x, mean_y, sigma_x, sigma_y;
  cv::meanStdDev(x, mean_x, sigma_x);
  cv::meanStdDev(y, mean_y, sigma_y);
  const double covariance = x.dot(y) / double(a.size()) - mean_x[0] * mean_y[0];
  return sigma_x[0] > 0 && sigma_y[0] > 0 ? covariance / (sigma_x[0] * sigma_y[0]) : 0;
}

}  // namespace

LampLight::LampLight(const std::vector<RigLamp>& lamps, const CoarseScene& scene,
                     const LampPictures& pictures)
    : lamps_(lamps), scene_(scene), pictures_(pictures) {
  for (std::size_t k = 0; k < lamps.size(); ++k) {
    cv::Mat3f light;
    cv::subtract(pictures.lit[k], pictures.dark, light);
    light_.push_back(light);
    color_.push_back(mean_over_object(light_[k]));
    level_.push_back(own_level(k, color_[k]) / expected(k));
  }
  std::vector<double> sorted = level_;
  std::sort(sorted.begin(), sorted.end());
  typical_ = sorted.empty() ? 0 : sorted[sorted.size() / 2];
}

cv::Vec3f LampLight::mean_over_object(const cv::Mat3f& image) const {
  const cv::Scalar mean = cv::mean(image, pictures_.object);
  return {float(mean[0]), float(mean[1]), float(mean[2])};
}

/// Mean of the channels that the lamp's colour is of.
double LampLight::own_level(std::size_t k, const cv::Vec3f& color) const {
  switch (lamps_[k].color) {
    case LampColor::red:
      return double(color[0]);
    case LampColor::green:
      return double(color[1]);
    case LampColor::blue:
      return double(color[2]);
    default:
      return double(color[0] + color[1] + color[2]) / 3;
  }
}

/// max(0, n . l) / r^2 with the lamp's distance r; nothing where the surface is not known.
std::optional<float> LampLight::shading(std::size_t k, int y, int x) const {
  const cv::Vec3f n = scene_.normals(y, x), p = scene_.points(y, x);
  if (!lamps_[k].position_m || std::isnan(n[0])) return std::nullopt;
  const Eigen::Vector3f to_lamp = lamps_[k].position_m->cast<float>() - Eigen::Vector3f(p[0], p[1], p[2]);
  const float r = to_lamp.norm();
  return std::max(0.0F, Eigen::Vector3f(n[0], n[1], n[2]).dot(to_lamp)) / (r * r * r);
}

/// What geometry leads to expect of a lamp's mean level; 1 without a position.
double LampLight::expected(std::size_t k) const {
  double sum = 0;
  int count = 0;
  for_object([&](int y, int x) {
    if (const auto s = shading(k, y, x)) sum += double(*s), ++count;
  });
  return sum > 0 ? sum / count : 1;
}

template <class Visit>
void LampLight::for_object(const Visit& visit) const {
  for (int y = 0; y < scene_.size.height; ++y) {
    for (int x = 0; x < scene_.size.width; ++x) {
      if (pictures_.object(y, x) != 0) visit(y, x);
    }
  }
}

std::vector<std::size_t> LampLight::placed_lamps() const {
  std::vector<std::size_t> placed;
  for (std::size_t k = 0; k < lamps_.size(); ++k) {
    if (lamps_[k].color == LampColor::white && lamps_[k].position_m && shines(k)) placed.push_back(k);
  }
  return placed;
}

double LampLight::level_in_dark(std::size_t k) const {
  return own_level(k, mean_over_object(pictures_.dark)) / expected(k) / typical_;
}

std::optional<double> LampLight::likeness_to_dark(std::size_t k) const {
  constexpr std::size_t kFewest = 3;
  const std::vector<std::size_t> placed = placed_lamps();
  if (placed.size() < kFewest || !lamps_[k].position_m) return std::nullopt;
  Shares dark, like;
  for_object([&](int y, int x) {
    float all = 0, all_shading = 0;
    for (const std::size_t j : placed) {
      all += brightness(light_[j](y, x)) / std::max(brightness(color_[j]), 1e-6F);
      all_shading += shading(j, y, x).value_or(0);
    }
    const auto own = shading(k, y, x);
    if (!own || all_shading <= 0 || all <= 0) return;
    dark.push_back(brightness(pictures_.dark(y, x)) / all);
    like.push_back(*own / all_shading);
  });
  return correlation(dark, like);
}

LampColor LampLight::seen_color(std::size_t k) const {
  cv::Vec3f white(0, 0, 0);
  for (std::size_t j = 0; j < lamps_.size(); ++j) {
    if (lamps_[j].color == LampColor::white && shines(j)) white += color_[j];
  }
  cv::Vec3f ratio = color_[k];
  for (int c = 0; c < 3; ++c) {
    if (white[c] > 0) ratio[c] /= white[c];
  }
  int first = 0;
  for (int c = 1; c < 3; ++c) {
    if (ratio[c] > ratio[first]) first = c;
  }
  const float second = std::max(ratio[(first + 1) % 3], ratio[(first + 2) % 3]);
  if (ratio[first] < kColorDominance * second) return LampColor::white;
  return std::array{LampColor::red, LampColor::green, LampColor::blue}[std::size_t(first)];
}

std::vector<std::vector<double>> LampLight::likeness(const std::vector<std::size_t>& placed) const {
  std::vector<Shares> seen(placed.size()), predicted(placed.size());
  std::vector<double> mean_shading;
  for (const std::size_t k : placed) mean_shading.push_back(expected(k));
  for_object([&](int y, int x) {
    std::vector<float> light, shade;
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const auto s = shading(placed[i], y, x);
      if (!s) return;
      shade.push_back(*s / float(mean_shading[i]));
      light.push_back(brightness(light_[placed[i]](y, x)) / brightness(color_[placed[i]]));
    }
    float all_light = 0, all_shade = 0;
    for (std::size_t i = 0; i < placed.size(); ++i) all_light += light[i], all_shade += shade[i];
    if (all_light < kDarkCell * float(placed.size()) || all_shade <= 0) return;  // too dark to tell
    for (std::size_t i = 0; i < placed.size(); ++i) {
      seen[i].push_back(light[i] / all_light);
      predicted[i].push_back(shade[i] / all_shade);
    }
  });
  std::vector<std::vector<double>> table(placed.size(), std::vector<double>(placed.size()));
  for (std::size_t i = 0; i < placed.size(); ++i) {
    for (std::size_t j = 0; j < placed.size(); ++j) table[i][j] = correlation(seen[i], predicted[j]);
  }
  return table;
}

}  // namespace rakelight
