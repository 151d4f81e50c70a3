// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The proof by picture that a lamp was on: the light of the top, middle and bottom rows, less the dark, against what the
// lamp has shown before. A lamp that was switched within the frame leaves top and bottom different.
#pragma once

#include <array>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "stack/stack.h"

namespace rakelight {

/// Mean linear RGB of three bands of rows (top, middle, bottom), each in a few pieces from left to right.
struct Signature {
  static constexpr int kPieces = 8;
  std::array<std::array<cv::Vec3f, kPieces>, 3> bands{};
};

/// Which rows the bands take: first rows, the same number of rows each.
struct SignatureBands {
  std::array<int, 3> first_row{};
  int rows = 1;
};

/// Bands where the object is: the first, middle and last rows whose greatest light over all `lit` images, less `dark`, is a
/// fair share of the brightest row's.
SignatureBands find_bands(const std::vector<cv::Mat>& lit, const cv::Mat& dark,
                          const ColorResponse& response);

Signature signature_of(const cv::Mat& color, const SignatureBands& bands, const ColorResponse& response);

/// What every light looks like in this scene, with its own dark level.
class LitSignatures {
 public:
  LitSignatures() = default;
  LitSignatures(SignatureBands bands, ColorResponse response, const cv::Mat& dark);
  /// From what text() gave. @param height of the images  @throws std::exception if it is not whole
  static LitSignatures parse(const std::string& text, const ColorResponse& response, int height);
  std::string text() const;  ///< JSON

  bool empty() const { return bands_.rows == 0; }
  void learn(const std::string& light, const cv::Mat& color);
  /// Whether a picture shows this light (an empty id: the dark) and nothing else.
  LitCheck check(const std::string& light, const cv::Mat& color) const;
  /// The learnt light that a picture is most like; empty: the dark.
  std::string nearest(const cv::Mat& color) const;

 private:
  Signature less_dark(const cv::Mat& color) const;
  float typical_level() const;

  SignatureBands bands_{{0, 0, 0}, 0};
  ColorResponse response_;
  Signature dark_;
  std::map<std::string, Signature> lit_;  ///< less the dark
};

}  // namespace rakelight
