// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/stack_io.h"

#include <cstdio>

#include "stack/atomic_folder.h"
#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/image_file.h"
#include "stack/importers/diligent.h"
#include "stack/importers/photometric_sr.h"
#include "stack/manifest.h"
#include "stack/parallel.h"
#include "stack/truth_io.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

constexpr const char* kManifest = "stack.json";
constexpr const char* kMask = "mask.png";
constexpr int kMaxAttempts = 100;
constexpr std::uint64_t kMaxManifestBytes = 16 << 20;
/// All pixels of a stack together, colour and depth counted apart: 6 GB of 16-bit colour.
constexpr std::uint64_t kMaxStackPixels = std::uint64_t{1} << 30;

const FolderKind& stack_kind() {
  static const FolderKind kind = {"stack", kManifest, {"color", "depth", kMask, "truth"}};
  return kind;
}

bool present(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

void check_memory(const Manifest& manifest, const fs::path& file) {
  std::uint64_t color = 0, depth = 0;
  for (const FrameFiles& files : manifest.files) {
    if (!files.color.empty()) color += std::uint64_t(manifest.stack.color_camera.size().area());
    if (!files.depth.empty()) depth += std::uint64_t(manifest.stack.depth_camera.size().area());
  }
  if (color > kMaxStackPixels || depth > kMaxStackPixels) {
    throw InputError(file.string(), "lists more pixels than can be held",
                     "split the stack or use smaller images");
  }
}

LightStack read_files(const fs::path& folder, Colors colors) {
  const fs::path file = path_inside(folder, kManifest);
  const Bytes bytes = read_file(file, kMaxManifestBytes);
  Manifest manifest = parse_manifest(std::string(bytes.begin(), bytes.end()), file.string());
  check_memory(manifest, file);
  LightStack& stack = manifest.stack;
  stack.origin = folder.string();
  in_parallel(static_cast<int>(stack.frames.size()), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    const auto& [color, depth] = manifest.files[i];
    Frame& frame = stack.frames[i];
    if (!color.empty()) {
      const fs::path image = path_inside(folder, color);
      const cv::Size size = stack.color_camera.size();
      if (colors == Colors::in_memory) frame.color = read_color_png(image, size);
      if (colors == Colors::on_disk) frame.read_color = later_color_png(image, size);
    }
    if (!depth.empty()) frame.depth = read_depth_png(path_inside(folder, depth), stack.depth_camera.size());
  });
  if (present(folder / kMask)) {
    stack.mask =
        read_mask_png(path_inside(folder, kMask), {stack.color_camera.size(), stack.depth_camera.size()});
  }
  return std::move(stack);
}

/// All files of one stack, even if a writer replaces the folder meanwhile.
LightStack read_stack_folder(const fs::path& folder, Colors colors) {
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    const FileIdentity before = file_identity(folder);
    try {
      LightStack stack = read_files(folder, colors);
      if (file_identity(folder) == before) return stack;
    } catch (const InputError&) {
      if (file_identity(folder) == before) throw;
    }
  }
  throw BusyError(folder.string() + ": another program keeps replacing it; read it when that is done");
}

/// Refuses pixels the format has no place for, before anything is written.
void check_pixels(const LightStack& stack) {
  const auto refuse = [](const std::string& what, const std::string& fault) {
    throw InputError(what, fault, "fill the stack as stack/stack.h says");
  };
  for (const Frame& frame : stack.frames) {
    const std::string name = "frame " + std::to_string(frame.index);
    const bool rgb = frame.color.type() == CV_8UC3 || frame.color.type() == CV_16UC3;
    if (!frame.color.empty() && !rgb) refuse(name, "has colour that is not 8- or 16-bit RGB");
    if (!frame.color.empty() && frame.color.size() != stack.color_camera.size()) {
      refuse(name, "has colour of another size than the colour camera");
    }
    if (!frame.depth.empty() && frame.depth.size() != stack.depth_camera.size()) {
      refuse(name, "has depth of another size than the depth camera");
    }
  }
  if (!stack.mask.empty() && stack.mask.size() != stack.color_camera.size() &&
      stack.mask.size() != stack.depth_camera.size()) {
    refuse("the mask", "has neither the colour camera's size nor the depth camera's");
  }
}

/// `color/0007.png` for the eighth frame, or nothing where the frame has no such image.
std::string image_name(const char* folder, std::size_t position, const cv::Mat& image) {
  if (image.empty()) return {};
  char name[32];
  std::snprintf(name, sizeof name, "%s/%04zu.png", folder, position);
  return name;
}

std::vector<FrameFiles> name_files(const LightStack& stack) {
  std::vector<FrameFiles> files;
  for (const Frame& frame : stack.frames) {
    const std::size_t position = files.size();
    files.push_back({image_name("color", position, frame.color), image_name("depth", position, frame.depth)});
  }
  return files;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::create_directory(folder, error) && error) throw_io_error("create", folder, error.value());
}

}  // namespace

LightStack read_stack(const fs::path& folder, Colors colors) {
  if (present(folder / kManifest)) return read_stack_folder(folder, colors);
  if (is_photometric_sr(folder)) return import_photometric_sr(folder, colors);
  if (is_diligent(folder)) return import_diligent(folder);
  if (!present(folder)) throw InputError(folder.string(), "does not exist", "check the path");
  throw InputError(folder.string(), "is neither a stack (no stack.json) nor a known source folder",
                   "record it again if the scan was cut off, or see 'rakelight import --help'");
}

cv::Mat1b read_mask(const fs::path& file) { return read_mask_png(file); }

void write_stack(const LightStack& given, const fs::path& folder, const std::optional<GroundTruth>& truth) {
  const LightStack stack = in_memory(given);
  check_pixels(stack);
  const std::vector<FrameFiles> files = name_files(stack);
  const std::string manifest = manifest_text(stack, files);
  AtomicFolder out(folder, stack_kind());
  for (const char* sub : {"color", "depth"}) make_folder(out.path() / sub);
  in_parallel(static_cast<int>(files.size()), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    if (!files[i].color.empty()) write_png(out.path() / files[i].color, stack.frames[i].color);
    if (!files[i].depth.empty()) write_png(out.path() / files[i].depth, stack.frames[i].depth);
  });
  if (!stack.mask.empty()) write_png(out.path() / kMask, stack.mask);
  if (truth) {
    make_folder(out.path() / "truth");
    write_truth(*truth, out.path() / "truth");
  }
  write_file(out.path() / kManifest, manifest);
  out.commit();
}

void check_stack_folder(const fs::path& folder) {
  const AtomicFolder locked_for_a_moment(folder, stack_kind());
}

}  // namespace rakelight
