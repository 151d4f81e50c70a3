// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The three kinds of paint of Sec. IV, as functions of texture coordinates.
#pragma once

#include <Eigen/Core>

#include "simulate/options.h"

namespace rakelight {

/// Linear RGB, about [0.1, 0.9], at texture coordinates (object's half size = 1).
/// simple: a few plain colours in large regions; pattern: stripes, checks and dots of several colours;
/// complicated: dense flowers, leaves and grain of many colours.
Eigen::Vector3f albedo_at(AlbedoKind kind, const Eigen::Vector2f& texture, std::uint64_t seed);

}  // namespace rakelight
