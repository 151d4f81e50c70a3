// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/viewer_window.h"

#include <GLFW/glfw3.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "stack/errors.h"
#include "stack/image_file.h"
#include "viewer/commands.h"
#include "viewer/gl/display_loss.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/glfw_window.h"
#include "viewer/gl/scene_renderer.h"
#include "viewer/mouse.h"
#include "viewer/picking.h"
#include "viewer/window/filmstrip.h"
#include "viewer/window/interface.h"
#include "viewer/window/key_names.h"
#include "viewer/window/legend.h"
#include "viewer/window/live_pictures.h"
#include "viewer/window/marks.h"
#include "viewer/window/panel.h"
#include "viewer/window/plots.h"

namespace rakelight {
namespace {

constexpr int kSamples = 4;
constexpr int kSettlingFrames = 3;  ///< Dear ImGui needs some frames to answer an event

/// A scene and all that is made of it.
struct Shown {
  explicit Shown(Scene shown) : scene(std::move(shown)), surfaces(scene), renderer(surfaces) {}
  Scene scene;
  Surfaces surfaces;
  SceneRenderer renderer;
  Filmstrip filmstrip;
};

/// The first of rakelight-0001.png, rakelight-0002.png … that does not exist.
std::filesystem::path free_picture_name() {
  for (int number = 1;; ++number) {
    char name[32];
    std::snprintf(name, sizeof name, "rakelight-%04d.png", number);
    if (!std::filesystem::exists(name)) return name;
  }
}

}  // namespace

struct ViewerWindow::Impl {
  GlfwWindowPtr window;
  std::optional<Interface> interface;
  std::unique_ptr<Shown> shown;
  std::unique_ptr<LivePictures> live;
  ViewState state;
  MouseControl mouse{[this](const cv::Point2d& at) { click(at); }};
  Look last_good;
  cv::Point2d cursor;  ///< where the last event said it was; asked for now, it might have moved on
  int frames_to_draw = kSettlingFrames;

