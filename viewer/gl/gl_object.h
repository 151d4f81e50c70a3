// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Owns one OpenGL object.
#pragma once

#include <utility>

namespace rakelight {

class GlObject {
 public:
  using Release = void (*)(unsigned);
  GlObject() = default;
  GlObject(unsigned id, Release release) : id_(id), release_(release) {}
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0U)), release_(other.release_) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(release_, other.release_);
    return *this;
  }
  ~GlObject() {
    if (id_ != 0) release_(id_);
  }
  unsigned id() const { return id_; }

 private:
  unsigned id_ = 0;
  Release release_ = nullptr;
};

GlObject make_buffer();
GlObject make_vertex_array();
GlObject make_framebuffer();
GlObject make_renderbuffer();
GlObject make_texture();

/// Compiles and links. @throws std::system_error with the driver's words: a driver that cannot is at fault
GlObject make_program(const char* vertex_shader, const char* fragment_shader);

/// Refuses what cannot draw. @param path how the context was made  @throws std::system_error below OpenGL 3.3
void require_opengl_33(const char* path);

/// Renderer and version in the driver's words.
const char* renderer_name();

}  // namespace rakelight
