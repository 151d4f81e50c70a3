// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the parts of a running scan share: devices, the plan, the frames' feed, the lamps' lag, the exposure, and the results
// so far.
#pragma once

#include <string>

#include "capture/capture.h"
#include "capture/frame_feed.h"
#include "capture/scan_plan.h"
#include "capture/sequence.h"

namespace rakelight {

class ScanSession {
 public:
  /// Everything is referred to, so it must live as long. @throws UsageError if what is resumed does not fit
  ScanSession(const Devices& devices, const Rig& rig, const ScanOptions& options,
              const ScanProgressCallback& progress);
  ScanSession(const ScanSession&) = delete;
  ScanSession& operator=(const ScanSession&) = delete;

  /// What the callback hears from now on, whenever a frame comes.
  void note(const std::string& stage, double fraction) { told_ = {stage, fraction}; }
  /// The same, and it hears so at once. @throws Cancelled if it says so
  void tell(const std::string& stage, double fraction);
  void warn(const std::string& text) { result.warnings.push_back(text); }

  /// Locks the exposure and waits until frames have it.
  void set_exposure(const ExposureSetting& wanted);

  /// Measures the lag between write and picture by the first lamp that changes the picture, at another exposure if none does
  /// at this one. @throws DeviceError
  void find_first_lag();
  /// Anew: after another exposure time, or a reset of the device's clock. @throws DeviceError
  void find_lag_again();
  /// find_lag_again() if the device's clock was reset.
  void check_epoch();

  /// A frame of the stack, with the depth that came nearest to it.
  Frame frame_of(const StepFrame& taken);
  void put_depth(Frame& frame, std::int64_t device_us);

  const Rig& rig;
  const ScanOptions& options;
  const ScanPlan plan;
  FrameFeed feed;
  Sequence sequence;
  ScanState state;
  ExposureSetting exposure;
  bool locked = false;  ///< automatic exposure and white balance are off, the sensor says
  ScanResult result;

 private:
  void start_state();
  void check_same_lamps() const;
  bool keep_going() const { return !progress_ || progress_(told_); }
  bool find_lag();

  const Devices& devices_;
  const ScanProgressCallback& progress_;
  ScanProgress told_;
};

}  // namespace rakelight
