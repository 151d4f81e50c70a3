// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/jpeg.h"

#include <cstdio>
#include <cstdlib>
// jpeglib.h needs the two above
#include <jpeglib.h>

#include <csetjmp>
#include <memory>

#include "stack/errors.h"

namespace rakelight {
namespace {

/// libjpeg reports an error by a call that must not return.
struct ErrorExit {
  jpeg_error_mgr manager{};  ///< first: libjpeg knows only this part
  std::jmp_buf back{};
};

[[noreturn]] void leave(j_common_ptr info) { std::longjmp(reinterpret_cast<ErrorExit*>(info->err)->back, 1); }
void stay_silent(j_common_ptr) {}

/// @param bytes, size of a buffer of libjpeg's, to be freed whatever is returned. Nothing here has a destructor, which
/// longjmp would jump over.
bool compress(const cv::Mat& picture, int quality, unsigned char** bytes, unsigned long* size) {
  jpeg_compress_struct info{};
  ErrorExit error;
  info.err = jpeg_std_error(&error.manager);
  error.manager.error_exit = leave;
  error.manager.output_message = stay_silent;
  if (setjmp(error.back) != 0) {
    jpeg_destroy_compress(&info);
    return false;
  }
  jpeg_create_compress(&info);
  jpeg_mem_dest(&info, bytes, size);
  info.image_width = static_cast<JDIMENSION>(picture.cols);
  info.image_height = static_cast<JDIMENSION>(picture.rows);
  info.input_components = picture.channels();
  info.in_color_space = picture.channels() == 3 ? JCS_RGB : JCS_GRAYSCALE;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, quality, TRUE);
  info.optimize_coding = TRUE;
  jpeg_start_compress(&info, TRUE);
  while (info.next_scanline < info.image_height) {
    JSAMPROW row = const_cast<JSAMPROW>(picture.ptr(static_cast<int>(info.next_scanline)));
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  jpeg_destroy_compress(&info);
  return true;
}

}  // namespace

std::vector<unsigned char> jpeg_bytes(const cv::Mat& picture, int quality) {
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  const bool kind = picture.type() == CV_8UC1 || picture.type() == CV_8UC3;
  const bool done = kind && !picture.empty() && compress(picture, quality, &buffer, &size);
  const std::unique_ptr<unsigned char, decltype(&std::free)> owned(buffer, std::free);
  if (!done) throw IoError("cannot encode a picture as JPEG");
  return {buffer, buffer + size};
}

}  // namespace rakelight
