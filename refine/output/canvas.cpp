// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/canvas.h"

#include <cairo.h>

#include <opencv2/imgproc.hpp>

#include "stack/errors.h"

namespace rakelight {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void trace(cairo_t* context, const std::vector<cv::Point2d>& points) {
  cairo_new_path(context);
  for (const cv::Point2d& point : points) cairo_line_to(context, point.x, point.y);
}

}  // namespace

/// Cairo draws into memory of our own: blue, green, red, unused.
struct Canvas::Cairo {
  explicit Cairo(const cv::Size& size)
      : pixels(size, cv::Vec4b::all(255)),
        surface(cairo_image_surface_create_for_data(pixels.data, CAIRO_FORMAT_RGB24, size.width, size.height,
                                                    static_cast<int>(pixels.step)),
                &cairo_surface_destroy),
        context(cairo_create(surface.get()), &cairo_destroy) {
    if (cairo_status(context.get()) != CAIRO_STATUS_SUCCESS)
      throw IoError("cannot draw a figure: out of memory");
    cairo_select_font_face(context.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  }

  cv::Mat4b pixels;
  Surface surface;
  Context context;
};

Canvas::Canvas(const cv::Size& size) : cairo_(std::make_shared<Cairo>(size)) {}

double Canvas::width_of(const std::string& words, double size) {
  cairo_set_font_size(cairo_->context.get(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_->context.get(), words.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(const std::string& words, const cv::Point2d& at, double size, Align align) {
  const double width = width_of(words, size);
  cairo_t* context = cairo_->context.get();
  cairo_set_source_rgb(context, 0, 0, 0);
  cairo_move_to(context,
                at.x - (align == Align::left     ? 0
                        : align == Align::middle ? width / 2
                                                 : width),
                at.y);
  cairo_show_text(context, words.c_str());
}

void Canvas::line(const std::vector<cv::Point2d>& points, const cv::Vec3d& color, double width) {
  cairo_t* context = cairo_->context.get();
  trace(context, points);
  cairo_set_source_rgb(context, color[0], color[1], color[2]);
  cairo_set_line_width(context, width);
  cairo_stroke(context);
}

void Canvas::area(const std::vector<cv::Point2d>& points, const cv::Vec3d& color, double opacity) {
  cairo_t* context = cairo_->context.get();
  trace(context, points);
  cairo_set_source_rgba(context, color[0], color[1], color[2], opacity);
  cairo_fill(context);
}

void Canvas::picture(const cv::Mat3b& rgb, const cv::Rect2d& box) {
  cairo_surface_flush(cairo_->surface.get());
  const cv::Rect target(cvRound(box.x), cvRound(box.y), cvRound(box.width), cvRound(box.height));
  cv::Mat scaled;
  cv::resize(rgb, scaled, target.size(), 0, 0, target.width < rgb.cols ? cv::INTER_AREA : cv::INTER_NEAREST);
  cv::cvtColor(scaled, scaled, cv::COLOR_RGB2BGRA);
  scaled.copyTo(cairo_->pixels(target));
  cairo_surface_mark_dirty(cairo_->surface.get());
}

cv::Mat3b Canvas::pixels() const {
  cairo_surface_flush(cairo_->surface.get());
  cv::Mat3b rgb;
  cv::cvtColor(cairo_->pixels, rgb, cv::COLOR_BGRA2RGB);
  return rgb;
}

}  // namespace rakelight
