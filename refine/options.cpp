// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/options.h"

#include <cmath>

namespace rakelight {

namespace {

/// Robust defaults of the methods that use one image.
void single_image_defaults(RefineOptions& options) {
  options.max_iterations = 8;
  options.min_iterations = 4;
  options.trust.attached_shadows = false;
  options.albedo.palette_weight = 100;
  // The fusion methods have one equation a pixel for two slopes: more is left to smoothness.
  options.depth.noise_ratio = options.method == Method::rgb_ratio ? 0.5 : 0.3;
  options.depth.smoothness = options.method == Method::rgb_ratio ? 100 : 700;
}

/// Table I.
void single_image_paper(RefineOptions& options) {
  options.albedo.edge_sigma = std::sqrt(0.05);
  options.albedo.smoothness = 10;
  if (options.method == Method::fusion_like) {
    options.depth.sensor_weight = 500;
    options.depth.smoothness = 2;
  } else if (options.method == Method::rgbd_fusion) {
    options.albedo.smoothness = 0.1;
    options.albedo.cutoff = 0.05;
    options.depth.sensor_weight = 0.004;
    options.depth.smoothness = 0.0075;
  }
}

}  // namespace

RefineOptions preset_options(Preset preset, Method method) {
  RefineOptions options;
  options.preset = preset;
  options.method = method;
  if (preset == Preset::robust) {
    if (method != Method::multi_light) single_image_defaults(options);
    return options;
  }
  options.max_iterations = 20;
  options.min_iterations = 2;
  options.tolerance =
      0.04;  // the paper names no epsilon; its depth's error rises again some iterations later
  options.lamps.model = LampModel::far;
  options.trust.attached_shadows = false;
  options.trust.model_error = 0;
  options.trust.cauchy_scale = 0;
  options.trust.edge_weight = 0;
  options.depth.sensor_weight = 100;
  options.depth.linearization = Linearization::fixed_point;
  options.depth.stencil = Stencil::forward;
  options.depth.max_backtracks = 0;
  options.uncertainty_samples = 0;
  if (method != Method::multi_light) single_image_paper(options);
  return options;
}

std::string to_string(Method method) {
  switch (method) {
    case Method::multi_light:
      return "multi-light";
    case Method::rgb_ratio:
      return "rgb-ratio";
    case Method::fusion_like:
      return "fusion-like";
    case Method::rgbd_fusion:
      return "rgbd-fusion";
  }
  return "unknown";
}

std::string to_string(Preset preset) { return preset == Preset::paper ? "paper" : "robust"; }

std::string to_string(Linearization linearization) {
  return linearization == Linearization::gauss_newton ? "gauss-newton" : "fixed-point";
}

std::string to_string(Stencil stencil) { return stencil == Stencil::forward ? "forward" : "symmetric"; }

std::string to_string(Solver solver) { return solver == Solver::multigrid ? "multigrid" : "exact"; }

std::string to_string(LampModel model) {
  switch (model) {
    case LampModel::automatic:
      return "auto";
    case LampModel::far:
      return "far";
    case LampModel::near:
      return "near";
  }
  return "unknown";
}

std::string to_string(LampPositions positions) {
  switch (positions) {
    case LampPositions::estimated:
      return "estimated";
    case LampPositions::start:
      return "start";
    case LampPositions::fixed:
      return "fixed";
  }
  return "unknown";
}

}  // namespace rakelight
