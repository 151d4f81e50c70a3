// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/camera_calibration.h"

#include <gmock/gmock.h>

#include "stack/errors.h"
#include "tests/capture/rendered_board.h"
#include "tests/support/message_of.h"

namespace rakelight::test {
namespace {

using testing::HasSubstr;

const CharucoBoard kBoard;
const Camera kColor{640, 480, 575.3, 577.1, 325.4, 236.2, {0.08, -0.15, 0.001, -0.0015}};
const Camera kDepth{640, 480, 571.0, 570.2, 316.3, 243.8, {-0.05, 0.06, 0.0, 0.0}};

/// Depth to colour: 25 mm to the side, turned by about a degree.
Eigen::Isometry3d color_from_depth() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(0.018, Eigen::Vector3d(0.3, 1, -0.2).normalized()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(-0.0251, 0.0006, -0.0012);
  return T;
}

std::vector<BoardView> views(const Camera& camera, const Eigen::Isometry3d& T_camera_color) {
  std::vector<BoardView> found;
  for (const BoardPose& pose : varied_poses()) {
    const std::string name = "view " + std::to_string(found.size());
    found.push_back(find_board(render_board(kBoard, T_camera_color * pose, camera), kBoard, name));
  }
  return found;
}

const std::vector<BoardView>& color_views() {
  static const auto found = views(kColor, Eigen::Isometry3d::Identity());
  return found;
}

TEST(CameraCalibration, FindsTheCameraThatTookThePictures) {
  const CameraFit fit = calibrate_camera(color_views(), kBoard);
  EXPECT_GE(fit.views.size(), 12u);
  EXPECT_LT(fit.rms_px, 0.15);
  const Eigen::Vector4d error(fit.camera.fx - kColor.fx, fit.camera.fy - kColor.fy, fit.camera.cx - kColor.cx,
                              fit.camera.cy - kColor.cy);
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 3.0) << error.transpose();
  EXPECT_LT(error.cwiseQuotient(fit.deviation_px).cwiseAbs().maxCoeff(), 3.0) << "in standard deviations";
  ASSERT_EQ(fit.camera.distortion.size(), 4u);
  EXPECT_NEAR(fit.camera.distortion[0], kColor.distortion[0], 0.02);
  EXPECT_LT(fit.deviation_px.maxCoeff(), 3.0);
  EXPECT_GE(fit.covered, 0.9);
}

TEST(CameraCalibration, FindsTheMotionBetweenTheCameras) {
  const auto& color = color_views();
  const auto depth = views(kDepth, color_from_depth().inverse());
  const PairFit pair = calibrate_pair(color, calibrate_camera(color, kBoard).camera, depth,
                                      calibrate_camera(depth, kBoard).camera, kBoard);
  EXPECT_GE(pair.pairs, 8);
  EXPECT_LT(pair.rms_px, 0.2);
  const Eigen::Isometry3d found(pair.T_color_depth);
  const Eigen::Isometry3d error = found * color_from_depth().inverse();
  EXPECT_LT(error.translation().norm(), 0.0015) << found.matrix();
  EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.003);
}

TEST(CameraCalibration, FindsCornersOfABoardThatIsPartlyOutside) {
  BoardPose pose = BoardPose::Identity();
  pose.translation() = Eigen::Vector3d(0.2, 0, 0.4);
  const BoardView view = find_board(render_board(kBoard, pose, kColor), kBoard, "half");
  EXPECT_GT(view.ids.size(), 4u);
  EXPECT_LT(view.ids.size(), 24u);
}

TEST(CameraCalibration, RefusesTooFewPictures) {
  auto some = color_views();
  some.resize(4);
  some.push_back({"wall", kColor.size(), {}, {}});
  EXPECT_THAT(message_of<InputError>([&] { calibrate_camera(some, kBoard); }),
              HasSubstr("4 of 5 pictures show the board"));
}

TEST(CameraCalibration, RefusesABoardThatWasNeverTilted) {
  std::vector<BoardView> flat;
  for (int k = 0; k < 6; ++k) {
    BoardPose pose = BoardPose::Identity();
    pose.translation() = Eigen::Vector3d(0.01 * k, -0.01 * k, 0.45);
    flat.push_back(find_board(render_board(kBoard, pose, kColor), kBoard, "flat"));
  }
  EXPECT_THAT(message_of<InputError>([&] { calibrate_camera(flat, kBoard); }), HasSubstr("at one tilt"));
}

TEST(CameraCalibration, RefusesPicturesOfTwoSizes) {
  auto mixed = color_views();
  mixed[3].size = {1280, 960};
  EXPECT_THAT(message_of<InputError>([&] { calibrate_camera(mixed, kBoard); }),
              HasSubstr("view 3: has another size"));
}

TEST(CameraCalibration, RefusesBoardsThatCannotBePrinted) {
  EXPECT_THROW(check_board({7, 5, 0.02, 0.02}), UsageError);
  EXPECT_THROW(check_board({2, 5, 0.03, 0.02}), UsageError);
  EXPECT_NO_THROW(check_board(kBoard));
}

}  // namespace
}  // namespace rakelight::test
