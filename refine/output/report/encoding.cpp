// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/report/encoding.h"

#include <vector>

#include "refine/output/jpeg.h"

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
  const std::vector<unsigned char> bytes = jpeg_bytes(picture, quality);
  return "data:image/jpeg;base64," + base64(bytes.data(), bytes.size());
}

}  // namespace rakelight
