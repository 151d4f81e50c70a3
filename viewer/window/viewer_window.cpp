// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/viewer_window.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <future>
#include <optional>

#include "stack/image_file.h"
#include "viewer/commands.h"
#include "viewer/gl/display_loss.h"
#include "viewer/gl/glfw_window.h"
#include "viewer/mouse.h"
#include "viewer/window/interface.h"
#include "viewer/window/live_pictures.h"
#include "viewer/window/panel.h"
#include "viewer/window/shown_scene.h"
#include "viewer/window/window_events.h"

namespace rakelight {
namespace {

constexpr int kSettlingFrames = 3;  ///< Dear ImGui needs some frames to answer an event

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
  std::unique_ptr<ShownScene> shown;
  std::unique_ptr<LivePictures> live;
  std::future<Scene> with_its_stack;  ///< what is shown, with its scan, while that is read
  ViewState state;
  MouseControl mouse{[this](const cv::Point2d& at) {
    if (shown) shown->click(state, device_coordinates(at, units()));
  }};
  WindowEvents events = make_events();
  int frames_to_draw = kSettlingFrames;
  bool quick_frames = false;  ///< where drawing takes long, all but the last frame are quick

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
  WindowEvents make_events();
  void press_key(const std::string& key);
  void open(const std::filesystem::path& folder);
  void replace(Scene scene, const Look& look, const ViewPoint& view);
  void show_stack_when_read();
  void draw(Detail detail);
  void save_picture(const cv::Size& size);
};

WindowEvents ViewerWindow::Impl::make_events() {
  WindowEvents handlers;
  handlers.any = [this] { frames_to_draw = kSettlingFrames; };
  handlers.key = [this](const std::string& key) { press_key(key); };
  handlers.press = [this](MouseButton button, bool shift, const cv::Point2d& at) {
    if (!interface->wants_mouse()) mouse.press(state, button, shift, at, units());
  };
  handlers.release = [this](const cv::Point2d& at) { mouse.release(at); };
  handlers.move = [this](const cv::Point2d& at) {
    if (!interface->wants_mouse()) mouse.move(state, at, units());
  };
  handlers.scroll = [this](double notches, const cv::Point2d& at) {
    if (!interface->wants_mouse()) mouse.scroll(state, notches, at, units());
  };
  handlers.drop = [this](const std::filesystem::path& path) { open(path); };
  return handlers;
}

/// Live pictures can only be left.
void ViewerWindow::Impl::press_key(const std::string& key) {
  if (shown) {
    rakelight::press_key(key, state, shown->scene());
  } else if (key == "Q") {
    state.wants_quit = true;
  }
}

void ViewerWindow::Impl::replace(Scene scene, const Look& look, const ViewPoint& view) {
  check_look(scene, look);
  auto next = std::make_unique<ShownScene>(std::move(scene), look);
  state.bounds = next->bounds();
  const cv::Size2d size = units();
  state.aspect = size.width / size.height;
  state.camera = camera_at(view, state.bounds, state.aspect);
  state.look = look;
  state.points.clear();
  state.tool = Tool::none;
  shown = std::move(next);
  live.reset();
  with_its_stack = {};
  if (!shown->scene().stack.empty())
    with_its_stack = std::async(std::launch::async, with_stack, shown->scene());
  frames_to_draw = kSettlingFrames;
  glfwSetWindowTitle(window.get(), ("Rakelight - " + shown->scene().title).c_str());
}

void ViewerWindow::Impl::open(const std::filesystem::path& folder) {
  try {
    Scene scene = open_scene({folder, {}});
    const Look look = default_look(scene);
    replace(std::move(scene), look, {});
    state.status = "opened " + folder.string();
  } catch (const std::exception& error) { state.status = error.what(); }
}

void ViewerWindow::Impl::show_stack_when_read() {
  if (!with_its_stack.valid() ||
      with_its_stack.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return;
  shown->extend(with_its_stack.get());
  frames_to_draw = kSettlingFrames;
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

void ViewerWindow::Impl::draw(Detail detail) {
  const cv::Size size = pixels();
  if (size.empty()) return;  // minimised
  state.aspect = static_cast<double>(size.width) / size.height;
  const bool taking = state.wants_picture;
  if (shown) {
    shown->draw(state, size, taking ? Detail::full : detail);
  } else {
    clear_window();
  }
  interface->begin_frame();
  if (live) live->draw(cv::Size2f(units()));
  shown ? shown->draw_interface(state, cv::Size2f(units())) : draw_status(state, cv::Size2f(units()));
  interface->end_frame();
  if (taking) save_picture(size);
  glfwSwapBuffers(window.get());
}

ViewerWindow::ViewerWindow(const std::string& title, const cv::Size& size) : impl_(std::make_unique<Impl>()) {
  impl_->window = make_glfw_window(title, size.width, size.height, true);
  glfwSwapInterval(1);
  impl_->quick_frames = is_software_renderer();
  listen(impl_->window.get(), impl_->events);
  impl_->interface.emplace(impl_->window.get());
}

ViewerWindow::~ViewerWindow() = default;

void ViewerWindow::show(Scene scene, const Look& look, const ViewPoint& view, bool light_follows_mouse) {
  impl_->replace(std::move(scene), look, view);
  impl_->state.light_follows_mouse = light_follows_mouse;
}

void ViewerWindow::update(Scene scene) {
  check_look(scene, impl_->state.look);
  auto next = std::make_unique<ShownScene>(std::move(scene), impl_->state.look);
  impl_->state.bounds = next->bounds();
  impl_->shown = std::move(next);
  impl_->with_its_stack = {};
  impl_->frames_to_draw = kSettlingFrames;
}

void ViewerWindow::show_pictures(const cv::Mat3b& color, const cv::Mat3b& depth) {
  impl_->with_its_stack = {};
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
    constexpr double kReading = 0.05;  // seconds
    glfwWaitEventsTimeout(impl_->with_its_stack.valid() ? std::min(most_wait, kReading) : most_wait);
  }
  require_display();
  impl_->show_stack_when_read();
  if (impl_->state.wants_quit || glfwWindowShouldClose(impl_->window.get()) == GLFW_TRUE) return false;
  if (impl_->frames_to_draw == 0) return true;
  --impl_->frames_to_draw;
  impl_->draw(impl_->quick_frames && impl_->frames_to_draw > 0 ? Detail::quick : Detail::full);
  return true;
}

void run_viewer(Scene scene, const Look& look, const ViewPoint& view, const WindowOptions& options) {
  ViewerWindow window("Rakelight", options.size);
  window.show(std::move(scene), look, view, options.light_follows_mouse);
  constexpr double kWait = 0.5;  // seconds; events end it early
  while (window.step(kWait)) {}
}

}  // namespace rakelight
