// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/float_tiff.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/png_header.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

/// Adobe deflate. OpenCV's default for three float channels is LogLuv: lossy, and without negative values.
constexpr int kDeflate = 8;
constexpr int kWidthTag = 256, kHeightTag = 257;
constexpr std::uint64_t kMaxFileBytes = kMaxImagePixels * 12 + (1 << 20);

[[noreturn]] void refuse(const fs::path& file, const std::string& fault) {
  throw InputError(file.string(), fault, "make or copy the file again");
}

/// Numbers of a classic TIFF, in the byte order that its first two bytes tell.
class TiffNumbers {
 public:
  TiffNumbers(const Bytes& bytes, const fs::path& file) : bytes_(bytes), file_(file) {
    const std::string start(
        bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(4, bytes.size())));
    big_endian_ = start == std::string("MM\0*", 4);
    if (!big_endian_ && start != std::string("II*\0", 4)) refuse(file, "is no TIFF image");
  }
  std::uint32_t number(std::uint64_t offset, unsigned count) const {
    if (offset + count > bytes_.size()) refuse(file_, "ends too early");
    std::uint32_t value = 0;
    for (unsigned i = 0; i < count; ++i) {
      value = value << 8 | bytes_[offset + (big_endian_ ? i : count - 1 - i)];
    }
    return value;
  }

 private:
  const Bytes& bytes_;
  const fs::path& file_;
  bool big_endian_ = false;
};

/// Width and height as the first directory claims them.
cv::Size claimed_size(const Bytes& bytes, const fs::path& file) {
  const TiffNumbers tiff(bytes, file);
  const std::uint64_t directory = tiff.number(4, 4);
  std::uint64_t width = 0, height = 0;
  for (unsigned i = 0, entries = tiff.number(directory, 2); i < entries; ++i) {
    const std::uint64_t entry = directory + 2 + 12 * std::uint64_t{i};
    const bool is_short = tiff.number(entry + 2, 2) == 3;
    const std::uint32_t value = tiff.number(entry + 8, is_short ? 2 : 4);
    if (tiff.number(entry, 2) == kWidthTag) width = value;
    if (tiff.number(entry, 2) == kHeightTag) height = value;
  }
  if (width == 0 || height == 0) refuse(file, "claims no size");
  if (std::max(width, height) > kMaxImageSide || width * height > kMaxImagePixels) {
    refuse(file,
           "claims " + std::to_string(width) + "x" + std::to_string(height) + " pixels, more than is read");
  }
  return {static_cast<int>(width), static_cast<int>(height)};
}

std::string text(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

cv::Mat read(const fs::path& file, int type, const ExpectedSize& expected) {
  const Bytes bytes = read_file(file, kMaxFileBytes);
  const cv::Size size = claimed_size(bytes, file);
  if (expected && size != *expected)
    refuse(file, "is " + text(size) + " pixels instead of " + text(*expected));
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    image.release();  // OpenCV reports some damage by an exception, some by an empty image
  }
  if (image.empty() || image.size() != size) refuse(file, "is damaged");
  if (image.type() != type) {
    refuse(file,
           std::string("does not hold ") + (type == CV_32FC1 ? "one float" : "three floats") + " a pixel");
  }
  return image;
}

void write(const fs::path& file, const cv::Mat& image) {
  Bytes bytes;
  if (!cv::imencode(".tiff", image, bytes, {cv::IMWRITE_TIFF_COMPRESSION, kDeflate})) {
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
