// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which frames of a scan are kept: each step's slots are filled with frames that prove their lamp by picture.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "capture/scan_session.h"

namespace rakelight {

class FrameKeeper {
 public:
  explicit FrameKeeper(ScanSession& session) : session_(session) {}

  /// Steps that want more images. Those of lamps that give no light of their own want none.
  std::vector<std::size_t> missing_steps() const;
  int missing_images(std::size_t step) const;

  /// Keeps a clean frame if its picture proves the lamp and its step wants one.
  void take(const StepFrame& taken);

  /// Frames that never matched are kept and marked: the object may have been moved, or the room's light changed. Warns of
  /// these and of steps that remain short.
  void settle();

 private:
  bool is_dead(const ScanStep& step) const;
  std::optional<int> free_slot(const ScanStep& step) const;
  void keep(Frame frame);
  void keep_more_depth(int slot, std::int64_t device_us);
  void settle_unproven(int slot, Frame frame);

  ScanSession& session_;
  std::map<int, Frame> unproven_;  ///< the last frame of each slot that did not match
};

}  // namespace rakelight
