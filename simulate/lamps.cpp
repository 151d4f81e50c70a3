// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/lamps.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "simulate/counter_random.h"

namespace rakelight {
namespace {

enum Stream : std::uint64_t { kStrength = 201, kDistance, kSway, kRgb };

/// Unit vector from the object to the lamp: `polar` from the axis to the camera, `azimuth` about it.
Eigen::Vector3d toward_lamp(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), -std::cos(polar)};
}

/// Two rings, taken in turn, a quarter inside and outside of the mean angle.
Eigen::Vector3d ring_direction(const RigOptions& options, int k, int count) {
  const double angle = options.angle_deg * M_PI / 180;
  return toward_lamp(angle * (k % 2 == 0 ? 1.2 : 0.8), 2 * M_PI * (k + 0.3) / count);
}

/// A smooth function of x in [0, 1] with values in about [-1, 1]: a few harmonics of random phase.
double wander(const CounterRandom& random, std::uint64_t channel, double x) {
  double sum = 0;
  for (std::uint64_t h = 1; h <= 3; ++h) {
    sum += std::sin(2 * M_PI * (static_cast<double>(h) * x + random.uniform(8 * channel + h))) /
           static_cast<double>(h);
  }
  return sum / 1.6;
}

/// A hand that goes around the object once and a bit, unevenly.
Eigen::Vector3d swayed_direction(const RigOptions& options, std::uint64_t seed, int k, int count) {
  const CounterRandom random(seed, kSway);
  const double x = static_cast<double>(k) / count;
  const double angle = options.angle_deg * M_PI / 180;
  const double polar = angle * (1 + 0.45 * wander(random, 1, x));
  return toward_lamp(polar, 2 * M_PI * (1.15 * x + random.uniform(0)) + 0.5 * wander(random, 2, x));
}

double lamp_distance(const RigOptions& options, std::uint64_t seed, int k, int count) {
  const CounterRandom random(seed, kDistance);
  const double swing = options.layout == LampLayout::swayed
                           ? wander(random, 3, static_cast<double>(k) / count)
                           : random.uniform(static_cast<std::uint64_t>(k), -1, 1);
  return options.distance_m * (1 + options.distance_spread * swing);
}

LampTruth make_lamp(const SimulateOptions& options, const std::string& id, LampColor color,
                    const Eigen::Vector3d& direction, double distance, const Eigen::Vector3d& strength) {
  LampTruth lamp;
  lamp.id = id;
  lamp.color = color;
  lamp.near = options.lamps.near;
  lamp.direction = direction;
  lamp.strength = strength;
  if (lamp.near) lamp.position_m = Eigen::Vector3d(0, 0, options.scene.distance_m) + distance * direction;
  return lamp;
}

}  // namespace

LampSet white_lamp(const SimulateOptions& options, int k) {
  const RigOptions& rig = options.lamps;
  const Eigen::Vector3d direction = rig.layout == LampLayout::ring
                                        ? ring_direction(rig, k, rig.count)
                                        : swayed_direction(rig, options.seed, k, rig.count);
  const CounterRandom random(options.seed, kStrength);
  const auto index = static_cast<std::uint64_t>(k);
  const double level = 1 + random.uniform(4 * index, -rig.strength_spread, rig.strength_spread);
  const double warmth = random.uniform(4 * index + 1, -0.3, 0.3) * rig.strength_spread;
  char id[32];
  std::snprintf(id, sizeof id, "white-%02d", k);
  LampSet set;
  set.light = {id, LampColor::white, {}, {}};
  set.lamps.push_back(make_lamp(options, id, LampColor::white, direction,
                                lamp_distance(rig, options.seed, k, rig.count),
                                level * Eigen::Vector3d(1 + warmth, 1, 1 - warmth)));
  if (rig.near && rig.write_positions) set.light.position_m = set.lamps.front().position_m;
  return set;
}

LampTruth channel_lamp(const SimulateOptions& options, int channel, int k, int count) {
  const RigOptions& rig = options.lamps;
  constexpr LampColor kColors[]{LampColor::red, LampColor::green, LampColor::blue};
  const LampColor color = kColors[channel];
  const double start = 2 * M_PI * CounterRandom(options.seed, kRgb).uniform(0);
  const double azimuth = start + 2 * M_PI * (channel + 3 * k) / (3 * count);
  return make_lamp(options, to_string(color), color, toward_lamp(rig.angle_deg * M_PI / 180, azimuth),
                   rig.distance_m, Eigen::Vector3d::Unit(channel));
}

namespace {

/// Red, green and blue lamps a third of a turn apart, each alone in its channel.
LampSet rgb_lamps(const SimulateOptions& options) {
  LampSet set;
  set.light = {"rgb", LampColor::rgb, {}, {}};
  for (int c = 0; c < 3; ++c) {
    set.lamps.push_back(channel_lamp(options, c, 0, 1));
    set.lamps.back().id = "rgb";
  }
  return set;
}

}  // namespace

std::vector<LampSet> make_lamp_sets(const SimulateOptions& options) {
  std::vector<LampSet> sets;
  if (options.lamps.dark_frame) sets.emplace_back();
  if (options.lamps.rgb) sets.push_back(rgb_lamps(options));
  for (int k = 0; k < options.lamps.count; ++k) sets.push_back(white_lamp(options, k));
  return sets;
}

Incident incident_light(const LampTruth& lamp, const Eigen::Vector3f& object_center,
                        const Eigen::Vector3f& point) {
  const Eigen::Vector3f strength = lamp.strength.cast<float>();
  if (!lamp.near) return {lamp.direction.cast<float>(), strength, std::numeric_limits<float>::infinity()};
  const Eigen::Vector3f position = lamp.position_m->cast<float>();
  const Eigen::Vector3f to_lamp = position - point;
  const float distance = to_lamp.norm();
  const Eigen::Vector3f direction = to_lamp / distance;
  const float axis_distance = (position - object_center).norm();
  const float lobe = std::max(0.0f, direction.dot(position - object_center) / axis_distance);
  const float falloff = axis_distance / distance;
  return {direction, strength * (lobe * falloff * falloff), distance};
}

}  // namespace rakelight
