// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/objects/cloth.h"

#include <cmath>

#include "simulate/counter_random.h"

namespace rakelight {
namespace {

constexpr float kBallRadius = 0.62f;

/// Keeps two nodes at their distance.
struct Link {
  std::size_t a, b;
  float length, stiffness;
};

class Cloth {
 public:
  explicit Cloth(const ClothOptions& options) : options_(options) {
    lay_flat();
    add_links();
  }

  void step() {
    constexpr float kGravity = 0.0011f, kDamping = 0.985f;
    for (std::size_t k = 0; k < now_.size(); ++k) {
      const Eigen::Vector3f velocity = kDamping * (now_[k] - before_[k]);
      before_[k] = now_[k];
      now_[k] += velocity + Eigen::Vector3f(0, kGravity, 0);
    }
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) {
      for (const Link& link : links_) satisfy(link);
    }
    for (std::size_t k = 0; k < now_.size(); ++k) rest_on_ball(k);
  }

  std::vector<Eigen::Vector3f> nodes() && { return std::move(now_); }

 private:
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row * options_.nodes + column);
  }

  /// Above the ball, turned and off centre so that no two folds are alike, with a breath of unevenness.
  void lay_flat() {
    const CounterRandom random(7, 1);
    constexpr double kTurn = 0.62;
    for (int row = 0; row < options_.nodes; ++row) {
      for (int column = 0; column < options_.nodes; ++column) {
        const Eigen::Vector2d p = flat_point(options_, static_cast<double>(column) / (options_.nodes - 1),
                                             static_cast<double>(row) / (options_.nodes - 1)) +
                                  Eigen::Vector2d(0.03, -0.04);
        const double uneven = 0.01 * random.normal(at(column, row));
        now_.push_back(Eigen::Vector3d(std::cos(kTurn) * p.x() - std::sin(kTurn) * p.y(), -0.66 + uneven,
                                       std::sin(kTurn) * p.x() + std::cos(kTurn) * p.y())
                           .cast<float>());
      }
    }
    before_ = now_;
  }

  void add_links() {
    struct Step {
      int columns, rows;
      double stiffness;
    };
    const double bend = options_.bend_stiffness;
    for (const Step& s : {Step{1, 0, 1}, {0, 1, 1}, {1, 1, 0.5}, {-1, 1, 0.5}, {2, 0, bend}, {0, 2, bend}}) {
      for (int row = 0; row + s.rows < options_.nodes; ++row) {
        for (int column = 0; column < options_.nodes; ++column) {
          const int other = column + s.columns;
          if (other < 0 || other >= options_.nodes) continue;
          const std::size_t from = at(column, row), to = at(other, row + s.rows);
          const float length =
              Eigen::Vector2f(now_[to].x() - now_[from].x(), now_[to].z() - now_[from].z()).norm();
          links_.push_back({from, to, length, static_cast<float>(s.stiffness)});
        }
      }
    }
  }

  void satisfy(const Link& link) {
    const Eigen::Vector3f apart = now_[link.b] - now_[link.a];
    const float length = apart.norm();
    if (length <= 0) return;
    const Eigen::Vector3f move = apart * (0.5f * link.stiffness * (length - link.length) / length);
    now_[link.a] += move;
    now_[link.b] -= move;
  }

  /// Contact with friction: what touches the ball slides little.
  void rest_on_ball(std::size_t k) {
    constexpr float kGrip = 0.97f;
    const float radius = now_[k].norm();
    if (radius >= kBallRadius || radius <= 0) return;
    now_[k] *= kBallRadius / radius;
    before_[k] += kGrip * (now_[k] - before_[k]);
  }

  ClothOptions options_;
  std::vector<Eigen::Vector3f> now_, before_;
  std::vector<Link> links_;
};

}  // namespace

Eigen::Vector2d flat_point(const ClothOptions& options, double s, double t) {
  const double x = 2 * s - 1, y = 2 * t - 1;  // the elliptical map of the square to the disc
  return options.radius * Eigen::Vector2d(x * std::sqrt(1 - y * y / 2), y * std::sqrt(1 - x * x / 2));
}

std::vector<Eigen::Vector3f> fallen_cloth(const ClothOptions& options) {
  Cloth cloth(options);
  for (int step = 0; step < options.steps; ++step) cloth.step();
  return std::move(cloth).nodes();
}

}  // namespace rakelight
