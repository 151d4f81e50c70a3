// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/following_lamps.h"

#include <stdexcept>
#include <utility>

namespace rakelight {
namespace {

class FollowingLamps : public LineBank {
 public:
  FollowingLamps(std::unique_ptr<LineBank> lines, std::unique_ptr<LineBank> lamps)
      : lines_(std::move(lines)), lamps_(std::move(lamps)) {
    if (lines_->size() != lamps_->size())
      throw std::invalid_argument("as many lines as lamps that hang on them are needed");
  }

  std::size_t size() const override { return lines_->size(); }
  void write(const std::vector<bool>& lit) override {
    lines_->write(lit);
    follow();
  }
  void write_changes(const std::vector<bool>& lit) override {
    lines_->write_changes(lit);
    follow();
  }
  std::vector<bool> read() override { return lines_->read(); }

 private:
  void follow() { lamps_->write(lines_->read()); }

  std::unique_ptr<LineBank> lines_, lamps_;
};

}  // namespace

std::unique_ptr<LineBank> follow_lines(std::unique_ptr<LineBank> lines, std::unique_ptr<LineBank> lamps) {
  return std::make_unique<FollowingLamps>(std::move(lines), std::move(lamps));
}

}  // namespace rakelight
