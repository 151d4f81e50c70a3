// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/open_scene.h"

#include <limits>
#include <opencv2/calib3d.hpp>

#include "refine/output/result_io.h"
#include "refine/steps/preprocess.h"
#include "refine/steps/registration.h"
#include "stack/color_response.h"
#include "stack/errors.h"
#include "stack/stack_io.h"
#include "stack/truth_io.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

/// Linear radiance as sRGB.
cv::Mat3b display_picture(const LightStack& stack, const Frame& frame) {
  static const ColorResponse srgb{ColorResponse::Kind::srgb, 1.0};
  constexpr int kSteps = 4096;
  static const std::vector<uchar> table = [] {
    std::vector<uchar> codes(kSteps + 1);
    for (int i = 0; i <= kSteps; ++i)
      codes[static_cast<std::size_t>(i)] = cv::saturate_cast<uchar>(255 * encode(srgb, double(i) / kSteps));
    return codes;
  }();
  const cv::Mat3f linear = linear_color(stack, frame);
  cv::Mat3b picture(linear.size());
  for (int y = 0; y < linear.rows; ++y) {
    for (int x = 0; x < linear.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float share = std::min(1.0f, std::max(0.0f, linear(y, x)[c]));
        picture(y, x)[c] = table[static_cast<std::size_t>(share * kSteps)];
      }
    }
  }
  return picture;
}

cv::Mat3b undistorted(const cv::Mat3b& picture, const Camera& camera) {
  if (camera.distortion.empty()) return picture;
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  cv::Mat3b result;
  cv::undistort(picture, result, K, camera.distortion);
  return result;
}

std::vector<FramePicture> frames_of(const LightStack& stack) {
  std::vector<FramePicture> frames;
  for (const Frame& frame : stack.frames) {
    if (frame.color.empty()) continue;
    frames.push_back({frame.light.value_or("dark") + " (frame " + std::to_string(frame.index) + ")",
                      undistorted(display_picture(stack, frame), stack.color_camera)});
  }
  return frames;
}

/// The depth frames merged; outside the mask there is no surface.
Layer sensor_layer(const LightStack& stack) {
  Layer layer;
  layer.kind = LayerKind::sensor;
  layer.camera = registered_depth_camera(stack);
  std::vector<cv::Mat1f> frames;
  for (const Frame& frame : stack.frames) {
    if (!frame.depth.empty()) frames.push_back(registered_depth(stack, frame));
  }
  if (frames.empty()) throw InputError(stack.origin, "has no depth image", "show a stack that has one");
  layer.depth = merge_depth_frames(frames).clone();
  if (stack.mask.empty()) return layer;
  for (int y = 0; y < layer.depth.rows; ++y) {
    for (int x = 0; x < layer.depth.cols; ++x) {
      const int v = y * stack.mask.rows / layer.depth.rows, u = x * stack.mask.cols / layer.depth.cols;
      if (stack.mask(v, u) == 0) layer.depth(y, x) = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return layer;
}

/// The truth lies on the grid of the colour or of the depth camera.
Layer truth_layer(const LightStack& stack, const GroundTruth& truth) {
  Layer layer;
  layer.kind = LayerKind::truth;
  layer.camera = binned(registered_depth_camera(stack),
                        static_cast<double>(registered_depth_camera(stack).width) / truth.depth.cols);
  layer.depth = truth.depth;
  layer.normals = truth.normals;
  return layer;
}

bool present(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

bool is_result(const fs::path& folder) { return present(folder / "result.json"); }

/// Says what a folder is not. Whatever else is wrong with a stack, read_stack says.
void refuse_what_is_neither(const fs::path& folder) {
  if (!present(folder)) throw InputError(folder.string(), "does not exist", "check the path");
  if (present(folder / "depth.tiff") && !present(folder / "stack.json")) {
    throw InputError(folder.string(), "is an unfinished result (no result.json)", "refine its stack again");
  }
}

void add_stack(Scene& scene, const LightStack& stack, const GroundTruth* truth) {
  scene.layers.insert(scene.layers.begin(), sensor_layer(stack));
  if (truth != nullptr) scene.layers.push_back(truth_layer(stack, *truth));
  scene.frames = frames_of(stack);
}

void add_stack(Scene& scene, const fs::path& folder) {
  const LightStack stack = read_stack(folder);
  if (!has_truth(folder)) return add_stack(scene, stack, nullptr);
  const GroundTruth truth = read_truth(folder);
  add_stack(scene, stack, &truth);
}

void add_result(Scene& scene, const fs::path& folder) {
  StoredResult result = read_result(folder);
  scene.layers.push_back({LayerKind::preprocessed, result.camera, result.initial_depth, {}});
  scene.layers.push_back({LayerKind::refined, result.camera, result.depth, result.normals});
  scene.albedo = result.albedo;
  scene.uncertainty = result.uncertainty;
  scene.iterations = result.iterations;
  scene.message = result.message;
  scene.stack = result.stack;
}

}  // namespace

Scene scene_of(const LightStack& stack, const GroundTruth* truth) {
  Scene scene;
  scene.title = stack.origin;
  add_stack(scene, stack, truth);
  return scene;
}

Scene open_scene(const SceneSource& source) {
  Scene scene;
  scene.title = source.folder.string();
  if (!is_result(source.folder)) {
    refuse_what_is_neither(source.folder);
    if (!source.stack.empty())
      throw UsageError("--stack goes with a result, and " + scene.title + " is none");
    add_stack(scene, source.folder);
    return scene;
  }
  add_result(scene, source.folder);
  if (source.stack.empty()) return scene;
  scene.stack.clear();
  add_stack(scene, source.stack);
  return scene;
}

Scene with_stack(const Scene& scene) {
  Scene more = scene;
  more.stack.clear();
  try {
    add_stack(more, scene.stack);
  } catch (const std::exception&) {  // moved, changed or cut since: the result can do without
    more = scene;
    more.stack.clear();
  }
  return more;
}

}  // namespace rakelight
