// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "simulate/objects/objects.h"
#include "simulate/objects/parametric_grid.h"

namespace rakelight {
namespace {

constexpr int kMapSize = 2048;                   // the relief is drawn at this size, then laid on the disc
constexpr double kUnit = 0.5 * kMapSize / 1.02;  // pixels of the map per coin radius
constexpr double kFaceRadius = 0.985;            // beyond lies the rounded edge

cv::Point2d map_point(double x, double y) { return {kMapSize / 2.0 + kUnit * x, kMapSize / 2.0 + kUnit * y}; }

std::vector<cv::Point> polygon(const std::vector<cv::Point2d>& points) {
  std::vector<cv::Point> result;
  for (const auto& p : points) result.push_back(map_point(p.x, p.y));
  return result;
}

/// Closed smooth curve through points: a Catmull-Rom spline.
std::vector<cv::Point2d> smooth_curve(const std::vector<cv::Point2d>& knots) {
  constexpr int kSteps = 12;
  std::vector<cv::Point2d> curve;
  const std::size_t n = knots.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto a = knots[(k + n - 1) % n], b = knots[k], c = knots[(k + 1) % n], d = knots[(k + 2) % n];
    for (int step = 0; step < kSteps; ++step) {
      const double u = static_cast<double>(step) / kSteps;
      curve.push_back(0.5 * (2 * b + (c - a) * u + (2 * a - 5 * b + 4 * c - d) * (u * u) +
                             (3 * b - a - 3 * c + d) * (u * u * u)));
    }
  }
  return curve;
}

/// A shape swollen like a pillow: 0 at its outline, 1 from `width` (coin radii) inwards, round between.
cv::Mat1f swollen(const cv::Mat1b& shape, double width) {
  cv::Mat1f distance;
  cv::distanceTransform(shape, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  for (float& value : distance) {
    const double u = 1 - std::min(1.0, static_cast<double>(value) / (width * kUnit));
    value = static_cast<float>(std::sqrt(1 - u * u));
  }
  return distance;
}

cv::Mat1b filled(const std::vector<cv::Point2d>& knots) {
  cv::Mat1b shape(kMapSize, kMapSize, std::uint8_t{0});
  cv::fillPoly(shape, std::vector<std::vector<cv::Point>>{polygon(smooth_curve(knots))}, 255);
  return shape;
}

/// A rounded stroke along a curve. Works on the rectangle around it only.
void add_stroke(cv::Mat1f& relief, const std::vector<cv::Point2d>& points, double width, double height) {
  std::vector<cv::Point> line = polygon(points);
  const int thickness = std::max(1, static_cast<int>(2 * width * kUnit));
  cv::Rect box = cv::boundingRect(line);
  box -= cv::Point(thickness, thickness);
  box += cv::Size(2 * thickness, 2 * thickness);
  cv::Mat1b shape(box.size(), std::uint8_t{0});
  for (cv::Point& p : line) p -= box.tl();
  cv::polylines(shape, std::vector<std::vector<cv::Point>>{line}, false, 255, thickness);
  cv::Mat1f part = relief(box);
  cv::scaleAdd(swollen(shape, width), height, part, part);
}

/// A smooth hill (or hollow) about a point.
void add_hill(cv::Mat1f& relief, const cv::Point2d& center, double rx, double ry, double height) {
  const cv::Point2d at = map_point(center.x, center.y);
  const double reach_x = 3.5 * rx * kUnit, reach_y = 3.5 * ry * kUnit;
  for (int v = static_cast<int>(at.y - reach_y); v <= at.y + reach_y; ++v) {
    for (int u = static_cast<int>(at.x - reach_x); u <= at.x + reach_x; ++u) {
      const double dx = (u - at.x) / (rx * kUnit), dy = (v - at.y) / (ry * kUnit);
      relief(v, u) += static_cast<float>(height * std::exp(-dx * dx - dy * dy));
    }
  }
}

/// The head's outline from the hairline over brow, nose, lips, chin and neck, round the back of the head.
const std::vector<cv::Point2d> kHead{
    {-0.235, -0.36}, {-0.275, -0.25}, {-0.285, -0.17}, {-0.272, -0.125}, {-0.30, -0.06}, {-0.352, 0.02},
    {-0.355, 0.045}, {-0.32, 0.062},  {-0.29, 0.075},  {-0.285, 0.105},  {-0.312, 0.13}, {-0.308, 0.152},
    {-0.285, 0.168}, {-0.302, 0.192}, {-0.292, 0.218}, {-0.268, 0.24},   {-0.272, 0.29}, {-0.235, 0.335},
    {-0.16, 0.34},   {-0.085, 0.32},  {-0.055, 0.36},  {-0.06, 0.47},    {-0.13, 0.58},  {0.02, 0.615},
    {0.20, 0.57},    {0.27, 0.50},    {0.20, 0.38},    {0.19, 0.26},     {0.27, 0.14},   {0.33, -0.02},
    {0.335, -0.20},  {0.27, -0.36},   {0.14, -0.46},   {-0.02, -0.485},  {-0.16, -0.445}};

/// The part of the head that is hair.
const std::vector<cv::Point2d> kHair{
    {-0.245, -0.35}, {-0.20, -0.27}, {-0.10, -0.235}, {0.00, -0.17},  {0.03, -0.07},  {0.025, 0.00},
    {0.10, 0.06},    {0.13, 0.15},   {0.16, 0.26},    {0.235, 0.22},  {0.30, 0.12},   {0.35, -0.02},
    {0.355, -0.20},  {0.285, -0.37}, {0.15, -0.475},  {-0.02, -0.50}, {-0.165, -0.46}};

/// Wavy locks that run back from the brow.
void add_hair(cv::Mat1f& relief) {
  const cv::Mat1f volume = swollen(filled(kHair), 0.07);
  for (int v = 0; v < kMapSize; ++v) {
    for (int u = 0; u < kMapSize; ++u) {
      if (volume(v, u) <= 0) continue;
      const double x = (u - kMapSize / 2.0) / kUnit, y = (v - kMapSize / 2.0) / kUnit;
      const double dx = x - 0.02, dy = y + 0.02;
      const double radius = std::hypot(dx, dy), angle = std::atan2(dy, dx);
      const double phase = 46 * radius + 1.6 * std::sin(7 * angle) + 0.9 * std::sin(13 * angle + 20 * radius);
      const double lock = 0.5 + 0.5 * std::cos(phase);
      relief(v, u) += volume(v, u) * static_cast<float>(0.020 + 0.020 * std::sqrt(lock));
    }
  }
}

void add_laurel(cv::Mat1f& relief) {
  for (int k = 0; k < 9; ++k) {  // leaves along an arc over the hair
    const double angle = -2.75 + 0.235 * k;
    const cv::Point2d at(0.02 + 0.335 * std::cos(angle), -0.06 + 0.335 * std::sin(angle));
    for (const double side : {-0.55, 0.55}) {
      const double turn = angle - M_PI / 2 + side;
      add_stroke(relief, {at, at + 0.085 * cv::Point2d(std::cos(turn), std::sin(turn))}, 0.017, 0.018);
    }
  }
}

void add_head(cv::Mat1f& relief) {
  cv::scaleAdd(swollen(filled(kHead), 0.20), 0.085, relief, relief);
  add_hair(relief);
  add_laurel(relief);
  add_hill(relief, {-0.225, -0.075}, 0.045, 0.028, -0.018);                                  // eye socket
  add_stroke(relief, {{-0.265, -0.12}, {-0.215, -0.135}, {-0.15, -0.115}}, 0.014, 0.012);    // brow
  add_stroke(relief, {{-0.258, -0.075}, {-0.225, -0.092}, {-0.175, -0.07}}, 0.007, 0.010);   // upper lid
  add_stroke(relief, {{-0.252, -0.062}, {-0.222, -0.052}, {-0.180, -0.066}}, 0.005, 0.007);  // lower lid
  add_hill(relief, {-0.228, -0.070}, 0.017, 0.015, 0.014);                                   // eyeball
  add_hill(relief, {-0.285, 0.045}, 0.022, 0.018, 0.014);                                 // wing of the nose
  add_hill(relief, {-0.165, 0.06}, 0.075, 0.065, 0.014);                                  // cheek
  add_stroke(relief, {{-0.300, 0.165}, {-0.26, 0.166}, {-0.215, 0.178}}, 0.006, -0.012);  // mouth
  add_hill(relief, {-0.20, 0.275}, 0.06, 0.05, 0.010);                                    // jaw
  add_stroke(
      relief,
      {{0.035, 0.10}, {0.01, 0.04}, {0.03, -0.03}, {0.08, -0.045}, {0.10, 0.00}, {0.065, 0.05}, {0.05, 0.10}},
      0.014, 0.022);  // ear
}

/// A letter, upright on its own square and turned by `angle` (clockwise, radians).
cv::Mat1b letter(const std::string& text, double angle) {
  constexpr int kBox = 240, kThickness = 15;
  constexpr double kSize = 4.4;
  int baseline = 0;
  const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_COMPLEX, kSize, kThickness, &baseline);
  cv::Mat1b upright(kBox, kBox, std::uint8_t{0});
  cv::putText(upright, text, {(kBox - size.width) / 2, (kBox + size.height) / 2}, cv::FONT_HERSHEY_COMPLEX,
              kSize, 255, kThickness, cv::LINE_8);
  const cv::Mat turn = cv::getRotationMatrix2D({kBox / 2.0f, kBox / 2.0f}, -angle * 180 / M_PI, 1.0);
  cv::Mat1b turned;
  cv::warpAffine(upright, turned, turn, upright.size(), cv::INTER_LINEAR);
  cv::threshold(turned, turned, 127, 255, cv::THRESH_BINARY);
  return turned;
}

/// Words around the face.
void add_lettering(cv::Mat1f& relief, const std::string& text, double start_deg, double step_deg) {
  constexpr double kRadius = 0.735;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const double angle = (start_deg + step_deg * static_cast<double>(k)) * M_PI / 180;
    const cv::Mat1b shape = letter(std::string(1, text[k]), angle);
    const cv::Point2d at = map_point(kRadius * std::sin(angle), -kRadius * std::cos(angle));
    cv::Mat1f part = relief(cv::Rect(
        {static_cast<int>(at.x) - shape.cols / 2, static_cast<int>(at.y) - shape.rows / 2}, shape.size()));
    cv::scaleAdd(swollen(shape, 0.012), 0.030, part, part);
  }
}

