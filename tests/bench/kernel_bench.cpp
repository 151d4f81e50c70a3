// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each step of an outer iteration in one thread. Counter `stream`: time over that of reading as many bytes as the step reads
// and writes.
#include <benchmark/benchmark.h>

#include "tests/bench/keep_memory.h"
#include "tests/bench/steps.h"
#include "tests/bench/stream.h"

int main(int argc, char** argv) {
  using namespace rakelight::bench;
  keep_freed_memory();
  const std::vector<Step> steps = iteration_steps();
  const double speed = stream_read_speed();
  for (const Step& step : steps) {
    benchmark::RegisterBenchmark(step.name.c_str(), [&](benchmark::State& run) {
      for (auto _ : run) step.run();
      run.counters["stream"] = benchmark::Counter(
          step.bytes / speed, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    })->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
