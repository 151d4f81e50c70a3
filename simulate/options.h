// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every parameter of the synthetic rig, with its unit.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>

#include "stack/stack.h"

namespace rakelight {

enum class SceneKind { vase, coin, drape, sphere, plane, mesh };
enum class AlbedoKind { simple, pattern, complicated };
enum class LampLayout { ring, swayed };

/// What stands before the camera. It is centred on the optical axis and scaled to fit the view.
struct SceneOptions {
  SceneKind kind = SceneKind::vase;
  std::filesystem::path mesh;  ///< PLY or OBJ (y up, z to the viewer), for SceneKind::mesh
  AlbedoKind albedo = AlbedoKind::pattern;
  double distance_m = 1.0;  ///< of the object's centre
  double fill = 0.92;       ///< share of the view's width or height that the object takes
  Eigen::Vector3d rotation_deg{0, 0,
                               0};  ///< yaw (about the vertical), pitch, roll, on top of the scene's own
};

/// The rig. Lamps are aimed at the object's centre.
struct RigOptions {
  int count = 16;    ///< white lamps lit in turn
  bool rgb = false;  ///< one more image first, under a red, a green and a blue lamp at once
  LampLayout layout = LampLayout::ring;
  bool near = false;              ///< inverse square fall-off and a Lambertian lobe; otherwise parallel light
  double distance_m = 0.8;        ///< mean distance of near lamps from the object's centre
  double distance_spread = 0.15;  ///< distances vary within 1 -+ this share
  double angle_deg = 40;          ///< mean angle between lamp and optical axis
  double strength_spread = 0.1;   ///< strengths vary within 1 -+ this share
  double ambient = 0.03;          ///< irradiance of the room light, share of one lamp's
  bool dark_frame = true;         ///< a frame with all lamps off comes first
  bool write_positions = false;   ///< tell the stack where near lamps stand
};

/// How radiance becomes pixels.
struct ImageOptions {
  int samples = 4;               ///< samples x samples camera rays a pixel
  bool attached_shadows = true;  ///< shading max(0, n.l); without: 0.75 n.l + 0.25, first-order harmonics
  bool cast_shadows = true;
  double highlight = 0.25;    ///< peak radiance of the highlight lobe, share of a facing white surface
  double shininess = 40;      ///< Blinn-Phong exponent
  double shot_noise = 0.01;   ///< standard deviation at full scale; grows with the root of radiance
  double read_noise = 0.003;  ///< standard deviation in the dark, share of full scale
  double clip_share = 0.002;  ///< share of the object's pixels, over the images, that exposure lets clip
  int bits = 8;               ///< 8 or 16
  ColorResponse response;
  double crosstalk = 0;  ///< share of a LED's light that leaks into each adjacent channel
};

/// Structured-light depth sensor: it measures disparity d = f b / z, so errors grow with z squared.
struct DepthSensorOptions {
  int frames = 0;                    ///< depth frames; 0: one an image
  double noise_mm = 3.6;             ///< standard deviation at 1 m of the part that is correlated in space
  double correlation_px = 4.5;       ///< radius of that correlation, pixels of a 640-wide grid
  double correlated_drift = 0.25;    ///< share of it that changes from frame to frame
  double white_noise_mm = 1.2;       ///< standard deviation at 1 m of the part drawn anew a pixel and frame
  double disparity_step_px = 0.125;  ///< quantisation of disparity, pixels of a 640-wide grid; 0: none
  double baseline_m = 0.075;         ///< camera to projector, along x
  bool holes = true;                 ///< no reading at grazing angles, depth edges, in the projector's shadow
  double unit_m = 0.0001;            ///< of the raw values
};

struct SimulateOptions {
  SceneOptions scene;
  RigOptions lamps;
  ImageOptions image;
  DepthSensorOptions depth;
  int width = 640, height = 480;  ///< depth grid
  int color_scale = 1;            ///< colour size / depth size, 1 to 4
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: all; the result does not depend on it
};

/// `ideal`: images by first-order harmonics, I = rho (0.75 l.n + 0.25), 16-bit, no shadow, highlight, noise or
/// ambient light (the depth sensor keeps its noise). `real`: everything on, 8-bit: the defaults.
enum class Realism { ideal, real };
SimulateOptions realism_options(Realism realism);

}  // namespace rakelight
