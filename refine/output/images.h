// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Float maps as pictures that other programs and people read.
#pragma once

#include <opencv2/core.hpp>

namespace rakelight {

/// Metres a step of a 16-bit depth picture: the finest of 1, 2, 5 times a power of ten whose range holds the depth.
double depth_unit(const cv::Mat1f& depth);

/// Depth in steps of `unit_m`, 0 where there is none.
cv::Mat1w depth_picture(const cv::Mat1f& depth, double unit_m);

/// Normals as OpenGL tools paint them: R = x right, G = y up, B = towards the camera; black where there is none.
cv::Mat_<cv::Vec3w> normals_picture(const cv::Mat3f& normals);

/// The linear albedo that pictures show as white: nearly the brightest of it.
float albedo_white(const cv::Mat3f& albedo);

/// Linear albedo as sRGB, scaled so that albedo_white() is white; R, G, B; black where there is none.
cv::Mat3b albedo_picture(const cv::Mat3f& albedo);

}  // namespace rakelight
