// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/result_io.h"

#include <algorithm>
#include <functional>
#include <future>
#include <limits>
#include <optional>
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
#include "stack/parallel.h"
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

/// A number of an iteration; 0 where the file has null (no number then).
double number_or_zero(ObjectReader& iteration, const std::string& key) {
  constexpr double kAny = std::numeric_limits<double>::max();
  return iteration.maybe_number(key, -kAny, kAny).value_or(0);
}

std::vector<IterationReport> read_iterations(ObjectReader& manifest) {
  constexpr std::size_t kMostIterations = 1'000'000;
  std::vector<IterationReport> iterations;
  for (ObjectReader& iteration : manifest.objects("iterations", kMostIterations)) {
    IterationReport report;
    report.index = static_cast<int>(iteration.integer("index", 0, kMostIterations));
    report.energy = number_or_zero(iteration, "energy");
    report.energy_before_depth = number_or_zero(iteration, "energy_before_depth");
    report.depth_change_mm = number_or_zero(iteration, "depth_change_mm");
    report.typical_change_mm = number_or_zero(iteration, "typical_change_mm");
    report.residual_scale = number_or_zero(iteration, "residual_scale");
    report.seconds = number_or_zero(iteration, "seconds");
    iterations.push_back(report);
  }
  return iterations;
}

bool present(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

/// @return empty where the stack has no folder
std::optional<StackPlace> place_of(const LightStack* stack, const fs::path& result) {
  std::error_code unknown;  // a path that cannot be resolved is told as it is
  if (stack == nullptr || stack->origin.empty()) return std::nullopt;
  const fs::path absolute = fs::weakly_canonical(fs::absolute(stack->origin, unknown), unknown);
  return StackPlace{absolute.lexically_relative(fs::weakly_canonical(fs::absolute(result, unknown), unknown)),
                    absolute};
}

/// Beside the result as it was, or where it lay then; a file of another program may say anything, so nothing is refused.
fs::path find_stack(ObjectReader& manifest, const fs::path& folder) {
  const auto* const place = manifest.find("stack");
  if (place == nullptr || !place->is_object()) return {};
  const auto text = [place](const char* key) {
    const auto found = place->find(key);
    return found != place->end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const std::string relative = text("relative"), absolute = text("absolute");
  if (!relative.empty() && present(folder / relative)) return (folder / relative).lexically_normal();
  return !absolute.empty() && present(absolute) ? fs::path(absolute) : fs::path();
}

void read_manifest(const fs::path& file, StoredResult& result) {
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
  result.camera = read_camera(camera);
  result.message = manifest.text("message", "");
  result.stack = find_stack(manifest, file.parent_path());
  if (manifest.find("iterations") != nullptr) result.iterations = read_iterations(manifest);
}

}  // namespace

std::string to_string(Output output) {
  switch (output) {
    case Output::depth:
      return "depth";
    case Output::normals:
      return "normals";
    case Output::albedo:
      return "albedo";
    case Output::uncertainty:
      return "uncertainty";
    case Output::mesh:
      return "mesh";
    case Output::pictures:
      return "pictures";
    case Output::report:
      return "report";
  }
  return "unknown";
}

void write_result(const RefineResult& result, const fs::path& folder, const LightStack* stack,
                  const std::vector<Output>& outputs) {
  AtomicFolder out(folder, result_kind());
  std::vector<std::function<void()>> jobs;  // the longest first, so that none is left alone at the end
  const auto add = [&](Output output, const char* name, auto make_and_write) {
    if (std::find(outputs.begin(), outputs.end(), output) == outputs.end()) return;
    jobs.push_back([&out, name, make_and_write] { make_and_write(out.path() / name); });
  };
  add(Output::report, "report.html",
      [&](const fs::path& file) { write_file(file, report_html(result, stack)); });
  add(Output::mesh, "mesh.ply", [&](const fs::path& file) { write_file(file, ply_bytes(mesh_of(result))); });
  add(Output::mesh, "mesh.glb", [&](const fs::path& file) {
    write_file(file, glb_bytes(mesh_of(result, stride_for(result.depth, kMaxGlbVertices))));
  });
  if (!result.uncertainty.empty())
    add(Output::uncertainty, "uncertainty.tiff",
        [&](const fs::path& file) { write_tiff(file, result.uncertainty); });
  add(Output::normals, "normals.tiff", [&](const fs::path& file) { write_tiff(file, result.normals); });
  add(Output::albedo, "albedo.tiff", [&](const fs::path& file) { write_tiff(file, result.albedo); });
  add(Output::depth, "depth.tiff", [&](const fs::path& file) { write_tiff(file, result.depth); });
  add(Output::depth, "initial_depth.tiff",
      [&](const fs::path& file) { write_tiff(file, result.initial_depth); });
  add(Output::pictures, "before_after.png",
      [&](const fs::path& file) { write_png(file, before_after_picture(result)); });
  add(Output::depth, "depth.png",
      [&](const fs::path& file) { write_png(file, depth_picture(result.depth, depth_unit(result.depth))); });
  add(Output::normals, "normals.png",
      [&](const fs::path& file) { write_png(file, normals_picture(result.normals)); });
  add(Output::albedo, "albedo.png",
      [&](const fs::path& file) { write_png(file, albedo_picture(result.albedo)); });
  in_parallel(jobs);
  write_file(out.path() / kManifest, result_json(result, place_of(stack, folder)));
  out.commit();
}

void check_result_folder(const fs::path& folder) {
  const AtomicFolder locked_for_a_moment(folder, result_kind());
}

StoredResult read_result(const fs::path& folder) {
  StoredResult result;
  read_manifest(folder / kManifest, result);
  const cv::Size size = result.camera.size();
  const auto map3 = [&](const char* name) { return read_float3_tiff(folder / name, size); };
  // Decompression takes the time: the large maps are read beside each other.
  auto normals = std::async(std::launch::async, map3, "normals.tiff");
  std::future<cv::Mat3f> uncertainty, albedo;
  if (present(folder / "uncertainty.tiff"))
    uncertainty = std::async(std::launch::async, map3, "uncertainty.tiff");
  if (present(folder / "albedo.tiff")) albedo = std::async(std::launch::async, map3, "albedo.tiff");
  result.depth = read_float_tiff(folder / "depth.tiff", size);
  result.initial_depth = read_float_tiff(folder / "initial_depth.tiff", size);
  result.normals = normals.get();
  if (uncertainty.valid()) result.uncertainty = uncertainty.get();
  if (albedo.valid()) result.albedo = albedo.get();
  return result;
}

}  // namespace rakelight
