// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The image files of a stack, checked before pixels are allocated and written so that a full disk is noticed.
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace rakelight {

/// Size an image must have; empty: any.
using ExpectedSize = std::optional<cv::Size>;

/// An 8- or 16-bit RGB PNG as CV_8UC3 or CV_16UC3, channels R, G, B. @throws InputError, IoError.
cv::Mat read_color_png(const std::filesystem::path& file, const ExpectedSize& size = {});

/// What reads such an image later, as often as it is wanted. It throws BusyError where the file is another one by then or
/// has changed.
std::function<cv::Mat()> later_color_png(const std::filesystem::path& file, const ExpectedSize& size);

/// A 16-bit grey PNG of raw depth. @throws InputError, IoError.
cv::Mat1w read_depth_png(const std::filesystem::path& file, const ExpectedSize& size = {});

/// A mask of any PNG kind up to 8 bits a channel: 255 where grey, or blue, is at least 128, else 0.
/// @param sizes it may have; empty: any  @throws InputError, IoError.
cv::Mat1b read_mask_png(const std::filesystem::path& file, const std::vector<cv::Size>& sizes = {});

/// Any PNG as brightness for looking at: colour becomes grey, and the brightest of 16-bit values becomes 255.
/// @throws InputError, IoError.
cv::Mat1b read_gray_png(const std::filesystem::path& file);

/// Writes a PNG: 8- or 16-bit, one channel or R, G, B. @throws IoError.
void write_png(const std::filesystem::path& file, const cv::Mat& image);

}  // namespace rakelight
