// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/frame_renderer.h"

#include <algorithm>
#include <cmath>

#include "simulate/counter_random.h"
#include "stack/color_response.h"

namespace rakelight {
namespace {

constexpr std::uint64_t kNoiseTable = 531, kNoisePlaces = 540;  // random streams; the latter one more a frame
constexpr std::size_t kNoiseNumbers = 1 << 17;
constexpr int kEncodingSteps = 1 << 14;  // fine enough for the steep foot of a gamma curve in 8 bits

std::vector<float> noise_table(std::uint64_t seed, std::size_t longest_row) {
  const CounterRandom random(seed, kNoiseTable);
  std::vector<float> table(kNoiseNumbers + longest_row);
  for (std::size_t k = 0; k < table.size(); ++k) table[k] = static_cast<float>(random.normal(k));
  return table;
}

std::vector<std::uint8_t> encoding_table(const ColorResponse& response) {
  std::vector<std::uint8_t> table(kEncodingSteps);
  for (int k = 0; k < kEncodingSteps; ++k) {
    const double value = encode(response, static_cast<double>(k) / (kEncodingSteps - 1));
    table[static_cast<std::size_t>(k)] =
        static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
  }
  return table;
}

/// A row of numbers, three a pixel. The loops over rows have neither branches nor calls, so that compilers vectorise them.
using Row = std::vector<float>;

/// sum += weight * row
void add_row(const cv::Mat3f& image, int row, float weight, Row& sum) {
  const auto* source = image.ptr<float>(row);
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * source[k];
}

/// Variance of a linear value v: read + shot * v.
struct NoiseLevel {
  float read = 0, shot = 0;
};

/// Amplification acts on both kinds of noise: var = (g read)^2 + shot^2 g v of the amplified value v.
NoiseLevel noise_level(const ImageOptions& options, double gain) {
  return {static_cast<float>(options.read_noise * options.read_noise * gain * gain),
          static_cast<float>(options.shot_noise * options.shot_noise * gain)};
}

/// step = clip(balance (value + noise)) as a step of the encoding table
void develop_row(const NoiseLevel& level, const float* noise, const Row& balance, const Row& value,
                 std::vector<std::int32_t>& step) {
  constexpr auto kTop = static_cast<float>(kEncodingSteps - 1);
  for (std::size_t k = 0; k < value.size(); ++k) {
    const float noisy = balance[k] * (value[k] + std::sqrt(level.read + level.shot * value[k]) * noise[k]);
    const float lit = noisy > 0 ? noisy : 0;
    // Never negative, and lround would keep the loop from being vectorised.
    step[k] =
        static_cast<std::int32_t>((lit < 1 ? lit : 1) * kTop + 0.5f);  // NOLINT(bugprone-incorrect-roundings)
  }
}

/// Factors of R, G and B for each pixel of a row.
Row balance_row(const cv::Vec3f& factors, int pixels) {
  Row row;
  for (int k = 0; k < pixels; ++k) row.insert(row.end(), factors.val, factors.val + 3);
  return row;
}

}  // namespace

FrameRenderer::FrameRenderer(LampImages images, const ImageOptions& options, std::uint64_t seed)
    : images_(std::move(images)),
      options_(options),
      seed_(seed),
      noise_(noise_table(seed, 3 * static_cast<std::size_t>(images_.ambient.cols))),
      encoded_(encoding_table(options.response)) {}

/// The sum of a row's light sources, linear, full scale 1.
void FrameRenderer::mix_row(const std::vector<LampRows>& light, const Exposure& exposure, int row,
                            std::vector<float>& sum) const {
  const auto per_us = static_cast<float>(exposure.gain / kReferenceGain / kReferenceExposureUs);
  std::fill(sum.begin(), sum.end(), 0.0f);
  add_row(images_.ambient, row, per_us * static_cast<float>(exposure.exposure_us), sum);
  for (const LampRows& lamp : light) {
    const float lit_us = lamp.lit_us[static_cast<std::size_t>(row)];
    if (lit_us > 0) add_row(images_.lamps[lamp.lamp], row, per_us * lit_us, sum);
  }
}

void FrameRenderer::render(const std::vector<LampRows>& light, const Exposure& exposure, int frame,
                           cv::Mat3b& image) const {
  const NoiseLevel level = noise_level(options_, exposure.gain / kReferenceGain);
  const Row balance = balance_row(exposure.white_balance, size().width);
  const CounterRandom places(seed_, kNoisePlaces + static_cast<std::uint64_t>(frame));
  Row value(balance.size());
  std::vector<std::int32_t> step(balance.size());
  image.create(size());
  for (int row = 0; row < image.rows; ++row) {
    mix_row(light, exposure, row, value);
    const float* noise = noise_.data() + places.bits(static_cast<std::uint64_t>(row)) % kNoiseNumbers;
    develop_row(level, noise, balance, value, step);
    auto* out = image.ptr<std::uint8_t>(row);
    for (std::size_t k = 0; k < step.size(); ++k) out[k] = encoded_[static_cast<std::size_t>(step[k])];
  }
}

}  // namespace rakelight
