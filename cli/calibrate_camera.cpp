// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/camera_calibration.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>

#include "capture/board_pictures.h"
#include "cli/calibrate.h"
#include "stack/errors.h"
#include "stack/image_file.h"

namespace rakelight::cli {
namespace {

using json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct Board {
  std::string squares = "7x5";
  double square_mm = 30, marker_mm = 22;
};
struct Arguments {
  fs::path views, picture;
  Board board;
};

constexpr const char* kCameraFooter =
    R"(VIEWS holds color/NAME.png and, taken at the same moment, ir/NAME.png (the depth camera's infrared picture, in
the size of its depth). Without ir/ only the colour camera is calibrated. A stack of the board will do, too.

Examples:
  rakelight calibrate camera views                                      prints what it finds
  rakelight calibrate camera views --rig my-rig.toml --picture seen.png    stores it; seen.png shows the corners
  rakelight calibrate camera views --squares 9x6 --square-mm 24.6 --marker-mm 18)";

constexpr const char* kBoardFooter = R"(Examples:
  rakelight calibrate board -o board.png                 7 x 5 squares; print it and measure a square
  rakelight calibrate board -o board.png --squares 9x6)";

void add_board_options(CLI::App& command, Board& board) {
  command.add_option("--squares", board.squares, "Squares of the board; default: 7x5")->type_name("CxR");
  command.add_option("--square-mm", board.square_mm, "Side of a square as printed; default: 30")
      ->type_name("MM");
  command.add_option("--marker-mm", board.marker_mm, "Side of a marker as printed; default: 22")
      ->type_name("MM");
}

CharucoBoard board_of(const Board& arguments) {
  CharucoBoard board;
  char more = 0;
  if (std::sscanf(arguments.squares.c_str(), "%3dx%3d%c", &board.columns, &board.rows, &more) != 2)
    throw UsageError("--squares is " + arguments.squares + "; give COLUMNSxROWS, such as 7x5");
  board.square_m = arguments.square_mm / 1000;
  board.marker_m = arguments.marker_mm / 1000;
  check_board(board);
  return board;
}

/// Replaces an older picture.
void write_picture(const fs::path& file, const cv::Mat& picture) {
  std::error_code ignored;
  if (fs::is_regular_file(file, ignored)) fs::remove(file, ignored);
  write_png(file, picture);
}

std::string camera_text(const char* name, const CameraFit& fit) {
  const Camera& c = fit.camera;
  const Eigen::Vector4d& s = fit.deviation_px;
  char text[320];
  std::snprintf(text, sizeof text,
                "%s: %d x %d, fx %.2f +- %.2f, fy %.2f +- %.2f, cx %.2f +- %.2f, cy %.2f +- %.2f\n"
                "  %zu views, reprojection error %.3f px, corners in %.0f %% of the picture\n",
                name, c.width, c.height, c.fx, s[0], c.fy, s[1], c.cx, s[2], c.cy, s[3], fit.views.size(),
                fit.rms_px, 100 * fit.covered);
  return text;
}

json camera_json(const CameraFit& fit) {
  const Camera& c = fit.camera;
  json views = json::array();
  for (std::size_t k = 0; k < fit.views.size(); ++k)
    views.push_back({{"picture", fit.views[k]}, {"reprojection_px", fit.view_rms_px[k]}});
  return {{"width", c.width},
          {"height", c.height},
          {"fx", c.fx},
          {"fy", c.fy},
          {"cx", c.cx},
          {"cy", c.cy},
          {"distortion", c.distortion},
          {"deviation_px", std::vector<double>(fit.deviation_px.begin(), fit.deviation_px.end())},
          {"reprojection_px", fit.rms_px},
          {"covered", fit.covered},
          {"views", views}};
}

std::string pair_text(const PairFit& pair) {
  const Eigen::Vector3d t = 1000 * pair.T_color_depth.topRightCorner<3, 1>();
  char text[160];
  std::snprintf(text, sizeof text,
                "depth to colour: %.2f, %.2f, %.2f mm; %d pairs, reprojection error %.3f px\n", t.x(), t.y(),
                t.z(), pair.pairs, pair.rms_px);
  return text;
}

json pair_json(const PairFit& pair) {
  json rows = json::array();
  for (int r = 0; r < 4; ++r) {
    const Eigen::Vector4d row = pair.T_color_depth.row(r);
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return {{"T_color_depth", rows}, {"pairs", pair.pairs}, {"reprojection_px", pair.rms_px}};
}

void warn_of(const std::string& name, const CameraFit& fit) {
  constexpr double kWellCovered = 0.7, kGoodFit_px = 0.7;
  if (fit.covered < kWellCovered)
    spdlog::warn(
        "{}: few corners near the picture's edges: distortion there is a guess; hold the board there too",
        name);
  if (fit.rms_px > kGoodFit_px)
    spdlog::warn("{}: a large reprojection error: is the board flat, and are pictures sharp?", name);
}

void run(const Arguments& arguments, const CalibrateTarget& target) {
  const CharucoBoard board = board_of(arguments.board);
  const BoardPictures pictures = find_boards(arguments.views, board);
  if (!arguments.picture.empty()) write_picture(arguments.picture, contact_sheet(pictures));
  const CameraFit color = calibrate_camera(pictures.color, board);
  warn_of("colour camera", color);
  std::string text = camera_text("colour camera", color);
  json result = {{"color_camera", camera_json(color)}};
  std::optional<CameraFit> depth;
  std::optional<PairFit> pair;
  if (pictures.has_ir) {
    std::vector<BoardView> seen;  // calibrate_camera passes over empty views, but they have no size
    for (const BoardView& view : pictures.ir)
      if (!view.size.empty()) seen.push_back(view);
    depth = calibrate_camera(seen, board);
    warn_of("depth camera", *depth);
    pair = calibrate_pair(pictures.color, color.camera, pictures.ir, depth->camera, board);
    text += camera_text("depth camera", *depth) + pair_text(*pair);
    result["depth_camera"] = camera_json(*depth);
    result["pair"] = pair_json(*pair);
  }
  store(target, [&](Rig& rig) {
    rig.calibration.color_camera = color.camera;
    if (!depth) return;
    rig.calibration.depth_camera = depth->camera;
    rig.calibration.T_color_depth = pair->T_color_depth;
  });
  print_result(target, text, result);
}

}  // namespace

void add_calibrate_camera(CLI::App& calibrate, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = calibrate.add_subcommand(
      "camera", "Both cameras and the motion between them, from pictures of a ChArUco board");
  command->footer(kCameraFooter);
  command->add_option("VIEWS", arguments->views, "Folder of pictures")->required();
  add_board_options(*command, arguments->board);
  command->add_option("--picture", arguments->picture, "Write a picture of all views with the corners found")
      ->type_name("FILE.png");
  auto target = add_target(*command);
  command->callback([arguments, target, &exit_code] {
    run(*arguments, *target);
    exit_code = 0;
  });
}

void add_calibrate_board(CLI::App& calibrate, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = calibrate.add_subcommand("board", "Write a ChArUco board to print");
  command->footer(kBoardFooter);
  command->add_option("-o,--output", arguments->picture, "Picture to write")
      ->required()
      ->type_name("FILE.png");
  add_board_options(*command, arguments->board);
  command->callback([arguments, &exit_code] {
    constexpr int kPixelsPerMm = 12;  // about 300 dpi
    const CharucoBoard board = board_of(arguments->board);
    write_picture(arguments->picture,
                  draw_board(board, static_cast<int>(arguments->board.square_mm * kPixelsPerMm)));
    exit_code = 0;
  });
}

}  // namespace rakelight::cli
