// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/capture/simulated_rig.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rakelight::test {
namespace {

constexpr double kPi = 3.14159265358979;
constexpr double kSphere_m = 0.2, kDistance_m = 1.0, kUnit_m = 0.0001;

std::int64_t rounded(double value) { return std::llround(value); }

}  // namespace

Rig simulated_rig(const SimulatedRigOptions& options, int white_lamps) {
  Rig rig;
  rig.name = "simulated";
  rig.sensor.exposure_us = options.exposure_us;
  rig.sensor.readout_us = options.readout_us;
  rig.sensor.lamp_jitter_us = options.lamp_jitter_us;
  for (int k = 0; k < white_lamps; ++k) {
    const double angle = 2 * kPi * k / white_lamps;
    const Eigen::Vector3d place(0.6 * std::cos(angle), 0.6 * std::sin(angle), 0.2);
    rig.lamps.push_back({"white-" + std::to_string(k), LampColor::white, {}, place});
  }
  double x = -0.3;
  for (const LampColor color : {LampColor::red, LampColor::green, LampColor::blue}) {
    rig.lamps.push_back({to_string(color), color, {}, Eigen::Vector3d(x, -0.4, 0.2)});
    x += 0.3;
  }
  return rig;
}

/// All that happens, on true host time.
struct SimulatedRig::World {
  struct Edge {
    double time_us;
    bool lit;
  };

  World(SimulatedRig& owner, const Rig& rig_, const SimulatedRigOptions& options_)
      : clock(owner.clock),
        rig(rig_),
        options(options_),
        random(options_.seed),
        edges(rig_.lamps.size()),
        written(rig_.lamps.size(), false),
        start_us(double(owner.clock.now_us()) + options_.phase_us) {
    exposure_us = options.exposure_us;
    make_scene();
    std::normal_distribution<float> normal(0, float(options.noise));
    for (float& value : noise) value = normal(random);
  }

  double uniform(double to) { return std::uniform_real_distribution<double>(0, to)(random); }
  bool chance(double share) { return uniform(1) < share; }

