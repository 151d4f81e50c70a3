// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/following_lamps.h"

#include <gmock/gmock.h>

namespace rakelight {
namespace {

using testing::ElementsAre;

using Levels = std::vector<bool>;

/// Keeps levels in the test's hands; the line `stuck` stays off.
class Bank : public LineBank {
 public:
  explicit Bank(Levels& levels, std::size_t stuck = 99) : levels_(levels), stuck_(stuck) {}
  std::size_t size() const override { return levels_.size(); }
  void write(const Levels& lit) override {
    for (std::size_t k = 0; k < lit.size(); ++k) levels_[k] = lit[k] && k != stuck_;
  }
  Levels read() override { return levels_; }

 private:
  Levels& levels_;
  std::size_t stuck_;
};

TEST(FollowingLamps, AreLitAsTheirLinesRead) {
  Levels lines(3), lamps(3);
  const auto bank = follow_lines(std::make_unique<Bank>(lines, 1), std::make_unique<Bank>(lamps));
  bank->write({true, true, false});
  EXPECT_THAT(lamps, ElementsAre(true, false, false)) << "the second line is stuck";
  EXPECT_THAT(bank->read(), ElementsAre(true, false, false));
  bank->write_changes({false, false, true});
  EXPECT_THAT(lamps, ElementsAre(false, false, true));
}

TEST(FollowingLamps, NeedALineEach) {
  Levels lines(3), lamps(2);
  EXPECT_THROW(follow_lines(std::make_unique<Bank>(lines), std::make_unique<Bank>(lamps)),
               std::invalid_argument);
}

}  // namespace
}  // namespace rakelight
