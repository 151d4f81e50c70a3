// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "refine/steps/near_lamp_equations.h"
#include "refine/steps/near_lamp_model.h"

namespace rakelight {

/// Normal equations of one colour channel in one region, whose samples depend on 5 unknowns of their own lamp and on the
/// shared ones; the albedo is eliminated.
class ChannelEquations {
 public:
  ChannelEquations(const NearLampUnknowns& at, const LampRegion& region, const RegionModel& model,
                   int channel);

  /// Adds near lamp i.
  void add_lamp(size_t i, const ShadingDerivatives& derivatives);

  /// Adds all to the equations of the fit. Once, and last.
  void add_to(NearLampEquations& total);

 private:
  void set_rows(size_t i, const ShadingDerivatives& derivatives);
  void add_products(Eigen::Index own);

  const NearLampUnknowns& at_;
  const LampRegion& region_;
  const RegionModel& model_;
  int channel_;
  Eigen::MatrixXd A_;            ///< sum w J J', lower half; unknowns: 5 of each image, then the shared ones
  Eigen::VectorXd b_;            ///< sum w r J
  Eigen::ArrayXXf J_;            ///< of the image at hand: sqrt(w) J, sqrt(w) r
  Eigen::ArrayXXf q_;            ///< sum_i w S J / sqrt(sum_i w S^2): what the albedo takes away is q'q
  Eigen::ArrayXf inverse_root_;  ///< 1 / sqrt(sum_i w S^2), 0 where no albedo is known
};

}  // namespace rakelight