  void make_scene() {
    const int w = options.width, h = options.height;
    camera = {w, h, 1.6 * w, 1.6 * w, (w - 1) / 2.0, (h - 1) / 2.0, {}};
    depth = cv::Mat1w(h, w, std::uint16_t{0});
    for (std::size_t k = 0; k < rig.lamps.size(); ++k) pictures.emplace_back(h, w, cv::Vec3f(0, 0, 0));
    albedo = cv::Mat3f(h, w, cv::Vec3f(0, 0, 0));
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) shade_pixel(x, y);
    }
  }

  void shade_pixel(int x, int y) {
    const Eigen::Vector3d ray((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1);
    const Eigen::Vector3d centre(0, 0, kDistance_m);
    const double a = ray.squaredNorm(), b = ray.dot(centre), c = centre.squaredNorm() - kSphere_m * kSphere_m;
    if (b * b < a * c) return;
    const Eigen::Vector3d p = ray * ((b - std::sqrt(b * b - a * c)) / a), n = (p - centre).normalized();
    depth(y, x) = static_cast<std::uint16_t>(std::lround(p.z() / kUnit_m));
    const float paint = (x / 4 + y / 4) % 2 == 0 ? 1.0F : 0.6F;
    albedo(y, x) = cv::Vec3f(paint, 0.8F * paint, 0.7F);
    for (std::size_t k = 0; k < rig.lamps.size(); ++k) {
      const Eigen::Vector3d to_lamp = *rig.lamps[k].position_m - p;
      const double shading = std::max(0.0, n.dot(to_lamp.normalized())) / to_lamp.squaredNorm();
      const cv::Vec3f color = color_of(rig.lamps[k].color);
      for (int i = 0; i < 3; ++i) pictures[k](y, x)[i] = float(shading) * color[i] * albedo(y, x)[i];
    }
  }

  static cv::Vec3f color_of(LampColor color) {
    switch (color) {
      case LampColor::red:
        return {1, 0.05F, 0};
      case LampColor::green:
        return {0.05F, 1, 0.05F};
      case LampColor::blue:
        return {0, 0.05F, 1};
      default:
        return {1, 1, 1};
    }
  }

  /// The lamp that a line switches: another one where two are swapped.
  std::size_t wired(std::size_t line) const {
    for (const auto& [a, b] : options.swapped) {
      for (std::size_t k = 0; k < rig.lamps.size(); ++k) {
        if (rig.lamps[line].id == a && rig.lamps[k].id == b) return k;
        if (rig.lamps[line].id == b && rig.lamps[k].id == a) return k;
      }
    }
    return line;
  }

  /// @param all also writes the lines that stay as they are
  void write(const std::vector<bool>& lit, bool all) {
    clock.sleep_until(clock.now_us() + rounded(options.board_us / 2));
    for (std::size_t line = 0; line < lit.size(); ++line) {
      if (all || lit[line] != written[line]) clock.sleep_until(clock.now_us() + rounded(options.line_us));
      if (lit[line] == written[line]) continue;
      written[line] = lit[line];
      const double latency = options.lamp_latency_us + uniform(options.lamp_jitter_us);
      edges[wired(line)].push_back({double(clock.now_us()) + latency, lit[line]});
    }
    clock.sleep_until(clock.now_us() + rounded(options.board_us / 2));
  }

  /// Share of [from, to] in which a lamp is lit.
  double lit_share(std::size_t lamp, double from, double to) const {
    const std::string& id = rig.lamps[lamp].id;
    if (options.stuck_on.count(id) != 0) return 1;
    if (options.stuck_off.count(id) != 0) return 0;
    double lit = 0, since = -1e18;
    bool on = false;
    const auto add = [&](double until) {
      if (on) lit += std::max(0.0, std::min(until, to) - std::max(since, from));
    };
    for (const Edge& edge : edges[lamp]) {
      add(edge.time_us);
      on = edge.lit;
      since = edge.time_us;
    }
    add(1e18);
    return lit / (to - from) * (options.dim.count(id) != 0 ? 0.3 : 1);
  }

  double opens_us(int frame) const { return start_us + frame * options.period_us; }

  std::int64_t device_us(int frame) const {
    const double since = opens_us(frame) - start_us;
    const double offset = options.reset_clock_at_frame >= 0 && frame >= options.reset_clock_at_frame
                              ? -opens_us(options.reset_clock_at_frame) + start_us
                              : options.device_offset_us;
    return rounded(since * (1 + options.device_drift) + offset);
  }

  cv::Mat render(int frame) {
    cv::Mat3b image(camera.size());
    std::size_t noise_at = random() % noise.size();
    const double scale = options.ignores_exposure ? 1 : exposure_us * gain / (8000.0 * 100);
    for (int y = 0; y < camera.height; ++y) {
      const double opens = opens_us(frame) + options.readout_us * (y + 0.5) / camera.height;
      std::vector<std::pair<std::size_t, float>> lit;
      for (std::size_t k = 0; k < edges.size(); ++k) {
        const double share = lit_share(k, opens, opens + exposure_us);
        if (share > 0) lit.emplace_back(k, float(share * options.brightness));
      }
      for (int x = 0; x < camera.width; ++x) {
        cv::Vec3f value = albedo(y, x) * float(options.ambient);
        for (const auto& [k, share] : lit) value += pictures[k](y, x) * share;
        for (int c = 0; c < 3; ++c)
          image(y, x)[c] =
              cv::saturate_cast<uchar>(255 * (value[c] * float(scale) + noise[noise_at++ % noise.size()]));
      }
    }
    return std::move(image);
  }

  SimulatedClock& clock;
  Rig rig;
  SimulatedRigOptions options;
  std::mt19937 random;
  std::vector<std::vector<Edge>> edges;  ///< of each lamp
  std::vector<bool> written;
  double start_us;
  double exposure_us, gain = 100;
  Camera camera;
  cv::Mat1w depth;
  cv::Mat3f albedo;
  std::vector<cv::Mat3f> pictures;   ///< of each lamp alone
  std::array<float, 16381> noise{};  ///< a prime number, so that no frame repeats another's
  bool unplugged = false;
  int delivered = 0;
};

namespace {

class SimulatedSource : public FrameSource {
 public:
  explicit SimulatedSource(SimulatedRig::World& world) : world_(world) {}

  SourceDescription describe() const override {
    SourceDescription description;
    description.sensor = {"Rakelight", "simulated", "simulated", "1", "test"};
    description.color_camera = description.depth_camera = world_.camera;
    description.depth_unit_m = kUnit_m;
    description.frame_period_us = 33333;
    description.depth_registered_to_color = true;
    return description;
  }

  void start() override {
    const double passed = double(world_.clock.now_us()) - world_.start_us;
    for (Next* next : {&color_, &depth_}) {
      next->frame = std::max(next->frame, int(std::ceil(passed / world_.options.period_us)));
      schedule(*next);
    }
  }
  void stop() override {}
  int overruns(Stream) const override { return 0; }

  ExposureLock lock_exposure(double exposure_us, double gain) override {
    world_.exposure_us = exposure_us;
    world_.gain = gain;
    return {exposure_us, gain, true, true};
  }

