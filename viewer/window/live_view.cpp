// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/live_view.h"

#include <chrono>
#include <future>
#include <utility>

#include "viewer/window/viewer_window.h"

namespace rakelight {
namespace {

Scene scene_so_far(const Camera& camera, const cv::Mat1f& depth) {
  Scene scene;
  scene.title = "the surface so far";
  scene.layers.push_back({LayerKind::refined, camera, depth, {}});
  return scene;
}

class LiveWindow {
 public:
  LiveWindow(const std::string& title, const cv::Size& size) : window_(title, size) {}

  void show(LiveFeed::News news) {
    if (!news.status.empty()) window_.set_status(news.status);
    if (news.scene) return show_scene(*std::move(news.scene));
    if (news.camera) {
      show_scene(scene_so_far(*news.camera, news.surface));
    } else if (!has_scene_ && !(news.color.empty() && news.depth.empty())) {
      const cv::Mat3b depth = news.depth.empty() ? cv::Mat3b() : depth_colors(news.depth, news.depth_unit_m);
      window_.show_pictures(news.color, depth);
    }
  }
  bool step() {
    constexpr double kWait = 0.03;  // seconds: the feed is asked about as often as a sensor has frames
    return window_.step(kWait);
  }

 private:
  /// Where the person has turned the surface it stays turned.
  void show_scene(Scene scene) {
    if (has_scene_) return window_.update(std::move(scene));
    const Look look = default_look(scene);
    window_.show(std::move(scene), look, {}, false);
    has_scene_ = true;
  }

  ViewerWindow window_;
  bool has_scene_ = false;
};

/// The work in its thread, waited for on every way out.
class Work {
 public:
  explicit Work(const std::function<void(LiveFeed&)>& work)
      : done_(std::async(std::launch::async, [this, &work] { work(feed_); })) {}
  ~Work() { feed_.stop_watching(); }  // the future waits
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  LiveFeed& feed() { return feed_; }
  bool is_done() const { return done_.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
  /// @throws what the work threw
  void finish() { done_.get(); }

 private:
  LiveFeed feed_;
  std::future<void> done_;
};

}  // namespace

void show_live(const std::string& title, const cv::Size& size, const std::function<void(LiveFeed&)>& work,
               const std::function<bool()>& keep_open) {
  LiveWindow window(title, size);
  Work running(work);
  bool open = true;
  while (open && !running.is_done()) {
    window.show(running.feed().take());
    open = window.step();
  }
  if (!open) running.feed().stop_watching();
  running.finish();
  window.show(running.feed().take());
  while (open && (!keep_open || keep_open())) open = window.step();
}

}  // namespace rakelight
