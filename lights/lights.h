// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lamps, switched so that none is ever left on. Read this header first.
//
//     Lights lights(ids, open_gpio_bank(lines), options);   // everything is off now
//     lights.show({"white-3"});                             // all off, then this one on
//     lights.all_off();                                     // also on destruction, on any way out
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rakelight {

/// A bank of output lines that take logical levels (true = lamp lit; active-low is the backend's business).
class LineBank {
 public:
  virtual ~LineBank() = default;
  virtual std::size_t size() const = 0;
  /// Sets every line. `lit.size() == size()`. @throws std::system_error naming what was attempted on which line.
  virtual void write(const std::vector<bool>& lit) = 0;
  /// Sets at least the lines that differ from the last write. A bank on which every line costs time (a USB adapter
  /// takes milliseconds for each) leaves the others alone. @throws as write()
  virtual void write_changes(const std::vector<bool>& lit) { write(lit); }
  /// The levels that the lines are at, as the bank sees them: a line that is stuck is at another than was written.
  /// @throws std::system_error naming what was attempted on which line.
  virtual std::vector<bool> read() = 0;
};

/// When lamps were switched, on the host's monotonic clock, in microseconds: every edge, of the old lamps going off
/// and of the new ones coming on, lies between the two.
struct SwitchTime {
  std::int64_t before_us = 0;  ///< before the first line is written
  std::int64_t after_us = 0;   ///< after the last one has been
};

struct LightsOptions {
  std::chrono::milliseconds max_on{2000};  ///< a lamp lit for longer is switched off by the watchdog
};

/// Lamps by name over a bank. Thread-safe. Off on construction and destruction.
class Lights {
 public:
  /// `ids[k]` names line k of `bank`. @throws std::system_error if the lamps cannot be switched off,
  /// std::invalid_argument where ids and lines differ in number or two lamps share an id.
  Lights(std::vector<std::string> ids, std::unique_ptr<LineBank> bank, LightsOptions options = {});
  ~Lights();
  Lights(const Lights&) = delete;
  Lights& operator=(const Lights&) = delete;

  const std::vector<std::string>& ids() const;
  /// What is lit off, then exactly these on, none for an empty list. A lamp goes off and comes on as long after the write
  /// as with any other call: lines that stay as they are are not written. If a line fails, all are off again, as far as
  /// they still obey. @throws std::invalid_argument for an unknown id, std::system_error where a line cannot be switched.
  SwitchTime show(const std::vector<std::string>& ids);
  /// Writes "off" to every line, whatever was written before. @throws std::system_error
  SwitchTime all_off();
  /// The ids of the lamps whose lines are at "lit", whatever was written. @throws std::system_error
  std::vector<std::string> lit() const;
  /// Whether the watchdog has had to switch a lamp off since the last show().
  bool watchdog_tripped() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rakelight
