// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "refine/output/canvas.h"

namespace rakelight {
namespace {

constexpr int kWidth = 1800, kMargin = 50, kGap = 50;
constexpr double kTitleSize = 40, kTextSize = 32;
const cv::Vec3d kBlack(0, 0, 0), kGrid(0.85, 0.85, 0.85);
const std::vector<cv::Vec3d> kSeriesColors{{0.8, 0.33, 0.0}, {0.0, 0.35, 0.7}, {0.0, 0.5, 0.35}};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", std::abs(value) < 1e-12 ? 0.0 : value);
  return text;
}

/// The largest of 1, 2, 5 times a power of ten that is at most `limit`.
double round_below(double limit) {
  const double decade = std::pow(10, std::floor(std::log10(limit)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= limit * (1 + 1e-9)) return step * decade;
  }
  return decade;
}

/// About `count` round numbers in [low, high].
std::vector<double> ticks(double low, double high, int count) {
  const double step = round_below((high - low) / count * 1.001);
  std::vector<double> values;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    values.push_back(k * step);
  return values;
}

void draw_length_bar(Canvas& canvas, const cv::Rect2d& box, double pixel_mm, double zoom) {
  const double length_mm = round_below(box.width * 0.3 / zoom * pixel_mm),
               length = length_mm / pixel_mm * zoom;
  const double y = box.br().y + 28;
  canvas.line({{box.x, y}, {box.x + length, y}}, kBlack, 6);
  canvas.text(number(length_mm) + " mm", {box.x + length + 14, y + 11}, kTextSize);
}

void draw_color_bar(Canvas& canvas, const cv::Rect2d& box, const ColorBar& bar) {
  canvas.picture(bar.colors, box);
  canvas.line({box.tl(), {box.br().x, box.y}, box.br(), {box.x, box.br().y}, box.tl()}, kBlack, 2);
  for (const double value : ticks(bar.low, bar.high, 6)) {
    const double x = box.x + box.width * (value - bar.low) / (bar.high - bar.low);
    canvas.line({{x, box.br().y}, {x, box.br().y + 10}}, kBlack, 2);
    canvas.text(number(value), {x, box.br().y + 44}, kTextSize, Align::middle);
  }
  canvas.text(bar.label, {box.x + box.width / 2, box.br().y + 90}, kTextSize, Align::middle);
}

/// The area of a diagram and what its values mean.
struct Axes {
  cv::Rect2d box;
  double low, high, top;

  cv::Point2d at(double x, double y) const {
    return {box.x + box.width * (x - low) / (high - low), box.br().y - box.height * y / top};
  }
};

void draw_axes(Canvas& canvas, const Axes& axes, const std::string& label) {
  for (const double y : ticks(0, axes.top, 5)) {
    canvas.line({axes.at(axes.low, y), axes.at(axes.high, y)}, kGrid, 2);
    canvas.text(number(y), axes.at(axes.low, y) + cv::Point2d(-14, 11), kTextSize, Align::right);
  }
  for (const double x : ticks(axes.low, axes.high, 8)) {
    canvas.line({axes.at(x, 0), axes.at(x, 0) + cv::Point2d(0, 12)}, kBlack, 2);
    canvas.text(number(x), axes.at(x, 0) + cv::Point2d(0, 50), kTextSize, Align::middle);
  }
  canvas.line({axes.at(axes.low, axes.top), axes.at(axes.low, 0), axes.at(axes.high, 0)}, kBlack, 3);
  canvas.text(label, axes.at((axes.low + axes.high) / 2, 0) + cv::Point2d(0, 105), kTextSize, Align::middle);
  canvas.text("% of the pixels a bin", {axes.box.x, axes.box.y - 16}, kTextSize);
}

constexpr int kBins = 60;

struct Histogram {
  std::vector<double> percent = std::vector<double>(kBins, 0.0);
  double beyond = 0;  ///< per cent
};

Histogram histogram_of(const std::vector<double>& values, double low, double high) {
  Histogram histogram;
  const double share = 100.0 / static_cast<double>(std::max<std::size_t>(1, values.size()));
  for (const double value : values) {
    const double bin = std::floor((value - low) / (high - low) * kBins);
    if (bin >= 0 && bin < kBins)
      histogram.percent[static_cast<std::size_t>(bin)] += share;
    else
      histogram.beyond += share;
  }
  return histogram;
}

std::vector<cv::Point2d> steps(const Histogram& histogram, const Axes& axes) {
  std::vector<cv::Point2d> points{axes.at(axes.low, 0)};
  for (std::size_t k = 0; k < kBins; ++k) {
    const double width = (axes.high - axes.low) / kBins, x = axes.low + static_cast<double>(k) * width;
    points.push_back(axes.at(x, histogram.percent[k]));
    points.push_back(axes.at(x + width, histogram.percent[k]));
  }
  points.push_back(axes.at(axes.high, 0));
  return points;
}

}  // namespace

