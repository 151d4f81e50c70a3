// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/frame_keeper.h"

#include <algorithm>

namespace rakelight {
namespace {

std::string name_of(const std::optional<std::string>& light, const char* dark) {
  return light ? "lamp '" + *light + "'" : dark;
}

}  // namespace

/// Whether a step's lamp gives no light of its own, so that no image can be taken.
bool FrameKeeper::is_dead(const ScanStep& step) const {
  const std::vector<LampFault>& faults = session_.state.faults;
  return std::any_of(faults.begin(), faults.end(), [&](const LampFault& fault) {
    const bool dead = fault.kind == LampFault::Kind::no_light || fault.kind == LampFault::Kind::stuck_on;
    return dead && step.light == fault.lamp;
  });
}

std::vector<std::size_t> FrameKeeper::missing_steps() const {
  std::vector<std::size_t> steps;
  for (std::size_t i = 0; i < session_.plan.steps.size(); ++i) {
    if (!is_dead(session_.plan.steps[i]) && missing_images(i) > 0) steps.push_back(i);
  }
  return steps;
}

int FrameKeeper::missing_images(std::size_t index) const {
  const ScanStep& step = session_.plan.steps[index];
  int missing = 0;
  for (int i = 0; i < step.images; ++i) missing += session_.state.has_slot(step.first_slot + i) ? 0 : 1;
  return missing;
}

std::optional<int> FrameKeeper::free_slot(const ScanStep& step) const {
  for (int i = 0; i < step.images; ++i) {
    if (!session_.state.has_slot(step.first_slot + i)) return step.first_slot + i;
  }
  return std::nullopt;
}

void FrameKeeper::take(const StepFrame& taken) {
  const ScanStep& step = session_.plan.steps[taken.step];
  const std::optional<int> slot = free_slot(step);
  if (!slot) return;
  const LitCheck check = session_.state.signatures.check(step.light.value_or(""), taken.frame.frame.image);
  Frame frame = session_.frame_of(taken);
  frame.index = *slot;
  frame.lit_check = check;
  if (!check.matches) {
    unproven_[*slot] = std::move(frame);
    return;
  }
  keep(std::move(frame));
  keep_more_depth(*slot, taken.frame.frame.device_us);
  const int wanted = session_.plan.slots * session_.options.depth_frames;
  session_.note("scanning", 0.4 + 0.6 * double(session_.state.stack.frames.size()) / wanted);
}

void FrameKeeper::keep(Frame frame) {
  session_.state.stack.frames.push_back(std::move(frame));
  if (session_.options.on_frame)
    session_.options.on_frame(session_.state, session_.state.stack.frames.back());
}

/// Depth does not see the lamps: any frame nearby is one more measurement of the same surface.
void FrameKeeper::keep_more_depth(int slot, std::int64_t device_us) {
  const std::optional<std::string> light = session_.state.stack.frames.back().light;
  const int more = session_.options.depth_frames - 1;
  for (int i = 0; i < more; ++i) {
    Frame frame;
    frame.index = session_.plan.slots + slot * more + i;
    frame.light = light;
    session_.put_depth(frame, device_us);
    if (frame.depth.empty()) return;
    keep(std::move(frame));
  }
}

void FrameKeeper::settle_unproven(int slot, Frame frame) {
  if (session_.state.has_slot(slot)) return;
  const std::string nearest = session_.state.signatures.nearest(frame.color);
  const std::optional<std::string> looks_like =
      nearest.empty() ? std::nullopt : std::optional<std::string>(nearest);
  session_.warn("the picture under " + name_of(frame.light, "no lamp") +
                " does not match what it showed before" +
                (looks_like == frame.light ? "" : " and looks like " + name_of(looks_like, "the dark")) +
                "; it is kept and marked: the object or the room's light may have changed");
  keep(std::move(frame));
}

void FrameKeeper::settle() {
  for (auto& [slot, frame] : unproven_) settle_unproven(slot, std::move(frame));
  for (const std::size_t step : missing_steps()) {
    session_.warn(name_of(session_.plan.steps[step].light, "the dark") + " has " +
                  std::to_string(missing_images(step)) + " images fewer than asked for: no whole frame came");
  }
}

}  // namespace rakelight
