// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/live_view.h"

#include <atomic>
#include <future>

#include "viewer/window/viewer_window.h"

namespace rakelight {
namespace {

/// The surface so far as a scene. The first one is kept beside it as what the refinement started from.
Scene scene_so_far(const Camera& camera, const cv::Mat1f& start, const cv::Mat1f& depth) {
  Scene scene;
  scene.title = "the surface so far";
  if (start.size() == depth.size()) scene.layers.push_back({LayerKind::preprocessed, camera, start, {}});
  scene.layers.push_back({LayerKind::refined, camera, depth, {}});
  return scene;
}

class LiveWindow {
 public:
  LiveWindow(const std::string& title, const cv::Size& size) : window_(title, size) {}

  void show(const LiveFeed::News& news) {
    if (!news.any) return;
    if (news.camera) {
      show_surface(*news.camera, news.surface);
    } else if (!has_surface_) {
      window_.show_pictures(news.color, news.depth);
    }
    if (!news.status.empty()) window_.set_status(news.status);
  }
  bool step() {
    constexpr double kWait = 0.03;  // seconds: the feed is asked about as often as a sensor has frames
    return window_.step(kWait);
  }

 private:
  void show_surface(const Camera& camera, const cv::Mat1f& depth) {
    if (start_.size() != depth.size()) start_ = depth;
    Scene scene = scene_so_far(camera, start_, depth);
    if (has_surface_) return window_.update(std::move(scene));
    const Look look = default_look(scene);
    window_.show(std::move(scene), look, {}, false);
    has_surface_ = true;
  }

  ViewerWindow window_;
  cv::Mat1f start_;
  bool has_surface_ = false;
};

}  // namespace

void show_live(const std::string& title, const cv::Size& size, const std::function<void(LiveFeed&)>& work,
               bool stay) {
  LiveWindow window(title, size);
  LiveFeed feed;
  std::future<void> done = std::async(std::launch::async, [&work, &feed] { work(feed); });
  const auto working = [&done] {
    return done.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
  };
  bool open = true;
  try {
    while (open && working()) {
      window.show(feed.take());
      open = window.step();
    }
  } catch (...) {
    feed.stop_watching();  // the work goes on and is waited for; what the window lacked is told then
    done.get();
    throw;
  }
  if (!open) feed.stop_watching();
  done.get();
  if (!open) return;
  window.show(feed.take());
  while (stay && window.step()) {}
}

}  // namespace rakelight
