// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Energy and normal equations of the joint lamp fit (refine/steps/near_lamps.h), region by region of the picture.
#pragma once

#include <vector>

#include "refine/observations.h"
#include "refine/steps/broad_shape.h"
#include "refine/steps/near_lamp_unknowns.h"
#include "refine/surface_state.h"

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

class NearLampProblem {
 public:
  static constexpr int kRegions = 12;

  /// @param shape nullptr: the surface is held  @param pixels about so many are used, evenly spread
  NearLampProblem(const Observations& images, const BroadShape* shape, const SurfaceState& state, int pixels);

  /// What the images and the sensor's depth leave unexplained.
  double energy(const NearLampUnknowns& at) const;

  /// One a region of the picture: their errors have little to do with each other.
  std::vector<NearLampEquations> equations(const NearLampUnknowns& at) const;

  /// What is known of a rig beforehand, against errors of variance `variance`: little ambient light, and axes that meet
  /// in the object. It decides only where the images do not.
  NearLampEquations prior(const NearLampUnknowns& at, double variance) const;

 private:
  struct ChannelSums;

  double pixel_energy(const NearLampUnknowns& at, const BroadPixel& pixel) const;
  void add_pixel(const NearLampUnknowns& at, const BroadPixel& pixel, std::vector<ChannelSums>& sums,
                 NearLampEquations& total) const;
  NearLampEquations region_equations(const NearLampUnknowns& at, const std::vector<BroadPixel>& pixels) const;
  double weight(int image, int c, int p) const;

  const Observations& images_;
  const SurfaceState& state_;
  std::vector<std::vector<BroadPixel>> regions_;
  Eigen::Vector3f aim_;  ///< where the axes are expected to meet: the middle of the surface
};

}  // namespace rakelight
