// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one shader of surfaces: points and triangles, lit or as they are.
#pragma once

namespace rakelight {

inline constexpr const char* kSurfaceVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 color;   // sRGB
uniform mat4 view, projection;
uniform float point_size;
out vec3 seen_position, seen_normal, paint;
void main() {
  vec4 seen = view * vec4(position, 1.0);
  seen_position = seen.xyz;
  seen_normal = mat3(view) * normal;
  paint = color;
  gl_Position = projection * seen;
  gl_PointSize = point_size;
}
)";

inline constexpr const char* kSurfaceFragmentShader = R"(#version 330 core
in vec3 seen_position, seen_normal, paint;
uniform vec3 light;        // to the light, view coordinates, unit length
uniform int material;      // 0 matte, 1 clay, 2 chrome, 3 as painted
uniform bool orthographic;
out vec4 result;

vec3 linear(vec3 srgb) { return pow(srgb, vec3(2.2)); }
vec3 encoded(vec3 radiance) { return pow(clamp(radiance, 0.0, 1.0), vec3(1.0 / 2.2)); }

// A studio: a bright half on the light's side, a dark one opposite, a soft edge between them that a flat surface seen
// from the front mirrors in grey, and a window around the light.
vec3 studio(vec3 direction) {
  vec2 side = light.xy / max(length(light.xy), 1e-4);
  float towards = dot(direction.xy, side);
  vec3 bright = mix(vec3(0.75, 0.80, 0.88), vec3(0.22, 0.26, 0.34), smoothstep(0.15, 1.0, towards));
  vec3 dark = mix(vec3(0.02, 0.02, 0.025), vec3(0.16, 0.14, 0.12), smoothstep(0.2, 1.0, -towards));
  float window = smoothstep(0.82, 0.95, dot(direction, light));
  return mix(dark, bright, smoothstep(-0.35, 0.35, towards)) + vec3(0.9, 0.88, 0.84) * window;
}

vec3 shaded(vec3 n, vec3 to_eye) {
  vec3 albedo = linear(paint);
  float lit = max(0.0, dot(n, light));
  if (material == 0) return albedo * (0.04 + 1.05 * lit);
  if (material == 1) {
    float fill = max(0.0, dot(n, to_eye));
    float sheen = 0.10 * pow(max(0.0, dot(n, normalize(light + to_eye))), 12.0);
    return albedo * (0.02 + 0.98 * lit + 0.16 * fill) + vec3(sheen * lit);
  }
  float edge = pow(1.0 - max(0.0, dot(n, to_eye)), 5.0);
  return studio(reflect(-to_eye, n)) * mix(min(vec3(1.0), albedo + 0.25), vec3(1.0), edge);
}

void main() {
  if (material == 3) {
    result = vec4(paint, 1.0);
    return;
  }
  vec3 to_eye = orthographic ? vec3(0.0, 0.0, 1.0) : normalize(-seen_position);
  vec3 n = normalize(seen_normal);
  bool behind = dot(n, to_eye) < -0.15;   // shading normals may look away a little near the outline
  vec3 radiance = shaded(behind ? -n : n, to_eye);
  result = vec4(encoded(behind ? 0.35 * radiance : radiance), 1.0);
}
)";

}  // namespace rakelight
