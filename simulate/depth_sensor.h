// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A structured-light depth sensor: what it sees, where it is blind, how it errs.
#pragma once

#include <vector>

#include "simulate/options.h"
#include "simulate/ray_tracer.h"

namespace rakelight {

/// The field of view of the usual structured-light sensor: f = 570 at 640 x 480.
Camera structured_light_camera(cv::Size size);

/// Depth frames in raw units (0 = no reading) of the scene seen by `camera`.
std::vector<cv::Mat1w> sense_depth(const SimulateOptions& options, const Camera& camera,
                                   const RayTracer& tracer, int count);

/// Unit-variance Gaussian noise with correlation radius `sigma_px` (autocorrelation exp(-r^2 / 4 sigma^2)).
cv::Mat1f correlated_noise(cv::Size size, double sigma_px, std::uint64_t seed, std::uint64_t stream);

}  // namespace rakelight
