// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A build without the viewer: there is no window, and asking for one says so.
#include "cli/scan_view.h"
#include "stack/errors.h"

namespace rakelight::cli {

bool ScanView::closed() const { return false; }

std::unique_ptr<FrameSource> ScanView::watched(std::unique_ptr<FrameSource> source, ColorResponse) const {
  return source;
}

void ScanView::say(const std::string&) const {}
void ScanView::show(const Progress&) {}
void ScanView::show(const std::filesystem::path&, const std::filesystem::path&) const {}

void run_in_view(const std::function<void(ScanView&)>&) {
  throw DeviceError(
      "cannot open a window for --view: this rakelight was built without the viewer; build it where GLFW, "
      "libepoxy and Dear ImGui are installed, or scan without --view");
}

}  // namespace rakelight::cli
