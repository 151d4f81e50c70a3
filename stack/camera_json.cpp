// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/camera_json.h"

#include "stack/png_header.h"

namespace rakelight {
namespace {

constexpr double kMaxPixels = 1e6;  // focal lengths, principal points

}  // namespace

Camera read_camera(ObjectReader& camera) {
  Camera result;
  result.width = static_cast<int>(camera.integer("width", 1, kMaxImageSide));
  result.height = static_cast<int>(camera.integer("height", 1, kMaxImageSide));
  if (std::uint64_t(result.width) * std::uint64_t(result.height) > kMaxImagePixels) {
    camera.refuse("width x height", "is too large", "use images of at most 64 megapixels");
  }
  result.fx = camera.number("fx", 1e-3, kMaxPixels);
  result.fy = camera.number("fy", 1e-3, kMaxPixels);
  result.cx = camera.number("cx", -kMaxPixels, kMaxPixels);
  result.cy = camera.number("cy", -kMaxPixels, kMaxPixels);
  result.distortion = camera.maybe_numbers("distortion").value_or(std::vector<double>{});
  const std::size_t count = result.distortion.size();
  if (count != 0 && count != 4 && count != 5 && count != 8) {
    camera.refuse("distortion", "does not have 0, 4, 5 or 8 coefficients", "write k1 k2 p1 p2 k3 k4 k5 k6");
  }
  return result;
}

nlohmann::ordered_json camera_json(const Camera& camera) {
  return {{"width", camera.width},
          {"height", camera.height},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"distortion", camera.distortion}};
}

}  // namespace rakelight
