// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "stack/image_file.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/offscreen_context.h"
#include "viewer/gl/scene_renderer.h"
#include "viewer/viewer.h"
#include "viewer/window/legend.h"

namespace rakelight {
namespace {

constexpr double kTurn = 2 * 3.14159265358979323846;

/// surface.png becomes surface0007.png.
std::filesystem::path numbered(const std::filesystem::path& file, int number) {
  char digits[16];
  std::snprintf(digits, sizeof digits, "%04d", number);
  std::filesystem::path result = file;
  return result.replace_filename(file.stem().string() + digits + file.extension().string());
}

/// Whole or not at all; a picture that is there is replaced.
void write_picture(const std::filesystem::path& file, const cv::Mat3b& picture) {
  std::filesystem::path partial = file;
  partial.replace_filename("." + file.filename().string() + ".partial");
  std::filesystem::remove(partial);  // left by a crash
  write_png(partial, picture);
  std::filesystem::rename(partial, file);
}

}  // namespace

PictureReport save_pictures(const Scene& scene, const Look& look, const ViewPoint& view,
                            const PictureOptions& options) {
  check_look(scene, look);
  Surfaces surfaces(scene);
  const auto context = make_offscreen_context();
  const Framebuffer framebuffer(options.size);
  SceneRenderer renderer(surfaces);
  const OffscreenLegend legend;
  const double aspect = static_cast<double>(options.size.width) / options.size.height;
  OrbitCamera camera = camera_at(view, surfaces.bounds(), aspect);
  PictureReport report;
  report.path = context->path();
  const int pictures = std::max(1, options.turntable);
  for (int i = 0; i < pictures; ++i) {
    renderer.draw(look, camera, options.size);
    if (options.legend) legend.draw(surfaces.range(look.coloring), look, options.size);
    report.files.push_back(options.turntable > 0 ? numbered(options.file, i) : options.file);
    write_picture(report.files.back(), framebuffer.read());
    camera.azimuth += kTurn / pictures;
  }
  return report;
}

}  // namespace rakelight
