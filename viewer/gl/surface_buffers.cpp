// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/gl/surface_buffers.h"

#include <epoxy/gl.h>

namespace rakelight {
namespace {

template <class T>
void fill(GLenum target, const GlObject& buffer, const std::vector<T>& values) {
  glBindBuffer(target, buffer.id());
  glBufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(), GL_STATIC_DRAW);
}

}  // namespace

SurfaceBuffers::SurfaceBuffers(const Surface& surface)
    : array_(make_vertex_array()),
      positions_(make_buffer()),
      normals_(make_buffer()),
      colors_(make_buffer()),
      indices_(make_buffer()),
      coarse_indices_(make_buffer()),
      points_(static_cast<int>(surface.positions.size())),
      indices_count_(static_cast<int>(3 * surface.triangles.size())),
      coarse_indices_count_(static_cast<int>(3 * surface.coarse_triangles.size())) {
  glBindVertexArray(array_.id());
  fill(GL_ARRAY_BUFFER, positions_, surface.positions);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  glEnableVertexAttribArray(0);
  fill(GL_ARRAY_BUFFER, normals_, surface.normals);
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  glEnableVertexAttribArray(1);
  glBindBuffer(GL_ARRAY_BUFFER, colors_.id());
  glVertexAttribPointer(2, 3, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
  glEnableVertexAttribArray(2);
  fill(GL_ELEMENT_ARRAY_BUFFER, coarse_indices_, surface.coarse_triangles);
  fill(GL_ELEMENT_ARRAY_BUFFER, indices_, surface.triangles);
}

void SurfaceBuffers::set_colors(const std::vector<cv::Vec3b>& colors) {
  fill(GL_ARRAY_BUFFER, colors_, colors);
}

void SurfaceBuffers::draw_points() const {
  glBindVertexArray(array_.id());
  glDrawArrays(GL_POINTS, 0, points_);
}

void SurfaceBuffers::draw_mesh() const {
  glBindVertexArray(array_.id());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  glDrawElements(GL_TRIANGLES, indices_count_, GL_UNSIGNED_INT, nullptr);
}

void SurfaceBuffers::draw_coarse_mesh() const {
  if (coarse_indices_count_ == 0) return draw_mesh();
  glBindVertexArray(array_.id());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, coarse_indices_.id());
  glDrawElements(GL_TRIANGLES, coarse_indices_count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace rakelight
