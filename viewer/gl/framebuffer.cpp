// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/gl/framebuffer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>
#include <system_error>

namespace rakelight {
namespace {

constexpr GLint kSamples = 4;

GlObject storage(GLenum format, const cv::Size& size, GLint samples) {
  GlObject buffer = make_renderbuffer();
  glBindRenderbuffer(GL_RENDERBUFFER, buffer.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, size.width, size.height);
  return buffer;
}

void require_complete(const cv::Size& size) {
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  throw std::system_error(std::make_error_code(std::errc::not_supported),
                          "cannot draw a picture of " + std::to_string(size.width) + "x" +
                              std::to_string(size.height) + " on " + renderer_name() +
                              "; ask for a smaller one");
}

void copy(GLuint from, GLuint to, const cv::Size& size) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlitFramebuffer(0, 0, size.width, size.height, 0, 0, size.width, size.height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
}

void require_size(const cv::Size& size) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
  if (std::max(size.width, size.height) <= most) return;
  throw std::system_error(std::make_error_code(std::errc::not_supported),
                          "cannot draw a picture of " + std::to_string(size.width) + "x" +
                              std::to_string(size.height) + ": " + renderer_name() + " ends at " +
                              std::to_string(most) + " pixels a side; ask for a smaller one");
}

}  // namespace

Framebuffer::Framebuffer(const cv::Size& size) : size_(size) {
  require_size(size);
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  const GLint samples = std::min(kSamples, most);
  color_ = storage(GL_RGBA8, size, samples);
  depth_ = storage(GL_DEPTH_COMPONENT24, size, samples);
  resolved_color_ = storage(GL_RGBA8, size, 0);
  resolved_ = make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, resolved_color_.id());
  require_complete(size);
  drawn_ = make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  require_complete(size);
}

void Framebuffer::bind() const { glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id()); }

void Framebuffer::resolve() const {
  copy(drawn_.id(), resolved_.id(), size_);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
}

cv::Mat3b Framebuffer::read() const {
  resolve();
  cv::Mat3b picture = read_pixels(size_);
  bind();
  return picture;
}

/// In two steps: samples are merged between buffers of one format only, and the window's may be another.
void Framebuffer::show_in_window() const {
  resolve();
  copy(resolved_.id(), 0, size_);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

bool is_software_renderer() {
  const std::string name = renderer_name();
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos;
}

void clear_window() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

cv::Mat3b read_pixels(const cv::Size& size) {
  cv::Mat3b upside_down(size), picture;
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.width, size.height, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data);
  cv::flip(upside_down, picture, 0);
  return picture;
}

}  // namespace rakelight
