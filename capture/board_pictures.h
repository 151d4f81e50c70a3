// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A folder of pictures of a ChArUco board: color/NAME.png and, taken at the same moment, ir/NAME.png.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

#include "capture/charuco.h"

namespace rakelight {

struct BoardPictures {
  std::vector<BoardView> color;
  std::vector<BoardView> ir;  ///< [k] belongs to color[k]; empty views where there is no such picture
  bool has_ir = false;
};

/// Finds the board in every picture. @throws InputError if there is no color/*.png or a picture is damaged; IoError
BoardPictures find_boards(const std::filesystem::path& folder, const CharucoBoard& board);

/// All pictures small, read again and put beside each other, with the corners found; RGB. @throws as find_boards
cv::Mat3b contact_sheet(const BoardPictures& pictures);

}  // namespace rakelight
