// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/capture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <numeric>
#include <utility>

#include "capture/auto_mask.h"
#include "capture/sequence.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr int kSettleFrames = 4;  // after the exposure has been set
constexpr int kMeteringRounds = 6;
constexpr int kMeteringPasses = 4;  // over what was dropped
constexpr double kObeys = 0.5;      // share of a change in exposure that must show in the picture
constexpr double kClearChange = 0.25;

/// RFC 3339, UTC.
std::string now_text() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

/// The stack without frames.
LightStack stack_header(const SourceDescription& source, const Rig& rig, const ScanPlan& plan) {
  LightStack stack;
  stack.created = now_text();
  stack.sensor = source.sensor;
  stack.color_camera = rig.calibration.color_camera.value_or(source.color_camera);
  stack.depth_camera = rig.calibration.depth_camera.value_or(source.depth_camera);
  stack.T_color_depth = source.T_color_depth;
  if (source.depth_registered_to_color) {
    stack.T_color_depth = Eigen::Matrix4d::Identity();
  } else if (rig.calibration.T_color_depth) {
    stack.T_color_depth = *rig.calibration.T_color_depth;
  }
  stack.depth_unit_m = source.depth_unit_m;
  stack.color_response = rig.calibration.color_response.value_or(stack.color_response);
  stack.color_crosstalk = rig.calibration.color_crosstalk.value_or(stack.color_crosstalk);
  stack.lights = plan.lights;
  return stack;
}

/// Lamps off and source stopped on every way out.
class AllOff {
 public:
  explicit AllOff(const Devices& devices) : devices_(devices) {}
  AllOff(const AllOff&) = delete;
  AllOff& operator=(const AllOff&) = delete;
  ~AllOff() {
    try {
      devices_.lights.all_off();
    } catch (const std::exception&) {  // on the way out of another failure, which is the one to tell
    }
    try {
      devices_.source.stop();
    } catch (const std::exception&) {}
  }

 private:
  const Devices& devices_;
};

class Scan {
 public:
  Scan(const Devices& devices, const Rig& rig, const ScanOptions& options,
       const ScanProgressCallback& progress)
      : devices_(devices),
        rig_(rig),
        options_(options),
        progress_(progress),
        plan_(plan_scan(rig, repeats(), rgb_shot())),
        feed_(devices.source, devices.clock, frame_timing(), [this] { return keep_going(); }),
        sequence_(feed_, devices.lights, plan_, {rig.sensor.lamp_jitter_us, options.margin_us}) {
    start_state();
  }

  ScanResult run() {
    tell("waiting for the sensor", 0);
    devices_.lights.all_off();
    set_exposure(exposure_);
    tell("measuring the latency of the lamps", 0.05);
    find_first_lag();
    if (!options_.resume) meter();
    take_sequence();
    retake();
    finish();
    return std::move(result_);
  }

 private:
  using Pictures = std::map<std::size_t, Frame>;  ///< by step

  int repeats() const {
    return options_.resume ? options_.resume->repeats : options_.repeats.value_or(rig_.repeats);
  }
  bool rgb_shot() const {
    return options_.resume ? options_.resume->rgb_shot : options_.rgb_shot.value_or(rig_.rgb_shot);
  }

  FrameTiming frame_timing() const {
    return {rig_.sensor.exposure_us, rig_.sensor.readout_us, devices_.source.describe().frame_period_us};
  }

  void start_state() {
    if (options_.resume) {
      state_ = *options_.resume;
      check_same_lamps();
      exposure_ = {state_.stack.exposure_us.value_or(rig_.sensor.exposure_us),
                   state_.stack.gain.value_or(rig_.sensor.gain)};
      return;
    }
    state_.stack = stack_header(devices_.source.describe(), rig_, plan_);
    state_.repeats = repeats();
    state_.rgb_shot = rgb_shot();
    exposure_ = {rig_.sensor.exposure_us, rig_.sensor.gain};
  }

