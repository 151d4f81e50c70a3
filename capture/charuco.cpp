// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/charuco.h"

#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgproc.hpp>

#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr int kMarkers = 250;  // in the dictionary: 5 x 5 bits each

cv::Ptr<cv::aruco::CharucoBoard> opencv_board(const CharucoBoard& board) {
  return cv::aruco::CharucoBoard::create(board.columns, board.rows, static_cast<float>(board.square_m),
                                         static_cast<float>(board.marker_m),
                                         cv::aruco::getPredefinedDictionary(cv::aruco::DICT_5X5_250));
}

}  // namespace

void check_board(const CharucoBoard& board) {
  if (board.columns < 3 || board.rows < 3 || board.columns * board.rows > 2 * kMarkers) {
    throw UsageError("the board has " + std::to_string(board.columns) + " x " + std::to_string(board.rows) +
                     " squares; use 3 x 3 at least and " + std::to_string(2 * kMarkers) + " squares at most");
  }
  if (!(board.marker_m > 0 && board.marker_m < board.square_m)) {
    throw UsageError("the board's markers are not smaller than its squares; give both sizes as printed");
  }
}

cv::Mat1b draw_board(const CharucoBoard& board, int pixels_per_square) {
  cv::Mat1b picture;
  const cv::Size size((board.columns + 1) * pixels_per_square, (board.rows + 1) * pixels_per_square);
  opencv_board(board)->draw(size, picture, pixels_per_square / 2);
  return picture;
}

BoardView find_board(const cv::Mat1b& picture, const CharucoBoard& board, const std::string& name) {
  BoardView view{name, picture.size(), {}, {}};
  const auto known = opencv_board(board);
  const auto parameters = cv::aruco::DetectorParameters::create();
  std::vector<std::vector<cv::Point2f>> markers, rejected;
  std::vector<int> ids;
  cv::aruco::detectMarkers(picture, known->dictionary, markers, ids, parameters, rejected);
  cv::aruco::refineDetectedMarkers(picture, known, markers, ids, rejected);
  if (ids.empty()) return view;
  cv::aruco::interpolateCornersCharuco(markers, ids, picture, known, view.corners, view.ids);
  return view;
}

std::vector<cv::Point3f> board_points(const CharucoBoard& board, const std::vector<int>& ids) {
  const auto known = opencv_board(board);
  std::vector<cv::Point3f> points;
  for (const int id : ids) points.push_back(known->chessboardCorners.at(static_cast<std::size_t>(id)));
  return points;
}

cv::Mat3b draw_view(const cv::Mat1b& picture, const BoardView& view) {
  cv::Mat3b drawn;
  cv::cvtColor(picture, drawn, cv::COLOR_GRAY2RGB);
  if (!view.ids.empty())
    cv::aruco::drawDetectedCornersCharuco(drawn, view.corners, view.ids, cv::Scalar(255, 40, 40));
  return drawn;
}

}  // namespace rakelight
