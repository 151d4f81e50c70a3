// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/lit_check.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "stack/color_response.h"

namespace rakelight {
namespace {

constexpr float kBandShare = 0.15F;    // of the brightest row's light: where a row begins to say something
constexpr int kRowsOfImage = 60;       // a band is one of so many
constexpr float kTolerance = 0.1F;     // of a band's light that may differ: lamps warm up, rooms flicker
constexpr float kFloor = 0.25F;        // bands darker than this share of the typical level are judged by it
constexpr float kNoiseFloor = 0.004F;  // one code of 8 bits, linear

cv::Mat3f linear_rows(const cv::Mat& color, int first, int rows, const ColorResponse& response) {
  const cv::Mat part = color.rowRange(first, first + rows);
  const double full = color.depth() == CV_16U ? 65535 : 255;
  std::vector<float> decoded(static_cast<std::size_t>(full) + 1);
  for (std::size_t i = 0; i < decoded.size(); ++i)
    decoded[i] = static_cast<float>(decode(response, double(i) / full));
  cv::Mat3w codes;
  part.convertTo(codes, CV_16UC3);
  cv::Mat3f linear(part.size());
  std::transform(codes.begin(), codes.end(), linear.begin(),
                 [&](const cv::Vec3w& c) { return cv::Vec3f(decoded[c[0]], decoded[c[1]], decoded[c[2]]); });
  return linear;
}

cv::Vec3f mean_of(const cv::Mat3f& image) {
  const cv::Scalar mean = cv::mean(image);
  return {static_cast<float>(mean[0]), static_cast<float>(mean[1]), static_cast<float>(mean[2])};
}

/// Root of the mean square over a band's pieces.
float band_level(const std::array<cv::Vec3f, Signature::kPieces>& band) {
  float sum = 0;
  for (const cv::Vec3f& piece : band) sum += piece.dot(piece);
  return std::sqrt(sum / Signature::kPieces);
}

float level(const Signature& signature) {
  float sum = 0;
  for (const auto& band : signature.bands) sum += band_level(band) / 3;
  return sum;
}

Signature difference(const Signature& a, const Signature& b) {
  Signature result;
  for (std::size_t band = 0; band < 3; ++band) {
    for (std::size_t piece = 0; piece < Signature::kPieces; ++piece)
      result.bands[band][piece] = a.bands[band][piece] - b.bands[band][piece];
  }
  return result;
}

/// Greatest light of each row over all images, less the dark.
std::vector<float> row_light(const std::vector<cv::Mat>& lit, const cv::Mat& dark,
                             const ColorResponse& response) {
  std::vector<float> light(static_cast<std::size_t>(dark.rows), 0);
  for (int y = 0; y < dark.rows; ++y) {
    const cv::Vec3f ambient = mean_of(linear_rows(dark, y, 1, response));
    for (const cv::Mat& image : lit) {
      const cv::Vec3f extra = mean_of(linear_rows(image, y, 1, response)) - ambient;
      float& best = light[static_cast<std::size_t>(y)];
      best = std::max({best, extra[0], extra[1], extra[2]});
    }
  }
  return light;
}

}  // namespace

SignatureBands find_bands(const std::vector<cv::Mat>& lit, const cv::Mat& dark,
                          const ColorResponse& response) {
  const std::vector<float> light = row_light(lit, dark, response);
  const float enough = std::max(kBandShare * *std::max_element(light.begin(), light.end()), kNoiseFloor);
  const auto bright = [enough](float value) { return value >= enough; };
  const auto begin = std::find_if(light.begin(), light.end(), bright);
  const auto end = std::find_if(light.rbegin(), light.rend(), bright).base();
  int first = static_cast<int>(begin - light.begin()), last = static_cast<int>(end - light.begin());
  const int rows = std::max(1, dark.rows / kRowsOfImage);
  if (last - first < 3 * rows) first = 0, last = dark.rows;  // nothing to go by: the whole image
  return {{first, (first + last - rows) / 2, last - rows}, rows};
}

Signature signature_of(const cv::Mat& color, const SignatureBands& bands, const ColorResponse& response) {
  Signature signature;
  for (std::size_t band = 0; band < 3; ++band) {
    const cv::Mat3f rows = linear_rows(color, bands.first_row[band], bands.rows, response);
    for (int piece = 0; piece < Signature::kPieces; ++piece) {
      const int from = piece * color.cols / Signature::kPieces,
                to = (piece + 1) * color.cols / Signature::kPieces;
      signature.bands[band][static_cast<std::size_t>(piece)] = mean_of(rows.colRange(from, to));
    }
  }
  return signature;
}

LitSignatures::LitSignatures(SignatureBands bands, ColorResponse response, const cv::Mat& dark)
    : bands_(bands), response_(response), dark_(signature_of(dark, bands, response)) {}

Signature LitSignatures::less_dark(const cv::Mat& color) const {
  return difference(signature_of(color, bands_, response_), dark_);
}

void LitSignatures::learn(const std::string& light, const cv::Mat& color) { lit_[light] = less_dark(color); }

/// Of the lights that give any: the median.
float LitSignatures::typical_level() const {
  std::vector<float> levels;
  for (const auto& [light, signature] : lit_) levels.push_back(level(signature));
  std::sort(levels.begin(), levels.end());
  return levels.empty() ? 0 : levels[levels.size() / 2];
}

LitCheck LitSignatures::check(const std::string& light, const cv::Mat& color) const {
  const Signature seen = less_dark(color);
  const auto found = lit_.find(light);
  const Signature error = found == lit_.end() ? seen : difference(seen, found->second);
  const float typical = typical_level();
  LitCheck result;
  result.matches = light.empty() || found != lit_.end();
  for (std::size_t band = 0; band < 3; ++band) {
    const float learnt = found == lit_.end() ? 0 : band_level(found->second.bands[band]);
    const float allowed = std::max(kTolerance * std::max(learnt, kFloor * typical), kNoiseFloor);
    result.matches = result.matches && band_level(error.bands[band]) <= allowed;
    cv::Vec3f mean{0, 0, 0};
    for (const cv::Vec3f& piece : seen.bands[band]) mean += piece / static_cast<float>(Signature::kPieces);
    for (int channel = 0; channel < 3; ++channel)
      result.rows_rgb[band][static_cast<std::size_t>(channel)] = static_cast<double>(mean[channel]);
  }
  return result;
}

std::string LitSignatures::nearest(const cv::Mat& color) const {
  const Signature seen = less_dark(color);
  std::string best;
  float least = level(seen);
  for (const auto& [light, signature] : lit_) {
    const float distance = level(difference(seen, signature));
    if (distance < least) least = distance, best = light;
  }
  return best;
}

namespace {

nlohmann::json to_json(const Signature& signature) {
  auto list = nlohmann::json::array();
  for (const auto& band : signature.bands) {
    for (const cv::Vec3f& piece : band) list.insert(list.end(), {piece[0], piece[1], piece[2]});
  }
  return list;
}

Signature parse_signature(const nlohmann::json& list) {
  Signature signature;
  std::size_t i = 0;
  for (auto& band : signature.bands) {
    for (cv::Vec3f& piece : band) {
      for (int channel = 0; channel < 3; ++channel) piece[channel] = list.at(i++).get<float>();
    }
  }
  return signature;
}

}  // namespace

std::string LitSignatures::text() const {
  nlohmann::json lit = nlohmann::json::object();
  for (const auto& [light, signature] : lit_) lit[light] = to_json(signature);
  return nlohmann::json{
      {"first_row", bands_.first_row}, {"rows", bands_.rows}, {"dark", to_json(dark_)}, {"lit", lit}}
      .dump();
}

LitSignatures LitSignatures::parse(const std::string& text, const ColorResponse& response, int height) {
  const auto json = nlohmann::json::parse(text);
  LitSignatures result;
  result.response_ = response;
  result.bands_.first_row = json.at("first_row").get<std::array<int, 3>>();
  result.bands_.rows = json.at("rows").get<int>();
  for (const int row : result.bands_.first_row) {
    if (row < 0 || result.bands_.rows < 1 || row > height - result.bands_.rows)
      throw std::out_of_range("bands");
  }
  result.dark_ = parse_signature(json.at("dark"));
  for (const auto& [light, signature] : json.at("lit").items())
    result.lit_[light] = parse_signature(signature);
  return result;
}

}  // namespace rakelight
