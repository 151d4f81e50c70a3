// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/capture/rendered_board.h"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace rakelight::test {
namespace {

constexpr int kPixelsPerSquare = 60;
constexpr int kSamples = 2;  // a pixel and side
constexpr float kWall = 90;  // grey of what is behind the board

/// Rays (x/z, y/z) of kSamples x kSamples samples a pixel: exact at pixel centres, linear between.
cv::Mat2f sample_rays(const Camera& camera) {
  std::vector<cv::Point2d> pixels, rays;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) pixels.emplace_back(u, v);
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  cv::undistortPoints(pixels, rays, K, camera.distortion);
  cv::Mat2f samples;
  cv::Mat2f(cv::Mat(rays).reshape(2, camera.height)).copyTo(samples);
  cv::resize(samples, samples, camera.size() * kSamples, 0, 0, cv::INTER_LINEAR);
  return samples;
}

}  // namespace

std::vector<BoardPose> varied_poses() {
  std::vector<BoardPose> poses;
  for (int k = 0; k < 14; ++k) {
    const double turn = 2 * M_PI * k / 14;
    const Eigen::Vector3d axis(std::cos(turn), std::sin(turn), 0.3 * (k % 3 - 1));
    BoardPose pose = BoardPose::Identity();
    pose.linear() = Eigen::AngleAxisd(0.4 + 0.02 * k, axis.normalized()).toRotationMatrix();
    pose.translation() =
        Eigen::Vector3d(0.11 * std::cos(2 * turn + 0.5), 0.08 * std::sin(2 * turn + 0.5), 0.36 + 0.012 * k);
    poses.push_back(pose);
  }
  return poses;
}

cv::Mat1b render_board(const CharucoBoard& board, const BoardPose& T_camera_board, const Camera& camera) {
  const cv::Mat1b print = draw_board(board, kPixelsPerSquare);
  const cv::Mat2f rays = sample_rays(camera);
  // The board is z = 0 of its own frame: where does each ray meet it?
  const Eigen::Isometry3d T_board_camera = T_camera_board.inverse();
  const Eigen::Vector3d eye = T_board_camera.translation();
  cv::Mat2f map(rays.size());
  for (int k = 0; k < map.rows * map.cols; ++k) {
    const cv::Vec2d direction = rays(k / map.cols, k % map.cols);
    const Eigen::Vector3d ray = T_board_camera.linear() * Eigen::Vector3d(direction[0], direction[1], 1);
    const Eigen::Vector3d hit = eye - eye.z() / ray.z() * ray;
    const auto pixel = [&](double at, int squares) {
      return static_cast<float>((at / board.square_m + 0.5 * (squares + 1)) * kPixelsPerSquare - 0.5);
    };
    map(k / map.cols, k % map.cols) = cv::Vec2f(pixel(hit.x(), board.columns), pixel(hit.y(), board.rows));
  }
  cv::Mat1b fine, picture;
  cv::remap(print, fine, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(kWall));
  cv::resize(fine, picture, camera.size(), 0, 0, cv::INTER_AREA);
  return picture;
}

}  // namespace rakelight::test
