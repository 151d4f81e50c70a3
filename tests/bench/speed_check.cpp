// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fails when a step of an outer iteration has become several times slower against a stream read of the bytes it moves. Processor
// time of one thread, best of many runs beside best of many reads: other programs on the machine hardly count. The limits are
// three to five times what was measured with AVX-512, so that older processors pass, too: what they catch is a scalar loop where
// a vector kernel was, a copy of a stack, a step that has become quadratic.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>

#include "tests/bench/keep_memory.h"
#include "tests/bench/steps.h"
#include "tests/bench/stream.h"

namespace rakelight::bench {
namespace {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double best_seconds(const Step& step) {
  constexpr int kRuns = 15;
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) {
    const double begin = processor_seconds();
    step.run();
    best = std::min(best, processor_seconds() - begin);
  }
  return best;
}

int check() {
  keep_freed_memory();
  const std::vector<Step> steps = iteration_steps();
  const double speed = stream_read_speed();
  std::printf("stream read: %.1f GB/s\n", speed / 1e9);
  int failures = 0;
  for (const Step& step : steps) {
    const double ratio = best_seconds(step) * speed / step.bytes;
    const bool slow = ratio > step.worst;
    std::printf("%-20s %5.1f times the read, at most %.0f%s\n", step.name.c_str(), ratio, step.worst,
                slow ? "  TOO SLOW" : "");
    failures += slow;
  }
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace rakelight::bench

int main() { return rakelight::bench::check(); }
