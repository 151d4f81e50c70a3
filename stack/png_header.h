// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a PNG file claims and whether its bytes are whole, before any pixel is allocated. Damage is found here: what decodes the
// pixels does not look at checksums again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rakelight {

struct PngHeader {
  enum class Color { gray = 0, rgb = 2, palette = 3, gray_alpha = 4, rgba = 6 };
  std::uint32_t width = 0, height = 0;
  int bit_depth = 0;  ///< bits a channel: 1, 2, 4, 8 or 16
  Color color = Color::gray;
  bool interlaced = false;  ///< Adam7

  bool operator==(const PngHeader& other) const;
};

/// Bytes from the start of a file that parse_png_header needs: signature and IHDR.
inline constexpr std::size_t kPngHeaderBytes = 33;

/// Largest image read: longest side and pixels.
inline constexpr std::uint32_t kMaxImageSide = 16384;
inline constexpr std::uint64_t kMaxImagePixels = std::uint64_t{64} << 20;

/// @param file named in messages  @throws InputError if this is no PNG, or one larger than the bounds above.
PngHeader parse_png_header(const unsigned char* data, std::size_t size, const std::string& file);

/// Checks the CRC of every chunk and that the file ends with IEND. @throws InputError if bytes are missing or changed.
void check_png_bytes(const unsigned char* data, std::size_t size, const std::string& file);

struct PngChunk {
  std::string_view type;  ///< four letters
  const unsigned char* data = nullptr;
  std::size_t size = 0;
};

/// The chunks of a file whose bytes are whole, in order.
std::vector<PngChunk> png_chunks(const unsigned char* data, std::size_t size);

}  // namespace rakelight
