// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/latency.h"

#include <algorithm>
#include <cmath>

#include "capture/edge_time.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr float kVisible = 0.012F;  // linear, sum of channels: a code of 8 bits each
constexpr float kSettled = 0.05F;   // of the change: two frames that differ by less show one state
constexpr float kNoise = 0.006F;    // of a band's mean: they may differ by as much anyway
constexpr std::int64_t kPatience_us = 400'000;  // the longest lag that is waited for
constexpr int kSettleFrames = 6;
constexpr int kMostToggles = 12;  // short exposures see an edge only now and then
constexpr double kSharp_us = 500;
constexpr double kGoldenRatio = 0.6180339887;  // its multiples fall evenly into a period

ProfiledFrame profiled(const TimedFrame& frame, const ColorResponse& response) {
  return {frame.time_us, row_profile(frame.frame.image, response)};
}

double spread(const std::vector<double>& sorted) {
  return sorted.empty() ? 0 : sorted.back() - sorted.front();
}

/// Frames from the write on until two show the same new state; nothing if the picture does not change in time.
std::optional<std::vector<ProfiledFrame>> watch_change(FrameFeed& feed, const RowProfile& before,
                                                       const ColorResponse& response) {
  const std::int64_t give_up_us = feed.clock().now_us() + kPatience_us;
  std::vector<ProfiledFrame> frames;
  while (feed.clock().now_us() < give_up_us) {
    frames.push_back(profiled(feed.next_color(), response));
    const RowProfile& now = frames.back().profile;
    const float change = largest_difference(now, before);
    if (change < kVisible || frames.size() < 2) continue;
    if (largest_difference(now, frames[frames.size() - 2].profile) < std::max(kSettled * change, kNoise))
      return frames;
  }
  return std::nullopt;
}

class LagMeasurement {
 public:
  LagMeasurement(FrameFeed& feed, Lights& lights, const LatencyOptions& options)
      : feed_(feed), lights_(lights), options_(options) {}

  /// Switches to `lit` after a wait of another share of the frame period each time and adds the edge. @return whether it was seen
  bool edge(const std::vector<std::string>& lit, LagEstimate& estimate) {
    wait_for_next_phase();
    LampEdge written;
    written.before_us = feed_.clock().now_us();
    lights_.show(lit);
    written.after_us = feed_.clock().now_us();
    const auto frames = watch_change(feed_, state_, options_.response);
    if (!frames) return false;
    const RowProfile& after = frames->back().profile;
    std::vector<ProfiledFrame> all = {last_};
    all.insert(all.end(), frames->begin(), frames->end());
    if (const auto seen = edge_time(all, state_, after, feed_.timing())) {
      estimate.add({written, !lit.empty(), *seen});
    }
    last_ = frames->back();
    state_ = after;
    return true;
  }

  /// Waits for the picture without lamps.
  void settle() {
    for (int i = 0; i < kSettleFrames; ++i) last_ = profiled(feed_.next_color(), options_.response);
    state_ = last_.profile;
  }

 private:
  void wait_for_next_phase() {
    phase_ = std::fmod(phase_ + kGoldenRatio, 1.0);
    const auto wait_us = std::llround(phase_ * feed_.timing().period_us);
    feed_.run_until(feed_.clock().now_us() + wait_us,
                    [this](TimedFrame&& frame) { last_ = profiled(frame, options_.response); });
  }

  FrameFeed& feed_;
  Lights& lights_;
  const LatencyOptions& options_;
  ProfiledFrame last_;
  RowProfile state_;
  double phase_ = 0;
};

}  // namespace

bool LagEstimate::Edge::sharp() const { return seen.latest_us - seen.earliest_us <= kSharp_us; }

bool LagEstimate::has_sharp(bool on) const {
  return std::any_of(edges_.begin(), edges_.end(), [on](const Edge& e) { return e.on == on && e.sharp(); });
}

/// The edges that tell most: the sharp ones, or all.
std::vector<const LagEstimate::Edge*> LagEstimate::best(bool on) const {
  std::vector<const Edge*> edges;
  for (const Edge& edge : edges_) {
    if (edge.on == on && (edge.sharp() || !has_sharp(on))) edges.push_back(&edge);
  }
  return edges;
}

