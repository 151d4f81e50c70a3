// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All images' terms at a pixel are one quadratic form of its unit normal, whatever the number of images:
//
//     e(n) = n' G n - 2 h' n + e0,   G = sum w rho^2 l l',  h = sum w rho l (I - rho phi),  e0 = sum w (I - rho phi)^2
//
// so the images are read once, and the depth step works on ten numbers a pixel.
//
// That is with the albedo held. Where it follows the normal instead (variable projection: rho = sum w S I / sum w S^2 is put in,
// and the derivative taken through it, Kaufman's way), turning the normal by d costs less by what a new albedo takes up:
//
//     e(n + d) -= d' K d,   K = sum_c rho^2 (sum w S l)(sum w S l)' / sum w S^2
//
// Held, albedo and shape each wait for the other, and creep: iterations that take a turn for the albedo's change.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "refine/cache_lines.h"
#include "refine/observations.h"
#include "refine/surface_state.h"

namespace rakelight {

/// Quadratic form e(n) of one pixel.
struct PhotometricTensor {
  Eigen::Matrix3f G = Eigen::Matrix3f::Zero();
  Eigen::Vector3f h = Eigen::Vector3f::Zero();
  float e0 = 0;

  float energy(const Eigen::Vector3f& n) const { return n.dot(G * n) - 2.0f * h.dot(n) + e0; }
};

enum class AlbedoRole { held, follows_normal };

/// The forms of all pixels, planar.
class PhotometricTensors {
 public:
  enum Part : size_t { xx, xy, xz, yy, yz, zz, hx, hy, hz, e0, kParts };

  explicit PhotometricTensors(size_t pixels = 0);

  size_t size() const { return pixels_; }
  PhotometricTensor operator[](size_t pixel) const;
  void set(size_t pixel, const PhotometricTensor& tensor);

  /// One number of G, h or e0 at every pixel. Whole vectors may be read from any pixel on (they are padded).
  float* part(Part which) { return parts_.data() + which * stride_; }
  const float* part(Part which) const { return parts_.data() + which * stride_; }

 private:
  size_t pixels_, stride_;
  CacheLineVector<float> parts_;
};

/// Tensors of all pixels under the state's weights. Samples on the far side of a lamp (l.n <= 0) count in e0 only.
PhotometricTensors accumulate_tensors(const Observations& images, const SurfaceState& state);

/// The albedo (refine/steps/albedo.h), which the state keeps, and the tensors under it, in one read of the images.
/// @param tensors of as many pixels
void find_albedo_and_accumulate(const Observations& images, AlbedoRole role, SurfaceState& state,
                                PhotometricTensors& tensors);

/// The tensors under new Cauchy weights (refine/steps/robust_weights.h), which the state keeps: both in one read of the images.
/// r^2 of a weight is the mean over the sample's usable channels; the weight is 0 where none is.
/// @param scale k sigma of the weights, linear radiance  @param tensors of as many pixels
void reweigh_and_accumulate(const Observations& images, double scale, AlbedoRole role, SurfaceState& state,
                            PhotometricTensors& tensors);

}  // namespace rakelight
