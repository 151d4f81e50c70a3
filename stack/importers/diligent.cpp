// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/importers/diligent.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/image_file.h"
#include "stack/importers/number_rows.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxImages = 4096;
constexpr int kSaturated16 = 65279;  // as saturated() in color_response.h

/// What the text files tell of one image.
struct Lamp {
  std::string image;
  Eigen::Vector3d direction;  ///< unit, camera coordinates
  Eigen::Vector3d intensity;  ///< linear RGB
};

std::vector<std::string> read_names(const fs::path& file) {
  const Bytes bytes = read_file(file, 1 << 20);
  std::istringstream lines(std::string(bytes.begin(), bytes.end()));
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (!line.empty()) names.push_back(line);
  }
  if (names.empty() || names.size() > kMaxImages) {
    throw InputError(file.string(), "does not name 1 to 4096 images", "write one file name a line");
  }
  return names;
}

/// One vector a line, as many as there are images.
std::vector<Eigen::Vector3d> read_vectors(const fs::path& file, std::size_t count) {
  std::vector<Eigen::Vector3d> vectors;
  for (const std::vector<double>& row : read_number_rows(file)) {
    if (row.size() != 3)
      throw InputError(file.string(), "has a line without three numbers", "write three a line");
    vectors.emplace_back(row.data());
  }
  if (vectors.size() != count) {
    throw InputError(
        file.string(),
        "has " + std::to_string(vectors.size()) + " lines for " + std::to_string(count) + " images",
        "write one line an image");
  }
  return vectors;
}

std::vector<Lamp> read_lamps(const fs::path& folder) {
  const std::vector<std::string> names = read_names(path_inside(folder, "filenames.txt"));
  const fs::path directions_file = path_inside(folder, "light_directions.txt");
  const fs::path intensities_file = path_inside(folder, "light_intensities.txt");
  const auto directions = read_vectors(directions_file, names.size());
  const auto intensities = read_vectors(intensities_file, names.size());
  std::vector<Lamp> lamps;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Eigen::Vector3d& d = directions[i];
    if (!(d.norm() > 1e-6))
      throw InputError(directions_file.string(), "has a zero direction", "mend that line");
    if (!(intensities[i].minCoeff() > 1e-6)) {
      throw InputError(intensities_file.string(), "has an intensity that is not positive", "mend that line");
    }
    // From x right, y up, z to the camera to x right, y down, z forward.
    lamps.push_back({names[i], Eigen::Vector3d(d.x(), -d.y(), -d.z()).normalized(), intensities[i]});
  }
  return lamps;
}

double least_intensity(const std::vector<Lamp>& lamps) {
  double least = lamps.front().intensity.minCoeff();
  for (const Lamp& lamp : lamps) least = std::min(least, lamp.intensity.minCoeff());
  return least;
}

/// The image as if every channel of every lamp had the intensity `target`.
cv::Mat equalised(const cv::Mat& color, const Eigen::Vector3d& intensity, double target) {
  cv::Mat image;
  color.convertTo(image, CV_16UC3, color.depth() == CV_8U ? 257.0 : 1.0);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      cv::Vec3w& pixel = image.at<cv::Vec3w>(y, x);
      for (int c = 0; c < 3; ++c) {
        const double value = pixel[c] * (target / intensity[c]);
        pixel[c] = pixel[c] >= kSaturated16 ? std::uint16_t{65535} : cv::saturate_cast<std::uint16_t>(value);
      }
    }
  }
  return image;
}

Camera read_camera(const fs::path& file, cv::Size size) {
  const auto rows = read_number_rows(file);
  const bool shaped = rows.size() == 3 && rows[0].size() == 3 && rows[1].size() == 3;
  if (!shaped || rows[0][0] <= 0 || rows[1][1] <= 0) {
    throw InputError(file.string(), "is no camera matrix", "write three rows: fx 0 cx, 0 fy cy, 0 0 1");
  }
  return {size.width, size.height, rows[0][0], rows[1][1], rows[0][2], rows[1][2], {}};
}

Camera published_camera(cv::Size size) {
  return {size.width, size.height, 3772.1, 3759.0, (size.width - 1) / 2.0, (size.height - 1) / 2.0, {}};
}

void add_frames(const fs::path& folder, const std::vector<Lamp>& lamps, LightStack& stack) {
  const double target = least_intensity(lamps);
  nlohmann::json directions = nlohmann::json::object();
  ExpectedSize size;
  for (const Lamp& lamp : lamps) {
    const std::string id = "lamp-" + std::to_string(stack.lights.size() + 1);
    const cv::Mat color = read_color_png(path_inside(folder, lamp.image), size);
    size = color.size();
    Frame frame;
    frame.index = static_cast<int>(stack.frames.size());
    frame.light = id;
    frame.color = equalised(color, lamp.intensity, target);
    stack.frames.push_back(std::move(frame));
    stack.lights.push_back({id, LampColor::white, {}, {}});
    directions[id]["direction_to_lamp"] = {lamp.direction.x(), lamp.direction.y(), lamp.direction.z()};
  }
  stack.unknown_keys = nlohmann::json{{"lights", directions}}.dump();
}

}  // namespace

bool is_diligent(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / "filenames.txt", ignored) &&
         fs::exists(folder / "light_directions.txt", ignored);
}

LightStack import_diligent(const fs::path& folder) {
  LightStack stack;
  stack.origin = folder.string();
  stack.sensor.driver = "diligent";
  add_frames(folder, read_lamps(folder), stack);
  const cv::Size size = stack.frames.front().color.size();
  if (fs::exists(folder / "K.txt")) {
    stack.color_camera = read_camera(path_inside(folder, "K.txt"), size);
  } else {
    stack.color_camera = published_camera(size);
    stack.sensor.name = "DiLiGenT (intrinsics assumed, principal point at the image centre)";
  }
  stack.depth_camera = stack.color_camera;
  if (fs::exists(folder / "mask.png")) stack.mask = read_mask_png(path_inside(folder, "mask.png"), {size});
  return stack;
}

}  // namespace rakelight
