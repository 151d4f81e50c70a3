// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <dlfcn.h>
#include <epoxy/egl.h>

#include <system_error>

#include "viewer/gl/gl_object.h"
#include "viewer/gl/offscreen_context.h"

namespace rakelight {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::system_error(std::make_error_code(std::errc::not_supported), "EGL without a display: " + what);
}

/// libepoxy ends the program where the library is missing, so that is asked first.
void require_library() {
  void* library = dlopen("libEGL.so.1", RTLD_LAZY);
  if (library == nullptr) refuse("no libEGL.so.1");
  dlclose(library);
}

class EglContext : public OffscreenContext {
 public:
  EglContext() {
    require_library();
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
      refuse("no surfaceless platform");
    display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE)
      refuse("no driver starts");
    try {
      make_current();
    } catch (...) {
      release();
      throw;
    }
  }
  ~EglContext() override { release(); }

  std::string path() const override { return "EGL without a display on " + std::string(renderer_name()); }

 private:
  void make_current() {
    eglBindAPI(EGL_OPENGL_API);
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglChooseConfig(display_, wanted, &config, 1, &count);
    if (count == 0) config = EGL_NO_CONFIG_KHR;
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                              3,
                              EGL_CONTEXT_MINOR_VERSION,
                              3,
                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                              EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
    if (context_ == EGL_NO_CONTEXT) refuse("the driver is older than OpenGL 3.3");
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
      refuse("the driver needs a surface");
    require_opengl_33("EGL without a display");
  }

  void release() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    eglTerminate(display_);
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<OffscreenContext> make_egl_context() { return std::make_unique<EglContext>(); }

}  // namespace rakelight
