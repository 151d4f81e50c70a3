// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/board_pictures.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "stack/errors.h"
#include "stack/image_file.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> png_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;  // a folder that is missing has no pictures
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".png") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

BoardView find_in(const fs::path& file, const CharucoBoard& board) {
  return find_board(read_gray_png(file), board, file.string());
}

/// A picture of fixed width with its corners, empty if there is no file.
cv::Mat3b thumbnail(const BoardView& view) {
  constexpr int kWidth = 320;
  if (view.size.empty()) return {};
  cv::Mat3b small;
  cv::resize(draw_view(read_gray_png(view.name), view), small,
             {kWidth, std::max(1, kWidth * view.size.height / view.size.width)}, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

BoardPictures find_boards(const fs::path& folder, const CharucoBoard& board) {
  BoardPictures pictures;
  const std::vector<std::string> names = png_names(folder / "color");
  if (names.empty()) {
    throw InputError((folder / "color").string(), "holds no picture",
                     "put pictures of the board there as PNG, and those of the depth camera under ir/");
  }
  for (const std::string& name : names) {
    pictures.color.push_back(find_in(folder / "color" / name, board));
    const bool paired = fs::exists(folder / "ir" / name);
    pictures.ir.push_back(paired ? find_in(folder / "ir" / name, board) : BoardView{});
    pictures.has_ir = pictures.has_ir || paired;
  }
  return pictures;
}

cv::Mat3b contact_sheet(const BoardPictures& pictures) {
  constexpr int kColumns = 4;
  std::vector<cv::Mat3b> tiles;
  cv::Size cell;
  for (const auto* views : {&pictures.color, &pictures.ir}) {
    for (const BoardView& view : *views) {
      const cv::Mat3b tile = thumbnail(view);
      if (tile.empty()) continue;
      cell = {std::max(cell.width, tile.cols), std::max(cell.height, tile.rows)};
      tiles.push_back(tile);
    }
  }
  const int count = static_cast<int>(tiles.size()), rows = (count + kColumns - 1) / kColumns;
  cv::Mat3b sheet(rows * cell.height, std::min(count, kColumns) * cell.width, cv::Vec3b(0, 0, 0));
  for (int k = 0; k < count; ++k) {
    const cv::Mat3b& tile = tiles[static_cast<std::size_t>(k)];
    tile.copyTo(sheet(cv::Rect(k % kColumns * cell.width, k / kColumns * cell.height, tile.cols, tile.rows)));
  }
  return sheet;
}

}  // namespace rakelight
