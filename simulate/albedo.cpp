// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/albedo.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulate/counter_random.h"

namespace rakelight {
namespace {

using Color = Eigen::Vector3d;
using Point = Eigen::Vector2d;

enum Stream : std::uint64_t { kNoise = 101, kRegion, kBloom, kLeaf };

std::uint64_t cell_index(std::int64_t x, std::int64_t y) {
  return (static_cast<std::uint64_t>(x) & 0xFFFFFFFFULL) << 32 |
         (static_cast<std::uint64_t>(y) & 0xFFFFFFFFULL);
}

double smooth_step(double low, double high, double x) {
  const double u = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

/// Value noise in [0, 1] with a cell size of 1.
double value_noise(const CounterRandom& random, const Point& p) {
  const auto x = static_cast<std::int64_t>(std::floor(p.x())),
             y = static_cast<std::int64_t>(std::floor(p.y()));
  const double u = smooth_step(0, 1, p.x() - static_cast<double>(x));
  const double v = smooth_step(0, 1, p.y() - static_cast<double>(y));
  const auto corner = [&](std::int64_t dx, std::int64_t dy) {
    return random.uniform(cell_index(x + dx, y + dy));
  };
  return (corner(0, 0) * (1 - u) + corner(1, 0) * u) * (1 - v) +
         (corner(0, 1) * (1 - u) + corner(1, 1) * u) * v;
}

/// Two octaves of value noise a component, in [-1, 1].
Point warp(const CounterRandom& random, const Point& p) {
  const auto component = [&](double shift) {
    const Point q = p + Point(shift, 1.7 * shift);
    return (2 * value_noise(random, q) + value_noise(random, 2.1 * q) - 1.5) / 1.5;
  };
  return {component(0), component(31.4)};
}

/// Displacement, integer cell and centre of a jittered lattice's nearest site.
struct Site {
  Point offset;  ///< from the site to the point
  std::uint64_t cell = 0;
  double distance = 1e9;
};

Site nearest_site(const CounterRandom& random, const Point& p, double jitter) {
  Site best;
  const auto x = static_cast<std::int64_t>(std::floor(p.x())),
             y = static_cast<std::int64_t>(std::floor(p.y()));
  for (std::int64_t cy = y - 1; cy <= y + 1; ++cy) {
    for (std::int64_t cx = x - 1; cx <= x + 1; ++cx) {
      const std::uint64_t cell = cell_index(cx, cy);
      const Point site(static_cast<double>(cx) + 0.5 + jitter * (random.uniform(8 * cell) - 0.5),
                       static_cast<double>(cy) + 0.5 + jitter * (random.uniform(8 * cell + 1) - 0.5));
      const double distance = (p - site).norm();
      if (distance < best.distance) best = {p - site, cell, distance};
    }
  }
  return best;
}

template <std::size_t N>
const Color& pick(const std::array<Color, N>& palette, double uniform) {
  return palette[std::min(N - 1, static_cast<std::size_t>(uniform * static_cast<double>(N)))];
}

Color simple(const Point& p, std::uint64_t seed) {
  static const std::array<Color, 4> kPalette{Color(0.78, 0.70, 0.56), Color(0.62, 0.22, 0.16),
                                             Color(0.18, 0.34, 0.50), Color(0.70, 0.52, 0.20)};
  const Point q = p + 0.18 * warp(CounterRandom(seed, kNoise), 1.6 * p);
  const CounterRandom random(seed, kRegion);
  return pick(kPalette, random.uniform(8 * nearest_site(random, 1.6 * q, 0.9).cell + 2));
}

Color pattern(const Point& p, std::uint64_t seed) {
  static const std::array<Color, 3> kStripes{Color(0.80, 0.74, 0.60), Color(0.68, 0.20, 0.14),
                                             Color(0.17, 0.18, 0.44)};
  const CounterRandom random(seed, kNoise);
  const Point q = p + 0.02 * warp(random, 3 * p);
  const double diagonal = (q.x() + q.y()) / 0.13;
  Color color =
      kStripes[static_cast<std::size_t>(static_cast<std::int64_t>(std::floor(diagonal)) % 3 + 3) % 3];
  const auto check = static_cast<std::int64_t>(std::floor(q.x() / 0.085) + std::floor(q.y() / 0.085));
  if (check % 2 != 0) color *= 0.72;
  const Point in_cell(std::remainder(q.x(), 0.26), std::remainder(q.y() - 0.06, 0.26));
  if (in_cell.norm() < 0.052) color = Color(0.16, 0.58, 0.36);
  return color;
}

/// A flower of `petals` petals with an eye, radius 1: returns false outside it.
bool flower(const Point& at, double petals, double turn, const Color& petal, const Color& eye, Color& color) {
  const double r = at.norm();
  const double angle = std::atan2(at.y(), at.x()) + turn;
  const double wave = std::abs(std::cos(0.5 * petals * angle));
  if (r > 0.55 + 0.45 * wave) return false;
  if (r < 0.26) {
    color = eye;
  } else {
    const double vein = 0.82 + 0.18 * std::cos(5 * petals * angle);
    color = petal * (0.55 + 0.45 * smooth_step(0.15, 0.7, r)) * vein *
            (0.45 + 0.55 * smooth_step(0.0, 0.35, wave));
  }
  return true;
}

/// Leaves: warped almond shapes on a dark ground.
Color foliage(const Point& p, std::uint64_t seed) {
  const CounterRandom random(seed, kLeaf);
  const Site site = nearest_site(random, p / 0.075, 0.9);
  const double turn = 2 * M_PI * random.uniform(8 * site.cell + 2);
  const Point local(std::cos(turn) * site.offset.x() + std::sin(turn) * site.offset.y(),
                    -std::sin(turn) * site.offset.x() + std::cos(turn) * site.offset.y());
  const double half = 0.30 * (1 - local.x() * local.x() / 0.4);
  if (std::abs(local.y()) > half) return {0.13, 0.15, 0.24};
  static const std::array<Color, 4> kLeaves{Color(0.20, 0.46, 0.20), Color(0.42, 0.56, 0.18),
                                            Color(0.14, 0.36, 0.32), Color(0.55, 0.50, 0.22)};
  const double rib =
      std::abs(local.y()) < 0.04 ? 1.5 : 0.85 + 0.15 * std::cos(40 * (local.x() + std::abs(local.y())));
  return pick(kLeaves, random.uniform(8 * site.cell + 3)) * rib;
}

Color complicated(const Point& p, std::uint64_t seed) {
  static const std::array<Color, 6> kPetals{Color(0.86, 0.30, 0.34), Color(0.88, 0.80, 0.72),
                                            Color(0.85, 0.58, 0.16), Color(0.46, 0.28, 0.66),
                                            Color(0.30, 0.50, 0.84), Color(0.84, 0.44, 0.66)};
  static const std::array<Color, 2> kEyes{Color(0.88, 0.74, 0.22), Color(0.36, 0.16, 0.12)};
  const CounterRandom noise(seed, kNoise), random(seed, kBloom);
  const Point q = p + 0.012 * warp(noise, 9 * p);
  Color color = foliage(q, seed);
  for (const double size : {0.085, 0.16}) {  // small blossoms under large ones
    const Site site = nearest_site(random, (q + Point(size, 3 * size)) / size, 0.75);
    if (random.uniform(8 * site.cell + 7) < 0.3) continue;
    const double petals = 5 + std::floor(4 * random.uniform(8 * site.cell + 2));
    const double radius = 0.36 + 0.14 * random.uniform(8 * site.cell + 3);
    flower(site.offset / radius, petals, 6.28 * random.uniform(8 * site.cell + 4),
           pick(kPetals, random.uniform(8 * site.cell + 5)), pick(kEyes, random.uniform(8 * site.cell + 6)),
           color);
  }
  return color * (0.80 + 0.4 * value_noise(noise, 90 * p));  // grain of the glaze
}

}  // namespace

Eigen::Vector3f albedo_at(AlbedoKind kind, const Eigen::Vector2f& texture, std::uint64_t seed) {
  const Point p = texture.cast<double>();
  const Color color = kind == AlbedoKind::simple    ? simple(p, seed)
                      : kind == AlbedoKind::pattern ? pattern(p, seed)
                                                    : complicated(p, seed);
  return color.cwiseMax(0.08).cwiseMin(0.92).cast<float>();
}

}  // namespace rakelight
