// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/float_tiff.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <tiffio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/png_header.h"
#include "stack/tiff_header.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kMaxFileBytes = kMaxImagePixels * 12 + (16 << 20);

[[noreturn]] void refuse(const fs::path& file, const std::string& fault) {
  throw InputError(file.string(), fault, "make or copy the file again");
}

std::string text(const cv::Size& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

/// libtiff's view of a file in memory.
struct MemoryFile {
  const Bytes& bytes;
  std::size_t at = 0;
};

tmsize_t read_memory(thandle_t handle, void* to, tmsize_t size) {
  auto& file = *static_cast<MemoryFile*>(handle);
  const std::size_t count = std::min(static_cast<std::size_t>(size), file.bytes.size() - file.at);
  std::memcpy(to, file.bytes.data() + file.at, count);
  file.at += count;
  return static_cast<tmsize_t>(count);
}

tmsize_t write_nothing(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek_memory(thandle_t handle, toff_t offset, int whence) {
  auto& file = *static_cast<MemoryFile*>(handle);
  const toff_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file.at : file.bytes.size();
  file.at = static_cast<std::size_t>(std::min<toff_t>(from + offset, file.bytes.size()));
  return file.at;
}

int close_memory(thandle_t) { return 0; }
toff_t size_of_memory(thandle_t handle) { return static_cast<MemoryFile*>(handle)->bytes.size(); }

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

/// libtiff says on the standard error what a caller is told by an exception.
void silence_libtiff() {
  static const bool once = [] {
    TIFFSetErrorHandler(nullptr);
    TIFFSetWarningHandler(nullptr);
    return true;
  }();
  static_cast<void>(once);
}

std::uint32_t field(TIFF* tiff, std::uint32_t tag) {
  std::uint16_t value = 0;
  TIFFGetFieldDefaulted(tiff, tag, &value);
  return value;
}

/// Rows from the strips. @return false where the file says one thing and holds another
bool read_rows(TIFF* tiff, cv::Mat& image) {
  const auto row_bytes = static_cast<tmsize_t>(static_cast<std::size_t>(image.cols) * image.elemSize());
  if (TIFFIsTiled(tiff) || field(tiff, TIFFTAG_PLANARCONFIG) != PLANARCONFIG_CONTIG ||
      TIFFScanlineSize(tiff) != row_bytes)
    return false;
  for (int y = 0; y < image.rows; ++y)
    if (TIFFReadScanline(tiff, image.ptr(y), static_cast<std::uint32_t>(y)) != 1) return false;
  return true;
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
  silence_libtiff();
  MemoryFile memory{bytes};
  const Tiff tiff(TIFFClientOpen("memory", "rm", &memory, read_memory, write_nothing, seek_memory,
                                 close_memory, size_of_memory, nullptr, nullptr),
                  TIFFClose);
  cv::Mat image(size, type);
  if (!tiff || !read_rows(tiff.get(), image)) refuse(file, "is damaged");
  return image;
}

bool write_rows(TIFF* tiff, const cv::Mat& image) {
  const bool rgb = image.channels() == 3;
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, image.cols);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, image.rows);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, image.channels());
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, rgb ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(tiff, 0));
  std::vector<unsigned char> row(static_cast<std::size_t>(image.cols) * image.elemSize());
  for (int y = 0; y < image.rows; ++y) {
    std::memcpy(row.data(), image.ptr(y), row.size());  // libtiff may change what it is given
    if (TIFFWriteScanline(tiff, row.data(), static_cast<std::uint32_t>(y), 0) != 1) return false;
  }
  return TIFFFlush(tiff) == 1;
}

/// libtiff's view of a file on the disk, and why writing it failed.
struct DiskFile {
  int fd = -1;
  int error = 0;
};

tmsize_t write_disk(thandle_t handle, void* data, tmsize_t size) {
  auto& file = *static_cast<DiskFile*>(handle);
  const char* const from = static_cast<const char*>(data);
  tmsize_t done = 0;
  while (done < size) {
    const ssize_t put = ::write(file.fd, from + done, static_cast<std::size_t>(size - done));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) {
      file.error = errno;
      break;
    }
    done += put;
  }
  return done;
}

tmsize_t read_disk(thandle_t handle, void* to, tmsize_t size) {
  return ::read(static_cast<DiskFile*>(handle)->fd, to, static_cast<std::size_t>(size));
}

toff_t seek_disk(thandle_t handle, toff_t offset, int whence) {
  return static_cast<toff_t>(::lseek(static_cast<DiskFile*>(handle)->fd, static_cast<off_t>(offset), whence));
}

int close_disk(thandle_t handle) {
  auto& file = *static_cast<DiskFile*>(handle);
  const int result = ::close(file.fd);
  if (result != 0 && file.error == 0) file.error = errno;
  return result;
}

toff_t size_of_disk(thandle_t handle) {
  struct stat status {};
  return ::fstat(static_cast<DiskFile*>(handle)->fd, &status) == 0 ? static_cast<toff_t>(status.st_size) : 0;
}

/// Row by row to the disk: the maps of a result are its largest files.
void write(const fs::path& file, const cv::Mat& image) {
  if (image.empty()) throw IoError("cannot encode " + file.string() + "; its image is empty");
  silence_libtiff();
  DiskFile disk{::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666)};
  if (disk.fd < 0) throw_io_error("create", file, errno);
  Tiff tiff(TIFFClientOpen("disk", "wm", &disk, read_disk, write_disk, seek_disk, close_disk, size_of_disk,
                           nullptr, nullptr),
            TIFFClose);
  if (!tiff) ::close(disk.fd);
  const bool written = tiff && write_rows(tiff.get(), image);
  tiff.reset();
  if (!written || disk.error != 0) throw_io_error("write", file, disk.error != 0 ? disk.error : EIO);
}

}  // namespace

cv::Mat1f read_float_tiff(const fs::path& file, const ExpectedSize& size) {
  return read(file, CV_32FC1, size);
}

cv::Mat3f read_float3_tiff(const fs::path& file, const ExpectedSize& size) {
  return read(file, CV_32FC3, size);
}

void write_tiff(const fs::path& file, const cv::Mat1f& image) { write(file, image); }

void write_tiff(const fs::path& file, const cv::Mat3f& image) { write(file, image); }

}  // namespace rakelight
