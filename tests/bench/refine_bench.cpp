// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole refinements of a stack in memory, beside a stream read measured in the same run:
//
//     refine_bench                        the table of docs/performance.md
//     refine_bench --benchmark_filter=vga
#include <benchmark/benchmark.h>

#include <chrono>
#include <opencv2/core/utility.hpp>

#include "refine/multi_light.h"
#include "refine/refine.h"
#include "tests/bench/bench_stack.h"
#include "tests/bench/keep_memory.h"
#include "tests/bench/stream.h"

namespace rakelight::bench {
namespace {

struct Size {
  const char* name;
  int width, height, images;
};

RefineOptions ten_iterations(bool robust) {
  RefineOptions options = preset_options(Preset::robust);
  options.max_iterations = options.min_iterations = 10;
  options.uncertainty_samples = 0;
  options.lamps.model = LampModel::far;
  options.scale = 1;
  if (!robust) options.trust.cauchy_scale = options.trust.edge_weight = 0;
  return options;
}

/// Ten outer iterations; counters: time over that of reading the bytes that must move, and ns a pixel and iteration.
void outer_iterations(benchmark::State& run, Size size, bool robust) {
  const RefineOptions options = ten_iterations(robust);
  const RefineProblem problem = make_problem(wavy_stack(size.width, size.height, size.images), options);
  double best = 1e9;
  for (auto _ : run) {
    const auto begin = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(
        refine_multi_light(problem, options, [](int, double, const Eigen::VectorXd&) {}));
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  const double pixels = problem.grid.size();
  run.counters["ms"] = 1e3 * best;
  run.counters["stream"] = best * stream_read_speed() / bytes_that_must_move(pixels, size.images);
  run.counters["ns_px_it"] = 1e9 * best / pixels / 10;
}

constexpr Size kVga{"vga_x10", 640, 480, 10}, kSxga{"1280x960_x20", 1280, 960, 20},
    kFive{"5Mpx_x10", 2592, 1944, 10};
constexpr Size kSmall{"50kpx_x10", 256, 192, 10}, kFour{"vga_x4", 640, 480, 4},
    kMany{"vga_x96", 640, 480, 96};

void add_benchmarks() {
  for (const Size& size : {kSmall, kVga, kSxga, kFive, kFour, kMany}) {
    for (const bool robust : {false, true}) {
      benchmark::RegisterBenchmark((std::string(size.name) + (robust ? "/robust" : "/unweighted")).c_str(),
                                   [=](benchmark::State& run) { outer_iterations(run, size, robust); })
          ->Unit(benchmark::kMillisecond)
          ->Iterations(size.width > 2000 ? 1 : 3);
    }
  }
}

}  // namespace
}  // namespace rakelight::bench

int main(int argc, char** argv) {
  rakelight::bench::keep_freed_memory();
  rakelight::bench::add_benchmarks();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
