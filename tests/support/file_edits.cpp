// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/file_edits.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace rakelight::test {
namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

/// The plain bit-by-bit CRC of the PNG specification, so that tests do not lean on the code they test.
std::uint32_t crc(const std::string& bytes) {
  std::uint32_t c = 0xffffffffu;
  for (const char byte : bytes) {
    c ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) c = (c & 1u) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
  }
  return ~c;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc(type + data));
}

}  // namespace

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void set_text(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::remove(file);  // ext4 flushes a file that is emptied and filled again: slow in a loop
  std::ofstream(file, std::ios::binary) << text;
}

void replace_in_file(const std::filesystem::path& file, const std::string& from, const std::string& to) {
  std::string text = text_of(file);
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::invalid_argument("no '" + from + "' in " + file.string());
  set_text(file, text.replace(at, from.size(), to));
}

void write_png_bomb(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height) {
  const std::string header = big_endian(width) + big_endian(height) + std::string("\x10\x02\x00\x00\x00", 5);
  set_text(file, "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", std::string(64, 'x')) +
                     chunk("IEND", ""));
}

}  // namespace rakelight::test
