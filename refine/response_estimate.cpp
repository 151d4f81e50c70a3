// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/response_estimate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "refine/steps/response_fit.h"
#include "stack/color_response.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr int kPixels = 600;
constexpr int kLeastImages = 6;
constexpr int kGroups = 4;                        // of images, left out in turn
constexpr double kLowest = 0.45, kHighest = 3.7;  // exponents tried
constexpr double kCoarse = 1.3, kFine = 1.13;     // ratio of neighbouring candidates
constexpr double kShadow = 0.12;       // light below this share of a pixel's brightest may be a shadow's
constexpr double kShadowRough = 0.35;  // the same of raw values, while the exponent is not known
constexpr double kNearBetter = 0.1;    // log likelihood a sample from which on near lamps are believed
constexpr double kModelBias = 0.07;    // of the exponent: what highlights and shadows do to it
constexpr double kSure = 0.12;         // deviation / gamma up to which the images determine it

std::vector<double> candidates(double ratio) {
  std::vector<double> gammas;
  for (double gamma = kLowest; gamma < kHighest; gamma *= ratio) gammas.push_back(gamma);
  return gammas;
}

/// Minimum of a curve over log gamma: the vertex of the parabola through the five (three) values around the least.
struct Minimum {
  double gamma = 1, misfit = 0;
  bool at_end = false;  ///< the least value is the first or the last
};

Minimum minimum_of(const std::vector<double>& gammas, const std::vector<double>& misfits) {
  const auto least = std::min_element(misfits.begin(), misfits.end()) - misfits.begin();
  const auto last = static_cast<std::ptrdiff_t>(misfits.size()) - 1;
  const auto at = [](std::ptrdiff_t k) { return static_cast<std::size_t>(k); };
  Minimum minimum{gammas[at(least)], misfits[at(least)], least == 0 || least == last};
  if (minimum.at_end) return minimum;
  const std::ptrdiff_t reach = least == 1 || least == last - 1 ? 1 : 2;
  Eigen::MatrixX3d A(2 * reach + 1, 3);
  Eigen::VectorXd b(2 * reach + 1);
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const double x = std::log(gammas[at(least + k)] / minimum.gamma);
    A.row(k + reach) << 1, x, x * x;
    b[k + reach] = misfits[at(least + k)];
  }
  const Eigen::Vector3d c = A.colPivHouseholderQr().solve(b);
  const double step = std::log(gammas[1] / gammas[0]);
  if (c[2] > 0) minimum.gamma *= std::exp(std::clamp(-c[1] / (2 * c[2]), -step, step));
  return minimum;
}

/// Everything that is tried, and how much of it is done.
class Search {
 public:
  Search(const LightStack& stack, const RefineOptions& options, const std::function<bool(double)>& progress)
      : stack_(stack), progress_(progress) {
    RefineOptions at_depth = options;
    at_depth.scale = 1;
    at_depth.lamps.harmonics =
        1;  // its own light model is fitted to few, steep samples: the first order does
    problem_ = make_problem(stack, at_depth);
  }

  int images() const { return problem_.images.images; }

  ResponseEstimate run() {
    const std::vector<int> all = without(-1);
    prepare(kShadowRough, kCoarse);
    const Minimum rough = minimum(all, ResponseLamps::near);
    prepare(std::pow(kShadow, 1 / rough.gamma), kFine);
    const Minimum far = minimum(all, ResponseLamps::far), near = minimum(all, ResponseLamps::near);
    const bool use_near = near.misfit < far.misfit - kNearBetter;
    const Minimum& best = use_near ? near : far;
    bool at_end = best.at_end;
    double squares = 0;
    for (int group = 0; group < kGroups; ++group) {  // jackknife
      const Minimum left = minimum(without(group), use_near ? ResponseLamps::near : ResponseLamps::far);
      squares += std::pow(std::log(left.gamma / best.gamma), 2);
      at_end = at_end || left.at_end;
    }
    ResponseEstimate estimate;
    estimate.gamma = best.gamma;
    const double spread = std::sqrt(squares * (kGroups - 1) / kGroups);
    estimate.deviation = best.gamma * std::hypot(spread, kModelBias);
    if (at_end) estimate.deviation = std::numeric_limits<double>::quiet_NaN();
    estimate.sure = !at_end && estimate.deviation < kSure * best.gamma;
    return estimate;
  }