std::vector<double> LagEstimate::lags_us(const ClockFit& fit, bool on) const {
  std::vector<double> lags;
  for (const Edge* edge : best(on)) {
    const std::int64_t written = on ? edge->written.after_us : edge->written.before_us;
    const double seen = (edge->seen.earliest_us + edge->seen.latest_us) / 2;
    lags.push_back(fit.host_at(std::llround(seen)) - static_cast<double>(written));
  }
  std::sort(lags.begin(), lags.end());
  return lags;
}

/// From the least to the greatest lag that the edges allow.
std::optional<LagEstimate::Span> LagEstimate::span(const ClockFit& fit, bool on) const {
  std::optional<Span> span;
  for (const Edge* edge : best(on)) {
    const auto written = static_cast<double>(on ? edge->written.after_us : edge->written.before_us);
    const double least = fit.host_at(std::llround(edge->seen.earliest_us)) - written;
    const double most = fit.host_at(std::llround(edge->seen.latest_us)) - written;
    span = span ? Span{std::min(span->least_us, least), std::max(span->most_us, most)} : Span{least, most};
  }
  return span;
}

LampLag LagEstimate::bounds(const ClockFit& fit, double jitter_us, double margin_us) const {
  const std::optional<Span> on = span(fit, true), off = span(fit, false);
  const double doubt = jitter_us + margin_us;
  return {(on ? on : off)->most_us + doubt, (off ? off : on)->least_us - doubt};
}

std::optional<LagEstimate> measure_lag(FrameFeed& feed, Lights& lights, const std::string& lamp,
                                       const LatencyOptions& options) {
  lights.all_off();
  LagMeasurement measurement(feed, lights, options);
  measurement.settle();
  LagEstimate estimate;
  estimate.epoch = feed.clock_fit().epoch();
  const auto enough = [&](int toggles) {
    return toggles >= kMostToggles || (estimate.has_sharp(true) && estimate.has_sharp(false));
  };
  for (int i = 0; i < options.toggles || !enough(i); ++i) {
    const bool lit = measurement.edge({lamp}, estimate), darkened = lit && measurement.edge({}, estimate);
    lights.all_off();
    if (!darkened) return std::nullopt;
  }
  if (estimate.edges().empty() || feed.clock_fit().epoch() != estimate.epoch) return std::nullopt;
  return estimate;
}

LatencyCalibration summarise(const LagEstimate& estimate, const ClockFit& fit) {
  std::vector<double> lags = estimate.lags_us(fit, true);
  const std::vector<double> off = estimate.lags_us(fit, false);
  const double jitter_us = std::max(spread(lags), spread(off));  // a slow write is no jitter
  lags.insert(lags.end(), off.begin(), off.end());
  std::sort(lags.begin(), lags.end());
  return {lags[lags.size() / 2], jitter_us, static_cast<int>(lags.size())};
}

LatencyCalibration calibrate_latency(FrameSource& source, Lights& lights, HostClock& clock,
                                     const SensorSetup& sensor, const std::string& lamp,
                                     const LatencyOptions& options, FrameFeed::KeepGoing keep_going) {
  const SourceDescription about = source.describe();
  if (!about.live) throw UsageError("a recording does not follow the lamps; give a rig file with a sensor");
  source.start();
  const ExposureLock lock = source.lock_exposure(sensor.exposure_us, sensor.gain);
  const FrameTiming timing{lock.exposure_us.value_or(sensor.exposure_us), sensor.readout_us,
                           about.frame_period_us};
  FrameFeed feed(source, clock, timing, std::move(keep_going));
  const std::optional<LagEstimate> estimate = measure_lag(feed, lights, lamp, options);
  source.stop();
  if (!estimate) {
    throw DeviceError("measured the latency of lamp '" + lamp +
                      "', but switching it does not change the picture; check its wiring and that the sensor "
                      "sees its light");
  }
  return summarise(*estimate, feed.clock_fit());
}

}  // namespace rakelight
