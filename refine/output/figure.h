// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Figures for print: maps with a colour bar, and histograms. White, 1800 pixels wide (15 cm at 300 dots an inch).
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace rakelight {

/// What colours mean.
struct ColorBar {
  std::string label;  ///< with its unit
  double low = 0, high = 1;
  cv::Mat3b colors;  ///< one row from low to high, R G B
};

/// One map of a figure.
struct MapPanel {
  std::string title;
  cv::Mat3b picture;    ///< R G B
  double pixel_mm = 0;  ///< what a pixel spans on the object, for the length bar
};

/// Maps side by side under a title, a bar of length under each, one colour bar for all at the foot.
cv::Mat3b map_figure(const std::string& title, const std::vector<MapPanel>& panels, const ColorBar& bar);

/// One distribution of a figure.
struct HistogramSeries {
  std::string name;
  std::vector<double> values;
};

/// Step curves of the share of values a bin in [low, high]; what lies beyond is said in the legend.
/// @param label of the values, with their unit
cv::Mat3b histogram_figure(const std::string& title, const std::string& label,
                           const std::vector<HistogramSeries>& series, double low, double high);

}  // namespace rakelight
