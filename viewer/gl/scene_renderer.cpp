// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/gl/scene_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "viewer/coloring.h"
#include "viewer/shaders/surface_shader.h"

namespace rakelight {
namespace {

constexpr int kAsPainted = 3;

int material_number(const Look& look) {
  if (!is_lit(look.coloring)) return kAsPainted;
  switch (look.material) {
    case Material::matte:
      return 0;
    case Material::clay:
      return 1;
    case Material::chrome:
      return 2;
  }
  return kAsPainted;
}

void clear(Background background) {
  if (background == Background::white) {
    glClearColor(1, 1, 1, 1);
  } else {
    glClearColor(0.105f, 0.11f, 0.125f, 1);
  }
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/// Points so large that those of the nearest surface touch.
float point_size(const Surface& surface, const OrbitCamera& camera, const cv::Size& size) {
  const double width_m = surface.bounds.high[0] - surface.bounds.low[0];
  const double height_m = surface.bounds.high[1] - surface.bounds.low[1];
  const double spacing_m = std::sqrt(width_m * height_m / static_cast<double>(surface.positions.size()));
  const double pixel_m = 2 * camera.distance * std::tan(camera.fov_y / 2) / size.height;
  return static_cast<float>(std::clamp(spacing_m / pixel_m, 1.0, 16.0));
}

}  // namespace

SceneRenderer::SceneRenderer(Surfaces& surfaces)
    : surfaces_(surfaces), program_(make_program(kSurfaceVertexShader, kSurfaceFragmentShader)) {}

const SurfaceBuffers& SceneRenderer::painted(LayerKind layer, const Look& look) {
  const std::pair<Coloring, int> paint(look.coloring, look.coloring == Coloring::image ? look.image : 0);
  auto found = uploaded_.find(layer);
  if (found != uploaded_.end() && found->second.paint == paint) return found->second.buffers;
  const Surface& surface = surfaces_.of(layer);
  if (found == uploaded_.end())
    found = uploaded_.emplace(layer, Uploaded{SurfaceBuffers(surface), paint}).first;
  const Scene& scene = surfaces_.scene();
  found->second.buffers.set_colors(
      colors_of(scene, *scene.find(layer), surface, paint.first, paint.second, surfaces_.range(paint.first)));
  found->second.paint = paint;
  return found->second.buffers;
}

void SceneRenderer::set_uniforms(const Look& look, const OrbitCamera& camera, const cv::Size& size) {
  const auto place = [this](const char* name) { return glGetUniformLocation(program_.id(), name); };
  const double aspect = static_cast<double>(size.width) / size.height;
  const Eigen::Matrix4f view = view_matrix(camera).cast<float>();
  const Eigen::Matrix4f projection = projection_matrix(camera, aspect, surfaces_.bounds()).cast<float>();
  glUseProgram(program_.id());
  glUniformMatrix4fv(place("view"), 1, GL_FALSE, view.data());
  glUniformMatrix4fv(place("projection"), 1, GL_FALSE, projection.data());
  glUniform3fv(place("light"), 1, light_direction(look.light).data());
  glUniform1i(place("material"), material_number(look));
  glUniform1i(place("orthographic"), camera.orthographic ? 1 : 0);
}

void SceneRenderer::draw(const Look& look, const OrbitCamera& camera, const cv::Size& size, Detail detail) {
  glViewport(0, 0, size.width, size.height);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_PROGRAM_POINT_SIZE);
  clear(look.background);
  set_uniforms(look, camera, size);
  const auto draw_layer = [&](LayerKind layer) {
    const SurfaceBuffers& buffers = painted(layer, look);
    glUniform1f(glGetUniformLocation(program_.id(), "point_size"),
                point_size(surfaces_.of(layer), camera, size));
    if (look.points) return buffers.draw_points();
    detail == Detail::quick ? buffers.draw_coarse_mesh() : buffers.draw_mesh();
  };
  if (!look.split) return draw_layer(look.layer);
  const int divider = static_cast<int>(std::lround(look.divider * size.width));
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, divider, size.height);
  draw_layer(look.before);
  glScissor(divider, 0, size.width - divider, size.height);
  draw_layer(look.layer);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace rakelight
