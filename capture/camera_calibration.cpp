// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/camera_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/calib3d.hpp>
#include <set>

#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr std::size_t kFewestCorners = 8;  // a homography and some to spare
constexpr std::size_t kFewestViews = 5, kFewestPairs = 3;
constexpr double kLargestDeviation = 0.02;  // of a focal length, as a share of it

using Points2 = std::vector<std::vector<cv::Point2f>>;
using Points3 = std::vector<std::vector<cv::Point3f>>;

cv::Matx33d intrinsics(const Camera& camera) {
  return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}

const std::string kMoreViews =
    "take 10 to 20 pictures that show the whole board large, tilted by up to 45 degrees each way";

void check_sizes(const std::vector<BoardView>& views) {
  for (const BoardView& view : views) {
    if (view.size != views.front().size)
      throw InputError(view.name, "has another size than " + views.front().name,
                       "calibrate one mode at a time");
  }
}

/// Share of a 4 x 4 raster that has corners: where there are none, distortion is extrapolated.
double covered_share(const Points2& corners, cv::Size size) {
  constexpr int kCells = 4;
  std::set<std::pair<int, int>> cells;
  for (const auto& view : corners) {
    for (const cv::Point2f& corner : view) {
      const auto cell = [](float at, int length) {
        return std::clamp(static_cast<int>(kCells * at / static_cast<float>(length)), 0, kCells - 1);
      };
      cells.emplace(cell(corner.x, size.width), cell(corner.y, size.height));
    }
  }
  return static_cast<double>(cells.size()) / (kCells * kCells);
}

/// Views of one tilt cannot tell focal length from distance, however small their residuals are.
void check_tilts(const std::vector<cv::Mat>& rotations) {
  constexpr double kLeast = 15 * CV_PI / 180;
  std::vector<cv::Vec3d> normals;
  for (const cv::Mat& rotation : rotations) {
    cv::Matx33d R;
    cv::Rodrigues(rotation, R);
    normals.emplace_back(R(0, 2), R(1, 2), R(2, 2));
  }
  double least_cosine = 1;
  for (const cv::Vec3d& a : normals)
    for (const cv::Vec3d& b : normals) least_cosine = std::min(least_cosine, a.dot(b));
  if (least_cosine < std::cos(kLeast)) return;
  throw InputError("the views", "show the board at one tilt, which tells nothing of the focal length",
                   kMoreViews);
}

void check_determined(const CameraFit& fit) {
  const double worst = std::max(fit.deviation_px[0] / fit.camera.fx, fit.deviation_px[1] / fit.camera.fy);
  if (worst < kLargestDeviation) return;
  char text[96];
  std::snprintf(text, sizeof text, "determine the focal length to %.0f %% only", 100 * worst);
  throw InputError("the views", text, kMoreViews);
}

/// Corners both views have, with their board points.
void add_common(const BoardView& color, const BoardView& depth, const CharucoBoard& board, Points3& objects,
                Points2& color_corners, Points2& depth_corners) {
  std::vector<int> ids;
  std::vector<cv::Point2f> in_color, in_depth;
  for (std::size_t k = 0; k < color.ids.size(); ++k) {
    const auto same = std::find(depth.ids.begin(), depth.ids.end(), color.ids[k]);
    if (same == depth.ids.end()) continue;
    ids.push_back(color.ids[k]);
    in_color.push_back(color.corners[k]);
    in_depth.push_back(depth.corners[static_cast<std::size_t>(same - depth.ids.begin())]);
  }
  if (ids.size() < kFewestCorners) return;
  objects.push_back(board_points(board, ids));
  color_corners.push_back(in_color);
  depth_corners.push_back(in_depth);
}

}  // namespace

CameraFit calibrate_camera(const std::vector<BoardView>& views, const CharucoBoard& board) {
  check_sizes(views);
  CameraFit fit;
  Points3 objects;
  Points2 corners;
  for (const BoardView& view : views) {
    if (view.ids.size() < kFewestCorners) continue;
    fit.views.push_back(view.name);
    objects.push_back(board_points(board, view.ids));
    corners.push_back(view.corners);
  }
  if (corners.size() < kFewestViews) {
    throw InputError(views.empty() ? "the folder" : views.front().name + " and the others",
                     std::to_string(corners.size()) + " of " + std::to_string(views.size()) +
                         " pictures show the board, which is too few",
                     kMoreViews + "; check --squares");
  }
  const cv::Size size = views.front().size;
  cv::Mat K, distortion, deviations, view_errors;
  std::vector<cv::Mat> rotations, translations;
  fit.rms_px = cv::calibrateCamera(objects, corners, size, K, distortion, rotations, translations, deviations,
                                   cv::noArray(), view_errors, cv::CALIB_FIX_K3);
  const cv::Mat1d k = K, d = distortion, s = deviations, e = view_errors;
  fit.camera = {size.width, size.height, k(0, 0), k(1, 1), k(0, 2), k(1, 2), {d(0), d(1), d(2), d(3)}};
  fit.deviation_px = {s(0), s(1), s(2), s(3)};
  fit.view_rms_px.assign(e.begin(), e.end());
  fit.covered = covered_share(corners, size);
  check_tilts(rotations);
  check_determined(fit);
  return fit;
}

PairFit calibrate_pair(const std::vector<BoardView>& color, const Camera& color_camera,
                       const std::vector<BoardView>& depth, const Camera& depth_camera,
                       const CharucoBoard& board) {
  Points3 objects;
  Points2 color_corners, depth_corners;
  for (std::size_t k = 0; k < std::min(color.size(), depth.size()); ++k)
    add_common(color[k], depth[k], board, objects, color_corners, depth_corners);
  if (objects.size() < kFewestPairs) {
    throw InputError("the pairs of pictures",
                     std::to_string(objects.size()) + " show the board in both, which is too few",
                     "hold the board where both cameras see it");
  }
  cv::Mat K_depth(intrinsics(depth_camera)), K_color(intrinsics(color_camera));
  cv::Mat d_depth(depth_camera.distortion, true), d_color(color_camera.distortion, true);
  cv::Mat R, t, essential, fundamental;
  PairFit fit;
  fit.rms_px =
      cv::stereoCalibrate(objects, depth_corners, color_corners, K_depth, d_depth, K_color, d_color,
                          color_camera.size(), R, t, essential, fundamental, cv::CALIB_FIX_INTRINSIC);
  fit.T_color_depth.setIdentity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) fit.T_color_depth(r, c) = R.at<double>(r, c);
    fit.T_color_depth(r, 3) = t.at<double>(r);
  }
  fit.pairs = static_cast<int>(objects.size());
  return fit;
}

}  // namespace rakelight
