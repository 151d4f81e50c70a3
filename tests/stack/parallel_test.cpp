// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>

namespace rakelight {
namespace {

TEST(InParallel, RunsEachOnce) {
  std::vector<std::atomic<int>> runs(100);
  in_parallel(100, [&](int k) { ++runs[static_cast<std::size_t>(k)]; });
  for (const auto& count : runs) EXPECT_EQ(count, 1);
  in_parallel(0, [](int) { FAIL(); });
}

TEST(InParallel, ThrowsWhatTheFirstThatFailedThrew) {
  std::atomic<int> ran{0};
  try {
    in_parallel(50, [&](int k) {
      ++ran;
      if (k == 7 || k == 31) throw std::runtime_error(std::to_string(k));
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) { EXPECT_STREQ(error.what(), "7"); }
  EXPECT_EQ(ran, 50);
}

}  // namespace
}  // namespace rakelight
