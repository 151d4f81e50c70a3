// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lamps that do not do what the rig file says, told from one picture of each: burnt out, stuck, dim, swapped.
//
// Paint cancels out of a lamp's share in the light of all lamps: share_k = S_k / sum_j S_j, where S_k = max(0, n . l_k) is
// known from the depth and the lamp's position. So the shares tell which lamp a picture was lit by, however the object
// is painted. Lamps without a position can be told by their colour and their level only.
#pragma once

#include <string>
#include <vector>

#include "capture/coarse_scene.h"
#include "capture/rig.h"

namespace rakelight {

struct LampFault {
  enum class Kind { no_light, stuck_on, dim, swapped };
  Kind kind = Kind::no_light;
  std::string lamp;
  std::string other;    ///< swapped: with which
  double level = 0;     ///< light, as a share of what the other lamps lead to expect
  std::string message;  ///< one sentence with what to do
};
std::string to_string(LampFault::Kind kind);

/// Linear radiance at the cells of the scene.
struct LampPictures {
  cv::Mat3f dark;
  std::vector<cv::Mat3f> lit;  ///< one a lamp of the rig, in its order, dark not subtracted
  cv::Mat1b object;            ///< 255: cells that count
};

std::vector<LampFault> find_lamp_faults(const std::vector<RigLamp>& lamps, const CoarseScene& scene,
                                        const LampPictures& pictures);

}  // namespace rakelight
