// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers to colours, with the scale bar that goes with them.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace rakelight {

enum class ColorScale {
  sequential,  ///< viridis: from low to high, even in lightness
  signed_,     ///< blue (minus), white (0), red (plus): signed_color() of refine
};

/// What a scale bar shows.
struct ColorRange {
  ColorScale scale = ColorScale::sequential;
  double low = 0, high = 1;
  std::string quantity;  ///< e.g. "refined - sensor"
  std::string unit;      ///< e.g. "mm"
};

/// The colour of a value, R G B; values beyond the ends take the ends' colours, NaN is grey.
cv::Vec3b color_of(const ColorRange& range, double value);

/// The smallest of 1, 2, 5 times a power of ten that is at least `value`; 1 if that is no positive number.
double round_up(double value);

/// Range from -r to +r with r = round_up() of the values' 95th percentile of size, NaN left out.
ColorRange signed_range(const std::vector<float>& values, const std::string& quantity,
                        const std::string& unit);

/// Range over all values but the outer two in a hundred, NaN left out.
ColorRange sequential_range(const std::vector<float>& values, const std::string& quantity,
                            const std::string& unit);

/// Round values inside the range for the bar's marks, ascending; 3 to 7 of them.
std::vector<double> ticks(const ColorRange& range);

}  // namespace rakelight
