// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images and truth from rays through the colour camera's pixels.
#pragma once

#include <functional>
#include <opencv2/core.hpp>

#include "simulate/shading.h"

namespace rakelight {

/// Called with the share of rows done; may throw to stop.
using RowProgress = std::function<void(double fraction_done)>;

/// Ray direction through pixel (u, v), z = 1. Cameras here have no distortion.
Eigen::Vector3f pixel_ray(const Camera& camera, double u, double v);

/// Factor that maps radiance to [0, 1] so that `clip_share` of the object's pixels, over all images, clip.
double auto_exposure(const ShadingContext& context, const Camera& camera, const std::vector<LampSet>& sets);

struct RenderedImages {
  std::vector<cv::Mat> colors;  ///< one a lamp set, CV_8UC3 or CV_16UC3, encoded
  cv::Mat3f albedo;             ///< mean over the pixel; NaN where its centre misses the object
};

/// Renders every lamp set: mean of samples x samples rays a pixel, through the image sensor (image_sensor.h).
RenderedImages render_images(const ShadingContext& context, const Camera& camera,
                             const std::vector<LampSet>& sets, double exposure, const RowProgress& progress);

/// Linear radiance a light source, so that any mixture of lamps is a weighted sum of images.
struct RadianceImages {
  cv::Mat3f ambient;
  std::vector<cv::Mat3f> lamps;  ///< runs parallel to the lamps asked for
  cv::Mat3f albedo;              ///< as in RenderedImages
};
RadianceImages render_radiance(const ShadingContext& context, const Camera& camera,
                               const std::vector<LampTruth>& lamps);

/// Depth (metres) and smooth normals along the rays through pixel centres; NaN where there is no object.
struct SurfaceMaps {
  cv::Mat1f depth;
  cv::Mat3f normals;
};
SurfaceMaps render_surface(const RayTracer& tracer, const Camera& camera);

}  // namespace rakelight
