// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/clock_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace rakelight {
namespace {

constexpr std::size_t kWindow = 900;                   // arrivals remembered: 30 s at 30 fps
constexpr std::int64_t kSpanForDrift_us = 10'000'000;  // below it jitter would pass for drift
constexpr double kLargestDrift = 5e-4;                 // quartz is within 1e-4
constexpr std::int64_t kWrap_us = 71'582'788;          // 2^32 / 60 MHz
constexpr std::int64_t kWrapTolerance_us = 500'000;
constexpr std::int64_t kResetJump_us = 1'000'000;  // no delivery is that uneven

struct Point {
  double x, y;
};

double cross(const Point& o, const Point& a, const Point& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Lower convex hull of points in order of x (Andrew's monotone chain).
std::vector<Point> lower_hull(const std::vector<Point>& points) {
  std::vector<Point> hull;
  for (const Point& p : points) {
    while (hull.size() >= 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
    hull.push_back(p);
  }
  return hull;
}

/// Slope of the hull's edge over x: of all lines below the points it has the least sum of distances if x is their mean.
double slope_over(const std::vector<Point>& hull, double x) {
  for (std::size_t i = 1; i < hull.size(); ++i) {
    if (hull[i].x >= x) return (hull[i].y - hull[i - 1].y) / (hull[i].x - hull[i - 1].x);
  }
  return 0;
}

}  // namespace

std::int64_t ClockFit::continuous(std::int64_t device_us, std::int64_t host_us) {
  if (last_raw_) {
    const std::int64_t device_step = device_us - last_raw_->device_us,
                       host_step = host_us - last_raw_->host_us;
    const bool wrapped = std::llabs(device_step + kWrap_us - host_step) < kWrapTolerance_us;
    const bool reset = device_step < 0 || std::llabs(device_step - host_step) > kResetJump_us;
    if (wrapped && device_step < 0) {
      shift_us_ += kWrap_us;
    } else if (reset) {
      shift_us_ += host_step - device_step;
      arrivals_.clear();
      ++epoch_;
    }
  }
  last_raw_ = Arrival{device_us, host_us};
  return device_us + shift_us_;
}

std::int64_t ClockFit::add(std::int64_t device_us, std::int64_t host_us) {
  const std::int64_t time_us = continuous(device_us, host_us);
  arrivals_.push_back({time_us, host_us});
  if (arrivals_.size() > kWindow) arrivals_.pop_front();
  fit();
  return time_us;
}

void ClockFit::fit() {
  const Arrival first = arrivals_.front();
  slope_ = 1;
  if (arrivals_.back().device_us - first.device_us >= kSpanForDrift_us) {
    std::vector<Point> delays;  // x: device time, y: arrival less device time, both since the first
    double mean = 0;
    for (const Arrival& a : arrivals_) {
      const auto x = static_cast<double>(a.device_us - first.device_us);
      delays.push_back({x, static_cast<double>(a.host_us - first.host_us) - x});
      mean += x / static_cast<double>(arrivals_.size());
    }
    slope_ += std::clamp(slope_over(lower_hull(delays), mean), -kLargestDrift, kLargestDrift);
  }
  offset_us_ = INFINITY;
  for (const Arrival& a : arrivals_) {
    const double along = slope_ * static_cast<double>(a.device_us - first.device_us);
    offset_us_ = std::min(offset_us_, static_cast<double>(a.host_us) - along);
  }
}

double ClockFit::host_at(std::int64_t device_us) const {
  return offset_us_ + slope_ * static_cast<double>(device_us - arrivals_.front().device_us);
}

}  // namespace rakelight
