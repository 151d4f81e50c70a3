// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_channel.h"

#include <algorithm>

namespace rakelight {
namespace {

constexpr Eigen::Index kShared = NearLampUnknowns::kShared;

/// Numbers of the unknowns of channel c: 5 of each image, then the shared ones.
std::vector<Eigen::Index> channel_unknowns(const NearLampUnknowns& at, int c) {
  std::vector<Eigen::Index> numbers;
  for (size_t i = 0; i < at.lamps.size(); ++i) {
    const Eigen::Index k = at.lamp_at(static_cast<Eigen::Index>(i));
    numbers.insert(numbers.end(), {k, k + 1, k + 2, k + 3 + c, k + 6 + c});
  }
  for (int k = 0; k < kShared; ++k) numbers.push_back(at.aim_at() + k);
  return numbers;
}

}  // namespace

ChannelEquations::ChannelEquations(Eigen::Index pixels, Eigen::Index images)
    : A_(Eigen::MatrixXd::Zero(kOwnUnknowns * images + kShared, kOwnUnknowns * images + kShared)),
      b_(Eigen::VectorXd::Zero(A_.rows())),
      q_(Eigen::MatrixXd::Zero(pixels, A_.rows())) {}

void ChannelEquations::add_image(Eigen::Index i, const Eigen::ArrayXd& w, const Eigen::ArrayXd& r,
                                 const Eigen::ArrayXd& q_factor, const SampleDerivatives& J) {
  const SampleDerivatives wJ = w.matrix().asDiagonal() * J;
  const Eigen::Matrix<double, kSampleUnknowns, kSampleUnknowns> JJ = wJ.transpose() * J;
  const Eigen::Matrix<double, kSampleUnknowns, 1> Jr = wJ.transpose() * r.matrix();
  const Eigen::Index own = kOwnUnknowns * i, shared = A_.rows() - kShared;
  A_.block<kOwnUnknowns, kOwnUnknowns>(own, own) += JJ.topLeftCorner<kOwnUnknowns, kOwnUnknowns>();
  A_.block<kShared, kOwnUnknowns>(shared, own) += JJ.bottomLeftCorner<kShared, kOwnUnknowns>();
  A_.bottomRightCorner<kShared, kShared>() += JJ.bottomRightCorner<kShared, kShared>();
  b_.segment<kOwnUnknowns>(own) += Jr.head<kOwnUnknowns>();
  b_.tail<kShared>() += Jr.tail<kShared>();
  q_.middleCols<kOwnUnknowns>(own) += q_factor.matrix().asDiagonal() * J.leftCols<kOwnUnknowns>();
  q_.rightCols<kShared>() += q_factor.matrix().asDiagonal() * J.rightCols<kShared>();
}

void ChannelEquations::add_to(const NearLampUnknowns& at, int c, NearLampEquations& total) {
  const std::vector<Eigen::Index> number = channel_unknowns(at, c);
  A_.selfadjointView<Eigen::Lower>().rankUpdate(q_.transpose(), -1);
  for (Eigen::Index j = 0; j < A_.rows(); ++j) {
    const Eigen::Index row = number[static_cast<size_t>(j)];
    total.b[row] += b_[j];
    for (Eigen::Index k = 0; k < A_.cols(); ++k)
      total.A(row, number[static_cast<size_t>(k)]) += A_(std::max(j, k), std::min(j, k));
  }
}

}  // namespace rakelight
