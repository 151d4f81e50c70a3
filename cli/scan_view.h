// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What `scan --view` shows: colour and depth while lamps switch, the surface as it is refined, what came of it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "capture/frame_source.h"
#include "refine/refine.h"

namespace rakelight {
class LiveFeed;
}

namespace rakelight::cli {

/// The window, or none: one made by default shows nothing.
class ScanView {
 public:
  ScanView() = default;
  explicit ScanView(LiveFeed& feed) : feed_(&feed) {}

  /// Whether the person has closed it, which stops a scan as Ctrl-C does.
  bool closed() const;
  /// The source whose frames are shown as they are taken. @param response of its colour values
  std::unique_ptr<FrameSource> watched(std::unique_ptr<FrameSource> source, ColorResponse response) const;
  void say(const std::string& status) const;
  /// The surface so far, once an iteration.
  void show(const Progress& progress);
  /// The finished folders. @param result may be empty
  void show(const std::filesystem::path& stack, const std::filesystem::path& result) const;

 private:
  [[maybe_unused]] LiveFeed* feed_ = nullptr;  // nothing uses it in a build without the viewer
  [[maybe_unused]] int iteration_ = 0;
};

/// Runs a scan in a second thread with the window on it; returns when both are done.
/// @throws DeviceError where the program was built without the viewer, std::system_error without a display, both before
///         the scan begins; what the scan throws
void run_in_view(const std::function<void(ScanView&)>& scan);

}  // namespace rakelight::cli
