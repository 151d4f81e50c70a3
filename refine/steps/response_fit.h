// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How well images that are decoded with some colour response agree with the lighting model, whatever the shape.
//
// With first-order lamps, I_ic(p) = rho_c(p) (l_ic . n(p) + phi_ic): over the images, a pixel has rank 4. A wrong response
// bends the rows and the rank rises. Normals are free here (started from the sensor's depth), so that the sensor's errors do
// not drown that; lamps vary linearly over the picture, as near lamps do to first order. Errors are judged as raw colour
// values, where they are the same for every candidate: in decoded ones the strongest compression would win.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "refine/problem.h"
#include "stack/stack.h"

namespace rakelight {

/// A sub-sample of the grid's pixels, and which of their samples every candidate is judged by.
struct ResponseSamples {
  PixelGrid grid;                  ///< the sub-sample: no pixel has neighbours
  Eigen::Matrix3Xd normals;        ///< [pixel] of the smoothed sensor depth
  Eigen::Matrix3Xd offset;         ///< [pixel] of the surface point from the centre of the object, metres
  Eigen::Matrix3d crosstalk;       ///< of the stack
  Observations raw;                ///< colour values in [0, 1] as they are: not decoded, nothing subtracted
  std::vector<unsigned char> use;  ///< as Observations::radiance: neither clipped nor in shadow
};

/// @param problem of the same stack. At most some `pixels` pixels, spread evenly.
/// @param shadow samples below this share of their pixel's largest raw value are taken for shadows
ResponseSamples response_samples(const LightStack& stack, const RefineProblem& problem, int pixels,
                                 double shadow);

/// The samples if colour values mean some response. Crosstalk and ambient light are undone after decoding.
struct DecodedSamples {
  std::vector<float> light;   ///< [image][channel][pixel] linear radiance
  std::vector<double> slope;  ///< as light: d radiance / d value
};
DecodedSamples decode_samples(const LightStack& stack, const ResponseSamples& samples,
                              const ColorResponse& response);

enum class ResponseLamps { far, near };

/// Negative log likelihood a sample (Cauchy errors of raw values) of the best model. Lower is better; what counts are
/// differences between candidates on the same samples and images.
/// @param images numbers of the images to use, at least 4
double response_misfit(const ResponseSamples& samples, const DecodedSamples& decoded,
                       const std::vector<int>& images, ResponseLamps lamps);

}  // namespace rakelight
