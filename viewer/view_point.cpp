// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "stack/errors.h"
#include "viewer/coloring.h"
#include "viewer/viewer.h"

namespace rakelight {
namespace {

constexpr double kRadian = 3.14159265358979323846 / 180;

void require_layer(const Scene& scene, LayerKind kind) {
  if (scene.find(kind) != nullptr) return;
  std::string there;
  for (const Layer& layer : scene.layers)
    there += (there.empty() ? "" : ", ") + name_of(kLayerNames, layer.kind);
  const bool of_stack = kind == LayerKind::sensor || kind == LayerKind::truth;
  throw UsageError(
      scene.title + " has no layer " + name_of(kLayerNames, kind) + " but " + there +
      (of_stack ? "; give the scan of the result with --stack STACK" : "; name a result of refine"));
}

}  // namespace

Look default_look(const Scene& scene) {
  Look look;
  look.layer = scene.find(LayerKind::refined) != nullptr ? LayerKind::refined : scene.layers.front().kind;
  look.before =
      scene.find(LayerKind::preprocessed) != nullptr ? LayerKind::preprocessed : scene.layers.front().kind;
  if (look.layer == LayerKind::refined) return look;
  look.points = true;
  if (scene.frames.empty()) return look;
  look.coloring = Coloring::image;
  double brightest = -1;
  for (std::size_t i = 0; i < scene.frames.size(); ++i) {
    const cv::Scalar mean = cv::mean(scene.frames[i].picture);
    if (mean[0] + mean[1] + mean[2] <= brightest) continue;
    brightest = mean[0] + mean[1] + mean[2];
    look.image = static_cast<int>(i);
  }
  return look;
}

void check_look(const Scene& scene, const Look& look) {
  require_layer(scene, look.layer);
  if (look.split) require_layer(scene, look.before);
  const std::string why = obstacle(scene, look.coloring);
  if (!why.empty())
    throw UsageError("cannot colour by " + name_of(kColoringNames, look.coloring) + ": " + why);
  if (look.coloring != Coloring::image) return;
  const int images = static_cast<int>(scene.frames.size());
  if (look.image >= 0 && look.image < images) return;
  throw UsageError("there is no image " + std::to_string(look.image) + "; name 0 to " +
                   std::to_string(images - 1));
}

OrbitCamera camera_at(const ViewPoint& view, const Box& bounds, double aspect) {
  OrbitCamera camera;
  camera.orthographic = view.orthographic;
  turn_to(camera, view.view);
  camera.azimuth += view.azimuth_deg * kRadian;
  camera.elevation += view.elevation_deg * kRadian;
  fit(camera, bounds, aspect);
  return camera;
}

}  // namespace rakelight
