// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/plots.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "viewer/color_map.h"
#include "viewer/look.h"

namespace rakelight {
namespace {

const cv::Vec3b kBefore(240, 160, 70), kAfter(90, 180, 250), kOther(150, 220, 130);

ImU32 im_color(const cv::Vec3b& c) { return IM_COL32(c[0], c[1], c[2], 255); }

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// The box of data that the plot shows.
struct Extent {
  double left = 0, right = 1, bottom = 0, top = 1;
};

Extent extent_of(const std::vector<Curve>& curves) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Extent extent{kInfinity, -kInfinity, kInfinity, -kInfinity};
  for (const Curve& curve : curves) {
    for (const cv::Point2d& p : curve.points) {
      if (!std::isfinite(p.y)) continue;
      extent = {std::min(extent.left, p.x), std::max(extent.right, p.x), std::min(extent.bottom, p.y),
                std::max(extent.top, p.y)};
    }
  }
  if (!(extent.left <= extent.right)) return {};
  if (extent.left == extent.right) extent.right = extent.left + 1;
  const double room = std::max(0.06 * (extent.top - extent.bottom), 1e-6 * (1 + std::abs(extent.top)));
  return {extent.left, extent.right, extent.bottom - room, extent.top + room};
}

class Plot {
 public:
  Plot(const Extent& extent, const ImVec2& low, const ImVec2& high)
      : extent_(extent), low_(low), high_(high), list_(*ImGui::GetWindowDrawList()) {}

  ImVec2 at(const cv::Point2d& p) const {
    const double u = (p.x - extent_.left) / (extent_.right - extent_.left);
    const double v = (p.y - extent_.bottom) / (extent_.top - extent_.bottom);
    return {low_.x + static_cast<float>(u) * (high_.x - low_.x),
            high_.y - static_cast<float>(v) * (high_.y - low_.y)};
  }

  void axes() {
    const ImU32 grid = IM_COL32(255, 255, 255, 40), ink = IM_COL32(210, 210, 210, 255);
    const float line = ImGui::GetFontSize();
    for (const double x : ticks({ColorScale::sequential, extent_.left, extent_.right, "", ""})) {
      const float px = at({x, extent_.bottom}).x;
      list_.AddLine({px, low_.y}, {px, high_.y}, grid);
      list_.AddText({px - ImGui::CalcTextSize(number(x).c_str()).x / 2, high_.y + 0.2f * line}, ink,
                    number(x).c_str());
    }
    for (const double y : ticks({ColorScale::sequential, extent_.bottom, extent_.top, "", ""})) {
      const float py = at({extent_.left, y}).y;
      list_.AddLine({low_.x, py}, {high_.x, py}, grid);
      const float width = ImGui::CalcTextSize(number(y).c_str()).x;
      list_.AddText({low_.x - width - 0.3f * line, py - line / 2}, ink, number(y).c_str());
    }
  }

  void curve(const Curve& curve) {
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      const cv::Point2d &a = curve.points[i - 1], &b = curve.points[i];
      if (std::isfinite(a.y) && std::isfinite(b.y)) list_.AddLine(at(a), at(b), im_color(curve.color), 1.6f);
    }
  }

 private:
  Extent extent_;
  ImVec2 low_, high_;
  ImDrawList& list_;
};

void begin(const char* title, bool* open, const ImVec2& at, const ImVec2& pivot) {
  const float line = ImGui::GetFontSize();
  ImGui::SetNextWindowPos(at, ImGuiCond_FirstUseEver, pivot);
  ImGui::SetNextWindowSize({32 * line, 15 * line}, ImGuiCond_FirstUseEver);
  ImGui::Begin(title, open, ImGuiWindowFlags_NoFocusOnAppearing);
}

Curve profile_curve(const Scene& scene, LayerKind kind, const ViewState& state, const cv::Vec3b& color) {
  Curve curve{name_of(kLayerNames, kind), color, {}};
  for (const ProfilePoint& p : profile_of(*scene.find(kind), state.points[0], state.points[1]))
    curve.points.emplace_back(p.along_mm, p.height_mm);
  return curve;
}

template <class Value>
Curve history(const Scene& scene, const char* name, const cv::Vec3b& color, const Value& value) {
  Curve curve{name, color, {}};
  for (const IterationReport& iteration : scene.iterations)
    curve.points.emplace_back(iteration.index, std::log10(value(iteration)));
  return curve;
}

}  // namespace

void draw_plot(const std::vector<Curve>& curves, const std::string& x_label, const std::string& y_label) {
  const float line = ImGui::GetFontSize();
  ImGui::TextUnformatted(y_label.c_str());
  for (const Curve& curve : curves) {
    ImGui::SameLine(0, 1.5f * line);
    ImGui::PushStyleColor(ImGuiCol_Text, im_color(curve.color));
    ImGui::TextUnformatted(curve.name.c_str());
    ImGui::PopStyleColor();
  }
  const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  const ImVec2 low(corner.x + 3.5f * line, corner.y),
      high(corner.x + room.x - line, corner.y + room.y - 2.6f * line);
  if (high.x <= low.x || high.y <= low.y) return;
  Plot plot(extent_of(curves), low, high);
  plot.axes();
  for (const Curve& curve : curves) plot.curve(curve);
  ImGui::GetWindowDrawList()->AddText({low.x, high.y + 1.4f * line}, IM_COL32(210, 210, 210, 255),
                                      x_label.c_str());
}

void draw_profile(const ViewState& state, const Scene& scene) {
  if (state.tool != Tool::profile || state.points.size() != 2) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  begin("Profile", nullptr, {size.x - 10, size.y - 10}, {1, 1});
  std::vector<Curve> curves = {profile_curve(scene, state.look.layer, state, kAfter)};
  if (state.look.before != state.look.layer)
    curves.push_back(profile_curve(scene, state.look.before, state, kBefore));
  draw_plot(curves, "along the line, mm", "height off the line, mm");
  ImGui::End();
}

void draw_convergence(ViewState& state, const Scene& scene) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  begin("Convergence", &state.show_convergence, {size.x - 10, 10}, {1, 0});
  if (scene.iterations.empty()) {
    ImGui::TextUnformatted("no iterations: this is not the result of an iterative refinement");
  } else {
    ImGui::TextWrapped("%s", scene.message.c_str());
    draw_plot({history(scene, "energy", kAfter, [](const auto& i) { return i.energy; }),
               history(scene, "depth change, mm", kOther, [](const auto& i) { return i.depth_change_mm; })},
              "iteration", "log10 of");
  }
  ImGui::End();
}

}  // namespace rakelight