void add_beads(cv::Mat1f& relief) {
  constexpr int kBeads = 96;
  for (int k = 0; k < kBeads; ++k) {
    const double angle = 2 * M_PI * k / kBeads;
    const cv::Point2d at = map_point(0.895 * std::cos(angle), 0.895 * std::sin(angle));
    const double radius = 0.021 * kUnit;
    for (int v = static_cast<int>(at.y - radius); v <= at.y + radius; ++v) {
      for (int u = static_cast<int>(at.x - radius); u <= at.x + radius; ++u) {
        const double r2 = (std::pow(u - at.x, 2) + std::pow(v - at.y, 2)) / (radius * radius);
        if (r2 < 1) relief(v, u) += static_cast<float>(0.024 * std::sqrt(1 - r2));
      }
    }
  }
}

/// A raised rim, and a field that is slightly hollow.
double rim(double radius) {
  const double u = (radius - 0.955) / 0.034;
  return (std::abs(u) < 1.0 ? 0.055 * std::pow(1 - u * u * u * u, 0.5) : 0.0) + 0.03 * radius * radius;
}

cv::Mat1f draw_relief() {
  cv::Mat1f relief(kMapSize, kMapSize, 0.0f);
  add_head(relief);
  add_lettering(relief, "RAKELIGHT", -152, 15);
  add_lettering(relief, "LVX ET FORMA", 18, 13);
  add_beads(relief);
  cv::GaussianBlur(relief, relief, {0, 0}, 4.0);
  return relief;
}

