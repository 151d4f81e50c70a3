// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lag from a lamp's write to its light in the picture, found by switching one lamp. Every scan does it once; `rakelight
// calibrate latency` does it many times.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture/edge_time.h"
#include "capture/frame_feed.h"
#include "capture/rig.h"
#include "lights/lights.h"
#include "stack/stack.h"

namespace rakelight {

/// Edges that were seen. They are kept against the device's clock, which does not jitter: the lag on the host's time line
/// follows the clock fit as that settles.
class LagEstimate {
 public:
  struct Edge {
    LampEdge written;
    bool on = true;
    EdgeTime seen;
    bool sharp() const;  ///< seen to within the gate's margin
  };
  void add(const Edge& edge) { edges_.push_back(edge); }
  const std::vector<Edge>& edges() const { return edges_; }
  bool has_sharp(bool on) const;
  int epoch = 0;  ///< of the device clock the edges were seen in

  /// Mid-lag of each sharp edge, of all if none is: from the end of the write for one that lights, from its beginning for
  /// one that darkens. Sorted.
  std::vector<double> lags_us(const ClockFit& fit, bool on) const;

  /// Bounds for the gate. @param jitter_us that the lamps may add  @param margin_us for the error of the measurement
  LampLag bounds(const ClockFit& fit, double jitter_us, double margin_us) const;

 private:
  struct Span {
    double least_us = 0, most_us = 0;
  };
  std::optional<Span> span(const ClockFit& fit, bool on) const;
  std::vector<const Edge*> best(bool on) const;

  std::vector<Edge> edges_;
};

/// What `rakelight calibrate latency` reports; the jitter goes into the rig file, the lag every scan measures itself.
struct LatencyCalibration {
  double lag_us = 0;     ///< median, write to picture on the line of earliest arrivals
  double jitter_us = 0;  ///< from the least to the greatest lag of edges of one kind
  int edges = 0;         ///< how many were seen
};

struct LatencyOptions {
  int toggles = 1;  ///< times on and off again; more until one of each kind is seen sharply
  ColorResponse response;
};

/// Switches `lamp` on and off and finds each edge in the pictures. All lamps are off before and after.
/// @return nothing if the lamp does not change the picture  @throws SensorLost, Cancelled, std::system_error
std::optional<LagEstimate> measure_lag(FrameFeed& feed, Lights& lights, const std::string& lamp,
                                       const LatencyOptions& options);

/// The figures of an estimate with at least one edge.
LatencyCalibration summarise(const LagEstimate& estimate, const ClockFit& fit);

/// Starts `source`, locks the rig's exposure, switches `lamp` `toggles` times and stops again.
/// @throws as measure_lag; DeviceError if the lamp does not change the picture; UsageError if `source` is a recording
LatencyCalibration calibrate_latency(FrameSource& source, Lights& lights, HostClock& clock,
                                     const SensorSetup& sensor, const std::string& lamp,
                                     const LatencyOptions& options, FrameFeed::KeepGoing keep_going = {});

}  // namespace rakelight
