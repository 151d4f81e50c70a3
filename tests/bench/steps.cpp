// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/steps.h"

#include <cmath>
#include <memory>
#include <opencv2/core/utility.hpp>

#include "refine/multi_light.h"
#include "refine/steps/albedo.h"
#include "refine/steps/depth_step.h"
#include "refine/steps/lighting.h"
#include "refine/steps/photometric_tensor.h"
#include "tests/bench/bench_stack.h"

namespace rakelight::bench {
namespace {

constexpr int kImages = 10;
constexpr double kEdgeWeight = 10, kCauchyScale = 0.02;

/// A refinement in its middle, and what its next iteration works on.
struct Middle {
  RefineOptions options = preset_options(Preset::robust);
  RefineProblem problem;
  SurfaceState state, weighted;
  PhotometricTensors tensors;
  CornerWeights weights;
  std::unique_ptr<DepthProblem> depth;
  std::unique_ptr<DepthSystem> system;

  Middle() {
    options.max_iterations = options.min_iterations = 3;
    options.uncertainty_samples = 0;
    options.lamps.model = LampModel::far;
    options.scale = 1;
    options.trust.cauchy_scale = 0;
    problem = make_problem(wavy_stack(640, 480, kImages), options);
    state = refine_multi_light(problem, options, [](int, double, const Eigen::VectorXd&) {}).state;
    tensors = accumulate_tensors(problem.images, state);
    weighted = state;
    reweigh_and_accumulate(problem.images, kCauchyScale, AlbedoRole::held, weighted, tensors);
    weights = corner_weights(problem.grid, problem.corners, tensors, state.zeta, kEdgeWeight);
    depth.reset(new DepthProblem{problem.grid, problem.corners, tensors, weights, problem.prior});
    system = std::make_unique<DepthSystem>(depth_system(*depth, state.zeta, Linearization::gauss_newton));
  }
};

/// A solver that takes the middle's system, to 10^-digits.
std::function<void()> solve_to(const std::shared_ptr<Middle>& m, int digits) {
  const std::shared_ptr<DepthSolver> solver =
      make_multigrid_depth_solver(m->problem.grid, m->problem.prior.cells, std::pow(10.0, -digits));
  return [m, solver] {
    Eigen::VectorXd step;
    solver->solve(std::move(*m->system), step);
    *m->system = solver->reuse_system();
  };
}

}  // namespace

std::vector<Step> iteration_steps() {
  cv::setNumThreads(1);
  const auto m = std::make_shared<Middle>();
  const double pixels = m->problem.grid.size();
  constexpr double kSamples = kImages * 3 * 2, kWeights = kImages * 4, kSurface = 24, kTensor = 40,
                   kCornerWeights = 16, kSystem = 28, kZeta = 8, kSolve = 300;  // bytes a pixel
  return {
      {"lights", pixels * (kSamples + kSurface), 6, [m] { estimate_far_lamps(m->problem.images, m->state); }},
      {"albedo and tensors", pixels * (kSamples + kSurface + 12 + kTensor), 10,
       [m] {
         find_albedo_and_accumulate(m->problem.images, AlbedoRole::follows_normal, m->state, m->tensors);
       }},
      {"lights, weighted", pixels * (kSamples + kWeights + kSurface), 8,
       [m] { estimate_far_lamps(m->problem.images, m->weighted); }},
      {"albedo, weighted", pixels * (kSamples + kWeights + kSurface + 12), 8,
       [m] { estimate_albedo(m->problem.images, m->weighted); }},
      {"weights and tensors", pixels * (kSamples + kWeights + kSurface + kTensor), 16,
       [m] {
         reweigh_and_accumulate(m->problem.images, kCauchyScale, AlbedoRole::follows_normal, m->weighted,
                                m->tensors);
       }},
      {"corner weights", pixels * (kTensor + kCornerWeights + kZeta), 8,
       [m] { corner_weights(m->problem.grid, m->problem.corners, m->tensors, m->state.zeta, kEdgeWeight); }},
      {"system", pixels * (kTensor + kCornerWeights + kZeta + kSystem), 20,
       [m] { fill_depth_system(*m->depth, m->state.zeta, Linearization::gauss_newton, *m->system); }},
      {"energy", pixels * (kTensor + kCornerWeights + kZeta), 8,
       [m] { depth_energy(*m->depth, m->state.zeta); }},
      {"solve to 1e-2", pixels * kSolve, 16, solve_to(m, 2)},
      {"solve to 1e-4", pixels * kSolve, 20, solve_to(m, 4)},
      {"solve to 1e-6", pixels * kSolve, 26, solve_to(m, 6)},
  };
}

}  // namespace rakelight::bench
