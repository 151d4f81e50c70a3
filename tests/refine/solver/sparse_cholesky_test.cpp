// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/sparse_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <utility>

namespace rakelight {
namespace {

Eigen::MatrixXd random_definite(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Eigen::MatrixXd B = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return uniform(random); });
  return B * B.transpose() + Eigen::MatrixXd::Identity(size, size);
}

SparseCholesky::Matrix lower_of(const Eigen::MatrixXd& A) {
  SparseCholesky::Matrix lower = Eigen::MatrixXd(A.triangularView<Eigen::Lower>()).sparseView();
  lower.makeCompressed();
  return lower;
}

TEST(SparseCholesky, SolvesAsADenseSolverDoes) {
  const Eigen::MatrixXd A = random_definite(12, 1);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(12, -1, 2);
  SparseCholesky cholesky;
  ASSERT_TRUE(cholesky.factorize(lower_of(A)));
  EXPECT_TRUE(cholesky.solve(b).isApprox(A.ldlt().solve(b), 1e-10));
}

TEST(SparseCholesky, TakesANewMatrixOfTheSamePatternAndOneOfAnotherSize) {
  SparseCholesky cholesky;
  for (const int size : {12, 12, 7, 20}) {
    const Eigen::MatrixXd A = random_definite(size, static_cast<unsigned>(size));
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(size, 1, 3);
    ASSERT_TRUE(cholesky.factorize(lower_of(A)));
    EXPECT_TRUE(cholesky.solve(b).isApprox(A.ldlt().solve(b), 1e-10));
  }
}

TEST(SparseCholesky, SaysWhenTheMatrixIsNotPositiveDefiniteAndRecovers) {
  Eigen::MatrixXd A = random_definite(8, 3);
  SparseCholesky cholesky;
  const double diagonal = std::exchange(A(4, 4), -1.0);
  EXPECT_FALSE(cholesky.factorize(lower_of(A)));
  EXPECT_EQ(cholesky.reciprocal_condition(), 0);
  A(4, 4) = diagonal;
  EXPECT_TRUE(cholesky.factorize(lower_of(A)));
}

TEST(SparseCholesky, TheReciprocalConditionTellsGoodFromBad) {
  SparseCholesky cholesky;
  ASSERT_TRUE(cholesky.factorize(lower_of(Eigen::MatrixXd::Identity(5, 5))));
  EXPECT_NEAR(cholesky.reciprocal_condition(), 1, 1e-12);
  Eigen::MatrixXd bad = Eigen::MatrixXd::Identity(5, 5);
  bad(2, 2) = 1e-12;
  ASSERT_TRUE(cholesky.factorize(lower_of(bad)));
  EXPECT_LT(cholesky.reciprocal_condition(), 1e-10);
}

}  // namespace
}  // namespace rakelight