  std::optional<SensorFrame> next(Stream stream, std::chrono::milliseconds timeout) override {
    Next& next = stream == Stream::color ? color_ : depth_;
    const std::int64_t until = world_.clock.now_us() + timeout.count() * 1000;
    if (world_.unplugged || next.arrives_us > until || unplugs(next)) {
      world_.clock.sleep_until(until);
      if (world_.unplugged && stream == Stream::color && ++silent_ > 20)
        throw SensorLost("the simulated sensor is gone");
      return std::nullopt;
    }
    world_.clock.sleep_until(next.arrives_us);
    SensorFrame frame;
    frame.index = next.frame;
    frame.device_us = world_.device_us(next.frame);
    frame.host_us = next.arrives_us;
    frame.image = stream == Stream::color ? world_.render(next.frame) : cv::Mat(world_.depth);
    if (stream == Stream::color) ++world_.delivered;
    if (world_.chance(world_.options.repeat_share) && !next.repeated) {
      next.repeated = true;
      return frame;
    }
    next.repeated = false;
    ++next.frame;
    schedule(next);
    return frame;
  }

 private:
  struct Next {
    int frame = 0;
    std::int64_t arrives_us = 0;
    bool repeated = false;
  };

  bool unplugs(const Next& next) {
    if (world_.options.unplug_at_frame < 0 || next.frame < world_.options.unplug_at_frame) return false;
    world_.unplugged = true;
    return true;
  }

  void schedule(Next& next) {
    while (world_.chance(world_.options.drop_share)) ++next.frame;
    const auto& o = world_.options;
    const double closes = world_.opens_us(next.frame) + o.readout_us + world_.exposure_us;
    const double arrives = closes + o.delivery_latency_us + world_.uniform(o.delivery_jitter_us);
    next.arrives_us = std::max(next.arrives_us, rounded(arrives));
  }

  SimulatedRig::World& world_;
  Next color_, depth_;
  int silent_ = 0;
};

class SimulatedBank : public LineBank {
 public:
  explicit SimulatedBank(std::shared_ptr<SimulatedRig::World> world)
      : world_(std::move(world)), written_(size(), false) {}
  std::size_t size() const override { return world_->rig.lamps.size(); }
  void write(const std::vector<bool>& lit) override {
    world_->write(lit, true);
    written_ = lit;
  }
  void write_changes(const std::vector<bool>& lit) override {
    world_->write(lit, false);
    written_ = lit;
  }
  std::vector<bool> read() override { return written_; }

 private:
  std::shared_ptr<SimulatedRig::World> world_;
  std::vector<bool> written_;
};

}  // namespace

SimulatedRig::SimulatedRig(const Rig& rig, const SimulatedRigOptions& options)
    : world_(std::make_shared<World>(*this, rig, options)),
      source_(std::make_unique<SimulatedSource>(*world_)) {
  std::vector<std::string> ids;
  for (const RigLamp& lamp : rig.lamps) ids.push_back(lamp.id);
  lights_ = std::make_unique<Lights>(ids, std::make_unique<SimulatedBank>(world_));
}

FrameSource& SimulatedRig::source() { return *source_; }
int SimulatedRig::frames_delivered() const { return world_->delivered; }

void SimulatedRig::plug_in() {
  world_->unplugged = false;
  world_->options.unplug_at_frame = -1;
  source_ = std::make_unique<SimulatedSource>(*world_);
}

std::set<std::string> SimulatedRig::lit_now() const {
  std::set<std::string> lit;
  for (std::size_t k = 0; k < world_->written.size(); ++k) {
    if (world_->written[k]) lit.insert(world_->rig.lamps[k].id);
  }
  return lit;
}

bool SimulatedRig::lit_only_by(std::int64_t device_us, const std::set<std::string>& lamps) const {
  int frame = -1;
  const double slope = world_->options.period_us * (1 + world_->options.device_drift);
  const auto guess = int(std::lround((double(device_us) - world_->options.device_offset_us) / slope));
  for (int k = std::max(0, guess - 2); k <= guess + 2; ++k) {
    if (world_->device_us(k) == device_us) frame = k;
  }
  if (frame < 0) return false;
  const double opens = world_->opens_us(frame),
               closes = opens + world_->options.readout_us + world_->exposure_us;
  for (std::size_t k = 0; k < world_->rig.lamps.size(); ++k) {
    const double wanted = lamps.count(world_->rig.lamps[k].id) != 0 ? 1 : 0;
    if (std::abs(world_->lit_share(k, opens, closes) - wanted) > 1e-9) return false;
  }
  return true;
}

}  // namespace rakelight::test
