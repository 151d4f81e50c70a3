// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/image_file.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "stack/atomic_folder.h"
#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/png_header.h"
#include "stack/png_pixels.h"

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

/// Bytes a PNG of this header may have: incompressible pixels, and room for texts and colour profiles.
std::uint64_t largest_file(const PngHeader& header) {
  const std::uint64_t raw = std::uint64_t{header.width} * header.height * 8;
  return raw + raw / 16 + (std::uint64_t{16} << 20);
}

/// All bytes of a file whose header was read before, checked.
Bytes checked_bytes(const fs::path& file, const PngHeader& header) {
  Bytes bytes = read_file(file, largest_file(header));
  const PngHeader now = parse_png_header(bytes.data(), bytes.size(), file.string());
  check_png_bytes(bytes.data(), bytes.size(), file.string());
  if (!(now == header)) throw InputError(file.string(), "changed while it was read", "read it again");
  return bytes;
}

cv::Mat decoded(const fs::path& file, const cv::Mat& pixels) {
  if (pixels.empty()) throw InputError(file.string(), "cannot be decoded", "copy or record it again");
  return pixels;
}

/// @param kind "grey" or "RGB"
cv::Mat plain_pixels(const fs::path& file, const PngHeader& header, const std::string& kind) {
  const Bytes bytes = checked_bytes(file, header);
  if (png_has_transparency(bytes)) {
    throw InputError(file.string(), "is not a plain " + kind + " image", "save it without transparency");
  }
  return decoded(file, png_pixels(bytes, header));
}

}  // namespace

cv::Mat read_color_png(const fs::path& file, const ExpectedSize& size) {
  const PngHeader header = checked_header(file, as_list(size));
  if (header.color != PngHeader::Color::rgb) {
    throw InputError(file.string(), "is not an RGB image",
                     "save it as 8- or 16-bit RGB without transparency");
  }
  return plain_pixels(file, header, "RGB");
}

std::function<cv::Mat()> later_color_png(const fs::path& file, const ExpectedSize& size) {
  return [file, size, then = file_identity(file)] {
    const auto check_identity = [&] {
      if (!(file_identity(file) == then))
        throw BusyError(file.string() +
                        ": another program has changed or replaced it; read it when that is done");
    };
    check_identity();
    cv::Mat image = read_color_png(file, size);
    check_identity();
    return image;
  };
}

cv::Mat1w read_depth_png(const fs::path& file, const ExpectedSize& size) {
  const PngHeader header = checked_header(file, as_list(size));
  if (header.color != PngHeader::Color::gray || header.bit_depth != 16) {
    throw InputError(file.string(), "is not a 16-bit grey image", "save depth as 16-bit grey PNG");
  }
  return plain_pixels(file, header, "grey");
}

cv::Mat1b read_mask_png(const fs::path& file, const std::vector<cv::Size>& sizes) {
  const PngHeader header = checked_header(file, sizes);
  if (header.bit_depth > 8) {
    throw InputError(file.string(), "has 16 bits a channel", "save the mask as 8-bit grey, 255 = object");
  }
  cv::Mat1b mask;
  constexpr int kBlue = 2;
  cv::extractChannel(decoded(file, png_rgba(checked_bytes(file, header), header)), mask, kBlue);
  cv::threshold(mask, mask, 127, 255, cv::THRESH_BINARY);
  return mask;
}

cv::Mat1b read_gray_png(const fs::path& file) {
  const PngHeader header = checked_header(file, {});
  cv::Mat image = decoded(file, png_rgba(checked_bytes(file, header), header));
  cv::cvtColor(image, image, cv::COLOR_RGBA2GRAY);
  if (image.depth() == CV_16U) cv::normalize(image, image, 0, 255, cv::NORM_MINMAX, CV_8U);
  return image;
}

void write_png(const fs::path& file, const cv::Mat& image) {
  const Bytes bytes = png_bytes(image);
  if (bytes.empty()) throw IoError("cannot encode " + file.string());
  write_file(file, bytes.data(), bytes.size());
}

}  // namespace rakelight
