// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ChArUco boards: a chessboard whose white squares bear markers, so that its corners are known even when part of it is
// hidden or outside the picture.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace rakelight {

struct CharucoBoard {
  int columns = 7, rows = 5;  ///< squares
  double square_m = 0.03;     ///< side of a square
  double marker_m = 0.022;    ///< side of a marker
};

/// Where a board's inner corners were seen in one picture.
struct BoardView {
  std::string name;                  ///< of the picture
  cv::Size size;                     ///< of the picture
  std::vector<int> ids;              ///< of the corners, rising
  std::vector<cv::Point2f> corners;  ///< pixels, centres at whole numbers
};

/// @throws UsageError if the board cannot exist
void check_board(const CharucoBoard& board);

/// The board as a picture to print, with a white border of half a square.
cv::Mat1b draw_board(const CharucoBoard& board, int pixels_per_square);

/// The corners of the board in a picture; none if it is not found.
BoardView find_board(const cv::Mat1b& picture, const CharucoBoard& board, const std::string& name);

/// Board coordinates of a view's corners, metres: x along columns, y along rows, z = 0.
std::vector<cv::Point3f> board_points(const CharucoBoard& board, const std::vector<int>& ids);

/// The picture with its corners drawn, RGB.
cv::Mat3b draw_view(const cv::Mat1b& picture, const BoardView& view);

}  // namespace rakelight
