// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The images a result was made from, small, each with what is known about its lamp.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "stack/stack.h"

namespace rakelight {

/// A list, an entry a frame that has colour: index, lamp, its colour, whether the lit check agrees (null: none), share of
/// the object that is clipped, and the picture: cropped to the object, all in one brightness.
/// @param surface 255 where the result has depth  @param box the object on that grid  @param side of a picture, pixels
/// @param count at most so many
nlohmann::ordered_json report_frames(const LightStack& stack, const cv::Mat1b& surface, const cv::Rect& box,
                                     int side, std::size_t count);

}  // namespace rakelight