  void check_same_lamps() const {
    const auto same = [](const Light& a, const Light& b) { return a.id == b.id && a.color == b.color; };
    const auto& before = state_.stack.lights;
    if (!std::equal(before.begin(), before.end(), plan_.lights.begin(), plan_.lights.end(), same)) {
      throw UsageError("the unfinished scan has other lamps than rig '" + rig_.name +
                       "'; resume it with its own rig file, or scan anew into another folder");
    }
    if (state_.stack.color_camera.size() != devices_.source.describe().color_camera.size()) {
      throw UsageError(
          "the unfinished scan has colour images of another size; resume it with its own rig file");
    }
  }

  void tell(const std::string& stage, double fraction) {
    told_ = {stage, fraction};
    feed_.check_keep_going();
  }

  bool keep_going() const { return !progress_ || progress_(told_); }

  void set_exposure(const ExposureSetting& exposure) {
    exposure_ = exposure;
    const ExposureLock lock = devices_.source.lock_exposure(exposure.time_us, exposure.gain);
    exposure_.time_us = lock.exposure_us.value_or(exposure.time_us);
    exposure_.gain = lock.gain.value_or(exposure.gain);
    locked_ = lock.auto_exposure_off && lock.auto_white_balance_off;
    feed_.set_exposure(exposure_.time_us);
    state_.stack.exposure_us = exposure_.time_us;
    state_.stack.gain = exposure_.gain;
    const int from = feed_.next_color().frame.index;
    while (feed_.next_color().frame.index < from + kSettleFrames) {}
  }

  /// By the first lamp that changes the picture.
  bool find_lag() {
    LatencyOptions options;
    options.response = state_.stack.color_response;
    for (const RigLamp& lamp : rig_.lamps) {
      const auto lag = measure_lag(feed_, devices_.lights, lamp.id, options);
      if (!lag) continue;
      sequence_.set_lag(*lag);
      result_.lag_us = summarise(*lag, feed_.clock_fit()).lag_us;
      return true;
    }
    return false;
  }

  /// Where no lamp changes the picture it may be too bright or too dark to tell.
  void find_first_lag() {
    const ExposureSetting start = exposure_;
    for (const double factor : {1.0, 0.25, 4.0}) {
      if (factor != 1) set_exposure({start.time_us, start.gain * factor});
      if (find_lag()) return;
      if (options_.resume) break;  // its exposure is known to be right
    }
    throw DeviceError(
        "switched every lamp on and off, but the picture never changed; check the lamps' supply and lines "
        "('rakelight lights test'), and that the sensor sees what they light");
  }

  void find_lag_again() {
    if (!find_lag())
      throw DeviceError(
          "measured the lamps' latency again, but the picture no longer changes; check their supply");
  }

  /// One picture of each step, dark first, the lamps backwards: an error in timing then differs from the sequence's.
  Pictures take_pictures() {
    Pictures pictures;
    const auto take = [&](const StepFrame& taken) {
      if (pictures.count(taken.step) == 0) pictures[taken.step] = frame_of(taken);
    };
    std::vector<std::size_t> steps(plan_.steps.size() - 1);
    std::iota(steps.begin(), steps.end(), std::size_t{0});
    std::reverse(steps.begin() + 1, steps.end());
    for (int pass = 0; pass < kMeteringPasses && !steps.empty(); ++pass) {
      sequence_.run(steps, 1, take);
      check_epoch();
      const auto taken = [&](std::size_t step) { return pictures.count(step) != 0; };
      steps.erase(std::remove_if(steps.begin(), steps.end(), taken), steps.end());
    }
    if (steps.empty()) return pictures;
    throw DeviceError(
        "waited for a whole frame under each lamp, but too many frames are dropped; use another USB port, "
        "or fewer streams on this one");
  }