 private:
  /// Samples free of shadows, decoded with every candidate.
  void prepare(double shadow, double ratio) {
    samples_ = response_samples(stack_, problem_, kPixels, shadow);
    gammas_ = candidates(ratio);
    decoded_.clear();
    for (const double gamma : gammas_)
      decoded_.push_back(decode_samples(stack_, samples_, {ColorResponse::Kind::gamma, gamma}));
  }

  /// All images but every kGroups-th.
  std::vector<int> without(int group) const {
    std::vector<int> kept;
    for (int i = 0; i < images(); ++i)
      if (i % kGroups != group) kept.push_back(i);
    return kept;
  }

  Minimum minimum(const std::vector<int>& images, ResponseLamps lamps) {
    constexpr double kCurves = 3 + kGroups;
    if (progress_ && !progress_(curves_done_++ / kCurves)) throw Cancelled();
    std::vector<double> misfits(gammas_.size());
    cv::parallel_for_(cv::Range(0, static_cast<int>(gammas_.size())), [&](const cv::Range& range) {
      for (int k = range.start; k < range.end; ++k) {
        const auto at = static_cast<std::size_t>(k);
        misfits[at] = response_misfit(samples_, decoded_[at], images, lamps);
      }
    });
    return minimum_of(gammas_, misfits);
  }

  const LightStack& stack_;
  const std::function<bool(double)>& progress_;
  RefineProblem problem_;
  ResponseSamples samples_;
  std::vector<double> gammas_;
  std::vector<DecodedSamples> decoded_;
  double curves_done_ = 0;
};

std::string numbers(const ResponseEstimate& estimate) {
  if (std::isnan(estimate.deviation)) return "no exponent fits clearly best";
  char text[64];
  std::snprintf(text, sizeof text, "gamma %.2f +- %.2f", estimate.gamma, estimate.deviation);
  return text;
}

/// The exponent nearest to a response.
double exponent_of(const ColorResponse& response) {
  switch (response.kind) {
    case ColorResponse::Kind::linear:
      return 1;
    case ColorResponse::Kind::srgb:
      return 2.2;
    case ColorResponse::Kind::gamma:
      return response.gamma;
  }
  return 1;
}

/// What to use, and the sentence that says so.
void decide(const ColorResponse& stated, ResponseEstimate& estimate) {
  estimate.used = stated;
  const std::string kept = "the stack's " + to_string(stated) + " is kept";
  if (!estimate.sure) {
    estimate.message = "response: not sure (" + numbers(estimate) + "), " + kept;
  } else if (std::abs(estimate.gamma - exponent_of(stated)) <= 2 * estimate.deviation) {
    estimate.message = "response: " + numbers(estimate) + " agrees, " + kept;
  } else {
    estimate.used = {ColorResponse::Kind::gamma, estimate.gamma};
    estimate.message =
        "response: " + numbers(estimate) + ", used instead of the stack's " + to_string(stated);
  }
}

}  // namespace

ResponseEstimate estimate_response(const LightStack& stack, const RefineOptions& options,
                                   const std::function<bool(double)>& progress) {
  Search search(stack, options, progress);
  if (search.images() < kLeastImages) {
    ResponseEstimate none;
    none.gamma = none.deviation = std::nan("");
    none.used = stack.color_response;
    none.message = "response: not sure (it takes " + std::to_string(kLeastImages) +
                   " images to find), the stack's " + to_string(stack.color_response) + " is kept";
    return none;
  }
  ResponseEstimate estimate = search.run();
  decide(stack.color_response, estimate);
  return estimate;
}

}  // namespace rakelight