  cv::Size2d units() const {
    int width = 1, height = 1;
    glfwGetWindowSize(window.get(), &width, &height);
    return cv::Size2d(std::max(1, width), std::max(1, height));
  }
  cv::Size pixels() const {
    cv::Size size;
    glfwGetFramebufferSize(window.get(), &size.width, &size.height);
    return size;
  }
  void listen();
  void press(const std::string& key);
  void click(const cv::Point2d& at);
  void open(const std::filesystem::path& folder);
  void replace(Scene scene, const Look& look, const ViewPoint& view);
  void draw_scene(const cv::Size& size);
  void draw_interface();
  void draw();
  void save_picture(const cv::Size& size);
};

/// Callbacks of C code: what they call may throw only on dropped folders, and that is caught in open().
void ViewerWindow::Impl::listen() {
  GLFWwindow* const glfw = window.get();
  glfwSetWindowUserPointer(glfw, this);
  const auto self = [](GLFWwindow* w) {
    auto* impl = static_cast<Impl*>(glfwGetWindowUserPointer(w));
    impl->frames_to_draw = kSettlingFrames;
    return impl;
  };
  static const auto owner = self;
  glfwSetMouseButtonCallback(glfw, [](GLFWwindow* w, int button, int action, int modifiers) {
    Impl& impl = *owner(w);
    if (action == GLFW_RELEASE) return impl.mouse.release(impl.cursor);
    if (impl.interface->wants_mouse()) return;
    const MouseButton which = button == GLFW_MOUSE_BUTTON_LEFT    ? MouseButton::left
                              : button == GLFW_MOUSE_BUTTON_RIGHT ? MouseButton::right
                                                                  : MouseButton::middle;
    impl.mouse.press(impl.state, which, (modifiers & GLFW_MOD_SHIFT) != 0, impl.cursor, impl.units());
  });
  glfwSetCursorPosCallback(glfw, [](GLFWwindow* w, double x, double y) {
    Impl& impl = *owner(w);
    impl.cursor = {x, y};
    if (!impl.interface->wants_mouse()) impl.mouse.move(impl.state, impl.cursor, impl.units());
  });
  glfwSetScrollCallback(glfw, [](GLFWwindow* w, double, double notches) {
    Impl& impl = *owner(w);
    if (!impl.interface->wants_mouse()) impl.mouse.scroll(impl.state, notches, impl.cursor, impl.units());
  });
  glfwSetKeyCallback(glfw, [](GLFWwindow* w, int key, int scancode, int action, int) {
    Impl& impl = *owner(w);
    if (action == GLFW_PRESS) impl.press(key_name(key, scancode));
  });
  glfwSetDropCallback(glfw, [](GLFWwindow* w, int count, const char** paths) {
    if (count > 0) owner(w)->open(paths[0]);
  });
  glfwSetWindowRefreshCallback(glfw, [](GLFWwindow* w) { owner(w); });
  glfwSetFramebufferSizeCallback(glfw, [](GLFWwindow* w, int, int) { owner(w); });
}

/// Live pictures can only be left.
void ViewerWindow::Impl::press(const std::string& key) {
  if (shown) {
    press_key(key, state, shown->scene);
  } else if (key == "Q") {
    state.wants_quit = true;
  }
}

void ViewerWindow::Impl::click(const cv::Point2d& at) {
  if (!shown || state.tool == Tool::none) return;
  const cv::Point2d device = device_coordinates(at, units());
  const bool before = state.look.split && (device.x + 1) / 2 < state.look.divider;
  const Surface& surface = shown->surfaces.of(before ? state.look.before : state.look.layer);
  const auto picked = pick(surface, ray_through(state.camera, state.aspect, device.x, device.y));
  if (!picked) {
    state.status = "no surface there";
    return;
  }
  add_point(state, picked->point);
  char text[120];
  std::snprintf(text, sizeof text, "point at (%.2f, %.2f, %.2f) mm", 1000 * picked->point.x(),
                1000 * picked->point.y(), 1000 * picked->point.z());
  state.status = text;
  if (state.points.size() < 2) return;
  std::snprintf(text, sizeof text, "distance %.2f mm", measured_mm(state));
  state.status = text;
}

void ViewerWindow::Impl::replace(Scene scene, const Look& look, const ViewPoint& view) {
  check_look(scene, look);
  auto next = std::make_unique<Shown>(std::move(scene));
  state.bounds = next->surfaces.bounds();
  const cv::Size2d size = units();
  state.aspect = size.width / size.height;
  state.camera = camera_at(view, state.bounds, state.aspect);
  state.look = last_good = look;
  state.points.clear();
  state.tool = Tool::none;
  shown = std::move(next);
  live.reset();
  frames_to_draw = kSettlingFrames;
  glfwSetWindowTitle(window.get(), ("Rakelight - " + shown->scene.title).c_str());
}

void ViewerWindow::Impl::open(const std::filesystem::path& folder) {
  try {
    Scene scene = open_scene({folder, {}});
    const Look look = default_look(scene);
    replace(std::move(scene), look, {});
    state.status = "opened " + folder.string();
  } catch (const std::exception& error) { state.status = error.what(); }
}

/// A layer that cannot be drawn is refused in the status line, and the one before it comes back.
void ViewerWindow::Impl::draw_scene(const cv::Size& size) {
  try {
    shown->renderer.draw(state.look, state.camera, size);
    last_good = state.look;
  } catch (const InputError& error) {
    state.status = error.what();
    state.look = last_good;
    shown->renderer.draw(state.look, state.camera, size);
  }
}

void ViewerWindow::Impl::draw_interface() {
  const cv::Size2f size(units());
  if (live) live->draw(size);
  if (!shown) return draw_status(state, size);
  Scene& scene = shown->scene;
  draw_legend(shown->surfaces.range(state.look.coloring), state.look, size);
  draw_marks(state, size);
  if (state.wants_picture) return;  // the rest is not part of it
  draw_status(state, size);
  if (state.show_panel) draw_panel(state, scene);
  if (state.show_keys) draw_keys_page(state);
  if (state.show_frames) shown->filmstrip.draw(state, scene);
  if (state.show_convergence) draw_convergence(state, scene);
  draw_profile(state, scene);
}

void ViewerWindow::Impl::save_picture(const cv::Size& size) {
  state.wants_picture = false;
  frames_to_draw = kSettlingFrames;
  try {
    const std::filesystem::path file = free_picture_name();
    write_png(file, read_pixels(size));
    state.status = "wrote " + std::filesystem::absolute(file).string();
  } catch (const std::exception& error) { state.status = error.what(); }
}

void ViewerWindow::Impl::draw() {
  const cv::Size size = pixels();
  if (size.empty()) return;  // minimised
  state.aspect = static_cast<double>(size.width) / size.height;
  clear_window();
  const bool taking = state.wants_picture;
  if (shown) draw_scene(size);
  interface->begin_frame();
  draw_interface();
  interface->end_frame();
  if (taking) save_picture(size);
  glfwSwapBuffers(window.get());
}

ViewerWindow::ViewerWindow(const std::string& title, const cv::Size& size) : impl_(std::make_unique<Impl>()) {
  impl_->window = make_glfw_window(title, size.width, size.height, true, kSamples);
  glfwSwapInterval(1);
  impl_->listen();
  impl_->interface.emplace(impl_->window.get());
}

ViewerWindow::~ViewerWindow() = default;

void ViewerWindow::show(Scene scene, const Look& look, const ViewPoint& view, bool light_follows_mouse) {
  impl_->replace(std::move(scene), look, view);
  impl_->state.light_follows_mouse = light_follows_mouse;
}

void ViewerWindow::update(Scene scene) {
  check_look(scene, impl_->state.look);
  auto next = std::make_unique<Shown>(std::move(scene));
  impl_->state.bounds = next->surfaces.bounds();
  impl_->shown = std::move(next);
  impl_->frames_to_draw = kSettlingFrames;
}

void ViewerWindow::show_pictures(const cv::Mat3b& color, const cv::Mat3b& depth) {
  impl_->shown.reset();
  if (!impl_->live) impl_->live = std::make_unique<LivePictures>();
  impl_->live->set(color, depth);
  impl_->frames_to_draw = kSettlingFrames;
}

void ViewerWindow::set_status(const std::string& text) {
  impl_->state.status = text;
  impl_->frames_to_draw = kSettlingFrames;
}

bool ViewerWindow::step(double most_wait) {
  if (impl_->frames_to_draw > 0) {
    glfwPollEvents();
  } else {
    glfwWaitEventsTimeout(most_wait);
  }
  require_display();
  if (impl_->state.wants_quit || glfwWindowShouldClose(impl_->window.get()) == GLFW_TRUE) return false;
  if (impl_->frames_to_draw == 0) return true;
  --impl_->frames_to_draw;
  impl_->draw();
  return true;
}

void run_viewer(Scene scene, const Look& look, const ViewPoint& view, const WindowOptions& options) {
  ViewerWindow window("Rakelight", options.size);
  window.show(std::move(scene), look, view, options.light_follows_mouse);
  constexpr double kWait = 0.5;  // seconds; events end it early
  while (window.step(kWait)) {}
}

}  // namespace rakelight