  /// After a reset of the device's clock the lag has to be measured anew.
  void check_epoch() {
    if (feed_.clock_fit().epoch() != sequence_.lag().epoch) find_lag_again();
  }

  /// Finds the exposure, then learns what each lamp looks like and whether it works.
  void meter() {
    const ExposureSetting start = exposure_;
    Brightness before;
    double commanded = 1;
    for (int round = 1;; ++round) {
      tell("metering", 0.1 + 0.25 * std::min(round, 2) / 2);
      const Pictures pictures = take_pictures();
      const CoarseScene scene = scene_of(pictures);
      const cv::Mat1b object = object_of(scene, pictures);
      const Brightness seen =
          measure_brightness(scene, object, lit_images(pictures), state_.stack.color_response);
      result_.metering_rounds = round;
      if (round > 1 && !obeyed(before, seen, commanded)) {
        warn("the sensor does not follow the exposure it is told: check its automatic exposure");
        return learn(scene, object, pictures);
      }
      const auto better = better_exposure(seen, exposure_, start, limits());
      if (!options_.meter || !better || round == kMeteringRounds) return learn(scene, object, pictures);
      commanded = better->time_us * better->gain / (exposure_.time_us * exposure_.gain);
      before = seen;
      const double time_us = exposure_.time_us;
      set_exposure(*better);
      // Some devices stamp a frame's beginning, others its end: with another exposure the lag may be another.
      if (exposure_.time_us != time_us) find_lag_again();
    }
  }

  MeteringLimits limits() const {
    MeteringLimits limits = options_.metering;
    limits.max_time_us = std::min(limits.max_time_us, 0.97 * feed_.timing().period_us);
    return limits;
  }

  /// Whether the level changed as commanded; where one of the pictures clips nothing can be said.
  bool obeyed(const Brightness& before, const Brightness& now, double commanded) const {
    const double limit = options_.metering.max_saturated;
    if (before.saturated > limit || now.saturated > limit || before.level <= 0) return true;
    if (std::abs(commanded - 1) < kClearChange) return true;
    return (now.level / before.level - 1) / (commanded - 1) > kObeys;
  }

  CoarseScene scene_of(const Pictures& pictures) const {
    std::vector<cv::Mat1w> depths;
    for (const auto& [step, frame] : pictures) {
      if (!frame.depth.empty()) depths.push_back(frame.depth);
    }
    return coarse_scene(state_.stack, depths);
  }

  std::vector<cv::Mat> lit_images(const Pictures& pictures) const {
    std::vector<cv::Mat> images;
    for (const auto& [step, frame] : pictures) {
      if (frame.light) images.push_back(frame.color);
    }
    return images;
  }

  /// The object's cells; all that have depth, or all, where it cannot be told.
  cv::Mat1b object_of(const CoarseScene& scene, const Pictures& pictures) const {
    const ColorResponse& response = state_.stack.color_response;
    const cv::Mat3f dark = at_cells(scene, pictures.at(0).color, response);
    cv::Mat3f most(scene.size, cv::Vec3f(0, 0, 0));
    for (const cv::Mat& color : lit_images(pictures))
      most = cv::max(most, at_cells(scene, color, response) - dark);
    cv::Mat1f light;
    cv::transform(most, light, cv::Matx13f(1, 1, 1));
    const cv::Mat1b object = object_cells(scene, light);
    if (cv::countNonZero(object) > 0) return object;
    return cv::Mat1b(scene.size, uchar{255});
  }

  void learn(const CoarseScene& scene, const cv::Mat1b& object, const Pictures& pictures) {
    const ColorResponse& response = state_.stack.color_response;
    const cv::Mat& dark = pictures.at(0).color;
    state_.signatures = LitSignatures(find_bands(lit_images(pictures), dark, response), response, dark);
    LampPictures lamps{at_cells(scene, dark, response), {}, object};
    for (const auto& [step, frame] : pictures) {
      if (!frame.light) continue;
      state_.signatures.learn(*frame.light, frame.color);
      if (lamps.lit.size() < rig_.lamps.size()) lamps.lit.push_back(at_cells(scene, frame.color, response));
    }
    state_.faults = find_lamp_faults(rig_.lamps, scene, lamps);
  }

