// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "refine/steps/near_lamp_equations.h"
#include "refine/steps/near_lamp_shading.h"

namespace rakelight {

/// Normal equations of one colour channel, whose samples depend on 5 unknowns of their own lamp and on the shared ones; the
/// albedo is eliminated.
class ChannelEquations {
 public:
  ChannelEquations(Eigen::Index pixels, Eigen::Index images);

  /// @param w weight, r = I - rho S - H and J = d (rho S + H) of image i's samples, a row a pixel
  /// @param q_factor w S / sqrt(sum_i w S^2)
  void add_image(Eigen::Index i, const Eigen::ArrayXd& w, const Eigen::ArrayXd& r,
                 const Eigen::ArrayXd& q_factor, const SampleDerivatives& J);

  /// Adds all to the equations of the fit. Once, and last. @param c the channel
  void add_to(const NearLampUnknowns& at, int c, NearLampEquations& total);

 private:
  Eigen::MatrixXd A_;  ///< sum w J J', lower half; unknowns: 5 of each image, then the shared ones
  Eigen::VectorXd b_;  ///< sum w r J
  Eigen::MatrixXd
      q_;  ///< [pixel, unknown] sum_i w S J / sqrt(sum_i w S^2): what the albedo takes away is q'q
};

}  // namespace rakelight
