// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vector kernels on every instruction set of this processor, whole refinements against each other.
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cmath>

#include "refine/refine.h"
#include "tests/support/bump_stack.h"

namespace rakelight {
namespace {

/// Runs kernels on one instruction set while it lives.
class InstructionSet {
 public:
  explicit InstructionSet(int64_t target) { choose(target); }
  ~InstructionSet() { choose(0); }
  InstructionSet(const InstructionSet&) = delete;
  InstructionSet& operator=(const InstructionSet&) = delete;

 private:
  static void choose(int64_t target) {
    hwy::SetSupportedTargetsForTest(target);  // 0: all that there are
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

RefineResult refined_on(int64_t target, const RefineOptions& options) {
  const InstructionSet set(target);
  return refine_depth(test::bump_stack(), options, {});
}

double rms_difference_mm(const RefineResult& a, const RefineResult& b) {
  double sum = 0;
  int count = 0;
  for (int v = 0; v < a.depth.rows; ++v) {
    for (int u = 0; u < a.depth.cols; ++u) {
      const double d = 1e3 * (static_cast<double>(a.depth(v, u)) - static_cast<double>(b.depth(v, u)));
      if (std::isnan(d)) continue;
      sum += d * d;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

struct Kind {
  LampModel lamps;
  bool weighted;  ///< without weights, plain images have kernels of their own
};

class InstructionSets : public testing::TestWithParam<Kind> {};

TEST_P(InstructionSets, AllGiveTheSameSurface) {
  RefineOptions options;
  options.lamps.model = GetParam().lamps;
  if (!GetParam().weighted) options.trust.cauchy_scale = 0;
  options.max_iterations = options.min_iterations = 6;
  options.uncertainty_samples = 0;
  const std::vector<int64_t> targets = hwy::SupportedAndGeneratedTargets();
  ASSERT_GE(targets.size(), 1U);
  const RefineResult first = refined_on(targets.front(), options);
  for (const int64_t target : targets) {
    const RefineResult other = refined_on(target, options);
    EXPECT_LT(rms_difference_mm(first, other), 1e-3) << hwy::TargetName(target);
  }
}

INSTANTIATE_TEST_SUITE_P(FarAndNear, InstructionSets,
                         testing::Values(Kind{LampModel::far, true}, Kind{LampModel::far, false},
                                         Kind{LampModel::near, true}, Kind{LampModel::near, false}));

TEST(Solvers, MultigridAndExactComeToTheSameSurface) {
  RefineOptions options;
  options.uncertainty_samples = 0;
  const RefineResult fast = refine_depth(test::bump_stack(), options, {});
  options.depth.solver = Solver::exact;
  const RefineResult exact = refine_depth(test::bump_stack(), options, {});
  EXPECT_LT(rms_difference_mm(fast, exact), 0.005);
  double angle = 0;
  int count = 0;
  for (int v = 0; v < fast.normals.rows; ++v) {
    for (int u = 0; u < fast.normals.cols; ++u) {
      const cv::Vec3f a = fast.normals(v, u), b = exact.normals(v, u);
      if (std::isnan(a[0])) continue;
      angle += std::asin(std::min(1.0, cv::norm(a.cross(b)))) * 180 / CV_PI;
      ++count;
    }
  }
  EXPECT_LT(angle / count, 0.05);
}

}  // namespace
}  // namespace rakelight
