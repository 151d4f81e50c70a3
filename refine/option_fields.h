// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one list of every parameter: what result.json records and what a configuration file may set. A field that is
// added to options.h is added here, nowhere else.
#pragma once

#include <array>

#include "refine/options.h"

namespace rakelight {

/// Every value of an enumeration that is an option: their names are those of to_string.
template <class Enum>
inline constexpr std::array<Enum, 0> kValuesOf{};
template <>
inline constexpr std::array kValuesOf<Method>{Method::multi_light, Method::rgb_ratio, Method::fusion_like,
                                              Method::rgbd_fusion};
template <>
inline constexpr std::array kValuesOf<Linearization>{Linearization::gauss_newton, Linearization::fixed_point};
template <>
inline constexpr std::array kValuesOf<Stencil>{Stencil::forward, Stencil::symmetric};
template <>
inline constexpr std::array kValuesOf<Solver>{Solver::multigrid, Solver::exact};
template <>
inline constexpr std::array kValuesOf<LampModel>{LampModel::automatic, LampModel::far, LampModel::near};
template <>
inline constexpr std::array kValuesOf<LampPositions>{LampPositions::estimated, LampPositions::start,
                                                     LampPositions::fixed};
template <>
inline constexpr std::array kValuesOf<Preset>{Preset::paper, Preset::robust};

/// Calls visit(name, field) for every parameter; a dot in a name separates a group from its member.
/// Fields are bool, int, double or an enumeration of kValuesOf. @param options RefineOptions, const or not
template <class Options, class Visitor>
void for_each_option(Options& options, Visitor&& visit) {
  visit("method", options.method);
  visit("preset", options.preset);
  visit("frame", options.frame);
  visit("estimate_response", options.estimate_response);
  visit("scale", options.scale);
  visit("max_iterations", options.max_iterations);
  visit("min_iterations", options.min_iterations);
  visit("tolerance", options.tolerance);
  visit("threads", options.threads);
  visit("uncertainty_samples", options.uncertainty_samples);
  visit("preprocess.bilateral_sigma_px", options.preprocess.bilateral_sigma_px);
  visit("preprocess.bilateral_sigma_noise", options.preprocess.bilateral_sigma_noise);
  visit("lamps.harmonics", options.lamps.harmonics);
  visit("lamps.model", options.lamps.model);
  visit("lamps.positions", options.lamps.positions);
  visit("lamps.lobe_exponent", options.lamps.lobe_exponent);
  visit("trust.attached_shadows", options.trust.attached_shadows);
  visit("trust.model_error", options.trust.model_error);
  visit("trust.cauchy_scale", options.trust.cauchy_scale);
  visit("trust.edge_weight", options.trust.edge_weight);
  visit("albedo.smoothness", options.albedo.smoothness);
  visit("albedo.edge_sigma", options.albedo.edge_sigma);
  visit("albedo.edge_floor", options.albedo.edge_floor);
  visit("albedo.palette_bandwidth", options.albedo.palette_bandwidth);
  visit("albedo.palette_weight", options.albedo.palette_weight);
  visit("albedo.depth_sigma", options.albedo.depth_sigma);
  visit("albedo.cutoff", options.albedo.cutoff);
  visit("albedo.local_smoothness", options.albedo.local_smoothness);
  visit("albedo.local_weight", options.albedo.local_weight);
  visit("albedo.ratio_sigma", options.albedo.ratio_sigma);
  visit("albedo.ratio_smoothness", options.albedo.ratio_smoothness);
  visit("depth.sensor_weight", options.depth.sensor_weight);
  visit("depth.noise_ratio", options.depth.noise_ratio);
  visit("depth.smoothness", options.depth.smoothness);
  visit("depth.floor", options.depth.floor);
  visit("depth.solver", options.depth.solver);
  visit("depth.linearization", options.depth.linearization);
  visit("depth.stencil", options.depth.stencil);
  visit("depth.max_backtracks", options.depth.max_backtracks);
}

}  // namespace rakelight
