// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/watched_source.h"

#include <utility>

namespace rakelight {
namespace {

class WatchedSource : public FrameSource {
 public:
  WatchedSource(std::unique_ptr<FrameSource> source, FrameLook look)
      : source_(std::move(source)), look_(std::move(look)) {}

  SourceDescription describe() const override { return source_->describe(); }
  void start() override { source_->start(); }
  void stop() override { source_->stop(); }
  std::optional<SensorFrame> next(Stream stream, std::chrono::milliseconds timeout) override {
    std::optional<SensorFrame> frame = source_->next(stream, timeout);
    if (frame) look_(stream, *frame);
    return frame;
  }
  int overruns(Stream stream) const override { return source_->overruns(stream); }
  ExposureLock lock_exposure(double exposure_us, double gain) override {
    return source_->lock_exposure(exposure_us, gain);
  }

 private:
  std::unique_ptr<FrameSource> source_;
  FrameLook look_;
};

}  // namespace

std::unique_ptr<FrameSource> watched(std::unique_ptr<FrameSource> source, FrameLook look) {
  return std::make_unique<WatchedSource>(std::move(source), std::move(look));
}

}  // namespace rakelight
