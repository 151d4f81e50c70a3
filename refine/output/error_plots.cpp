// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/error_plots.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "refine/output/error_map.h"
#include "refine/output/figure.h"
#include "refine/output/pictures.h"
#include "stack/atomic_folder.h"
#include "stack/image_file.h"

namespace rakelight {
namespace {

const cv::Vec3b kPaper(205, 205, 205);  ///< around the object: neither a small error nor the page

const FolderKind& plots_kind() {
  static const FolderKind kind{"folder of error plots",
                               "depth_error.png",
                               {"normal_error.png", "depth_histogram.png", "normal_histogram.png"}};
  return kind;
}

std::vector<double> finite_values(const cv::Mat1f& map) {
  std::vector<double> values;
  for (const float value : map) {
    if (std::isfinite(value)) values.push_back(static_cast<double>(value));
  }
  return values;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

double root_mean_square(std::vector<double> values) {
  for (double& value : values) value *= value;
  return std::sqrt(mean_of(values));
}

std::string captioned(const char* name, const char* measure, double value, const char* unit) {
  char text[96];
  std::snprintf(text, sizeof text, "%s: %s %.3g%s", name, measure, value, unit);
  return text;
}

/// What a pixel spans at the object's mean distance.
double pixel_mm(const ErrorMaps& maps) { return 1e3 * maps.mean_depth_m / maps.camera.fx; }

cv::Mat3b on_paper(cv::Mat3b picture, const cv::Mat1f& errors) {
  picture.setTo(kPaper, cv::Mat(errors == errors) == 0);  // OpenCV finds NaN != NaN false
  return picture(object_box(errors)).clone();
}

/// Viridis of [0, range].
cv::Mat3b angle_colors(const cv::Mat1f& degrees, double range) {
  cv::Mat levels, colors;
  degrees.convertTo(levels, CV_8U, 255 / range);
  cv::applyColorMap(levels, colors, cv::COLORMAP_VIRIDIS);
  cv::cvtColor(colors, colors, cv::COLOR_BGR2RGB);
  return colors;
}

/// 512 values from low to high, as one row.
cv::Mat1f ramp(double low, double high) {
  cv::Mat1f row(1, 512);
  for (int x = 0; x < row.cols; ++x) row(x) = static_cast<float>(low + (high - low) * x / (row.cols - 1));
  return row;
}

/// The two states with their captions.
struct Compared {
  const ErrorMaps &before, &after;
  std::string before_words, after_words;
};

cv::Mat3b depth_figure(const Compared& c) {
  const double range = round_range(c.before.depth_mm, 0.9);
  const auto panel = [range](const ErrorMaps& maps, const std::string& words) {
    return MapPanel{words, on_paper(error_colors(maps.depth_mm, range), maps.depth_mm), pixel_mm(maps)};
  };
  return map_figure(
      "Depth error", {panel(c.before, c.before_words), panel(c.after, c.after_words)},
      {"depth minus truth, mm (red: too far)", -range, range, error_colors(ramp(-range, range), range)});
}

cv::Mat3b normal_figure(const Compared& c) {
  const double range = round_range(c.before.normal_deg, 0.9);
  const auto panel = [range](const ErrorMaps& maps, const std::string& words) {
    return MapPanel{words, on_paper(angle_colors(maps.normal_deg, range), maps.normal_deg), pixel_mm(maps)};
  };
  return map_figure("Angular error of the normals",
                    {panel(c.before, c.before_words), panel(c.after, c.after_words)},
                    {"angle to the true normal, degrees", 0, range, angle_colors(ramp(0, range), range)});
}

}  // namespace

void write_error_plots(const ErrorMaps& before, const ErrorMaps& after, const std::filesystem::path& folder) {
  AtomicFolder out(folder, plots_kind());
  const std::vector<double> depth_before = finite_values(before.depth_mm),
                            depth_after = finite_values(after.depth_mm);
  const std::vector<double> angle_before = finite_values(before.normal_deg),
                            angle_after = finite_values(after.normal_deg);
  const Compared depth{before, after, captioned("sensor", "RMSE", root_mean_square(depth_before), " mm"),
                       captioned("refined", "RMSE", root_mean_square(depth_after), " mm")};
  const Compared normals{before, after, captioned("sensor", "mean", mean_of(angle_before), "\u00b0"),
                         captioned("refined", "mean", mean_of(angle_after), "\u00b0")};
  write_png(out.path() / "depth_error.png", depth_figure(depth));
  write_png(out.path() / "normal_error.png", normal_figure(normals));
  const double depth_range = round_range(before.depth_mm, 0.98),
               angle_range = round_range(before.normal_deg, 0.98);
  write_png(out.path() / "depth_histogram.png",
            histogram_figure("Depth error", "depth minus truth, mm",
                             {{depth.before_words, depth_before}, {depth.after_words, depth_after}},
                             -depth_range, depth_range));
  write_png(out.path() / "normal_histogram.png",
            histogram_figure("Angular error of the normals", "angle to the true normal, degrees",
                             {{normals.before_words, angle_before}, {normals.after_words, angle_after}}, 0,
                             angle_range));
  out.commit();
}

}  // namespace rakelight
