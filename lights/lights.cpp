// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lights/lights.h"

#include <algorithm>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

#include "lights/watchdog.h"

namespace rakelight {
namespace {

std::int64_t now_us() {
  using namespace std::chrono;
  return duration_cast<microseconds>(steady_clock::now().time_since_epoch()).count();
}

void check_ids(const std::vector<std::string>& ids, const LineBank& bank) {
  if (ids.size() != bank.size()) {
    throw std::invalid_argument("cannot name " + std::to_string(bank.size()) + " lamp lines by " +
                                std::to_string(ids.size()) + " ids; give each line one");
  }
  if (std::set<std::string>(ids.begin(), ids.end()).size() != ids.size())
    throw std::invalid_argument("two lamps bear one id; give each its own");
}

}  // namespace

struct Lights::State {
  std::vector<std::string> ids;
  std::unique_ptr<LineBank> bank;
  mutable std::mutex mutex;  // guards the bank
  Watchdog watchdog;         // last: its thread must end before the bank goes

  State(std::vector<std::string> lamp_ids, std::unique_ptr<LineBank> lines, const LightsOptions& options)
      : ids(std::move(lamp_ids)),
        bank(std::move(lines)),
        watchdog(options.max_on, mutex, [this] { off(); }) {}

  void off() { bank->write(std::vector<bool>(bank->size(), false)); }

  std::vector<bool> levels(const std::vector<std::string>& lit_ids) const {
    std::vector<bool> lit(ids.size(), false);
    for (const std::string& id : lit_ids) {
      const auto found = std::find(ids.begin(), ids.end(), id);
      if (found == ids.end()) throw std::invalid_argument("cannot light \"" + id + "\": no lamp has this id");
      lit[static_cast<std::size_t>(found - ids.begin())] = true;
    }
    return lit;
  }

  /// Off comes first: adapters change lines one by one, and two lamps must never be lit by the way.
  void switch_to(const std::vector<bool>& lit) {
    const std::vector<bool> dark(lit.size(), false);
    bank->write_changes(dark);
    if (lit == dark) return watchdog.stop();
    watchdog.start();
    try {
      bank->write_changes(lit);
    } catch (...) {
      try {
        off();
        watchdog.stop();
      } catch (...) {
        // What went wrong first is what the caller has to know; the watchdog goes on trying.
      }
      throw;
    }
  }
};

Lights::Lights(std::vector<std::string> ids, std::unique_ptr<LineBank> bank, LightsOptions options) {
  check_ids(ids, *bank);
  bank->write(std::vector<bool>(bank->size(), false));
  state_ = std::make_unique<State>(std::move(ids), std::move(bank), options);
}

Lights::~Lights() {
  try {
    all_off();
  } catch (...) {
    // The device has gone; nothing is left to be switched. Destructors do not throw.
  }
}

const std::vector<std::string>& Lights::ids() const { return state_->ids; }

SwitchTime Lights::show(const std::vector<std::string>& ids) {
  const std::vector<bool> lit = state_->levels(ids);
  const std::lock_guard lock(state_->mutex);
  SwitchTime time;
  time.before_us = now_us();
  state_->switch_to(lit);
  time.after_us = now_us();
  return time;
}

SwitchTime Lights::all_off() {
  const std::lock_guard lock(state_->mutex);
  SwitchTime time;
  time.before_us = now_us();
  state_->off();
  time.after_us = now_us();
  state_->watchdog.stop();
  return time;
}

std::vector<std::string> Lights::lit() const {
  const std::lock_guard lock(state_->mutex);
  const std::vector<bool> levels = state_->bank->read();
  std::vector<std::string> lit;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (levels[k]) lit.push_back(state_->ids[k]);
  }
  return lit;
}

bool Lights::watchdog_tripped() const {
  const std::lock_guard lock(state_->mutex);
  return state_->watchdog.tripped();
}

}  // namespace rakelight
