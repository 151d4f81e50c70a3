// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/png_pixels.h"

#include <spng.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>

namespace rakelight {
namespace {

using Spng = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

cv::Mat decoded(const Bytes& bytes, const PngHeader& header, int type, spng_format format) {
  const Spng spng(spng_ctx_new(SPNG_CTX_IGNORE_ADLER32), spng_ctx_free);
  if (!spng) throw std::bad_alloc();
  spng_set_crc_action(spng.get(), SPNG_CRC_USE, SPNG_CRC_USE);  // check_png_bytes has looked at them
  cv::Mat image(static_cast<int>(header.height), static_cast<int>(header.width), type);
  const bool whole =
      spng_set_png_buffer(spng.get(), bytes.data(), bytes.size()) == 0 &&
      spng_decode_image(spng.get(), image.data, image.total() * image.elemSize(), format, 0) == 0;
  return whole ? image : cv::Mat();
}

}  // namespace

bool png_has_transparency(const Bytes& bytes) {
  const std::vector<PngChunk> chunks = png_chunks(bytes.data(), bytes.size());
  return std::any_of(chunks.begin(), chunks.end(), [](const PngChunk& each) { return each.type == "tRNS"; });
}

cv::Mat png_pixels(const Bytes& bytes, const PngHeader& header) {
  const bool gray = header.color == PngHeader::Color::gray, rgb = header.color == PngHeader::Color::rgb;
  if ((!gray && !rgb) || header.bit_depth < 8) return {};
  const int type = CV_MAKETYPE(header.bit_depth == 16 ? CV_16U : CV_8U, gray ? 1 : 3);
  return decoded(bytes, header, type, SPNG_FMT_PNG);
}

cv::Mat png_rgba(const Bytes& bytes, const PngHeader& header) {
  return header.bit_depth == 16 ? decoded(bytes, header, CV_16UC4, SPNG_FMT_RGBA16)
                                : decoded(bytes, header, CV_8UC4, SPNG_FMT_RGBA8);
}

Bytes png_bytes(const cv::Mat& image) {
  constexpr int kFastest = 1, kRunLengths = 3;  // of zlib: rows of differences have little else to find
  const Spng spng(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
  if (!spng) throw std::bad_alloc();
  const cv::Mat stored = image.isContinuous() ? image : image.clone();
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(stored.cols);
  header.height = static_cast<std::uint32_t>(stored.rows);
  header.bit_depth = stored.depth() == CV_16U ? 16 : 8;
  header.color_type = static_cast<std::uint8_t>(stored.channels() == 3 ? SPNG_COLOR_TYPE_TRUECOLOR
                                                                       : SPNG_COLOR_TYPE_GRAYSCALE);
  if (stored.empty() || (stored.channels() != 1 && stored.channels() != 3) || stored.depth() > CV_16U ||
      stored.depth() == CV_8S)
    return {};
  spng_set_option(spng.get(), SPNG_ENCODE_TO_BUFFER, 1);
  spng_set_option(spng.get(), SPNG_IMG_COMPRESSION_LEVEL, kFastest);
  spng_set_option(spng.get(), SPNG_IMG_COMPRESSION_STRATEGY, kRunLengths);
  spng_set_option(spng.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_SUB);
  if (spng_set_ihdr(spng.get(), &header) != 0 ||
      spng_encode_image(spng.get(), stored.data, stored.total() * stored.elemSize(), SPNG_FMT_PNG,
                        SPNG_ENCODE_FINALIZE) != 0)
    return {};
  std::size_t size = 0;
  int error = 0;
  const std::unique_ptr<void, decltype(&std::free)> encoded(spng_get_png_buffer(spng.get(), &size, &error),
                                                            std::free);
  const auto* const data = static_cast<const unsigned char*>(encoded.get());
  return error == 0 && data != nullptr ? Bytes(data, data + size) : Bytes();
}

}  // namespace rakelight
