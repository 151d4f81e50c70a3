// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What can be looked at: depth maps as layers, images, the truth, the history of a refinement. How it is looked at is
// viewer/look.h.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "refine/refine.h"
#include "stack/stack.h"

namespace rakelight {

enum class LayerKind {
  sensor,        ///< the depth frames merged, as measured
  preprocessed,  ///< filled and smoothed: what the refinement started from
  refined,
  truth,
};

/// One depth map as a surface.
struct Layer {
  LayerKind kind = LayerKind::refined;
  Camera camera;      ///< of the grid, without distortion
  cv::Mat1f depth;    ///< metres, NaN where there is no surface
  cv::Mat3f normals;  ///< camera frame, unit length; may be empty: then those of the depth
};

/// A colour image of the stack as it is shown.
struct FramePicture {
  std::string caption;  ///< lamp and frame
  cv::Mat3b picture;    ///< sRGB, R G B, on the colour camera's grid
};

/// Layers share the camera's coordinates, not the grid. Maps may be empty where the source has none.
struct Scene {
  std::string title;          ///< the folder
  std::vector<Layer> layers;  ///< at least one, of different kinds
  cv::Mat3f albedo;           ///< linear RGB on the refined grid
  cv::Mat3f uncertainty;      ///< as in RefineResult, on the refined grid
  std::vector<FramePicture> frames;
  std::vector<IterationReport> iterations;
  std::string message;  ///< how the refinement ended
  std::filesystem::path
      stack;  ///< of a result whose scan is there and not yet loaded (with_stack()); else empty

  /// The layer of that kind, or null.
  const Layer* find(LayerKind kind) const;
};

}  // namespace rakelight
