// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A rig in simulated time: a free-running rolling shutter that looks at a painted sphere, lamps with latency and faults,
// frames that come late or never. It knows what truly lit each row of each frame.
#pragma once

#include <deque>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "capture/frame_source.h"
#include "capture/host_clock.h"
#include "capture/rig.h"
#include "lights/lights.h"

namespace rakelight::test {

struct SimulatedRigOptions {
  int width = 32, height = 24;
  double exposure_us = 8000, readout_us = 30000, period_us = 33333;
  double phase_us = 0;            ///< of the first frame
  double device_offset_us = 5e6;  ///< device clock less host clock
  double device_drift = 0;        ///< device clock's rate less 1
  double lamp_latency_us = 2000, lamp_jitter_us = 0;
  double delivery_latency_us = 15000, delivery_jitter_us = 2000;
  double drop_share = 0, repeat_share = 0;
  double board_us = 200;  ///< a write of the lamp board takes this long
  double line_us = 0;     ///< and this much more a line, one after the other, as on USB
  double ambient = 0.02, brightness = 0.6, noise = 0.003;
  int unplug_at_frame = -1;
  int reset_clock_at_frame = -1;
  bool ignores_exposure = false;
  unsigned seed = 1;
  std::set<std::string> stuck_on, stuck_off, dim;
  std::vector<std::pair<std::string, std::string>> swapped;
};

class SimulatedClock : public HostClock {
 public:
  std::int64_t now_us() const override { return now_; }
  void sleep_until(std::int64_t host_us) override { now_ = std::max(now_, host_us); }

 private:
  std::int64_t now_ = 1'000'000'000;
};

/// Twelve white lamps on a ring, one red, one green, one blue, with positions.
Rig simulated_rig(const SimulatedRigOptions& options, int white_lamps = 12);

class SimulatedRig {
 public:
  SimulatedRig(const Rig& rig, const SimulatedRigOptions& options);

  SimulatedClock clock;
  FrameSource& source();
  Lights& lights() { return *lights_; }
  /// Lamps that are written on now.
  std::set<std::string> lit_now() const;
  /// Whether exactly these lamps lit every row of the frame of this device stamp from opening to closing.
  bool lit_only_by(std::int64_t device_us, const std::set<std::string>& lamps) const;
  /// Gives the device back after an unplug.
  void plug_in();
  int frames_delivered() const;

  struct World;

 private:
  std::shared_ptr<World> world_;
  std::unique_ptr<FrameSource> source_;
  std::unique_ptr<Lights> lights_;
};

}  // namespace rakelight::test
