// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Energy and normal equations of the joint lamp fit (refine/steps/near_lamps.h), region by region of the picture.
#pragma once

#include <vector>

#include "refine/steps/near_lamp_samples.h"
#include "refine/steps/near_lamp_unknowns.h"

namespace rakelight {

/// A step s solves A s = b: -2 b is the energy's gradient, 2 A its curvature (Gauss-Newton).
struct NearLampEquations {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  double energy = 0;
  double samples = 0;  ///< believed samples less the albedos taken from them

  explicit NearLampEquations(Eigen::Index size)
      : A(Eigen::MatrixXd::Zero(size, size)), b(Eigen::VectorXd::Zero(size)) {}
  NearLampEquations& operator+=(const NearLampEquations& other);
};

/// What the images and the sensor's depth leave unexplained in all regions.
double near_lamp_energy(const std::vector<LampRegion>& regions, const NearLampUnknowns& at);

/// One a region of the picture: their errors have little to do with each other.
std::vector<NearLampEquations> near_lamp_equations(const std::vector<LampRegion>& regions,
                                                   const NearLampUnknowns& at);

}  // namespace rakelight
