// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/importers/photometric_sr.h"

#include <charconv>
#include <cmath>
#include <map>

#include "stack/checked_file.h"
#include "stack/color_response.h"
#include "stack/errors.h"
#include "stack/image_file.h"
#include "stack/importers/number_rows.h"
#include "stack/parallel.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

/// K.txt: the camera without its size, and how depth is stored.
struct Calibration {
  Camera color_camera;
  int scale = 1;                  ///< colour size / depth size
  double min_mm = 0, max_mm = 0;  ///< depths of raw 0 and 65535
};

Calibration read_calibration(const fs::path& file) {
  const auto rows = read_number_rows(file);
  const std::string cure = "write three rows of the camera matrix and a row 'scale,min,max'";
  if (rows.size() != 4 || rows[0].size() != 3 || rows[1].size() != 3 || rows[2].size() != 3 ||
      rows[3].size() != 3) {
    throw InputError(file.string(), "does not have four rows of three numbers", cure);
  }
  Calibration result;
  result.color_camera.fx = rows[0][0];
  result.color_camera.fy = rows[1][1];
  result.color_camera.cx = rows[0][2];
  result.color_camera.cy = rows[1][2];
  result.min_mm = rows[3][1];
  result.max_mm = rows[3][2];
  if (rows[0][0] <= 0 || rows[1][1] <= 0 || rows[0][1] != 0 || rows[1][0] != 0 || rows[2][0] != 0 ||
      rows[2][1] != 0 || rows[2][2] != 1) {
    throw InputError(file.string(), "is no camera matrix (fx,0,cx; 0,fy,cy; 0,0,1)", cure);
  }
  const double scale = rows[3][0];
  if (scale < 1 || scale > 64 || scale != std::floor(scale)) {
    throw InputError(file.string(), "scale is no whole number from 1 to 64",
                     "write colour size / depth size there");
  }
  result.scale = static_cast<int>(scale);
  if (result.min_mm < 0 || result.max_mm <= result.min_mm) {
    throw InputError(file.string(), "min,max are no range of depths", "write 0 <= min < max in mm");
  }
  return result;
}

