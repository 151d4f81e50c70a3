// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What one picture of each lamp says of its light: how much, of which colour, from where.
//
// Paint cancels out of a lamp's share in the light of all lamps: share_k = S_k / sum_j S_j, where S_k = max(0, n . l_k) is
// known from the depth and the lamp's position. So the shares tell which lamp a picture was lit by, however the object
// is painted. Lamps without a position can be told by their colour and their level only.
#pragma once

#include <optional>
#include <vector>

#include "capture/coarse_scene.h"
#include "capture/rig.h"

namespace rakelight {

/// Linear radiance at the cells of the scene.
struct LampPictures {
  cv::Mat3f dark;
  std::vector<cv::Mat3f> lit;  ///< one a lamp of the rig, in its order, dark not subtracted
  cv::Mat1b object;            ///< 255: cells that count
};

class LampLight {
 public:
  /// All are referred to.
  LampLight(const std::vector<RigLamp>& lamps, const CoarseScene& scene, const LampPictures& pictures);

  /// Light of the median lamp, over what geometry leads to expect; 0 where most give none.
  double typical() const { return typical_; }
  /// Light of a lamp, as a share of what the others lead to expect.
  double level(std::size_t lamp) const { return level_[lamp] / typical_; }
  bool shines(std::size_t lamp) const { return level(lamp) >= kNoLight; }

  /// The dark's light in the lamp's channels, as a share of what the lamp would give.
  double level_in_dark(std::size_t lamp) const;
  /// Correlation of the dark's share in the light of all lamps with the share the lamp would have there. Nothing where
  /// places are not known well enough to tell.
  std::optional<double> likeness_to_dark(std::size_t lamp) const;

  /// The colour that a lamp's picture is lit by, against what white lamps show of the object.
  LampColor seen_color(std::size_t lamp) const;

  /// White lamps that shine and whose places are known.
  std::vector<std::size_t> placed_lamps() const;
  /// Entry [i][j]: correlation of the share of light in picture placed[i] with the share that lamp placed[j] would have.
  std::vector<std::vector<double>> likeness(const std::vector<std::size_t>& placed) const;

 private:
  static constexpr double kNoLight = 0.08;  ///< of the expected level: less is none

  cv::Vec3f mean_over_object(const cv::Mat3f& image) const;
  double own_level(std::size_t lamp, const cv::Vec3f& color) const;
  std::optional<float> shading(std::size_t lamp, int y, int x) const;
  double expected(std::size_t lamp) const;
  template <class Visit>
  void for_object(const Visit& visit) const;

  const std::vector<RigLamp>& lamps_;
  const CoarseScene& scene_;
  const LampPictures& pictures_;
  std::vector<cv::Mat3f> light_;  ///< less the dark
  std::vector<cv::Vec3f> color_;  ///< its mean over the object
  std::vector<double> level_;     ///< over what geometry leads to expect
  double typical_ = 0;
};

}  // namespace rakelight
