// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/table_pictures.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "refine/depth_normals.h"
#include "refine/output/error_map.h"
#include "refine/output/images.h"
#include "refine/output/jpeg.h"
#include "refine/output/pictures.h"
#include "stack/atomic_folder.h"
#include "stack/checked_file.h"
#include "stack/color_response.h"
#include "stack/image_file.h"

namespace rakelight {
namespace {

constexpr const char *kInput = "input", *kTruth = "truth";
constexpr std::array kKinds{"relief", "normals", "albedo", "error"};
constexpr int kSheetColumn = 112;  ///< pixels
constexpr int kCaption = 20;

const FolderKind& pictures_kind() {
  static const FolderKind kind = [] {
    std::vector<std::string> slugs{kInput, kTruth}, files{"error-scale.png"};
    for (const TableVariant& variant : table_variants()) slugs.push_back(variant.slug);
    for (const std::string& slug : slugs)
      for (const char* what : kKinds) files.push_back(slug + "-" + what + ".png");
    return FolderKind{"folder of a table's pictures", "sheet.jpg", files};
  }();
  return kind;
}

cv::Mat3f as_float(const cv::Mat3d& normals) {
  cv::Mat3f result;
  normals.convertTo(result, CV_32F);
  return result;
}

/// In the order of kKinds.
std::array<cv::Mat3b, 4> pictures_of(const PictureRow& row, const cv::Mat1f& truth, double range_mm) {
  std::array<cv::Mat3b, 4> pictures;
  cv::cvtColor(raking_light(row.normals), pictures[0], cv::COLOR_GRAY2RGB);
  normals_picture(row.normals).convertTo(pictures[1], CV_8U, 1.0 / 257.0);
  pictures[2] =
      row.albedo.empty() ? cv::Mat3b(row.depth.size(), cv::Vec3b::all(0)) : albedo_picture(row.albedo);
  pictures[3] = error_map(row.depth, truth, range_mm);
  return pictures;
}

/// The same for all rows, judged by the first: the sensor's depth.
double range_of(const std::vector<PictureRow>& rows, const cv::Mat1f& truth) {
  return rows.empty() ? 1.0 : error_range_mm(rows.front().depth, truth);
}

cv::Mat3b strip(const std::array<cv::Mat3b, 4>& pictures, const cv::Rect& box, const std::string& caption,
                int width) {
  const int height = std::max(1, width * box.height / box.width);
  cv::Mat3b result(height + kCaption, 4 * width, cv::Vec3b::all(0));
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const cv::Mat3b cropped = pictures[k](box);
    cv::Mat3b scaled;
    cv::resize(cropped, scaled, {width, height}, 0, 0, width < box.width ? cv::INTER_AREA : cv::INTER_LINEAR);
    scaled.copyTo(result(cv::Rect(static_cast<int>(k) * width, kCaption, width, height)));
  }
  cv::putText(result, caption, {4, kCaption - 6}, cv::FONT_HERSHEY_SIMPLEX, 0.42, cv::Scalar::all(235), 1,
              cv::LINE_AA);
  return result;
}

void write_jpeg(const std::filesystem::path& file, const cv::Mat3b& picture) {
  constexpr int kQuality = 85;
  const std::vector<unsigned char> bytes = jpeg_bytes(picture, kQuality);
  write_file(file, bytes.data(), bytes.size());
}

}  // namespace

PictureRow input_row(const LightStack& stack, const RefineResult& result) {
  PictureRow row{kInput, kInput, result.initial_depth,
                 as_float(normals_from_depth(result.camera, result.initial_depth)), cv::Mat3f()};
  const auto lit = std::find_if(stack.frames.begin(), stack.frames.end(),
                                [](const Frame& frame) { return frame.light && has_color(frame); });
  if (lit == stack.frames.end()) return row;
  cv::resize(linear_color(stack, with_color(*lit)), row.albedo, result.depth.size(), 0, 0, cv::INTER_AREA);
  row.albedo.setTo(cv::Scalar::all(NAN), cv::Mat(result.depth == result.depth) == 0);
  return row;
}

PictureRow result_row(const TableVariant& variant, const RefineResult& result) {
  return {variant.name, variant.slug, result.depth, as_float(normals_from_depth(result.camera, result.depth)),
          result.albedo};
}

PictureRow truth_row(const GroundTruth& truth) {
  return {kTruth, kTruth, truth.depth, truth.normals, truth.albedo};
}

cv::Mat3b picture_sheet(const std::vector<PictureRow>& rows, const GroundTruth& truth, int width) {
  const double range_mm = range_of(rows, truth.depth);
  std::vector<cv::Mat3b> strips;
  int height = 0;
  for (const PictureRow& row : rows) {
    const auto pictures = pictures_of(row, truth.depth, range_mm);
    strips.push_back(strip(pictures, object_box(row.depth), row.name, width));
    height = std::max(height, strips.back().rows);
  }
  const int lines = (static_cast<int>(strips.size()) + 1) / 2;
  const cv::Mat3b scale = error_scale(width, range_mm);
  cv::Mat3b sheet(lines * height + scale.rows, 8 * width, cv::Vec3b::all(0));
  for (int k = 0; k < static_cast<int>(strips.size()); ++k) {
    const cv::Mat3b& each = strips[static_cast<std::size_t>(k)];
    each.copyTo(sheet(cv::Rect({(k % 2) * 4 * width, (k / 2) * height}, each.size())));
  }
  scale.copyTo(sheet(cv::Rect({7 * width, lines * height}, scale.size())));
  return sheet;
}

void write_table_pictures(const std::vector<PictureRow>& rows, const GroundTruth& truth,
                          const std::filesystem::path& folder) {
  AtomicFolder out(folder, pictures_kind());
  const double range_mm = range_of(rows, truth.depth);
  for (const PictureRow& row : rows) {
    const auto pictures = pictures_of(row, truth.depth, range_mm);
    for (std::size_t k = 0; k < kKinds.size(); ++k)
      write_png(out.path() / (row.slug + "-" + kKinds[k] + ".png"), pictures[k]);
  }
  write_png(out.path() / "error-scale.png", error_scale(256, range_mm));
  write_jpeg(out.path() / "sheet.jpg", picture_sheet(rows, truth, kSheetColumn));
  out.commit();
}

void check_pictures_folder(const std::filesystem::path& folder) {
  const AtomicFolder locked_for_a_moment(folder, pictures_kind());
}

}  // namespace rakelight