  /// Whether a step's lamp gives no light of its own, so that no image can be taken.
  bool is_dead(const ScanStep& step) const {
    return std::any_of(state_.faults.begin(), state_.faults.end(), [&](const LampFault& fault) {
      const bool dead = fault.kind == LampFault::Kind::no_light || fault.kind == LampFault::Kind::stuck_on;
      return dead && step.light == fault.lamp;
    });
  }

  std::vector<std::size_t> missing_steps() const {
    std::vector<std::size_t> steps;
    for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
      if (is_dead(plan_.steps[i])) continue;
      if (missing_images(plan_.steps[i]) > 0) steps.push_back(i);
    }
    return steps;
  }

  int missing_images(const ScanStep& step) const {
    int missing = 0;
    for (int i = 0; i < step.images; ++i) missing += state_.has_slot(step.first_slot + i) ? 0 : 1;
    return missing;
  }

  void take_sequence() {
    const ExposureWindow span =
        sequence_.run(missing_steps(), 0, [this](const StepFrame& taken) { take(taken); });
    result_.sensor_time_us = span.closes_us - span.opens_us;
  }

  void retake() {
    for (int pass = 0; pass < options_.max_retakes; ++pass) {
      check_epoch();
      const std::vector<std::size_t> steps = missing_steps();
      if (steps.empty()) return;
      for (const std::size_t step : steps) result_.retaken += missing_images(plan_.steps[step]);
      sequence_.run(steps, 0, [this](const StepFrame& taken) { take(taken); });
    }
  }

  Frame frame_of(const StepFrame& taken) {
    const SensorFrame& sensor = taken.frame.frame;
    Frame frame;
    frame.light = plan_.steps[taken.step].light;
    frame.color = sensor.image;
    frame.color_time = {sensor.device_us, sensor.host_us};
    frame.led_edge_time.host_us = (taken.edge.before_us + taken.edge.after_us) / 2;
    put_depth(frame, sensor.device_us);
    return frame;
  }

  void put_depth(Frame& frame, std::int64_t device_us) {
    const SensorFrame depth = feed_.take_depth_near(device_us);
    if (depth.image.empty()) return;
    frame.depth = depth.image;
    frame.depth_time = {depth.device_us, depth.host_us};
  }

  /// Keeps a clean frame if its picture proves the lamp and its step wants one.
  void take(const StepFrame& taken) {
    const ScanStep& step = plan_.steps[taken.step];
    const std::optional<int> slot = free_slot(step);
    if (!slot) return;
    const LitCheck check = state_.signatures.check(step.light.value_or(""), taken.frame.frame.image);
    Frame frame = frame_of(taken);
    frame.index = *slot;
    frame.lit_check = check;
    if (!check.matches) {
      unproven_[*slot] = std::move(frame);
      return;
    }
    keep(std::move(frame));
    keep_more_depth(*slot, taken.frame.frame.device_us);
    told_ = {"scanning",
             0.4 + 0.6 * double(state_.stack.frames.size()) / double(plan_.slots * options_.depth_frames)};
  }

  std::optional<int> free_slot(const ScanStep& step) const {
    for (int i = 0; i < step.images; ++i) {
      if (!state_.has_slot(step.first_slot + i)) return step.first_slot + i;
    }
    return std::nullopt;
  }

  void keep(Frame frame) {
    state_.stack.frames.push_back(std::move(frame));
    if (options_.on_frame) options_.on_frame(state_, state_.stack.frames.back());
  }

  /// Depth does not see the lamps: any frame nearby is one more measurement of the same surface.
  void keep_more_depth(int slot, std::int64_t device_us) {
    const std::optional<std::string> light = state_.stack.frames.back().light;
    for (int i = 1; i < options_.depth_frames; ++i) {
      Frame frame;
      frame.index = plan_.slots + slot * (options_.depth_frames - 1) + i - 1;
      frame.light = light;
      put_depth(frame, device_us);
      if (frame.depth.empty()) return;
      keep(std::move(frame));
    }
  }

  void warn(const std::string& text) { result_.warnings.push_back(text); }

  void finish() {
    for (auto& [slot, frame] : unproven_) settle_unproven(slot, std::move(frame));
    check_complete();
    if (!locked_) warn("the sensor does not say that its automatic exposure and white balance are off");
    auto& frames = state_.stack.frames;
    std::sort(frames.begin(), frames.end(), [](const Frame& a, const Frame& b) { return a.index < b.index; });
    for (const LampFault& fault : state_.faults) warn(fault.message);
    result_.faults = state_.faults;
    result_.dropped = feed_.dropped();
    measure_saturation();
    result_.stack = std::move(state_.stack);
    result_.stack.unknown_keys = finished_keys(state_);
  }

  /// A frame that never matched is kept and marked: the object may have been moved, or the room's light changed.
  void settle_unproven(int slot, Frame frame) {
    if (state_.has_slot(slot)) return;
    const std::string looks_like = state_.signatures.nearest(frame.color);
    const std::string name = [](const std::string& id) {
      return id.empty() ? "the dark" : "lamp '" + id + "'";
    }(looks_like);
    const bool same = looks_like == frame.light.value_or("");
    warn("the picture under " + (frame.light ? "lamp '" + *frame.light + "'" : std::string("no lamp")) +
         " does not match what it showed before" + (same ? "" : " and looks like " + name) +
         "; it is kept and marked: the object or the room's light may have changed");
    keep(std::move(frame));
  }

  void check_complete() {
    for (const std::size_t step : missing_steps()) {
      const std::string what =
          plan_.steps[step].light ? "lamp '" + *plan_.steps[step].light + "'" : "the dark";
      warn(what + " has " + std::to_string(missing_images(plan_.steps[step])) +
           " images fewer than asked for: no whole frame came");
    }
  }

  void measure_saturation() {
    Pictures pictures;
    for (const Frame& frame : state_.stack.frames) {
      if (!frame.color.empty()) pictures[pictures.size()] = frame;
    }
    if (pictures.empty() || pictures.at(0).light) return;
    const CoarseScene scene = scene_of(pictures);
    const cv::Mat1b object = object_of(scene, pictures);
    result_.saturated =
        measure_brightness(scene, object, lit_images(pictures), state_.stack.color_response).saturated;
    if (result_.saturated > options_.metering.max_saturated)
      warn(
          "over 1 % of the object is saturated under some lamp: lower exposure or gain in the rig file, or "
          "scan with metering");
  }

  const Devices& devices_;
  const Rig& rig_;
  const ScanOptions& options_;
  const ScanProgressCallback& progress_;
  ScanPlan plan_;
  ScanProgress told_;
  FrameFeed feed_;
  Sequence sequence_;
  ScanState state_;
  ExposureSetting exposure_;
  bool locked_ = false;
  std::map<int, Frame> unproven_;  ///< the last frame of each slot that did not match
  ScanResult result_;
};

}  // namespace

ScanResult capture_stack(const Devices& devices, const Rig& rig, const ScanOptions& options,
                         const ScanProgressCallback& progress) {
  if (!devices.source.describe().live) {
    throw UsageError(
        "a recording does not follow the lamps; read it as a stack, or import it with 'rakelight import "
        "oni'");
  }
  const AllOff on_every_way_out(devices);
  devices.source.start();
  Scan scan(devices, rig, options, progress);
  return scan.run();
}

}  // namespace rakelight
