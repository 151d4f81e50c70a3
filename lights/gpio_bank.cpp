// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lights/gpio_bank.h"

#include <utility>

#include "lights/gpio_backend.h"
#include "lights/gpio_lookup.h"
#include "lights/guard.h"

namespace rakelight {
namespace {

class GpioBank : public LineBank {
 public:
  GpioBank(std::vector<FoundLine> lines, const std::string& consumer)
      : lines_(std::move(lines)), written_(lines_.size(), false) {
    outputs_.reserve(lines_.size());
    for (const FoundLine& line : lines_) {
      explained(line, [&] {
        outputs_.push_back(request_output(line.chip_path, line.offset, line.active_low, consumer));
      });
    }
  }

  std::size_t size() const override { return lines_.size(); }

  void write(const std::vector<bool>& lit) override {
    for (std::size_t k = 0; k < lines_.size(); ++k) set(k, lit[k]);
  }

  void write_changes(const std::vector<bool>& lit) override {
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      if (written_[k] != lit[k]) set(k, lit[k]);
    }
  }

  std::vector<bool> read() override {
    std::vector<bool> levels(lines_.size());
    for (std::size_t k = 0; k < lines_.size(); ++k)
      explained(lines_[k], [&] { levels[k] = outputs_[k].get(); });
    return levels;
  }

 private:
  void set(std::size_t k, bool lit) {
    if (lit) written_[k] = true;  // even if it fails: it may be lit now
    explained(lines_[k], [&] { outputs_[k].set(lit); });
    written_[k] = lit;
  }

  template <class Action>
  static void explained(const FoundLine& line, Action action) {
    try {
      action();
    } catch (const std::system_error& error) { throw explain(error, line, list_gpio_chips()); }
  }

  std::vector<FoundLine> lines_;
  std::vector<bool> written_;
  std::vector<OutputLine> outputs_;
};

}  // namespace

std::unique_ptr<LineBank> open_gpio_bank(const std::vector<GpioLine>& lines, const GpioBankOptions& options) {
  std::vector<FoundLine> found = find_lines(lines, list_gpio_chips());
  GuardOptions guard;
  guard.max_on = options.max_on;
  return open_guarded([&] { return std::make_unique<GpioBank>(std::move(found), options.consumer); }, guard);
}

}  // namespace rakelight
