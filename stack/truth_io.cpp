// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/truth_io.h"

#include <cmath>

#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/float_tiff.h"
#include "stack/manifest.h"
#include "stack/strict_json.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

using json = nlohmann::ordered_json;

constexpr std::uint64_t kMaxLampsBytes = 1 << 20;

json to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

json to_json(const LampTruth& lamp) {
  json result = {{"id", lamp.id}, {"color", to_string(lamp.color)}, {"near", lamp.near}};
  if (lamp.position_m) result["position_m"] = to_json(*lamp.position_m);
  result["direction"] = to_json(lamp.direction);
  result["strength"] = to_json(lamp.strength);
  return result;
}

std::optional<Eigen::Vector3d> maybe_vector(ObjectReader& lamp, const std::string& key) {
  const auto numbers = lamp.maybe_numbers(key);
  if (!numbers) return {};
  if (numbers->size() != 3) lamp.refuse(key, "is no vector", "write three numbers");
  return Eigen::Vector3d(numbers->data());
}

LampTruth read_lamp(ObjectReader& reader) {
  LampTruth lamp;
  lamp.id = reader.text("id");
  lamp.color = parse_lamp_color(reader.text("color"), reader.place() + " color");
  lamp.near = reader.boolean("near");
  lamp.position_m = maybe_vector(reader, "position_m");
  reader.get("direction");
  lamp.direction = *maybe_vector(reader, "direction");
  reader.get("strength");
  lamp.strength = *maybe_vector(reader, "strength");
  return lamp;
}

std::vector<LampTruth> read_lamps(const fs::path& file) {
  const Bytes bytes = read_file(file, kMaxLampsBytes);
  const auto document = parse_strict_json(std::string(bytes.begin(), bytes.end()), file.string());
  ObjectReader reader(document, file.string());
  std::vector<LampTruth> lamps;
  for (ObjectReader& lamp : reader.objects("lamps", 4096)) lamps.push_back(read_lamp(lamp));
  return lamps;
}

/// Depth is a positive number or NaN; normals have unit length wherever there is depth.
void check_truth(const GroundTruth& truth, const fs::path& folder) {
  bool any = false;
  for (int y = 0; y < truth.depth.rows; ++y) {
    for (int x = 0; x < truth.depth.cols; ++x) {
      const float z = truth.depth(y, x);
      if (std::isnan(z)) continue;
      any = true;
      if (!std::isfinite(z) || z <= 0) {
        throw InputError((folder / "depth.tiff").string(), "holds a depth that is no positive number",
                         "write metres, and NaN outside the object");
      }
      const double length = cv::norm(truth.normals(y, x));
      if (!std::isnan(length) && !(std::abs(length - 1) < 0.01)) {
        throw InputError((folder / "normals.tiff").string(), "holds a normal that is not of unit length",
                         "write unit vectors, and NaN outside the object");
      }
    }
  }
  if (!any)
    throw InputError((folder / "depth.tiff").string(), "holds no depth", "give the truth of an object");
}

bool present(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

}  // namespace

void write_truth(const GroundTruth& truth, const fs::path& folder) {
  write_tiff(folder / "depth.tiff", truth.depth);
  write_tiff(folder / "normals.tiff", truth.normals);
  if (!truth.albedo.empty()) write_tiff(folder / "albedo.tiff", truth.albedo);
  if (truth.lamps.empty()) return;
  json lamps = json::array();
  for (const LampTruth& lamp : truth.lamps) lamps.push_back(to_json(lamp));
  write_file(folder / "lamps.json", json{{"lamps", lamps}}.dump(2) + "\n");
}

bool has_truth(const fs::path& folder) { return present(folder / "truth" / "depth.tiff"); }

GroundTruth read_truth(const fs::path& folder) {
  const fs::path home = has_truth(folder) ? path_inside(folder, "truth") : folder;
  GroundTruth truth;
  truth.depth = read_float_tiff(path_inside(home, "depth.tiff"));
  const cv::Size size = truth.depth.size();
  truth.normals = read_float3_tiff(path_inside(home, "normals.tiff"), size);
  if (present(home / "albedo.tiff")) truth.albedo = read_float3_tiff(path_inside(home, "albedo.tiff"), size);
  if (present(home / "lamps.json")) truth.lamps = read_lamps(path_inside(home, "lamps.json"));
  check_truth(truth, home);
  return truth;
}

}  // namespace rakelight
