// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/stream.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <opencv2/core/utility.hpp>
#include <vector>

namespace rakelight::bench {

double stream_read_speed() {
  static const std::vector<std::uint64_t> buffer(std::size_t{64} << 20, 1);  // 512 MB
  constexpr int kParts = 64;
  double best = 0;
  std::atomic<std::uint64_t> sink{0};
  for (int run = 0; run < 7; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    cv::parallel_for_(cv::Range(0, kParts), [&](const cv::Range& range) {
      const std::size_t part = buffer.size() / kParts;
      const std::uint64_t* at = buffer.data() + static_cast<std::size_t>(range.start) * part;
      const std::size_t count = static_cast<std::size_t>(range.end - range.start) * part;
      std::uint64_t sums[8] = {};
      for (std::size_t k = 0; k < count; k += 8)
        for (std::size_t j = 0; j < 8; ++j) sums[j] += at[k + j];
      for (const std::uint64_t sum : sums) sink += sum;
    });
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    best = std::max(best, static_cast<double>(buffer.size() * sizeof(std::uint64_t)) / time.count());
  }
  return best;
}

double bytes_that_must_move(double pixels, double images, double iterations) {
  constexpr double kStateBytes = 330, kSampleBytes = 1, kReads = 2, kChannels = 3;
  return iterations * pixels * (kReads * kChannels * kSampleBytes * images + kStateBytes);
}

}  // namespace rakelight::bench
