// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/gl/gl_object.h"

#include <epoxy/gl.h>

#include <string>
#include <system_error>

namespace rakelight {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::system_error(std::make_error_code(std::errc::not_supported), what);
}

GlObject make_shader(GLenum kind, const char* source) {
  GlObject shader(glCreateShader(kind), [](unsigned id) { glDeleteShader(id); });
  glShaderSource(shader.id(), 1, &source, nullptr);
  glCompileShader(shader.id());
  GLint compiled = 0;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled != 0) return shader;
  std::string log(1024, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  refuse("cannot compile a shader on " + std::string(renderer_name()) + ": " + log +
         "; update the graphics driver");
}

}  // namespace

GlObject make_buffer() {
  GLuint id = 0;
  glGenBuffers(1, &id);
  return {id, [](unsigned buffer) { glDeleteBuffers(1, &buffer); }};
}

GlObject make_vertex_array() {
  GLuint id = 0;
  glGenVertexArrays(1, &id);
  return {id, [](unsigned array) { glDeleteVertexArrays(1, &array); }};
}

GlObject make_framebuffer() {
  GLuint id = 0;
  glGenFramebuffers(1, &id);
  return {id, [](unsigned framebuffer) { glDeleteFramebuffers(1, &framebuffer); }};
}

GlObject make_renderbuffer() {
  GLuint id = 0;
  glGenRenderbuffers(1, &id);
  return {id, [](unsigned renderbuffer) { glDeleteRenderbuffers(1, &renderbuffer); }};
}

GlObject make_texture() {
  GLuint id = 0;
  glGenTextures(1, &id);
  return {id, [](unsigned texture) { glDeleteTextures(1, &texture); }};
}

GlObject make_program(const char* vertex_shader, const char* fragment_shader) {
  const GlObject vertex = make_shader(GL_VERTEX_SHADER, vertex_shader);
  const GlObject fragment = make_shader(GL_FRAGMENT_SHADER, fragment_shader);
  GlObject program(glCreateProgram(), [](unsigned id) { glDeleteProgram(id); });
  glAttachShader(program.id(), vertex.id());
  glAttachShader(program.id(), fragment.id());
  glLinkProgram(program.id());
  GLint linked = 0;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
  if (linked == 0)
    refuse("cannot link a shader on " + std::string(renderer_name()) + "; update the graphics driver");
  return program;
}

void require_opengl_33(const char* path) {
  const int version = epoxy_gl_version();
  if (version >= 33) return;
  refuse("cannot draw: " + std::string(path) + " gives OpenGL " + std::to_string(version / 10) + "." +
         std::to_string(version % 10) + " and 3.3 is needed; update the graphics driver");
}

const char* renderer_name() {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name == nullptr ? "an unknown renderer" : reinterpret_cast<const char*>(name);
}

}  // namespace rakelight
