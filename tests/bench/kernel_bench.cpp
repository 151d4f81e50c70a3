// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps of an outer iteration one by one, on VGA x 10. Counter `stream`: time over that of reading as many bytes as the
// step reads and writes, one thread against one thread.
#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/core/utility.hpp>

#include "refine/multi_light.h"
#include "refine/steps/albedo.h"
#include "refine/steps/depth_step.h"
#include "refine/steps/lighting.h"
#include "refine/steps/photometric_tensor.h"
#include "tests/bench/bench_stack.h"
#include "tests/bench/stream.h"

namespace rakelight::bench {
namespace {

/// A refinement in its middle.
struct Middle {
  RefineOptions options = preset_options(Preset::robust);
  RefineProblem problem;
  SurfaceState state;
  PhotometricTensors tensors;
  CornerWeights weights;

  Middle() {
    cv::setNumThreads(1);
    options.max_iterations = options.min_iterations = 3;
    options.uncertainty_samples = 0;
    options.lamps.model = LampModel::far;
    options.scale = 1;
    problem = make_problem(wavy_stack(640, 480, 10), options);
    state = refine_multi_light(problem, options, [](int, double, const Eigen::VectorXd&) {}).state;
    tensors = accumulate_tensors(problem.images, state);
    weights = corner_weights(problem.grid, problem.corners, tensors, state.zeta, 10);
  }
};

Middle& middle() {
  static Middle instance;
  return instance;
}

void count(benchmark::State& run, double bytes_a_pixel) {
  static const double speed = stream_read_speed();
  run.counters["bytes"] = bytes_a_pixel;
  run.counters["stream"] = benchmark::Counter(middle().problem.grid.size() * bytes_a_pixel / speed,
                                              benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

constexpr double kSamples = 10 * 3 * 2, kWeights = 10 * 4, kNormalsAndAlbedo = 24, kTensor = 40, kCorners = 16;

void lights(benchmark::State& run) {
  Middle& m = middle();
  for (auto _ : run) benchmark::DoNotOptimize(estimate_far_lamps(m.problem.images, m.state));
  count(run, kSamples + kWeights + kNormalsAndAlbedo);
}
BENCHMARK(lights)->Unit(benchmark::kMillisecond);

void albedo(benchmark::State& run) {
  Middle& m = middle();
  for (auto _ : run) benchmark::DoNotOptimize(estimate_albedo(m.problem.images, m.state));
  count(run, kSamples + kWeights + kNormalsAndAlbedo + 12);
}
BENCHMARK(albedo)->Unit(benchmark::kMillisecond);

void weights_and_tensors(benchmark::State& run) {
  Middle& m = middle();
  for (auto _ : run) reweigh_and_accumulate(m.problem.images, 0.02, m.state, m.tensors);
  count(run, kSamples + 2 * kWeights + kNormalsAndAlbedo + kTensor);
}
BENCHMARK(weights_and_tensors)->Unit(benchmark::kMillisecond);

void corner_weighting(benchmark::State& run) {
  Middle& m = middle();
  for (auto _ : run)
    benchmark::DoNotOptimize(corner_weights(m.problem.grid, m.problem.corners, m.tensors, m.state.zeta, 10));
  count(run, kTensor + 2 * kCorners + 8);
}
BENCHMARK(corner_weighting)->Unit(benchmark::kMillisecond);

void assembly(benchmark::State& run) {
  Middle& m = middle();
  const DepthProblem depth{m.problem.grid, m.problem.corners, m.tensors, m.weights, m.problem.prior};
  for (auto _ : run) benchmark::DoNotOptimize(depth_system(depth, m.state.zeta, Linearization::gauss_newton));
  count(run, kTensor + kCorners + 8 + 28);
}
BENCHMARK(assembly)->Unit(benchmark::kMillisecond);

void energy(benchmark::State& run) {
  Middle& m = middle();
  const DepthProblem depth{m.problem.grid, m.problem.corners, m.tensors, m.weights, m.problem.prior};
  for (auto _ : run) benchmark::DoNotOptimize(depth_energy(depth, m.state.zeta));
  count(run, kTensor + kCorners + 8);
}
BENCHMARK(energy)->Unit(benchmark::kMillisecond);

/// To 1e-2, 1e-4, 1e-6 of the right-hand side, set-up included.
void solve(benchmark::State& run) {
  Middle& m = middle();
  const DepthProblem depth{m.problem.grid, m.problem.corners, m.tensors, m.weights, m.problem.prior};
  const DepthSystem system = depth_system(depth, m.state.zeta, Linearization::gauss_newton);
  const auto solver = make_multigrid_depth_solver(m.problem.grid, m.problem.prior.cells,
                                                  std::pow(10.0, -static_cast<double>(run.range(0))));
  Eigen::VectorXd step;
  for (auto _ : run) solver->solve(system, step);
  count(run, 300);
}
BENCHMARK(solve)->Arg(2)->Arg(4)->Arg(6)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rakelight::bench

BENCHMARK_MAIN();
