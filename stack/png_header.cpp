// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PNG specification (ISO/IEC 15948), sections 5.2-5.5 and 11.2.2.
#include "stack/png_header.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>

#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr std::array<unsigned char, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr const char* kCopyAgain = "copy or record it again";

std::uint32_t big_endian(const unsigned char* data) {
  return std::uint32_t{data[0]} << 24 | std::uint32_t{data[1]} << 16 | std::uint32_t{data[2]} << 8 | data[3];
}

bool is_type(const unsigned char* type, const char* name) { return std::equal(type, type + 4, name); }

bool allowed(int color, int bits) {
  switch (color) {
    case 0:
      return bits == 1 || bits == 2 || bits == 4 || bits == 8 || bits == 16;
    case 3:
      return bits == 1 || bits == 2 || bits == 4 || bits == 8;
    case 2:
    case 4:
    case 6:
      return bits == 8 || bits == 16;
    default:
      return false;
  }
}

}  // namespace

bool PngHeader::operator==(const PngHeader& other) const {
  return width == other.width && height == other.height && bit_depth == other.bit_depth &&
         color == other.color && interlaced == other.interlaced;
}

PngHeader parse_png_header(const unsigned char* data, std::size_t size, const std::string& file) {
  if (size < kSignature.size() || !std::equal(kSignature.begin(), kSignature.end(), data)) {
    throw InputError(file, "is not a PNG image", "convert it to PNG");
  }
  if (size < kPngHeaderBytes || big_endian(data + 8) != 13 || !is_type(data + 12, "IHDR") ||
      libdeflate_crc32(0, data + 12, 17) != big_endian(data + 29) || !allowed(data[25], data[24])) {
    throw InputError(file, "has a damaged PNG header", kCopyAgain);
  }
  PngHeader header;
  header.width = big_endian(data + 16);
  header.height = big_endian(data + 20);
  header.bit_depth = data[24];
  header.color = static_cast<PngHeader::Color>(data[25]);
  header.interlaced = data[28] != 0;
  const std::string size_text = std::to_string(header.width) + " x " + std::to_string(header.height);
  if (header.width == 0 || header.height == 0) throw InputError(file, "has no pixels", kCopyAgain);
  if (header.width > kMaxImageSide || header.height > kMaxImageSide ||
      std::uint64_t{header.width} * header.height > kMaxImagePixels) {
    throw InputError(file, "is too large (" + size_text + ")", "use images of at most 64 megapixels");
  }
  return header;
}

void check_png_bytes(const unsigned char* data, std::size_t size, const std::string& file) {
  std::size_t at = kSignature.size();
  while (size >= at + 12) {
    const std::size_t length = big_endian(data + at);
    if (length > size - at - 12) break;
    const unsigned char* type = data + at + 4;
    if (libdeflate_crc32(0, type, length + 4) != big_endian(type + 4 + length)) {
      throw InputError(file,
                       "is damaged (checksum of the PNG chunk at byte " + std::to_string(at) + " is wrong)",
                       kCopyAgain);
    }
    at += length + 12;
    if (!is_type(type, "IEND")) continue;
    if (at != size) throw InputError(file, "has data after the end of the PNG image", kCopyAgain);
    return;
  }
  throw InputError(file, "is cut short at byte " + std::to_string(size), kCopyAgain);
}

std::vector<PngChunk> png_chunks(const unsigned char* data, std::size_t size) {
  std::vector<PngChunk> chunks;
  for (std::size_t at = kSignature.size(); size >= at + 12;) {
    const std::size_t length = big_endian(data + at);
    if (length > size - at - 12) break;
    const auto* const type = reinterpret_cast<const char*>(data + at + 4);
    chunks.push_back({{type, 4}, data + at + 8, length});
    at += length + 12;
  }
  return chunks;
}

}  // namespace rakelight
