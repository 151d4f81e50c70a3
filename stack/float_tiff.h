// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Float maps (depth, normals, albedo) as TIFF: lossless, NaN included, checked before pixels are allocated.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "stack/image_file.h"

namespace rakelight {

/// A map of one float a pixel. @throws InputError naming file, fault and cure; IoError.
cv::Mat1f read_float_tiff(const std::filesystem::path& file, const ExpectedSize& size = {});

/// A map of three floats a pixel, in the order of the file (x, y, z or R, G, B). @throws as read_float_tiff.
cv::Mat3f read_float3_tiff(const std::filesystem::path& file, const ExpectedSize& size = {});

/// Writes a new TIFF. Three channels are stored in their order (OpenCV then reads them backwards: z, y, x).
/// @throws IoError.
void write_tiff(const std::filesystem::path& file, const cv::Mat1f& image);
void write_tiff(const std::filesystem::path& file, const cv::Mat3f& image);

}  // namespace rakelight
