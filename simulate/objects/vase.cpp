// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "simulate/objects/objects.h"
#include "simulate/objects/parametric_grid.h"

namespace rakelight {
namespace {

/// Outline (radius, y) from the foot's centre up the outside, over the lip and down the inside.
constexpr std::array<std::array<double, 2>, 22> kOutline{{
    {0.00, 1.00},   {0.20, 1.00},   {0.335, 0.995}, {0.36, 0.965},  {0.33, 0.92},   {0.275, 0.87},
    {0.29, 0.81},   {0.40, 0.68},   {0.53, 0.48},   {0.615, 0.24},  {0.625, 0.00},  {0.555, -0.22},
    {0.415, -0.41}, {0.29, -0.55},  {0.235, -0.68}, {0.235, -0.80}, {0.275, -0.91}, {0.355, -0.985},
    {0.365, -1.00}, {0.335, -0.99}, {0.24, -0.88},  {0.20, -0.70},
}};

constexpr int kLast = static_cast<int>(kOutline.size()) - 1;

/// Catmull-Rom spline through the outline, t in [0, 1].
Eigen::Vector2d outline_at(double t) {
  const double x = t * kLast;
  const int k = std::min(static_cast<int>(x), kLast - 1);
  const double u = x - k;
  const auto knot = [](int i) {
    const auto& p = kOutline[static_cast<std::size_t>(std::clamp(i, 0, kLast))];
    return Eigen::Vector2d(p[0], p[1]);
  };
  const Eigen::Vector2d a = knot(k - 1), b = knot(k), c = knot(k + 1), d = knot(k + 2);
  return 0.5 *
         (2 * b + (c - a) * u + (2 * a - 5 * b + 4 * c - d) * u * u + (3 * b - a - 3 * c + d) * u * u * u);
}

/// 0 below `low`, 1 above `high`, smooth between.
double ramp(double low, double high, double x) {
  const double u = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

/// 1 within [low, high], falling to 0 over `soft` on both sides.
double window(double low, double high, double soft, double x) {
  return ramp(low - soft, low, x) * (1 - ramp(high, high + soft, x));
}

/// A rounded moulding at y.
double bead(double center, double half_width, double y) {
  const double u = (y - center) / half_width;
  return std::abs(u) < 1 ? std::sqrt(1 - u * u) : 0.0;
}

/// A rosette of eight petals about (0, 0), radius 1; height 0 to 1.
double rosette(double x, double y) {
  const double r = std::hypot(x, y);
  const double petals = std::abs(std::cos(4 * std::atan2(y, x)));
  const double rim = 0.62 + 0.34 * petals;
  const double petal = ramp(0.0, 0.22, rim - r) * (0.45 + 0.55 * petals) * ramp(0.18, 0.4, r);
  const double button = std::sqrt(std::max(0.0, 1 - (r / 0.27) * (r / 0.27)));
  return std::max(0.8 * petal, button);
}

/// An upright leaf with a midrib and veins about (0, 0), half height 1; height 0 to 1.
double leaf(double x, double y) {
  if (std::abs(y) >= 1) return 0;
  const double half = 0.42 * std::pow(1 - y * y, 0.8) * (1 + 0.25 * y);
  const double inside = ramp(0.0, 0.16, half - std::abs(x));
  const double veins = 0.75 + 0.25 * std::cos(16 * (y + 0.9 * std::abs(x)));
  const double midrib = 1 - 0.55 * std::exp(-std::pow(x / 0.045, 2));
  return inside * veins * midrib;
}

/// The embossed band: rosettes and leaves in turn around the belly.
double band(double angle, double y) {
  constexpr double kCenter = 0.10, kHalf = 0.185;
  constexpr int kMotifs = 18;
  const double turn = angle / (2 * M_PI) * kMotifs;
  const double cell = std::floor(turn + 0.5);
  const double x = (turn - cell) * 2 * M_PI / kMotifs * 0.62 / kHalf;
  const double v = (y - kCenter) / kHalf;
  const bool flower = static_cast<long>(cell) % 2 == 0;
  return flower ? rosette(x / 0.86, v / 0.86) : leaf(x, v / 0.92);
}

/// Relief outwards from the turned body, in object units.
double relief(double angle, double y) {
  double height = 0.030 * band(angle, y) * window(-0.09, 0.29, 0.02, y);
  for (const double edge : {-0.125, 0.325}) height += 0.022 * bead(edge, 0.022, y);
  height += 0.022 * std::abs(std::sin(14 * angle)) * window(0.40, 0.66, 0.06, y);  // gadroons
  height += 0.010 * std::cos(26 * angle + 9 * y) * window(-0.50, -0.24, 0.05, y);  // twisted flutes
  for (const double ring : {-0.60, -0.66, -0.72}) height += 0.014 * bead(ring, 0.024, y);
  return height;
}

}  // namespace

SceneMesh make_vase(int detail) {
  const GridShape shape{2 * detail, 5 * detail / 2, true};
  return parametric_grid(shape, [](double s, double t) {
    const double angle = 2 * M_PI * s;
    const Eigen::Vector2d p = outline_at(t);
    const bool outside = t < 0.84;
    const double radius = std::max(0.0, p.x()) + (outside ? relief(angle, p.y()) : 0.0);
    // s = 0 and the seam lie at the back; texture is unrolled at the belly's radius.
    return SurfacePoint{{radius * std::sin(angle + M_PI), p.y(), -radius * std::cos(angle + M_PI)},
                        {0.62 * (angle - M_PI), p.y()}};
  });
}

}  // namespace rakelight
