// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/report/encoding.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "stack/errors.h"

namespace rakelight {

std::string base64(const void* data, std::size_t size) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::string text;
  text.reserve((size + 2) / 3 * 4);
  for (std::size_t at = 0; at < size; at += 3) {
    const auto byte = [&](std::size_t k) { return at + k < size ? unsigned{bytes[at + k]} : 0U; };
    const unsigned group = byte(0) << 16 | byte(1) << 8 | byte(2);
    text += kDigits[group >> 18];
    text += kDigits[group >> 12 & 63];
    text += at + 1 < size ? kDigits[group >> 6 & 63] : '=';
    text += at + 2 < size ? kDigits[group & 63] : '=';
  }
  return text;
}

std::string jpeg_uri(const cv::Mat& picture, int quality) {
  cv::Mat stored = picture;
  if (picture.channels() == 3) cv::cvtColor(picture, stored, cv::COLOR_RGB2BGR);
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".jpg", stored, bytes, {cv::IMWRITE_JPEG_QUALITY, quality, cv::IMWRITE_JPEG_OPTIMIZE, 1}))
    throw IoError("cannot encode a picture of the report");
  return "data:image/jpeg;base64," + base64(bytes.data(), bytes.size());
}

}  // namespace rakelight
