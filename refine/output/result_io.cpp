// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/result_io.h"

#include <nlohmann/json.hpp>
#include <string>

#include "refine/output/images.h"
#include "refine/output/mesh.h"
#include "refine/output/pictures.h"
#include "refine/output/ply.h"
#include "refine/output/result_json.h"
#include "stack/atomic_folder.h"
#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/float_tiff.h"
#include "stack/image_file.h"
#include "stack/png_header.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

constexpr const char* kManifest = "result.json";
constexpr std::uint64_t kMaxManifestBytes = 64 << 20;

const FolderKind& result_kind() {
  static const FolderKind kind{"result",
                               kManifest,
                               {"depth.tiff", "depth.png", "initial_depth.tiff", "normals.tiff",
                                "normals.png", "albedo.tiff", "albedo.png", "mesh.ply", "before_after.png"}};
  return kind;
}

[[noreturn]] void refuse_manifest(const fs::path& file, const std::string& fault) {
  throw InputError(file.string(), fault, "refine the stack again");
}

nlohmann::json read_manifest(const fs::path& file) {
  const Bytes bytes = read_file(file, kMaxManifestBytes);
  const auto json = nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) refuse_manifest(file, "is no JSON object");
  if (json.value("format", "") != kResultFormat) refuse_manifest(file, "is not of a result");
  if (json.value("version", 0) != kResultVersion) {
    throw InputError(file.string(), "has a format version this program does not read",
                     "use a newer rakelight");
  }
  return json;
}

Camera camera_of(const nlohmann::json& json) {
  Camera camera;
  json.at("width").get_to(camera.width);
  json.at("height").get_to(camera.height);
  json.at("fx").get_to(camera.fx);
  json.at("fy").get_to(camera.fy);
  json.at("cx").get_to(camera.cx);
  json.at("cy").get_to(camera.cy);
  json.at("distortion").get_to(camera.distortion);
  return camera;
}

Camera read_camera(const fs::path& file) {
  try {
    const Camera camera = camera_of(read_manifest(file).at("camera"));
    const int side = static_cast<int>(kMaxImageSide);
    const bool sized = camera.width > 0 && camera.height > 0 && camera.width <= side && camera.height <= side;
    if (!sized || !(camera.fx > 0) || !(camera.fy > 0)) refuse_manifest(file, "describes no possible camera");
    return camera;
  } catch (const nlohmann::json::exception&) {
    refuse_manifest(file, "lacks the camera, or parts of the file have another type");
  }
}

}  // namespace

void write_result(const RefineResult& result, const fs::path& folder) {
  AtomicFolder out(folder, result_kind());
  write_tiff(out.path() / "depth.tiff", result.depth);
  write_png(out.path() / "depth.png", depth_picture(result.depth, depth_unit(result.depth)));
  write_tiff(out.path() / "initial_depth.tiff", result.initial_depth);
  write_tiff(out.path() / "normals.tiff", result.normals);
  write_png(out.path() / "normals.png", normals_picture(result.normals));
  write_tiff(out.path() / "albedo.tiff", result.albedo);
  write_png(out.path() / "albedo.png", albedo_picture(result.albedo));
  write_file(out.path() / "mesh.ply", ply_bytes(mesh_of(result)));
  write_png(out.path() / "before_after.png", before_after_picture(result));
  write_file(out.path() / kManifest, result_json(result));
  out.commit();
}

void check_result_folder(const fs::path& folder) {
  const AtomicFolder locked_for_a_moment(folder, result_kind());
}

StoredResult read_result(const fs::path& folder) {
  StoredResult result;
  result.camera = read_camera(folder / kManifest);
  result.depth = read_float_tiff(folder / "depth.tiff", result.camera.size());
  result.initial_depth = read_float_tiff(folder / "initial_depth.tiff", result.camera.size());
  result.normals = read_float3_tiff(folder / "normals.tiff", result.camera.size());
  return result;
}

}  // namespace rakelight
