// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/lamp_faults.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace rakelight {
namespace {

constexpr double kNoLight = 0.08, kDim = 0.5;  // of the expected level
constexpr double kStuckLevel = 0.35;    // light in the dark frame, of a lamp's level: more than a room's
constexpr double kStuckLikeness = 0.5;  // correlation of the dark's share with the lamp's
constexpr double kSwapMargin = 0.08;    // by which the other lamp must explain a picture better
constexpr float kColorDominance = 2;    // a channel against the next, relative to white
constexpr std::size_t kFewestForShares = 3;

using Shares = std::vector<float>;  // over the cells that count

class FaultFinder {
 public:
  FaultFinder(const std::vector<RigLamp>& lamps, const CoarseScene& scene, const LampPictures& pictures)
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

  std::vector<LampFault> find() {
    if (typical_ <= 0) return all_dark();
    find_by_level();
    find_swapped_colors();
    find_swapped_places();
    return std::move(faults_);
  }

 private:
  double share_of_typical(std::size_t k) const { return level_[k] / typical_; }
  bool gives_light(std::size_t k) const { return share_of_typical(k) >= kNoLight; }

  cv::Vec3f mean_over_object(const cv::Mat3f& image) const {
    const cv::Scalar mean = cv::mean(image, pictures_.object);
    return {float(mean[0]), float(mean[1]), float(mean[2])};
  }

