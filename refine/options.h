// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every parameter of the refinement, with its unit or equation.
#pragma once

#include <string>

namespace rakelight {

enum class Method { multi_light, rgb_ratio, fusion_like, rgbd_fusion };
enum class Preset { paper, robust };
enum class Linearization {
  gauss_newton,  ///< in normal and albedo at once (refine/steps/photometric_tensor.h)
  fixed_point,   ///< n / d with d and albedo held (the paper)
};
enum class Stencil {
  forward,    ///< one corner a pixel: forward differences, backward at the border (the paper)
  symmetric,  ///< the mean over all four corners: unbiased, without the null space of central differences
};

/// What solves the depth step's linear system (refine/solver/depth_solver.h).
enum class Solver {
  multigrid,  ///< conjugate gradients with a multigrid preconditioner
  exact,      ///< sparse Cholesky factorisation: the reference
};

/// Filling and smoothing of the sensor's depth before any method (Sec. III, first paragraph).
struct PreprocessOptions {
  double bilateral_sigma_px = 3.0;     ///< spatial reach of the bilateral filter, depth pixels
  double bilateral_sigma_noise = 7.0;  ///< range of the bilateral filter, in measured depth noise deviations
};

enum class LampModel {
  automatic,  ///< near if it explains the images clearly better than far
  far,        ///< directional, first-order harmonics a channel (the paper)
  near,       ///< point sources
};
enum class LampPositions {
  estimated,  ///< from images and depth alone
  start,      ///< started from position_m of the stack's lights
  fixed,      ///< held at position_m of the stack's lights
};

/// The lamps, Eq. (26) and refine/lamp.h.
struct LampOptions {
  /// Order of the far lamps' spherical harmonics, 1 or 2. The second is for broad and ambient light: 9 unknowns a channel,
  /// no attached shadows (it follows the clamped cosine by itself), no near lamps.
  int harmonics = 1;
  LampModel model = LampModel::automatic;
  LampPositions positions = LampPositions::estimated;
  double lobe_exponent =
      1;  ///< emission cos^m about the axis towards the object: 0 isotropic, 1 Lambertian LED
};

/// Which samples are believed.
struct TrustOptions {
  bool attached_shadows = true;  ///< shading is max(0, l.n) + phi
  /// Model error no image is free of, as a share of the median radiance: floor of the robust scale sigma.
  double model_error = 0.035;
  double cauchy_scale = 1.0;  ///< k: weight 1 / (1 + (r / (k sigma))^2) a pixel and image; 0: off (the paper)
  double edge_weight =
      10;  ///< a corner's term is divided by sqrt(1 + e / (edge_weight median e)); 0: off (the paper)
};

/// The albedo of one image (refine/steps/albedo_smooth.h); methods rgb-ratio, fusion-like and rgbd-fusion.
struct AlbedoOptions {
  double smoothness = 1000;  ///< lambda_rho: weight of differences between neighbours
  double edge_sigma =
      0.05;  ///< sigma_I: change between neighbours that begins to count as an edge of the paint
  /// Share of the smoothness left across an edge. More lets the paint of neighbours mix, which the shape then takes up.
  double edge_floor = 1e-4;
  double palette_bandwidth = 0.25;  ///< of the object's few colours in log RGB; 0: no palette
  double palette_weight = 10;       ///< pull to the palette against the pixel's own colour
  double depth_sigma = 7.07;  ///< sigma_z of Eq. (11), in the unit of the method's depth (preset paper only)
  double cutoff = 0;  ///< tau of RGBD-Fusion: no smoothing where |I - I_k|^2 is more; 0: none (paper only)
  double local_smoothness = 0.1;  ///< lambda_b1 of RGBD-Fusion's local term (paper only)
  double local_weight = 0.1;      ///< lambda_b2 of RGBD-Fusion's local term (paper only)
  double ratio_sigma = 100;       ///< sigma_c of Eq. (21), rgb-ratio (paper only)
  double ratio_smoothness = 100;  ///< lambda_rho1 / lambda_rho2 of Eq. (20), rgb-ratio (paper only)
};

/// The depth step, Eq. (32) and (34).
struct DepthOptions {
  /// lambda_z on log z, against intensities in [0, 1] (the paper: 100). 0: from the measured noise of images and depth.
  double sensor_weight = 0;
  /// With sensor_weight 0: lambda_z = noise_ratio * image error variance / variance of log depth, both measured
  /// (refine/steps/noise.h). Above 1 because errors of the lamp and reflectance model are correlated over pixels and
  /// images, while the sensor's are not.
  double noise_ratio = 36;
  /// lambda_l of Eq. (8), lambda_z2 of RGBD-Fusion; 0: no Laplacian (the tables' "ns"). Robust single-image methods: on
  /// the change of tilt from pixel to pixel, against one shading sample's error variance, 1/rad^2 (refine/shading.h)
  double smoothness = 0;
  /// Weak pull of every refined pixel to the start, on log z; without it, colour pixels no depth pixel covers would drift
  double floor = 0.5;
  Solver solver = Solver::multigrid;
  Linearization linearization = Linearization::gauss_newton;
  Stencil stencil = Stencil::symmetric;
  int max_backtracks =
      8;  ///< halvings of a step that would raise the energy; 0: take it as it is (the paper)
};

struct RefineOptions {
  Method method = Method::multi_light;
  Preset preset = Preset::robust;
  int frame = -1;  ///< single-image methods: index of the frame to use; -1: the first that fits
  bool estimate_response =
      false;                ///< find what colour values mean from the images (refine/response_estimate.h)
  int scale = 0;            ///< refined grid / depth grid, 1 to 4; 0: as fine as the colour images are
  int max_iterations = 40;  ///< outer iterations
  int min_iterations = 14;  ///< robust: no stop before the lamp model is chosen and has taken effect
  double tolerance =
      0.01;  ///< robust: stop when depth typically moves less than this share of a depth pixel's noise;
             ///< paper: epsilon, the relative change of the energy
  int threads = 0;               ///< 0: all; the result does not depend on it
  int uncertainty_samples = 16;  ///< random surfaces drawn for the error bars (multi-light); 0: none
  PreprocessOptions preprocess;
  LampOptions lamps;
  TrustOptions trust;
  AlbedoOptions albedo;
  DepthOptions depth;
};

/// The defaults of a preset for a method.
RefineOptions preset_options(Preset preset, Method method = Method::multi_light);

std::string to_string(Method method);
std::string to_string(Preset preset);
std::string to_string(Linearization linearization);
std::string to_string(Stencil stencil);
std::string to_string(Solver solver);
std::string to_string(LampModel model);
std::string to_string(LampPositions positions);

}  // namespace rakelight
