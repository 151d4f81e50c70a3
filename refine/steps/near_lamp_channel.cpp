// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_channel.h"

#include <algorithm>

#include "refine/kernels/gram.h"

namespace rakelight {
namespace {

constexpr Eigen::Index kShared = NearLampUnknowns::kShared, kGloss = NearLampUnknowns::kGloss,
                       kMoving = kShared - kGloss;   // aim and shape
constexpr Eigen::Index kResidual = kSampleUnknowns;  // column of J_

Eigen::Index whole_blocks(Eigen::Index columns) {
  constexpr Eigen::Index kBlock = kernels::kGramRuns;
  return (columns + kBlock - 1) / kBlock * kBlock;
}

/// Products of all pairs of columns; the lower half is sure.
Eigen::MatrixXf products(const Eigen::ArrayXXf& columns) {
  Eigen::MatrixXf result(columns.cols(), columns.cols());
  kernels::gram(columns.data(), columns.rows(), static_cast<int>(columns.cols()),
                static_cast<int>(columns.rows()), result.data());
  return result;
}

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

ChannelEquations::ChannelEquations(const NearLampUnknowns& at, const LampRegion& region,
                                   const RegionModel& model, int channel)
    : at_(at), region_(region), model_(model), channel_(channel) {
  const Eigen::Index rows = region.samples->rows(),
                     unknowns = kOwnUnknowns * static_cast<Eigen::Index>(at.lamps.size()) + kShared;
  A_ = Eigen::MatrixXd::Zero(unknowns, unknowns);
  b_ = Eigen::VectorXd::Zero(unknowns);
  J_ = Eigen::ArrayXXf::Zero(rows, whole_blocks(kSampleUnknowns + 1));
  q_ = Eigen::ArrayXXf::Zero(rows, whole_blocks(unknowns));
  inverse_root_ = (model.rho.col(channel) > 0.0f).select(model.SS.col(channel).rsqrt(), 0.0f);
}

void ChannelEquations::set_rows(size_t i, const ShadingDerivatives& by) {
  const Eigen::Index column = sample_column(i, channel_);
  const float e = at_.lamps[i].strength[channel_];
  const auto rho = model_.rho.col(channel_);
  const Eigen::ArrayXf root = (rho > 0.0f).select(region_.w.col(column).sqrt(), 0.0f);
  const Eigen::ArrayXf lit = root * rho, moving = e * lit;
  const auto lobes = region_.lobes.middleCols<kGloss>(kGloss * static_cast<Eigen::Index>(i));
  for (Eigen::Index k = 0; k < 3; ++k) J_.col(k) = moving * by.col(kByPlace + k);
  J_.col(3) = lit * by.col(kValue) + root * (lobes.matrix() * at_.gloss.cast<float>()).array();
  J_.col(4) = lit;
  for (Eigen::Index k = 0; k < kMoving; ++k) J_.col(kOwnUnknowns + k) = moving * by.col(kByShared + k);
  for (Eigen::Index k = 0; k < kGloss; ++k) J_.col(kOwnUnknowns + kMoving + k) = e * root * lobes.col(k);
  J_.col(kResidual) = root * model_.residual(column);

  const Eigen::ArrayXf share = root * model_.S.col(column) * inverse_root_;
  for (Eigen::Index k = 0; k < kOwnUnknowns; ++k)
    q_.col(kOwnUnknowns * static_cast<Eigen::Index>(i) + k) = share * J_.col(k);
  for (Eigen::Index k = 0; k < kShared; ++k)
    q_.col(b_.size() - kShared + k) += share * J_.col(kOwnUnknowns + k);
}

void ChannelEquations::add_products(Eigen::Index own) {
  const Eigen::MatrixXd JJ = products(J_).cast<double>();
  const Eigen::Index shared = b_.size() - kShared;
  A_.block<kOwnUnknowns, kOwnUnknowns>(own, own) += JJ.topLeftCorner<kOwnUnknowns, kOwnUnknowns>();
  A_.block<kShared, kOwnUnknowns>(shared, own) += JJ.block<kShared, kOwnUnknowns>(kOwnUnknowns, 0);
  A_.bottomRightCorner<kShared, kShared>() += JJ.block<kShared, kShared>(kOwnUnknowns, kOwnUnknowns);
  const Eigen::RowVectorXd Jr = JJ.row(kResidual);
  b_.segment<kOwnUnknowns>(own) += Jr.head<kOwnUnknowns>().transpose();
  b_.tail<kShared>() += Jr.segment<kShared>(kOwnUnknowns).transpose();
}

void ChannelEquations::add_lamp(size_t i, const ShadingDerivatives& derivatives) {
  set_rows(i, derivatives);
  add_products(kOwnUnknowns * static_cast<Eigen::Index>(i));
}

void ChannelEquations::add_to(NearLampEquations& total) {
  A_ -= products(q_).topLeftCorner(A_.rows(), A_.cols()).cast<double>();
  const std::vector<Eigen::Index> number = channel_unknowns(at_, channel_);
  for (Eigen::Index j = 0; j < A_.rows(); ++j) {
    const Eigen::Index row = number[static_cast<size_t>(j)];
    total.b[row] += b_[j];
    for (Eigen::Index k = 0; k < A_.cols(); ++k)
      total.A(row, number[static_cast<size_t>(k)]) += A_(std::max(j, k), std::min(j, k));
  }
}

}  // namespace rakelight
