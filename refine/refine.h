// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The refinement engine: pure functions on light stacks. Read this header first.
//
//     LightStack   stack  = read_stack(folder);
//     RefineResult result = refine_depth(stack, options);
//     write_result(result, out);                        // refine/output/result_io.h
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "refine/frame_thumbnails.h"
#include "refine/options.h"
#include "refine/response_estimate.h"
#include "stack/stack.h"

namespace rakelight {

/// How a refinement ended.
enum class Termination {
  converged,       ///< the stopping rule of the method was met
  max_iterations,  ///< the iteration limit came first: usable, but not settled
  diverged,        ///< the energy rose or a system was singular: the best state so far is returned
};

/// One outer iteration as it ran.
struct IterationReport {
  int index = 0;
  double energy = 0;               ///< after the depth step, the weights of this iteration
  double energy_before_depth = 0;  ///< same weights, before the depth step
  double depth_change_mm = 0;      ///< root mean square change of depth
  double typical_change_mm = 0;    ///< the same as most pixels have it (1.4826 medians); multi-light only
  double residual_scale = 0;       ///< robust standard deviation of the photometric residual, linear radiance
  int backtracks = 0;              ///< halvings the depth step needed
  double sensor_weight = 0;        ///< lambda_z used, on log z
  double seconds = 0;  ///< wall time; filled in by a caller who has a clock: the engine reads none
};

/// Light of one image, camera coordinates: S_c = l_c . n + phi_c at the object's centre.
struct LightEstimate {
  std::string id;
  int frame_index = 0;
  Eigen::Matrix<double, 3, 4> sh_rgb =
      Eigen::Matrix<double, 3, 4>::Zero();  ///< row c (R, G, B): l_x, l_y, l_z, phi
  /// With --harmonics 2, row c: Q_xx, Q_yy, Q_xy, Q_xz, Q_yz of the term n' Q n, whose trace is 0.
  std::optional<Eigen::Matrix<double, 3, 5>> second_order_rgb;
  std::optional<Eigen::Vector3d> position_m;  ///< of a near lamp (refine/lamp.h)
  double distance_deviation_m = 0;            ///< of its distance from the object's centre
  double direction_deviation_rad = 0;         ///< of its direction
};

struct RefineResult {
  Camera camera;            ///< of the refined grid
  int scale = 1;            ///< refined grid / depth grid
  cv::Mat1f depth;          ///< metres, NaN where there is no surface
  cv::Mat1f initial_depth;  ///< the preprocessed sensor depth on the same grid, metres, NaN outside
  cv::Mat3f normals;        ///< camera frame, unit length, n_z < 0; NaN outside
  cv::Mat3f albedo;         ///< linear RGB, mean 1 a channel over the surface; NaN outside
  cv::Mat3f
      uncertainty;  ///< one standard deviation of depth (m), of the normal (rad), and the number of images that
                    ///< light the pixel; NaN outside; empty where the method gives none
  cv::Mat1b inpainted;  ///< 255 where the sensor gave no depth and the start was filled in
  std::vector<LightEstimate> lights;
  std::vector<IterationReport> iterations;
  Termination termination = Termination::max_iterations;
  std::string message;                    ///< one sentence on how it ended
  std::vector<std::string> warnings;      ///< one sentence each
  std::map<std::string, double> quality;  ///< named measures, e.g. "coverage", "image_noise", "depth_noise_m"
  std::vector<FrameThumbnail> thumbnails;             ///< of the stack's first frames
  ColorResponse color_response;                       ///< what colour values were taken to mean
  std::optional<ResponseEstimate> response_estimate;  ///< with RefineOptions::estimate_response
  RefineOptions options;                              ///< every parameter used, resolved
};

/// A surface on its way, on the refined grid.
struct SurfaceSoFar {
  Camera camera;
  cv::Mat1f depth;  ///< metres, NaN where there is no surface
};

/// Where the work stands; return false to cancel (refine_depth then throws Cancelled).
struct Progress {
  std::string stage;         ///< e.g. "depth step"
  double fraction_done = 0;  ///< of the whole, 0 to 1
  int iteration = 0;         ///< outer iterations done
  std::function<SurfaceSoFar()> surface =
      {};  ///< makes it, inside the callback only; empty before the first iteration
};
using ProgressCallback = std::function<bool(const Progress&)>;

/// Refines the stack's depth by photometric stereo. Pure: no file, clock or output is touched.
/// @throws InputError when the data cannot be used, UsageError when the options ask what the stack cannot give
///         (a scale finer than its colour), Cancelled when the callback returned false.
RefineResult refine_depth(const LightStack& stack, const RefineOptions& options,
                          const ProgressCallback& progress = {});

}  // namespace rakelight
