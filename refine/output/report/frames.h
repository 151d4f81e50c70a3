// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The images a result was made from, small, each with what is known about its lamp.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "refine/frame_thumbnails.h"

namespace rakelight {

/// A list, an entry a frame that has colour: index, lamp, its colour, whether the lit check agrees (null: none), share of
/// the object that is clipped, and the picture: cropped to the object, all in one brightness.
/// @param pictures of the stack's frames  @param side of a picture, pixels  @param count at most so many
nlohmann::ordered_json report_frames(const LightStack& stack, const std::vector<FrameThumbnail>& pictures,
                                     int side, std::size_t count);

}  // namespace rakelight
