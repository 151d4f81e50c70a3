// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/step_pictures.h"

#include "capture/auto_mask.h"

namespace rakelight {
namespace {

std::vector<cv::Mat> lit_images(const StepPictures& pictures) {
  std::vector<cv::Mat> images;
  for (const auto& [step, frame] : pictures) {
    if (frame.light) images.push_back(frame.color);
  }
  return images;
}

CoarseScene scene_of(const LightStack& header, const StepPictures& pictures) {
  std::vector<cv::Mat1w> depths;
  for (const auto& [step, frame] : pictures) {
    if (!frame.depth.empty()) depths.push_back(frame.depth);
  }
  return coarse_scene(header, depths);
}

cv::Mat1b object_of(const CoarseScene& scene, const StepPictures& pictures, const ColorResponse& response) {
  const cv::Mat3f dark = at_cells(scene, pictures.at(0).color, response);
  cv::Mat3f most(scene.size, cv::Vec3f(0, 0, 0));
  for (const cv::Mat& color : lit_images(pictures))
    most = cv::max(most, at_cells(scene, color, response) - dark);
  cv::Mat1f light;
  cv::transform(most, light, cv::Matx13f(1, 1, 1));
  const cv::Mat1b object = object_cells(scene, light);
  if (cv::countNonZero(object) > 0) return object;
  return cv::Mat1b(scene.size, uchar{255});
}

}  // namespace

SceneInPictures examine(const LightStack& header, const StepPictures& pictures) {
  SceneInPictures seen{scene_of(header, pictures), {}};
  seen.object = object_of(seen.scene, pictures, header.color_response);
  return seen;
}

Brightness brightness_of(const SceneInPictures& seen, const StepPictures& pictures,
                         const ColorResponse& response) {
  return measure_brightness(seen.scene, seen.object, lit_images(pictures), response);
}

void learn_lamps(const SceneInPictures& seen, const StepPictures& pictures, const std::vector<RigLamp>& lamps,
                 ScanState& state) {
  const ColorResponse& response = state.stack.color_response;
  const cv::Mat& dark = pictures.at(0).color;
  state.signatures = LitSignatures(find_bands(lit_images(pictures), dark, response), response, dark);
  LampPictures alone{at_cells(seen.scene, dark, response), {}, seen.object};
  for (const auto& [step, frame] : pictures) {
    if (!frame.light) continue;
    state.signatures.learn(*frame.light, frame.color);
    if (alone.lit.size() < lamps.size()) alone.lit.push_back(at_cells(seen.scene, frame.color, response));
  }
  state.faults = find_lamp_faults(lamps, seen.scene, alone);
}

}  // namespace rakelight
