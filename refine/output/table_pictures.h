// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each method made of one stack, side by side.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "refine/table.h"

namespace rakelight {

/// One row of pictures; maps as in RefineResult.
struct PictureRow {
  std::string name, slug;
  cv::Mat1f depth;
  cv::Mat3f normals;  ///< of that depth
  cv::Mat3f albedo;   ///< may be empty: black
};

/// Rows for the sensor's depth (with the image that single-image methods use, in the albedo's place), for a method's
/// result, for the truth.
PictureRow input_row(const LightStack& stack, const RefineResult& result);
PictureRow result_row(const TableVariant& variant, const RefineResult& result);
PictureRow truth_row(const GroundTruth& truth);

/// One picture: the rows two a line, each with relief (raking light), normals, albedo and error, cropped to the
/// object; the errors' scale at the foot. R, G, B. @param width of one of the four, pixels
cv::Mat3b picture_sheet(const std::vector<PictureRow>& rows, const GroundTruth& truth, int width);

/// Writes SLUG-{relief,normals,albedo,error}.png of each row (full size), error-scale.png and sheet.jpg, whole or not at
/// all. @throws as write_result.
void write_table_pictures(const std::vector<PictureRow>& rows, const GroundTruth& truth,
                          const std::filesystem::path& folder);

/// Refuses early what write_table_pictures would refuse.
void check_pictures_folder(const std::filesystem::path& folder);

}  // namespace rakelight
