// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/result_io.h"

#include <string>

#include "refine/output/glb.h"
#include "refine/output/images.h"
#include "refine/output/mesh.h"
#include "refine/output/pictures.h"
#include "refine/output/ply.h"
#include "refine/output/report/report.h"
#include "refine/output/result_json.h"
#include "stack/atomic_folder.h"
#include "stack/camera_json.h"
#include "stack/checked_file.h"
#include "stack/float_tiff.h"
#include "stack/image_file.h"
#include "stack/strict_json.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

constexpr const char* kManifest = "result.json";
constexpr std::uint64_t kMaxManifestBytes = 64 << 20;

const FolderKind& result_kind() {
  static const FolderKind kind{
      "result",
      kManifest,
      {"depth.tiff", "depth.png", "initial_depth.tiff", "normals.tiff", "normals.png", "uncertainty.tiff",
       "albedo.tiff", "albedo.png", "mesh.ply", "mesh.glb", "before_after.png", "report.html"}};
  return kind;
}

Camera read_camera_of(const fs::path& file) {
  const Bytes bytes = read_file(file, kMaxManifestBytes);
  const auto json = parse_strict_json({bytes.begin(), bytes.end()}, file.string());
  ObjectReader manifest(json, file.string());
  if (manifest.text("format") != kResultFormat) {
    manifest.refuse("format", "is not " + std::string(kResultFormat), "name a folder that refine wrote");
  }
  if (manifest.integer("version", 1, 1'000'000) != kResultVersion) {
    manifest.refuse("version", "is one this program does not read", "use a newer rakelight");
  }
  manifest.get("camera");
  ObjectReader camera = *manifest.maybe_object("camera");
  return read_camera(camera);
}

}  // namespace

void write_result(const RefineResult& result, const fs::path& folder, const LightStack* stack) {
  AtomicFolder out(folder, result_kind());
  write_tiff(out.path() / "depth.tiff", result.depth);
  write_png(out.path() / "depth.png", depth_picture(result.depth, depth_unit(result.depth)));
  write_tiff(out.path() / "initial_depth.tiff", result.initial_depth);
  write_tiff(out.path() / "normals.tiff", result.normals);
  write_png(out.path() / "normals.png", normals_picture(result.normals));
  if (!result.uncertainty.empty()) write_tiff(out.path() / "uncertainty.tiff", result.uncertainty);
  write_tiff(out.path() / "albedo.tiff", result.albedo);
  write_png(out.path() / "albedo.png", albedo_picture(result.albedo));
  write_file(out.path() / "mesh.ply", ply_bytes(mesh_of(result)));
  write_file(out.path() / "mesh.glb", glb_bytes(mesh_of(result, stride_for(result.depth, kMaxGlbVertices))));
  write_png(out.path() / "before_after.png", before_after_picture(result));
  write_file(out.path() / "report.html", report_html(result, stack));
  write_file(out.path() / kManifest, result_json(result));
  out.commit();
}

void check_result_folder(const fs::path& folder) {
  const AtomicFolder locked_for_a_moment(folder, result_kind());
}

StoredResult read_result(const fs::path& folder) {
  StoredResult result;
  result.camera = read_camera_of(folder / kManifest);
  result.depth = read_float_tiff(folder / "depth.tiff", result.camera.size());
  result.initial_depth = read_float_tiff(folder / "initial_depth.tiff", result.camera.size());
  result.normals = read_float3_tiff(folder / "normals.tiff", result.camera.size());
  if (std::filesystem::exists(folder / "uncertainty.tiff"))
    result.uncertainty = read_float3_tiff(folder / "uncertainty.tiff", result.camera.size());
  return result;
}

}  // namespace rakelight
