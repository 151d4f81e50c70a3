// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Looking at a scan or a result. Read this header first.
//
//     Scene scene = open_scene({folder, stack});           // viewer/open_scene.h
//     save_pictures(scene, look, view, {"surface.png"});   // no display needed
//     run_viewer(scene, look, view, {});                   // the window; live: viewer/live_view.h
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "viewer/look.h"
#include "viewer/open_scene.h"
#include "viewer/orbit_camera.h"

namespace rakelight {

/// Where the scene is first looked at from; it always fills the picture.
struct ViewPoint {
  StandardView view = StandardView::front;
  double azimuth_deg = 0, elevation_deg = 0;  ///< from the standard view on
  bool orthographic = false;
};

struct PictureOptions {
  std::filesystem::path file;  ///< PNG; of a turntable, 0000, 0001 … go before the ending
  cv::Size size{1280, 960};    ///< pixels
  int turntable = 0;           ///< so many pictures around the object; 0: one picture
  bool legend = true;          ///< scale bar and layer names
};

struct PictureReport {
  std::vector<std::filesystem::path> files;
  std::string path;  ///< how it was drawn: which kind of context, on which renderer
};

/// Draws without a window and writes. @throws std::system_error without OpenGL 3.3, IoError, InputError
PictureReport save_pictures(const Scene& scene, const Look& look, const ViewPoint& view,
                            const PictureOptions& options);

struct WindowOptions {
  cv::Size size{1280, 960};  ///< at a scale of 1
  bool light_follows_mouse = true;
};

/// Opens the window and returns when it is closed. @throws std::system_error without a display or OpenGL 3.3, InputError
void run_viewer(Scene scene, const Look& look, const ViewPoint& view, const WindowOptions& options);

/// @throws UsageError if the look asks for a layer or colouring the scene does not have
void check_look(const Scene& scene, const Look& look);

/// Without anything asked for: the refined surface as clay, a scan's depth as points in the colours of its brightest image.
Look default_look(const Scene& scene);

/// The camera of a view point on the scene. @param aspect width / height
OrbitCamera camera_at(const ViewPoint& view, const Box& bounds, double aspect);

}  // namespace rakelight