cv::Mat3b map_figure(const std::string& title, const std::vector<MapPanel>& panels, const ColorBar& bar) {
  constexpr double kPanelTop = 170, kFoot = 260, kTallest = 1100;
  const auto count = static_cast<double>(panels.size());
  const double column = (kWidth - 2 * kMargin - (count - 1) * kGap) / count;
  double tallest = 1;
  for (const MapPanel& panel : panels)
    tallest = std::max(tallest, std::min(kTallest, column * panel.picture.rows / panel.picture.cols));
  Canvas canvas({kWidth, static_cast<int>(kPanelTop + tallest + kFoot)});
  canvas.text(title, {kWidth / 2.0, 70}, kTitleSize, Align::middle);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const cv::Mat3b& picture = panels[k].picture;
    const double zoom = std::min(column / picture.cols, tallest / picture.rows);
    const double middle = kMargin + column / 2 + static_cast<double>(k) * (column + kGap);
    const cv::Rect2d box(middle - picture.cols * zoom / 2, kPanelTop, picture.cols * zoom,
                         picture.rows * zoom);
    canvas.text(panels[k].title, {middle, kPanelTop - 22}, kTextSize, Align::middle);
    canvas.picture(picture, box);
    draw_length_bar(canvas, box, panels[k].pixel_mm, zoom);
  }
  draw_color_bar(canvas, {kWidth * 0.25, kPanelTop + tallest + 80, kWidth * 0.5, 40}, bar);
  return canvas.pixels();
}

cv::Mat3b histogram_figure(const std::string& title, const std::string& label,
                           const std::vector<HistogramSeries>& series, double low, double high) {
  Canvas canvas({kWidth, 1150});
  canvas.text(title, {kWidth / 2.0, 70}, kTitleSize, Align::middle);
  std::vector<Histogram> histograms;
  Axes axes{{130, 160, kWidth - 130 - 60, 840}, low, high, 1e-3};
  for (const HistogramSeries& each : series) {
    histograms.push_back(histogram_of(each.values, low, high));
    const std::vector<double>& percent = histograms.back().percent;
    axes.top = std::max(axes.top, 1.05 * *std::max_element(percent.begin(), percent.end()));
  }
  draw_axes(canvas, axes, label);
  for (std::size_t k = 0; k < series.size(); ++k) {
    const cv::Vec3d& color = kSeriesColors[k % kSeriesColors.size()];
    canvas.area(steps(histograms[k], axes), color, 0.25);
    canvas.line(steps(histograms[k], axes), color, 4);
    const std::string words = series[k].name + "; beyond: " + number(histograms[k].beyond) + " %";
    const double y = axes.box.y + 40 + 50 * static_cast<double>(k);
    const double x = axes.box.br().x - canvas.width_of(words, kTextSize);
    canvas.line({{x - 70, y - 11}, {x - 16, y - 11}}, color, 10);
    canvas.text(words, {x, y}, kTextSize);
  }
  return canvas.pixels();
}

}  // namespace rakelight
