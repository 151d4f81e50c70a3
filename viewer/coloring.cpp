// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/coloring.h"

#include <algorithm>
#include <limits>

#include "refine/output/images.h"

namespace rakelight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
const cv::Vec3b kPlain(205, 196, 186);  ///< unfired clay

/// The pixel of a grid of another size that covers the same part of the view.
cv::Point pixel_on(const cv::Size& grid, const cv::Point& pixel, const cv::Size& own) {
  const auto across = [](int position, int from, int to) {
    return std::clamp(static_cast<int>((position + 0.5) * to / from), 0, to - 1);
  };
  return {across(pixel.x, own.width, grid.width), across(pixel.y, own.height, grid.height)};
}

/// A picture's colours at the surface's points.
std::vector<cv::Vec3b> sampled(const cv::Mat3b& picture, const Surface& surface, const cv::Size& own) {
  std::vector<cv::Vec3b> colors;
  colors.reserve(surface.pixels.size());
  for (const cv::Point& pixel : surface.pixels)
    colors.push_back(picture(pixel_on(picture.size(), pixel, own)));
  return colors;
}

/// Millimetres that the layer is deeper than another; NaN where either has nothing.
cv::Mat1f deeper_by_mm(const Layer& layer, const Layer& other) {
  cv::Mat1f difference(layer.depth.size());
  for (int y = 0; y < difference.rows; ++y) {
    for (int x = 0; x < difference.cols; ++x) {
      const float z = other.depth(pixel_on(other.depth.size(), {x, y}, layer.depth.size()));
      difference(y, x) = 1000 * (layer.depth(y, x) - z);
    }
  }
  return difference;
}

/// One deviation of depth; the refined surface alone has one.
cv::Mat1f deviation_mm(const Scene& scene, const Layer& layer) {
  cv::Mat1f deviation(layer.depth.size(), kNaN);
  if (layer.kind == LayerKind::refined) cv::extractChannel(scene.uncertainty * 1000, deviation, 0);
  return deviation;
}

std::vector<cv::Vec3b> normal_colors(const Surface& surface) {
  const auto channel = [](float value) { return cv::saturate_cast<uchar>((value + 1) * 127.5f); };
  std::vector<cv::Vec3b> colors;
  colors.reserve(surface.normals.size());
  for (const cv::Vec3f& n : surface.normals)  // as OpenGL tools paint them: y up, z to the viewer
    colors.emplace_back(channel(n[0]), channel(-n[1]), channel(-n[2]));
  return colors;
}

std::vector<cv::Vec3b> mapped(const cv::Mat1f& values, const Surface& surface, const ColorRange& range) {
  std::vector<cv::Vec3b> colors;
  colors.reserve(surface.pixels.size());
  for (const cv::Point& pixel : surface.pixels)
    colors.push_back(color_of(range, static_cast<double>(values(pixel))));
  return colors;
}

/// The layers whose numbers set the range: before and after the refinement; without one, the sensor's.
std::vector<const Layer*> compared_layers(const Scene& scene) {
  std::vector<const Layer*> layers;
  for (const LayerKind kind : {LayerKind::preprocessed, LayerKind::refined}) {
    if (const Layer* layer = scene.find(kind)) layers.push_back(layer);
  }
  if (layers.empty()) layers.push_back(&scene.layers.front());
  return layers;
}

}  // namespace

std::string obstacle(const Scene& scene, Coloring coloring) {
  switch (coloring) {
    case Coloring::plain:
    case Coloring::normals:
    case Coloring::depth:
      return "";
    case Coloring::albedo:
      return scene.albedo.empty() ? "there is no albedo here; name a result that refine wrote" : "";
    case Coloring::image:
      return scene.frames.empty()
                 ? "no images here: the scan of this result is not at hand; name it with --stack STACK"
                 : "";
    case Coloring::delta:
      return scene.find(LayerKind::preprocessed) == nullptr
                 ? "there is no refined depth to compare; name a result that refine wrote"
                 : "";
    case Coloring::uncertainty:
      return scene.uncertainty.empty() ? "this has no uncertainty; name a result of the multi-light method"
                                       : "";
    case Coloring::error:
      return scene.find(LayerKind::truth) == nullptr
                 ? "the truth is not known; give a stack that has one with --stack STACK"
                 : "";
  }
  return "";
}

cv::Mat1f values_of(const Scene& scene, const Layer& layer, Coloring coloring) {
  switch (coloring) {
    case Coloring::depth:
      return cv::Mat(layer.depth * 1000);
    case Coloring::delta:
      return deeper_by_mm(layer, *scene.find(LayerKind::preprocessed));
    case Coloring::uncertainty:
      return deviation_mm(scene, layer);
    case Coloring::error:
      return deeper_by_mm(layer, *scene.find(LayerKind::truth));
    default:
      return {};
  }
}

std::optional<ColorRange> range_of(const Scene& scene, Coloring coloring) {
  std::vector<float> values;
  for (const Layer* layer : compared_layers(scene)) {
    const cv::Mat1f own = values_of(scene, *layer, coloring);
    const bool nothing_by_definition = coloring == Coloring::delta && layer->kind == LayerKind::preprocessed;
    if (!nothing_by_definition) values.insert(values.end(), own.begin(), own.end());
  }
  switch (coloring) {
    case Coloring::depth:
      return sequential_range(values, "depth", "mm");
    case Coloring::delta:
      return signed_range(values, "deeper than the start by", "mm");
    case Coloring::uncertainty:
      return sequential_range(values, "standard deviation of depth", "mm");
    case Coloring::error:
      return signed_range(values, "deeper than the truth by", "mm");
    default:
      return std::nullopt;
  }
}

std::vector<cv::Vec3b> colors_of(const Scene& scene, const Layer& layer, const Surface& surface,
                                 Coloring coloring, int image, const std::optional<ColorRange>& range) {
  if (range) return mapped(values_of(scene, layer, coloring), surface, *range);
  const cv::Size own = layer.depth.size();
  switch (coloring) {
    case Coloring::albedo:
      return sampled(albedo_picture(scene.albedo), surface, own);
    case Coloring::image:
      return sampled(scene.frames.at(static_cast<std::size_t>(image)).picture, surface, own);
    case Coloring::normals:
      return normal_colors(surface);
    default:
      return std::vector<cv::Vec3b>(surface.pixels.size(), kPlain);
  }
}

}  // namespace rakelight
