// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/LU>
#include <cmath>

#include "capture/rig_calibration_file.h"

namespace rakelight {
namespace {

constexpr double kMaxPixels = 1e6;
constexpr double kMaxMetres = 100;

std::optional<Camera> read_camera(TomlReader& calibration, const std::string& key) {
  auto table = calibration.table(key);
  if (!table) return {};
  const auto required = [&](const std::string& name, double least) {
    const auto value = table->number(name, least, kMaxPixels);
    if (!value) table->refuse(name, "is missing", "write all of width, height, fx, fy, cx and cy");
    return *value;
  };
  Camera camera;
  camera.width = static_cast<int>(required("width", 1));
  camera.height = static_cast<int>(required("height", 1));
  camera.fx = required("fx", 1);
  camera.fy = required("fy", 1);
  camera.cx = required("cx", -kMaxPixels);
  camera.cy = required("cy", -kMaxPixels);
  camera.distortion = table->numbers("distortion", -1e3, 1e3).value_or(std::vector<double>{});
  const std::size_t count = camera.distortion.size();
  if (count != 0 && count != 4 && count != 5 && count != 8) {
    table->refuse("distortion", "does not have 0, 4, 5 or 8 coefficients", "write k1 k2 p1 p2 k3 k4 k5 k6");
  }
  table->refuse_unknown();
  return camera;
}

template <int N>
std::optional<Eigen::Matrix<double, N, N>> read_square(TomlReader& calibration, const std::string& key) {
  const auto rows = calibration.rows(key, -kMaxMetres, kMaxMetres);
  if (!rows) return {};
  const std::string size = std::to_string(N);
  if (rows->size() != N || rows->front().size() != N) {
    calibration.refuse(key, "is no matrix of " + size + " x " + size, "write " + size + " rows");
  }
  Eigen::Matrix<double, N, N> matrix;
  for (std::size_t r = 0; r < N; ++r) {
    for (std::size_t c = 0; c < N; ++c) matrix(Eigen::Index(r), Eigen::Index(c)) = (*rows)[r][c];
  }
  return matrix;
}

void check_rigid(const TomlReader& calibration, const Eigen::Matrix4d& motion) {
  const Eigen::Matrix3d R = motion.topLeftCorner<3, 3>();
  const bool last_row = motion.row(3) == Eigen::RowVector4d(0, 0, 0, 1);
  if (!last_row || !(R * R.transpose()).isIdentity(1e-6) || R.determinant() < 0) {
    calibration.refuse("T_color_depth", "is no rigid motion", "write a rotation, a translation and 0 0 0 1");
  }
}

std::optional<ColorResponse> read_response(TomlReader& calibration) {
  if (calibration.is_text("color_response")) {
    const std::string name = *calibration.text("color_response");
    if (name == "linear") return ColorResponse{};
    if (name == "srgb") return ColorResponse{ColorResponse::Kind::srgb, 1.0};
    calibration.refuse("color_response", "is no response", "write \"linear\", \"srgb\" or { gamma = 2.2 }");
  }
  auto table = calibration.table("color_response");
  if (!table) return {};
  const auto gamma = table->number("gamma", 0.1, 10);
  if (!gamma) table->refuse("gamma", "is missing", "write { gamma = 2.2 }");
  table->refuse_unknown();
  return ColorResponse{ColorResponse::Kind::gamma, *gamma};
}

}  // namespace

RigCalibration read_calibration(TomlReader& file) {
  RigCalibration result;
  auto table = file.table("calibration");
  if (!table) return result;
  result.color_camera = read_camera(*table, "color_camera");
  result.depth_camera = read_camera(*table, "depth_camera");
  result.T_color_depth = read_square<4>(*table, "T_color_depth");
  if (result.T_color_depth) check_rigid(*table, *result.T_color_depth);
  result.color_response = read_response(*table);
  result.color_crosstalk = read_square<3>(*table, "color_crosstalk");
  if (result.color_crosstalk && std::abs(result.color_crosstalk->determinant()) < 1e-6) {
    table->refuse("color_crosstalk", "cannot be undone (it is singular)", "measure it again");
  }
  table->refuse_unknown();
  return result;
}

}  // namespace rakelight
