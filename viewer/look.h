// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a scene is looked at: which layer, painted by what, in what light.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "viewer/scene.h"

namespace rakelight {

/// What paints the surface. Maps (all after albedo) are drawn without light, so that their colours match the scale bar.
enum class Coloring { plain, albedo, image, normals, depth, delta, uncertainty, error };

/// How the surface answers the light.
enum class Material {
  matte,   ///< Lambertian
  clay,    ///< Lambertian with a fill light and a dull sheen: relief reads best
  chrome,  ///< a mirror in a dark studio with one bright window, the light
};

enum class Background { dark, white };

/// Direction to the light, seen in the picture: azimuth 0 = from the right, 90 = from above; elevation 0 = grazing,
/// 90 = from the viewer.
struct LightAngles {
  double azimuth_deg = 135;
  double elevation_deg = 22;
};

struct Look {
  LayerKind layer = LayerKind::refined;  ///< right of the divider with split
  LayerKind before = LayerKind::sensor;  ///< left of the divider
  bool split = false;
  double divider = 0.5;  ///< share of the width, 0 to 1
  Coloring coloring = Coloring::plain;
  int image = 0;  ///< of Coloring::image: index in Scene::frames
  Material material = Material::clay;
  LightAngles light;
  bool points = false;  ///< points instead of a mesh
  Background background = Background::dark;
};

template <class Enum>
struct Named {
  Enum value;
  const char* name;
};

inline constexpr std::array<Named<LayerKind>, 4> kLayerNames{{{LayerKind::sensor, "sensor"},
                                                              {LayerKind::preprocessed, "preprocessed"},
                                                              {LayerKind::refined, "refined"},
                                                              {LayerKind::truth, "truth"}}};
inline constexpr std::array<Named<Coloring>, 8> kColoringNames{{{Coloring::plain, "plain"},
                                                                {Coloring::albedo, "albedo"},
                                                                {Coloring::image, "image"},
                                                                {Coloring::normals, "normals"},
                                                                {Coloring::depth, "depth"},
                                                                {Coloring::delta, "delta"},
                                                                {Coloring::uncertainty, "uncertainty"},
                                                                {Coloring::error, "error"}}};
inline constexpr std::array<Named<Material>, 3> kMaterialNames{
    {{Material::matte, "matte"}, {Material::clay, "clay"}, {Material::chrome, "chrome"}}};

template <class Enum, std::size_t N>
std::string name_of(const std::array<Named<Enum>, N>& names, Enum value) {
  for (const auto& named : names) {
    if (named.value == value) return named.name;
  }
  return "unknown";
}

/// @return empty when there is no such name
template <class Enum, std::size_t N>
std::optional<Enum> value_of(const std::array<Named<Enum>, N>& names, const std::string& name) {
  for (const auto& named : names) {
    if (name == named.name) return named.value;
  }
  return std::nullopt;
}

/// Whether the light shades this colouring: maps and photographs are shown as they are.
inline bool is_lit(Coloring coloring) { return coloring == Coloring::plain || coloring == Coloring::albedo; }

/// Unit vector from the surface to the light; x right, y up, z to the viewer.
std::array<float, 3> light_direction(const LightAngles& light);

/// The light for a mouse at (x, y), each -1 to 1 from the left and bottom edge: straight at the middle, grazing at the
/// edges.
LightAngles light_at(double x, double y);

}  // namespace rakelight