/// Files `<prefix><number>.png` of a subfolder by their number, so that 2 comes before 10.
std::map<int, fs::path> numbered_images(const fs::path& folder, const std::string& sub,
                                        const std::string& prefix) {
  std::map<int, fs::path> result;
  std::error_code error;
  for (fs::directory_iterator entry(path_inside(folder, sub), error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const std::string stem = entry->path().stem().string();
    if (entry->path().extension() != ".png" || stem.rfind(prefix, 0) != 0) continue;
    int number = 0;
    const char* last = stem.data() + stem.size();
    const auto parsed = std::from_chars(stem.data() + prefix.size(), last, number);
    if (parsed.ec != std::errc() || parsed.ptr != last || number < 0) continue;
    if (!result.emplace(number, path_inside(folder, sub + "/" + name)).second) {
      throw InputError(entry->path().string(), "bears the number of another image",
                       "number the images once each");
    }
  }
  if (error)
    throw InputError((folder / sub).string(), "cannot be listed (" + error.message() + ")",
                     "check the folder");
  return result;
}

/// Depth whose raw 0 is `min` mm, counted anew so that raw 0 is 0 mm and 65535 stays `max`.
cv::Mat1w requantised(const cv::Mat1w& raw, const Calibration& calibration) {
  const double low = calibration.min_mm / calibration.max_mm;
  cv::Mat1w result(raw.size());
  for (int y = 0; y < raw.rows; ++y) {
    for (int x = 0; x < raw.cols; ++x) {
      const double value = low * 65535.0 + raw(y, x) * (1 - low);
      result(y, x) = raw(y, x) == 0 ? std::uint16_t{0} : cv::saturate_cast<std::uint16_t>(value);
    }
  }
  return result;
}

void add_color_frames(const fs::path& folder, Colors colors, LightStack& stack,
                      std::map<int, Frame>& frames) {
  const std::map<int, fs::path> files = numbered_images(folder, "RGB", "I_");
  if (files.empty()) {
    throw InputError((folder / "RGB").string(), "has no image I_<number>.png", "put one image a lamp there");
  }
  std::vector<std::pair<fs::path, Frame*>> jobs;
  for (const auto& [number, file] : files) {
    Frame& frame = frames[number];
    frame.light = "I_" + std::to_string(number);
    stack.lights.push_back({*frame.light, LampColor::white, {}, {}});
    jobs.emplace_back(file, &frame);
  }
  jobs.front().second->color = read_color_png(jobs.front().first);
  const cv::Size size = jobs.front().second->color.size();
  in_parallel(static_cast<int>(jobs.size()) - 1, [&](int k) {
    const auto& [file, frame] = jobs[static_cast<std::size_t>(k) + 1];
    if (colors == Colors::in_memory) frame->color = read_color_png(file, size);
    if (colors == Colors::on_disk) frame->read_color = later_color_png(file, size);
  });
  stack.color_camera.width = size.width;
  stack.color_camera.height = size.height;
}

void add_depth_frames(const fs::path& folder, const Calibration& calibration, cv::Size size,
                      std::map<int, Frame>& frames) {
  const std::map<int, fs::path> files = numbered_images(folder, "Depth", "z0_");
  if (files.empty()) {
    throw InputError((folder / "Depth").string(), "has no image z0_<number>.png",
                     "put the sensor's depth there");
  }
  std::vector<std::pair<fs::path, Frame*>> jobs;
  for (const auto& [number, file] : files) jobs.emplace_back(file, &frames[number]);
  in_parallel(static_cast<int>(jobs.size()), [&](int k) {
    const auto& [file, frame] = jobs[static_cast<std::size_t>(k)];
    const cv::Mat1w raw = read_depth_png(file, size);
    frame->depth = calibration.min_mm == 0 ? raw : requantised(raw, calibration);
  });
}

ColorResponse read_response(const fs::path& file) {
  const Bytes bytes = read_file(file, 256);
  std::string text(bytes.begin(), bytes.end());
  text.erase(text.find_last_not_of(" \t\r\n") + 1);
  try {
    return parse_color_response(text);
  } catch (const UsageError&) {
    throw InputError(file.string(), "is not understood", "write linear, srgb or a positive gamma");
  }
}

}  // namespace

bool is_photometric_sr(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "RGB", ignored) && fs::exists(folder / "K.txt", ignored);
}

LightStack import_photometric_sr(const fs::path& folder, Colors colors) {
  const Calibration calibration = read_calibration(path_inside(folder, "K.txt"));
  LightStack stack;
  stack.origin = folder.string();
  stack.sensor.driver = "photometric-sr";
  stack.color_camera = calibration.color_camera;
  stack.depth_unit_m = calibration.max_mm / 65535.0 / 1000.0;

  std::map<int, Frame> frames;
  add_color_frames(folder, colors, stack, frames);
  const Camera& color = stack.color_camera;
  if (color.width % calibration.scale != 0 || color.height % calibration.scale != 0) {
    throw InputError((folder / "K.txt").string(), "scale does not divide the colour images' size",
                     "write colour size / depth size there");
  }
  stack.depth_camera = binned(color, calibration.scale);
  add_depth_frames(folder, calibration, stack.depth_camera.size(), frames);
  for (auto& [number, frame] : frames) {
    frame.index = number;
    stack.frames.push_back(std::move(frame));
  }
  if (fs::exists(folder / "response.txt"))
    stack.color_response = read_response(path_inside(folder, "response.txt"));
  if (fs::exists(folder / "mask.png")) {
    stack.mask = read_mask_png(path_inside(folder, "mask.png"), {color.size(), stack.depth_camera.size()});
  }
  return stack;
}

}  // namespace rakelight
