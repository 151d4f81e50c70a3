// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/driver/virtual_rig_state.h"

#include <chrono>

namespace rakelight {
namespace {

double host_now_us() {
  using Microseconds = std::chrono::duration<double, std::micro>;
  return Microseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

VirtualRigState::VirtualRigState(std::function<void()> on_unplug)
    : on_unplug_(std::move(on_unplug)), lamps_(LampTimeline(setup_.wiring)) {}

void VirtualRigState::set_up(const std::string& text) {
  if (text == text_) return;
  VirtualSensorSetup setup = parse_virtual_setup(text);
  {
    const std::scoped_lock lock(scene_mutex_, lamps_mutex_);
    scene_.reset();
    color_.reset();
    depth_.reset();
    setup_ = std::move(setup);
    lamps_.emplace(setup_.wiring);
    text_ = text;
  }
  color(setup_.color_size);
  depth(setup_.depth_size);
}

bool VirtualRigState::write_lamps(const std::vector<bool>& lines) {
  const std::lock_guard<std::mutex> lock(lamps_mutex_);
  if (lines.size() != lamps_->size()) return false;
  lamps_->write(host_now_us(), lines);
  return true;
}

std::vector<bool> VirtualRigState::lit_lamps() const {
  const std::lock_guard<std::mutex> lock(lamps_mutex_);
  std::vector<bool> lit(lamps_->size());
  for (std::size_t lamp = 0; lamp < lit.size(); ++lamp) lit[lamp] = lamps_->lit_at(lamp, host_now_us());
  return lit;
}

std::vector<LampRows> VirtualRigState::light(const RollingShutter& shutter, double start_us) const {
  const std::lock_guard<std::mutex> lock(lamps_mutex_);
  return frame_light(*lamps_, shutter, *epoch_us_ + start_us);
}

double VirtualRigState::now_us() {
  const std::lock_guard<std::mutex> lock(clock_mutex_);
  if (!epoch_us_) epoch_us_ = host_now_us();
  return host_now_us() - *epoch_us_;
}

const VirtualScene& VirtualRigState::scene() {
  if (!scene_) scene_ = std::make_unique<VirtualScene>(setup_);
  return *scene_;
}

std::shared_ptr<const FrameRenderer> VirtualRigState::color(cv::Size size) {
  const std::lock_guard<std::mutex> lock(scene_mutex_);
  if (!color_ || color_->size() != size) {
    color_ =
        std::make_shared<FrameRenderer>(scene().render_color(size), scene().options().image, setup_.seed);
  }
  return color_;
}

std::shared_ptr<const DepthSensor> VirtualRigState::depth(cv::Size size) {
  const std::lock_guard<std::mutex> lock(scene_mutex_);
  if (!depth_ || depth_size_ != size) {
    depth_ = std::make_shared<DepthSensor>(scene().depth_sensor(size));
    depth_size_ = size;
  }
  return depth_;
}

GroundTruth VirtualRigState::truth() {
  const std::shared_ptr<const FrameRenderer> seen = color(setup_.color_size);
  const std::lock_guard<std::mutex> lock(scene_mutex_);
  return scene().truth(seen->images());
}

void VirtualRigState::unplug() {
  if (plugged_in_.exchange(false)) on_unplug_();
}

}  // namespace rakelight