double lookup(const cv::Mat1f& map, double x, double y) {
  const cv::Point2d at = map_point(x, y);
  const int u = std::clamp(static_cast<int>(at.x), 0, map.cols - 2),
            v = std::clamp(static_cast<int>(at.y), 0, map.rows - 2);
  const double a = at.x - u, b = at.y - v;
  const auto value = [&map](int row, int column) { return static_cast<double>(map(row, column)); };
  return (value(v, u) * (1 - a) + value(v, u + 1) * a) * (1 - b) +
         (value(v + 1, u) * (1 - a) + value(v + 1, u + 1) * a) * b;
}

/// The reeded edge: from the face's border round to the back.
SurfacePoint edge_point(double angle, double turn) {
  constexpr double kThickness = 0.07;
  const double radius = kFaceRadius + 0.015 * std::sin(turn * M_PI / 2) * (1 + 0.15 * std::cos(150 * angle));
  const double z = -rim(kFaceRadius) + kThickness * turn;
  return {{radius * std::cos(angle), radius * std::sin(angle), z},
          {radius * std::cos(angle), radius * std::sin(angle)}};
}

}  // namespace

SceneMesh make_coin(int detail) {
  const cv::Mat1f relief = draw_relief();
  const GridShape shape{4 * detail, 3 * detail / 2, true};
  constexpr double kFaceShare = 0.96;  // of the rows; the rest is the edge
  SceneMesh mesh = parametric_grid(shape, [&](double s, double t) {
    const double angle = 2 * M_PI * s;
    if (t > kFaceShare) return edge_point(angle, (t - kFaceShare) / (1 - kFaceShare));
    const double radius = kFaceRadius * t / kFaceShare;
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    return SurfacePoint{{x, y, -rim(radius) - lookup(relief, x, y)}, {x, y}};
  });
  return mesh;
}

}  // namespace rakelight
