// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "capture/color_calibration.h"
#include "stack/color_response.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr int kTiles = 4;          // regions a side, for the spread
constexpr double kDarkest = 0.06;  // of full scale: below, black level and quantisation rule
constexpr double kBrightest = 0.98;
constexpr int kPixels = 40'000;     // an image, spread evenly
constexpr double kNarrowest = 1.5;  // ratio of the longest to the shortest exposure
constexpr double kAsGood = 1.05;    // a named response may leave this much more error than the best exponent

/// One pixel and channel at one exposure.
struct Sample {
  double value = 0, log_exposure = 0;
};
/// One pixel and channel over the sweep.
struct Track {
  int tile = 0;
  std::vector<Sample> samples;
};

std::vector<double> log_exposures(const std::vector<LightStack>& sweep) {
  std::vector<double> logs;
  for (const LightStack& stack : sweep) {
    if (!stack.exposure_us || !(*stack.exposure_us > 0))
      throw InputError(stack.origin, "does not tell its exposure", "write exposure_us into its stack.json");
    if (stack.gain != sweep.front().gain)
      throw InputError(stack.origin, "has another gain than " + sweep.front().origin, "keep the gain");
    logs.push_back(std::log(*stack.exposure_us));
  }
  const auto [least, most] = std::minmax_element(logs.begin(), logs.end());
  if (logs.size() < 2 || *most - *least < std::log(kNarrowest)) {
    throw InputError(sweep.front().origin + " and the others", "do not differ enough in exposure_us",
                     "record the same scene at several exposures, such as 4, 8, 16 and 32 ms");
  }
  return logs;
}

/// The first image of the same lamp in another stack; null where there is none.
const Frame* same_lamp(const LightStack& stack, const Frame& frame) {
  const auto found = std::find_if(stack.frames.begin(), stack.frames.end(), [&](const Frame& candidate) {
    return candidate.light == frame.light && !candidate.color.empty();
  });
  return found == stack.frames.end() ? nullptr : &*found;
}

double value_at(const cv::Mat& color, cv::Point pixel, int channel) {
  return color.depth() == CV_16U ? color.at<cv::Vec3w>(pixel)[channel] / 65535.0
                                 : color.at<cv::Vec3b>(pixel)[channel] / 255.0;
}

/// Images of one lamp over the sweep.
void add_tracks(const std::vector<const Frame*>& frames, const std::vector<double>& logs,
                std::vector<Track>& tracks) {
  const cv::Size size = frames.front()->color.size();
  const int step = std::max(1, static_cast<int>(std::sqrt(size.area() / kPixels)));
  for (int v = step / 2; v < size.height; v += step) {
    for (int u = step / 2; u < size.width; u += step) {
      for (int c = 0; c < 3; ++c) {
        Track track;
        track.tile = v * kTiles / size.height * kTiles + u * kTiles / size.width;
        for (std::size_t k = 0; k < frames.size(); ++k) {
          const double value = value_at(frames[k]->color, {u, v}, c);
          if (value > kDarkest && value < kBrightest) track.samples.push_back({value, logs[k]});
        }
        if (track.samples.size() >= 2) tracks.push_back(track);
      }
    }
  }
}

std::vector<Track> tracks_of(const std::vector<LightStack>& sweep, const std::vector<double>& logs) {
  std::vector<Track> tracks;
  for (const Frame& frame : sweep.front().frames) {
    if (!frame.light || frame.color.empty() || same_lamp(sweep.front(), frame) != &frame) continue;
    std::vector<const Frame*> frames;
    for (const LightStack& stack : sweep) {
      const Frame* other = same_lamp(stack, frame);
      if (other == nullptr || other->color.size() != frame.color.size()) {
        throw InputError(
            stack.origin,
            "has no image under lamp '" + *frame.light + "' of the size of " + sweep.front().origin,
            "record all with the same rig");
      }
      frames.push_back(other);
    }
    add_tracks(frames, logs, tracks);
  }
  return tracks;
}

/// Weighted sums of products about each track's own mean: the pixel's radiance drops out. Noise of a logarithm grows
/// as 1 / value, so samples weigh value^2.
struct Moments {
  double xx = 0, xy = 0, yy = 0, weight = 0;

  template <class Y>
  void add(const Track& track, const Y& log_radiance) {
    double sum = 0, x = 0, y = 0;
    for (const Sample& s : track.samples) {
      const double w = s.value * s.value;
      sum += w;
      x += w * s.log_exposure;
      y += w * log_radiance(s.value);
    }
    for (const Sample& s : track.samples) {
      const double w = s.value * s.value, dx = s.log_exposure - x / sum, dy = log_radiance(s.value) - y / sum;
      xx += w * dx * dx;
      xy += w * dx * dy;
      yy += w * dy * dy;
      weight += w;
    }
  }
};

/// Rms of log radiance that a response leaves against the exposures.
double error_of(const ColorResponse& response, const std::vector<Track>& tracks) {
  Moments m;
  for (const Track& track : tracks)
    m.add(track, [&](double value) { return std::log(decode(response, value)); });
  return std::sqrt(std::max(0.0, m.xx - 2 * m.xy + m.yy) / m.weight);
}

/// Exposures are exact and values are not, so log value is fitted on log exposure: its slope is 1 / gamma.
double gamma_of(const Moments& m) { return m.xx / m.xy; }

}  // namespace

ResponseFit measure_response(const std::vector<LightStack>& sweep) {
  const std::vector<double> logs = log_exposures(sweep);
  const std::vector<Track> tracks = tracks_of(sweep, logs);
  Moments whole;
  std::array<Moments, kTiles * kTiles> tiles;
  for (const Track& track : tracks) {
    const auto log_value = [](double value) { return std::log(value); };
    whole.add(track, log_value);
    tiles[static_cast<std::size_t>(track.tile)].add(track, log_value);
  }
  if (tracks.size() < 1000 || !(whole.xy > 0)) {
    throw InputError(sweep.front().origin + " and the others",
                     "show too few pixels that are lit and unclipped twice",
                     "choose exposures nearer to each other, and record in the same order of brightness");
  }
  ResponseFit fit;
  fit.samples = static_cast<int>(tracks.size());
  fit.gamma = gamma_of(whole);
  double squares = 0;
  int used = 0;
  for (const Moments& tile : tiles) {
    if (tile.xx < 0.01 * whole.xx || !(tile.xy > 0)) continue;
    squares += std::pow(gamma_of(tile) - fit.gamma, 2);
    ++used;
  }
  fit.deviation = std::sqrt(squares / std::max(1, used - 1));
  fit.response = {ColorResponse::Kind::gamma, fit.gamma};
  fit.error = error_of(fit.response, tracks);
  double allowed = kAsGood * fit.error;
  for (const ColorResponse named : {ColorResponse{}, ColorResponse{ColorResponse::Kind::srgb, 1.0}}) {
    const double error = error_of(named, tracks);
    if (error > allowed) continue;
    fit.response = named;
    fit.error = allowed = error;
  }
  return fit;
}

}  // namespace rakelight
