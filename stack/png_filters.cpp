// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/png_filters.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>
#include <type_traits>

namespace rakelight {
namespace {

unsigned char low_byte(int value) { return static_cast<unsigned char>(value & 0xff); }

using Pixel = cv::v_int16x8;  // the bytes of one pixel as numbers, in the first lanes

/// @param Word at least as long as a pixel: reading three bytes is slower than reading four
template <class Word>
Pixel pixel_at(const unsigned char* bytes) {
  Word word = 0;
  std::memcpy(&word, bytes, sizeof word);
  return cv::v_reinterpret_as_s16(cv::v_expand_low(cv::v_reinterpret_as_u8(cv::v_uint64x2(word, 0))));
}

template <class Word>
void put(const Pixel& pixel, unsigned char* bytes) {
  const auto word = static_cast<Word>(cv::v_reinterpret_as_u64(cv::v_pack_u(pixel, pixel)).get0());
  std::memcpy(bytes, &word, sizeof word);
}

/// What PNG's Paeth filter predicts: of left, up and above_left, in this order, the one nearest to left + up - above_left.
Pixel predicted(const Pixel& left, const Pixel& up, const Pixel& above_left) {
  const Pixel vertical = up - above_left, horizontal = left - above_left, sum = vertical + horizontal,
              zero = cv::v_setzero_s16();
  const Pixel to_left = cv::v_max(vertical, zero - vertical),
              to_up = cv::v_max(horizontal, zero - horizontal), to_above_left = cv::v_max(sum, zero - sum);
  const Pixel least = cv::v_min(to_above_left, cv::v_min(to_left, to_up));
  return cv::v_select(least == to_left, left, cv::v_select(least == to_up, up, above_left));
}

/// Every pixel waits for the one to its left, so what goes side by side are the bytes of a pixel.
template <std::size_t kPixel>
void undo_paeth(const unsigned char* from, const unsigned char* above, std::size_t bytes,
                unsigned char* row) {
  using Word = std::conditional_t<(kPixel > 4), std::uint64_t, std::uint32_t>;
  const Pixel byte = cv::v_setall_s16(0xff);
  Pixel left = cv::v_setzero_s16(), above_left = left;
  std::size_t k = 0;
  for (; k + sizeof(Word) <= bytes;
       k += kPixel) {  // a word may reach into the next pixel, which is written after it
    const Pixel up = pixel_at<Word>(above + k);
    left = (pixel_at<Word>(from + k) + predicted(left, up, above_left)) & byte;
    above_left = up;
    put<Word>(left, row + k);
  }
  for (; k < bytes; k += kPixel) {
    unsigned char last_from[sizeof(Word)] = {}, last_above[sizeof(Word)] = {}, last[sizeof(Word)];
    std::copy_n(from + k, kPixel, last_from);
    std::copy_n(above + k, kPixel, last_above);
    const Pixel up = pixel_at<Word>(last_above);
    left = (pixel_at<Word>(last_from) + predicted(left, up, above_left)) & byte;
    above_left = up;
    put<Word>(left, last);
    std::copy_n(last, kPixel, row + k);
  }
}

template <std::size_t kPixel>
void undo_sub(const unsigned char* from, std::size_t bytes, unsigned char* row) {
  std::copy_n(from, kPixel, row);
  for (std::size_t k = kPixel; k < bytes; ++k) row[k] = low_byte(from[k] + row[k - kPixel]);
}

void undo_up(const unsigned char* from, const unsigned char* above, std::size_t bytes, unsigned char* row) {
  for (std::size_t k = 0; k < bytes; ++k) row[k] = low_byte(from[k] + above[k]);
}

template <std::size_t kPixel>
void undo_average(const unsigned char* from, const unsigned char* above, std::size_t bytes,
                  unsigned char* row) {
  std::array<int, kPixel> left{};
  for (std::size_t k = 0; k < bytes; k += kPixel) {
    for (std::size_t c = 0; c < kPixel; ++c) {
      row[k + c] = low_byte(from[k + c] + (left[c] + above[k + c]) / 2);
      left[c] = row[k + c];
    }
  }
}

/// Above the first row lie zeros.
template <std::size_t kPixel>
void undo_first_average(const unsigned char* from, std::size_t bytes, unsigned char* row) {
  std::copy_n(from, kPixel, row);
  for (std::size_t k = kPixel; k < bytes; ++k) row[k] = low_byte(from[k] + row[k - kPixel] / 2);
}

template <std::size_t kPixel>
bool undo(int filter, const unsigned char* from, const unsigned char* above, std::size_t bytes,
          unsigned char* row) {
  switch (filter) {
    case 0:
      std::copy_n(from, bytes, row);
      return true;
    case 1:
      undo_sub<kPixel>(from, bytes, row);
      return true;
    case 2:
      above ? undo_up(from, above, bytes, row) : static_cast<void>(std::copy_n(from, bytes, row));
      return true;
    case 3:
      above ? undo_average<kPixel>(from, above, bytes, row) : undo_first_average<kPixel>(from, bytes, row);
      return true;
    case 4:  // without a row above, the nearest is always the left one
      above ? undo_paeth<kPixel>(from, above, bytes, row) : undo_sub<kPixel>(from, bytes, row);
      return true;
    default:
      return false;
  }
}

}  // namespace

bool undo_png_filter(const unsigned char* filtered, const unsigned char* above, std::size_t bytes,
                     int pixel_bytes, unsigned char* row) {
  const int filter = *filtered++;
  switch (pixel_bytes) {
    case 1:
      return undo<1>(filter, filtered, above, bytes, row);
    case 2:
      return undo<2>(filter, filtered, above, bytes, row);
    case 3:
      return undo<3>(filter, filtered, above, bytes, row);
    case 6:
      return undo<6>(filter, filtered, above, bytes, row);
    default:
      return false;
  }
}

}  // namespace rakelight
