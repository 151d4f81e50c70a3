// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The result folder (docs/result-format.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "refine/refine.h"

namespace rakelight {

/// Parts of a result folder that may be left out; result.json is always there.
enum class Output {
  depth,        ///< depth.tiff, depth.png, initial_depth.tiff
  normals,      ///< normals.tiff, normals.png
  albedo,       ///< albedo.tiff, albedo.png
  uncertainty,  ///< uncertainty.tiff, where the method gives one
  mesh,         ///< mesh.ply, mesh.glb
  pictures,     ///< before_after.png
  report,       ///< report.html
};
inline const std::vector<Output> kAllOutputs{Output::depth,       Output::normals, Output::albedo,
                                             Output::uncertainty, Output::mesh,    Output::pictures,
                                             Output::report};
std::string to_string(Output output);

/// Writes depth, normals, albedo, meshes, pictures, report.html and result.json whole or not at all: a temporary sibling
/// is filled under a lock, then renamed. The files are made side by side.
/// @param stack what the result was made from, whose frames the report shows and whose folder (its origin)
///              result.json names; null: neither
/// @throws BusyError, IoError; InputError if `folder` exists and is neither empty nor a result.
void write_result(const RefineResult& result, const std::filesystem::path& folder,
                  const LightStack* stack = nullptr, const std::vector<Output>& outputs = kAllOutputs);

/// Refuses early what write_result would refuse, so that a long run does not end in vain. @throws as write_result.
void check_result_folder(const std::filesystem::path& folder);

/// The maps of a result folder, all on the camera's grid.
struct StoredResult {
  Camera camera;
  cv::Mat1f depth;              ///< metres, NaN where there is no surface
  cv::Mat1f initial_depth;      ///< the sensor's, before refinement, metres, NaN outside
  cv::Mat3f normals;            ///< camera frame, NaN outside; channels x, y, z
  cv::Mat3f uncertainty;        ///< as in RefineResult; empty where the result has none
  cv::Mat3f albedo;             ///< linear RGB, NaN outside; empty where the result has none
  std::filesystem::path stack;  ///< the folder it was made from, as far as it is still there; else empty
  std::string message;          ///< one sentence on how the refinement ended
  std::vector<IterationReport> iterations;
};

/// Reads a result folder. @throws InputError naming the file, the fault and the cure; IoError.
StoredResult read_result(const std::filesystem::path& folder);

}  // namespace rakelight
