// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/scan_view.h"

#include <utility>

#include "capture/watched_source.h"
#include "cli/interrupt.h"
#include "stack/color_response.h"
#include "viewer/live_view.h"
#include "viewer/open_scene.h"

namespace rakelight::cli {
namespace {

constexpr int kWidth = 1280, kHeight = 640;  ///< colour and depth beside each other

/// From the sensor's 8-bit codes to what a screen wants.
cv::Mat1b display_codes(const ColorResponse& response) {
  static const ColorResponse kScreen{ColorResponse::Kind::srgb, 1.0};
  cv::Mat1b codes(1, 256);
  for (int code = 0; code < 256; ++code)
    codes(code) = cv::saturate_cast<uchar>(255 * encode(kScreen, decode(response, code / 255.0)));
  return codes;
}

}  // namespace

bool ScanView::closed() const { return feed_ != nullptr && !feed_->is_watched(); }

std::unique_ptr<FrameSource> ScanView::watched(std::unique_ptr<FrameSource> source,
                                               ColorResponse response) const {
  if (feed_ == nullptr) return source;
  const double unit_m = source->describe().depth_unit_m;
  const cv::Mat1b codes = display_codes(response);
  return rakelight::watched(std::move(source), [=](Stream stream, const SensorFrame& frame) {
    if (stream == Stream::depth) return feed_->show_depth(frame.image, unit_m);
    cv::Mat3b picture;
    cv::LUT(frame.image, codes, picture);
    feed_->show_color(picture);
  });
}

void ScanView::say(const std::string& status) const {
  if (feed_ != nullptr) feed_->say(status);
}

void ScanView::show(const Progress& progress) {
  if (feed_ == nullptr) return;
  feed_->say(progress.iteration == 0 ? progress.stage
                                     : "refining: iteration " + std::to_string(progress.iteration));
  if (!progress.surface || progress.iteration == iteration_) return;
  iteration_ = progress.iteration;
  const SurfaceSoFar surface = progress.surface();
  feed_->show_surface(surface.camera, surface.depth);
}

void ScanView::show(const std::filesystem::path& stack, const std::filesystem::path& result) const {
  if (feed_ == nullptr) return;
  feed_->show_scene(result.empty() ? open_scene({stack, {}}) : open_scene({result, stack}));
  feed_->say("done; close the window to end");
}

void run_in_view(const std::function<void(ScanView&)>& scan) {
  const auto work = [&scan](LiveFeed& feed) {
    ScanView view(feed);
    scan(view);
  };
  show_live("Rakelight - scan", {kWidth, kHeight}, work, [] { return !interrupted(); });
}

}  // namespace rakelight::cli
