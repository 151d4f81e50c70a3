// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/image_file.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/png_header.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

std::string to_text(cv::Size size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

void check_size(const fs::path& file, cv::Size actual, const std::vector<cv::Size>& allowed) {
  if (allowed.empty() || std::find(allowed.begin(), allowed.end(), actual) != allowed.end()) return;
  throw InputError(file.string(),
                   "is " + to_text(actual) + " pixels where " + to_text(allowed[0]) + " are expected",
                   "use images of the sizes the cameras have");
}

std::vector<cv::Size> as_list(const ExpectedSize& size) {
  return size ? std::vector<cv::Size>{*size} : std::vector<cv::Size>{};
}

PngHeader checked_header(const fs::path& file, const std::vector<cv::Size>& sizes) {
  const Bytes start = read_file_start(file, kPngHeaderBytes);
  const PngHeader header = parse_png_header(start.data(), start.size(), file.string());
  check_size(file, cv::Size(static_cast<int>(header.width), static_cast<int>(header.height)), sizes);
  return header;
}

/// Decodes checked bytes as they are; empty if OpenCV cannot.
cv::Mat decode(const Bytes& bytes) {
  try {
    return cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) { return {}; }  // each caller says which file it was
}

/// Bytes a PNG of this header may have: incompressible pixels, and room for texts and colour profiles.
std::uint64_t largest_file(const PngHeader& header) {
  const std::uint64_t raw = std::uint64_t{header.width} * header.height * 8;
  return raw + raw / 16 + (std::uint64_t{16} << 20);
}

cv::Mat decode_png(const fs::path& file, const PngHeader& header) {
  const Bytes bytes = read_file(file, largest_file(header));
  // Parsed again: the file may have changed since its first bytes were read.
  const PngHeader now = parse_png_header(bytes.data(), bytes.size(), file.string());
  check_png_bytes(bytes.data(), bytes.size(), file.string());
  const bool unchanged = now.width == header.width && now.height == header.height;
  cv::Mat image = unchanged ? decode(bytes) : cv::Mat();
  if (image.empty()) throw InputError(file.string(), "cannot be decoded", "copy or record it again");
  return image;
}

}  // namespace

cv::Mat read_color_png(const fs::path& file, const ExpectedSize& size) {
  const PngHeader header = checked_header(file, as_list(size));
  if (header.color != PngHeader::Color::rgb) {
    throw InputError(file.string(), "is not an RGB image",
                     "save it as 8- or 16-bit RGB without transparency");
  }
  cv::Mat image = decode_png(file, header);
  if (image.type() != CV_8UC3 && image.type() != CV_16UC3) {
    throw InputError(file.string(), "is not a plain RGB image", "save it without transparency");
  }
  cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
  return image;
}

cv::Mat1w read_depth_png(const fs::path& file, const ExpectedSize& size) {
  const PngHeader header = checked_header(file, as_list(size));
  if (header.color != PngHeader::Color::gray || header.bit_depth != 16) {
    throw InputError(file.string(), "is not a 16-bit grey image", "save depth as 16-bit grey PNG");
  }
  const cv::Mat image = decode_png(file, header);
  if (image.type() != CV_16UC1) {
    throw InputError(file.string(), "is not a plain grey image", "save it without transparency");
  }
  return image;
}

cv::Mat1b read_mask_png(const fs::path& file, const std::vector<cv::Size>& sizes) {
  const PngHeader header = checked_header(file, sizes);
  if (header.bit_depth > 8) {
    throw InputError(file.string(), "has 16 bits a channel", "save the mask as 8-bit grey, 255 = object");
  }
  cv::Mat1b mask;
  cv::extractChannel(decode_png(file, header), mask, 0);
  cv::threshold(mask, mask, 127, 255, cv::THRESH_BINARY);
  return mask;
}

cv::Mat1b read_gray_png(const fs::path& file) {
  cv::Mat image = decode_png(file, checked_header(file, {}));
  if (image.channels() == 4) cv::cvtColor(image, image, cv::COLOR_BGRA2GRAY);
  if (image.channels() == 3) cv::cvtColor(image, image, cv::COLOR_BGR2GRAY);
  if (image.depth() == CV_16U) cv::normalize(image, image, 0, 255, cv::NORM_MINMAX, CV_8U);
  return image;
}

void write_png(const fs::path& file, const cv::Mat& image) {
  cv::Mat stored = image;
  if (image.channels() == 3) {
    stored = cv::Mat();  // conversion in place would turn the caller's pixels
    cv::cvtColor(image, stored, cv::COLOR_RGB2BGR);
  }
  Bytes bytes;
  // Encoded in memory because cv::imwrite does not notice a full disk.
  if (!cv::imencode(".png", stored, bytes)) throw IoError("cannot encode " + file.string());
  write_file(file, bytes.data(), bytes.size());
}

}  // namespace rakelight