  /// Mean of the channels that the lamp's colour is of.
  double own_level(std::size_t k, const cv::Vec3f& color) const {
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
  std::optional<float> shading(std::size_t k, int y, int x) const {
    const cv::Vec3f n = scene_.normals(y, x), p = scene_.points(y, x);
    if (!lamps_[k].position_m || std::isnan(n[0])) return std::nullopt;
    const Eigen::Vector3f to_lamp = lamps_[k].position_m->cast<float>() - Eigen::Vector3f(p[0], p[1], p[2]);
    const float r = to_lamp.norm();
    return std::max(0.0F, Eigen::Vector3f(n[0], n[1], n[2]).dot(to_lamp)) / (r * r * r);
  }

  /// What geometry leads to expect of a lamp's mean level; 1 without a position.
  double expected(std::size_t k) const {
    double sum = 0;
    int count = 0;
    for_object([&](int y, int x) {
      if (const auto s = shading(k, y, x)) sum += double(*s), ++count;
    });
    return sum > 0 ? sum / count : 1;
  }

  template <class Visit>
  void for_object(const Visit& visit) const {
    for (int y = 0; y < scene_.size.height; ++y) {
      for (int x = 0; x < scene_.size.width; ++x) {
        if (pictures_.object(y, x) != 0) visit(y, x);
      }
    }
  }

  void report(LampFault::Kind kind, std::size_t k, double level, const std::string& text,
              std::string other = {}) {
    faults_.push_back({kind, lamps_[k].id, std::move(other), level, "lamp '" + lamps_[k].id + "' " + text});
  }

  std::vector<LampFault> all_dark() {
    for (std::size_t k = 0; k < lamps_.size(); ++k)
      report(LampFault::Kind::no_light, k, 0,
             "gives no light; check its wiring, its line in the rig file and its supply");
    return std::move(faults_);
  }

  void find_by_level() {
    for (std::size_t k = 0; k < lamps_.size(); ++k) {
      const double level = share_of_typical(k);
      if (level >= kDim) continue;
      if (level >= kNoLight) {
        report(LampFault::Kind::dim, k, level,
               "is dim: " + percent(level) +
                   " of the light that the others lead to expect; clean it, or check its current");
      } else if (lights_the_dark(k)) {
        report(LampFault::Kind::stuck_on, k, 1,
               "is stuck on: it lights the dark frames; check its switch and line");
      } else {
        report(LampFault::Kind::no_light, k, level,
               "gives no light; it is burnt out, unplugged or stuck off");
      }
    }
  }

  static std::string percent(double share) {
    char text[16];
    std::snprintf(text, sizeof text, "%.0f %%", 100 * share);
    return text;
  }

  /// Whether the dark is as bright as a lamp and, where the lamp's place is known, comes from there.
  bool lights_the_dark(std::size_t k) const {
    if (own_level(k, mean_over_object(pictures_.dark)) / expected(k) < kStuckLevel * typical_) return false;
    const std::vector<std::size_t> placed = placed_lamps();
    if (placed.size() < kFewestForShares || !lamps_[k].position_m) return true;
    std::vector<float> dark, like;
    for_object([&](int y, int x) {
      float all = 0, all_shading = 0;
      for (const std::size_t j : placed) {
        all += brightness(light_[j](y, x)) / std::max(mean_brightness(j), 1e-6F);
        all_shading += shading(j, y, x).value_or(0);
      }
      const auto own = shading(k, y, x);
      if (!own || all_shading <= 0 || all <= 0) return;
      dark.push_back(brightness(pictures_.dark(y, x)) / all);
      like.push_back(*own / all_shading);
    });
    return correlation(dark, like) > kStuckLikeness;
  }

  static float brightness(const cv::Vec3f& rgb) { return rgb[0] + rgb[1] + rgb[2]; }
  float mean_brightness(std::size_t k) const { return brightness(color_[k]); }

  /// White lamps that light and whose places are known.
  std::vector<std::size_t> placed_lamps() const {
    std::vector<std::size_t> placed;
    for (std::size_t k = 0; k < lamps_.size(); ++k) {
      if (lamps_[k].color == LampColor::white && lamps_[k].position_m && gives_light(k)) placed.push_back(k);
    }
    return placed;
  }

  static double correlation(const Shares& a, const Shares& b) {
    if (a.empty()) return 0;
    const cv::Mat1f x(1, int(a.size()), const_cast<float*>(a.data())),
        y(1, int(b.size()), const_cast<float*>(b.data()));
    cv::Scalar mean_x, mean_y, sigma_x, sigma_y;
    cv::meanStdDev(x, mean_x, sigma_x);
    cv::meanStdDev(y, mean_y, sigma_y);
    const double covariance = x.dot(y) / double(a.size()) - mean_x[0] * mean_y[0];
    return sigma_x[0] > 0 && sigma_y[0] > 0 ? covariance / (sigma_x[0] * sigma_y[0]) : 0;
  }

  /// The colour a picture is lit by, against what white lamps show of the object.
  LampColor seen_color(std::size_t k) const {
    cv::Vec3f white(0, 0, 0);
    for (std::size_t j = 0; j < lamps_.size(); ++j) {
      if (lamps_[j].color == LampColor::white && gives_light(j)) white += color_[j];
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

  void find_swapped_colors() {
    for (std::size_t k = 0; k < lamps_.size(); ++k) {
      for (std::size_t j = k + 1; j < lamps_.size(); ++j) {
        if (lamps_[k].color == lamps_[j].color || lamps_[k].color == seen_color(k)) continue;
        if (seen_color(k) == lamps_[j].color && seen_color(j) == lamps_[k].color) {
          drop_level_faults(k, j);
          report_swap(k, j);
        }
      }
    }
  }

  /// A swapped coloured lamp leaves its own channel dark: that is no second fault.
  void drop_level_faults(std::size_t k, std::size_t j) {
    const auto of_pair = [&](const LampFault& f) { return f.lamp == lamps_[k].id || f.lamp == lamps_[j].id; };
    faults_.erase(std::remove_if(faults_.begin(), faults_.end(), of_pair), faults_.end());
  }

  void report_swap(std::size_t k, std::size_t j) {
    report(LampFault::Kind::swapped, k, 1,
           "is swapped with lamp '" + lamps_[j].id +
               "': each picture shows the other's light; swap their lines in the rig file",
           lamps_[j].id);
  }

  /// likeness[i][j]: correlation of picture i's share of light with the share that lamp j would have.
  std::vector<std::vector<double>> likeness(const std::vector<std::size_t>& placed) const {
    std::vector<Shares> seen(placed.size()), predicted(placed.size());
    std::vector<double> mean_shading;
    for (const std::size_t k : placed) mean_shading.push_back(expected(k));
    for_object([&](int y, int x) {
      std::vector<float> light, shade;
      for (std::size_t i = 0; i < placed.size(); ++i) {
        const auto s = shading(placed[i], y, x);
        if (!s) return;
        shade.push_back(*s / float(mean_shading[i]));
        light.push_back(brightness(light_[placed[i]](y, x)) / mean_brightness(placed[i]));
      }
      float all_light = 0, all_shade = 0;
      for (std::size_t i = 0; i < placed.size(); ++i) all_light += light[i], all_shade += shade[i];
      if (all_light < 0.2F * float(placed.size()) || all_shade <= 0) return;  // too dark to tell
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

  void find_swapped_places() {
    const std::vector<std::size_t> placed = placed_lamps();
    if (placed.size() < kFewestForShares) return;
    const auto table = likeness(placed);
    const auto best = [&](std::size_t i) {
      return std::size_t(std::max_element(table[i].begin(), table[i].end()) - table[i].begin());
    };
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const std::size_t j = best(i);
      const double gain = table[i][j] + table[j][i] - table[i][i] - table[j][j];
      if (j > i && best(j) == i && gain > kSwapMargin) report_swap(placed[i], placed[j]);
    }
  }

  const std::vector<RigLamp>& lamps_;
  const CoarseScene& scene_;
  const LampPictures& pictures_;
  std::vector<cv::Mat3f> light_;  ///< less the dark
  std::vector<cv::Vec3f> color_;  ///< its mean over the object
  std::vector<double> level_;     ///< over what geometry leads to expect
  double typical_ = 0;
  std::vector<LampFault> faults_;
};

}  // namespace

std::string to_string(LampFault::Kind kind) {
  switch (kind) {
    case LampFault::Kind::no_light:
      return "no-light";
    case LampFault::Kind::stuck_on:
      return "stuck-on";
    case LampFault::Kind::dim:
      return "dim";
    case LampFault::Kind::swapped:
      break;
  }
  return "swapped";
}

std::vector<LampFault> find_lamp_faults(const std::vector<RigLamp>& lamps, const CoarseScene& scene,
                                        const LampPictures& pictures) {
  return FaultFinder(lamps, scene, pictures).find();
}

}  // namespace rakelight
