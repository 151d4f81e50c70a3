// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a colouring shows of a layer: numbers, their range, and one colour a point.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "viewer/color_map.h"
#include "viewer/look.h"
#include "viewer/surface.h"

namespace rakelight {

/// Why the scene cannot be coloured so, with what would help; empty if it can.
std::string obstacle(const Scene& scene, Coloring coloring);

/// The number shown at each pixel of the layer (millimetres), NaN where there is none; empty if the colouring is not of
/// numbers. @param coloring one without obstacle()
cv::Mat1f values_of(const Scene& scene, const Layer& layer, Coloring coloring);

/// The scale bar of a colouring: one for all layers, so that they compare; empty if it is not of numbers.
std::optional<ColorRange> range_of(const Scene& scene, Coloring coloring);

/// sRGB, R G B, as Surface::positions. @param image index in Scene::frames, for Coloring::image  @param range that of
/// range_of()
std::vector<cv::Vec3b> colors_of(const Scene& scene, const Layer& layer, const Surface& surface,
                                 Coloring coloring, int image, const std::optional<ColorRange>& range);

}  // namespace rakelight
