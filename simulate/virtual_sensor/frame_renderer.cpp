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

/// sum += weight * row
void add_row(const cv::Mat3f& image, int row, float weight, std::vector<float>& sum) {
  const auto* source = image.ptr<float>(row);
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * source[k];
}

}  // namespace

FrameRenderer::FrameRenderer(LampImages images, const ImageOptions& options, std::uint64_t seed)
    : images_(std::move(images)),
      options_(options),
      seed_(seed),
      noise_(noise_table(seed, static_cast<std::size_t>(3 * images_.ambient.cols))),
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
  // Amplification acts on both kinds of noise: var = (g read)^2 + shot^2 g v of the amplified value v.
  const auto gain = static_cast<float>(exposure.gain / kReferenceGain);
  const auto read = static_cast<float>(options_.read_noise * options_.read_noise) * gain * gain;
  const auto shot = static_cast<float>(options_.shot_noise * options_.shot_noise) * gain;
  constexpr auto kTop = static_cast<float>(kEncodingSteps - 1);
  const cv::Vec3f& balance = exposure.white_balance;
  const CounterRandom places(seed_, kNoisePlaces + static_cast<std::uint64_t>(frame));
  std::vector<float> sum(static_cast<std::size_t>(3 * size().width));
  image.create(size());
  for (int row = 0; row < image.rows; ++row) {
    mix_row(light, exposure, row, sum);
    const float* noise = noise_.data() + places.bits(static_cast<std::uint64_t>(row)) % kNoiseNumbers;
    auto* out = image.ptr<std::uint8_t>(row);
    for (std::size_t k = 0; k < sum.size(); ++k) {
      const float value = balance.val[k % 3] * (sum[k] + std::sqrt(read + shot * sum[k]) * noise[k]);
      const float clipped = std::min(std::max(value, 0.0f), 1.0f);
      out[k] = encoded_[static_cast<std::size_t>(clipped * kTop + 0.5f)];
    }
  }
}

}  // namespace rakelight
