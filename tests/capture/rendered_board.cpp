// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/capture/rendered_board.h"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace rakelight::test {
namespace {

constexpr int kPixelsPerSquare = 60;
constexpr int kSamples = 3;  // a pixel and side
constexpr float kWall = 90;  // grey of what is behind the board

}  // namespace

std::vector<BoardPose> varied_poses() {
  std::vector<BoardPose> poses;
  for (int k = 0; k < 10; ++k) {
    const double turn = 2 * M_PI * k / 10;
    const Eigen::Vector3d axis(std::cos(turn), std::sin(turn), 0.3 * (k % 3 - 1));
    BoardPose pose = BoardPose::Identity();
    pose.linear() = Eigen::AngleAxisd(0.35 + 0.03 * k, axis.normalized()).toRotationMatrix();
    pose.translation() =
        Eigen::Vector3d(0.11 * std::cos(2 * turn + 0.5), 0.08 * std::sin(2 * turn + 0.5), 0.42 + 0.02 * k);
    poses.push_back(pose);
  }
  return poses;
}

cv::Mat1b render_board(const CharucoBoard& board, const BoardPose& T_camera_board, const Camera& camera) {
  const cv::Mat1b print = draw_board(board, kPixelsPerSquare);
  std::vector<cv::Point2d> samples, rays;
  for (int v = 0; v < kSamples * camera.height; ++v) {
    for (int u = 0; u < kSamples * camera.width; ++u)
      samples.emplace_back((u + 0.5) / kSamples - 0.5, (v + 0.5) / kSamples - 0.5);
  }
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  cv::undistortPoints(samples, rays, K, camera.distortion, cv::noArray(), cv::noArray(),
                      cv::TermCriteria(cv::TermCriteria::COUNT, 20, 0));
  // The board is z = 0 of its own frame: where does each ray meet it?
  const Eigen::Isometry3d T_board_camera = T_camera_board.inverse();
  const Eigen::Vector3d eye = T_board_camera.translation();
  cv::Mat2f map(kSamples * camera.height, kSamples * camera.width);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const Eigen::Vector3d ray = T_board_camera.linear() * Eigen::Vector3d(rays[k].x, rays[k].y, 1);
    const Eigen::Vector3d hit = eye - eye.z() / ray.z() * ray;
    const auto pixel = [&](double at, int squares) {
      return static_cast<float>((at / board.square_m + 0.5 * (squares + 1)) * kPixelsPerSquare - 0.5);
    };
    map(static_cast<int>(k) / map.cols, static_cast<int>(k) % map.cols) =
        cv::Vec2f(pixel(hit.x(), board.columns), pixel(hit.y(), board.rows));
  }
  cv::Mat1b fine, picture;
  cv::remap(print, fine, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(kWall));
  cv::resize(fine, picture, camera.size(), 0, 0, cv::INTER_AREA);
  return picture;
}

}  // namespace rakelight::test
