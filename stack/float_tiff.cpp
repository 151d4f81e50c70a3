// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/float_tiff.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/png_header.h"
#include "stack/tiff_header.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

/// None, said explicitly: OpenCV's default for three float channels is LogLuv, which is lossy and without negative values.
constexpr int kUncompressed = 1;
constexpr std::uint64_t kMaxFileBytes = kMaxImagePixels * 12 + (16 << 20);

[[noreturn]] void refuse(const fs::path& file, const std::string& fault) {
  throw InputError(file.string(), fault, "make or copy the file again");
}

std::string text(const cv::Size& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

cv::Mat read(const fs::path& file, int type, const ExpectedSize& expected) {
  const Bytes bytes = read_file(file, kMaxFileBytes);
  const TiffHeader header = parse_tiff_header(bytes.data(), bytes.size(), file.string());
  const cv::Size size(static_cast<int>(header.width), static_cast<int>(header.height));
  const int channels = CV_MAT_CN(type);
  if (!header.is_float32 || header.channels != static_cast<std::uint32_t>(channels)) {
    refuse(file, std::string("does not hold ") + (channels == 1 ? "one float" : "three floats") + " a pixel");
  }
  if (expected && size != *expected) {
    refuse(file, "is " + text(size) + " pixels instead of " + text(*expected));
  }
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    image.release();  // OpenCV reports some damage by an exception, some by an empty image
  }
  if (image.size() != size || image.type() != type) refuse(file, "is damaged");
  return image;
}

void write(const fs::path& file, const cv::Mat& image) {
  Bytes bytes;
  if (!cv::imencode(".tiff", image, bytes, {cv::IMWRITE_TIFF_COMPRESSION, kUncompressed})) {
    throw IoError("cannot encode " + file.string() + "; its image is empty or too large");
  }
  write_file(file, bytes.data(), bytes.size());
}

}  // namespace

cv::Mat1f read_float_tiff(const fs::path& file, const ExpectedSize& size) {
  return read(file, CV_32FC1, size);
}

cv::Mat3f read_float3_tiff(const fs::path& file, const ExpectedSize& size) {
  cv::Mat3f image;
  cv::cvtColor(read(file, CV_32FC3, size), image, cv::COLOR_BGR2RGB);
  return image;
}

void write_tiff(const fs::path& file, const cv::Mat1f& image) { write(file, image); }

void write_tiff(const fs::path& file, const cv::Mat3f& image) {
  cv::Mat3f backwards;
  cv::cvtColor(image, backwards, cv::COLOR_RGB2BGR);
  write(file, backwards);
}

}  // namespace rakelight
