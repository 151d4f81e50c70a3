// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TIFF revision 6.0, sections 2 and 8; SampleFormat: section 19.
#include "stack/tiff_header.h"

#include <vector>

#include "stack/errors.h"
#include "stack/png_header.h"

namespace rakelight {
namespace {

enum Tag : std::uint32_t {
  kWidth = 256,
  kHeight = 257,
  kBitsPerSample = 258,
  kStripOffsets = 273,
  kSamplesPerPixel = 277,
  kStripBytes = 279,
  kSampleFormat = 339
};

/// Reads numbers of either byte order, never outside the file.
class TiffBytes {
 public:
  TiffBytes(const unsigned char* data, std::size_t size, const std::string& file)
      : data_(data), size_(size), file_(file) {
    const bool little = size >= 8 && data[0] == 'I' && data[1] == 'I';
    const bool big = size >= 8 && data[0] == 'M' && data[1] == 'M';
    big_ = big;
    if ((!little && !big) || number(2, 2) != 42)
      throw InputError(file, "is not a TIFF image", "convert it to TIFF");
  }

  std::uint32_t number(std::size_t at, std::size_t bytes) const {
    if (at > size_ || bytes > size_ - at) throw_cut();
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) value = value << 8 | data_[at + (big_ ? i : bytes - 1 - i)];
    return value;
  }

  /// The values of the directory entry at `at`: SHORTs or LONGs, in the entry or where it points.
  std::vector<std::uint32_t> values(std::size_t at) const {
    const std::uint32_t type = number(at + 2, 2), count = number(at + 4, 4);
    const std::size_t bytes = type == 3 ? 2 : 4;
    if ((type != 3 && type != 4) || count > size_) throw_cut();
    const std::size_t start = count * bytes <= 4 ? at + 8 : number(at + 8, 4);
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(number(start + i * bytes, bytes));
    if (result.empty()) throw_cut();
    return result;
  }

  [[noreturn]] void throw_cut() const {
    throw InputError(file_, "is cut short or damaged", "copy or write it again");
  }

 private:
  const unsigned char* data_;
  std::size_t size_;
  const std::string& file_;
  bool big_ = false;
};

bool all_are(const std::vector<std::uint32_t>& values, std::uint32_t value) {
  for (const std::uint32_t v : values) {
    if (v != value) return false;
  }
  return !values.empty();
}

}  // namespace

TiffHeader parse_tiff_header(const unsigned char* data, std::size_t size, const std::string& file) {
  const TiffBytes bytes(data, size, file);
  const std::size_t directory = bytes.number(4, 4);
  const std::uint32_t entries = bytes.number(directory, 2);
  TiffHeader header;
  std::vector<std::uint32_t> bits, format, offsets, lengths;
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t at = directory + 2 + 12 * i;
    switch (bytes.number(at, 2)) {
      case kWidth:
        header.width = bytes.values(at)[0];
        break;
      case kHeight:
        header.height = bytes.values(at)[0];
        break;
      case kSamplesPerPixel:
        header.channels = bytes.values(at)[0];
        break;
      case kBitsPerSample:
        bits = bytes.values(at);
        break;
      case kSampleFormat:
        format = bytes.values(at);
        break;
      case kStripOffsets:
        offsets = bytes.values(at);
        break;
      case kStripBytes:
        lengths = bytes.values(at);
        break;
      default:
        break;
    }
  }
  bytes.number(directory + 2 + 12 * std::size_t{entries}, 4);  // the next directory's place ends this one
  header.is_float32 = all_are(bits, 32) && all_are(format, 3);
  if (header.width == 0 || header.height == 0 || offsets.empty() || offsets.size() != lengths.size()) {
    bytes.throw_cut();
  }
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (offsets[i] > size || lengths[i] > size - offsets[i]) bytes.throw_cut();
  }
  if (header.width > kMaxImageSide || header.height > kMaxImageSide || header.channels > 4 ||
      std::uint64_t{header.width} * header.height > kMaxImagePixels) {
    throw InputError(file, "is too large", "use images of at most 64 megapixels");
  }
  return header;
}

}  // namespace rakelight
