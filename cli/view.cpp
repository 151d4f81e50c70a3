// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "stack/errors.h"
#include "viewer/viewer.h"

namespace rakelight::cli {
namespace {

constexpr const char* kFooter = R"(Examples:
  rakelight view my-surface                                  turn a result under a raking light; F1 shows the keys
  rakelight view my-surface --stack my-scan                  with its scan, which was moved since
  rakelight view my-scan                                     a scan before it is refined
  rakelight view my-surface --screenshot surface.png         a picture, without a display
  rakelight view my-surface --split --screenshot both.png    before | after
  rakelight view my-surface --color delta --screenshot d.png   what the refinement changed, in mm
  rakelight view my-surface --material chrome --light 60,35 --screenshot chrome.png
  rakelight view my-surface --turntable 36 --screenshot turn.png   turn0000.png to turn0035.png)";

struct Arguments {
  SceneSource source;
  std::optional<std::string> layer, before, color, material, light, view, background;
  std::string size = "1280x960";
  std::optional<int> turntable;
  std::filesystem::path screenshot;
  double azimuth = 0, elevation = 0;
  bool split = false, orthographic = false, points = false, mesh = false, no_legend = false;
};

template <class Enum, std::size_t N>
std::vector<std::string> names(const std::array<Named<Enum>, N>& named) {
  std::vector<std::string> result;
  for (const auto& item : named) result.emplace_back(item.name);
  return result;
}

constexpr std::array<Named<StandardView>, 6> kViewNames{{{StandardView::front, "front"},
                                                         {StandardView::back, "back"},
                                                         {StandardView::left, "left"},
                                                         {StandardView::right, "right"},
                                                         {StandardView::top, "top"},
                                                         {StandardView::bottom, "bottom"}}};
constexpr std::array<Named<Background>, 2> kBackgroundNames{
    {{Background::dark, "dark"}, {Background::white, "white"}}};

/// Two numbers with a separator between them and nothing else.
template <class Number>
void read_pair(const std::string& option, const std::string& text, const char* format, Number& a, Number& b,
               const std::string& example) {
  int used = 0;
  if (std::sscanf(text.c_str(), format, &a, &b, &used) == 2 && used == static_cast<int>(text.size())) return;
  throw UsageError(option + " takes two numbers such as " + example + ", not '" + text + "'");
}

cv::Size size_of(const Arguments& arguments) {
  cv::Size size;
  read_pair("--size", arguments.size, "%dx%d%n", size.width, size.height, "1280x960");
  constexpr int kLeast = 16, kMost = 16384;
  if (std::min(size.width, size.height) >= kLeast && std::max(size.width, size.height) <= kMost) return size;
  throw UsageError("--size takes 16 to 16384 pixels a side, not '" + arguments.size + "'");
}

/// "albedo", or "image:3" with the image's number.
void read_color(const std::string& text, Look& look) {
  const auto colon = text.find(':');
  const auto coloring = value_of(kColoringNames, text.substr(0, colon));
  if (!coloring) throw UsageError("--color does not know '" + text + "'; see rakelight view --help");
  look.coloring = *coloring;
  if (colon == std::string::npos) return;
  int used = 0;
  const std::string number = text.substr(colon + 1);
  if (*coloring != Coloring::image || std::sscanf(number.c_str(), "%d%n", &look.image, &used) != 1 ||
      used != static_cast<int>(number.size()))
    throw UsageError("--color takes a number only as image:NUMBER, not '" + text + "'");
}

Look look_of(const Arguments& arguments, Look look) {
  if (arguments.color) read_color(*arguments.color, look);
  if (arguments.layer) look.layer = *value_of(kLayerNames, *arguments.layer);
  if (arguments.before) look.before = *value_of(kLayerNames, *arguments.before);
  if (arguments.material) look.material = *value_of(kMaterialNames, *arguments.material);
  if (arguments.background) look.background = *value_of(kBackgroundNames, *arguments.background);
  if (arguments.light) {
    read_pair("--light", *arguments.light, "%lf,%lf%n", look.light.azimuth_deg, look.light.elevation_deg,
              "135,22");
  }
  look.split = arguments.split || arguments.before.has_value();
  if (arguments.points) look.points = true;
  if (arguments.mesh) look.points = false;
  return look;
}

ViewPoint view_of(const Arguments& arguments) {
  ViewPoint view;
  if (arguments.view) view.view = *value_of(kViewNames, *arguments.view);
  view.azimuth_deg = arguments.azimuth;
  view.elevation_deg = arguments.elevation;
  view.orthographic = arguments.orthographic;
  return view;
}

/// Whether it shows what a result does not hold; the window reads that later, when it stands.
bool wants_stack(const Look& look) {
  const auto of_scan = [](LayerKind kind) { return kind == LayerKind::sensor || kind == LayerKind::truth; };
  return of_scan(look.layer) || (look.split && of_scan(look.before)) || look.coloring == Coloring::image ||
         look.coloring == Coloring::error;
}

void run(const Arguments& arguments) {
  const cv::Size size = size_of(arguments);
  if (!arguments.screenshot.empty() && arguments.screenshot.extension() != ".png")
    throw UsageError("--screenshot writes PNG, so name a file that ends in .png, not '" +
                     arguments.screenshot.string() + "'");
  Scene scene = open_scene(arguments.source);
  const Look look = look_of(arguments, default_look(scene));
  if (!scene.stack.empty() && wants_stack(look)) scene = with_stack(scene);
  if (arguments.screenshot.empty())
    return run_viewer(std::move(scene), look, view_of(arguments), {size, !arguments.light.has_value()});
  const PictureOptions picture{arguments.screenshot, size, arguments.turntable.value_or(0),
                               !arguments.no_legend};
  const PictureReport report = save_pictures(scene, look, view_of(arguments), picture);
  std::cout << report.files.front().string();
  if (report.files.size() > 1) std::cout << " to " << report.files.back().string();
  std::cout << ": " << size.width << "x" << size.height << ", drawn by " << report.path << "\n";
}

}  // namespace

void add_view_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("view", "Look at a scan or a result, or take a picture of it");
  command->footer(kFooter);
  command->add_option("FOLDER", arguments->source.folder, "Stack, source folder or result")->required();
  command
      ->add_option("--stack", arguments->source.stack,
                   "The scan a result was made from; default: where result.json says, if it is still there")
      ->type_name("STACK");
  command
      ->add_option("--screenshot", arguments->screenshot,
                   "Write a picture instead of opening a window; no display")
      ->type_name("F.png");
  command->add_option("--layer", arguments->layer, "Surface to show")
      ->check(CLI::IsMember(names(kLayerNames)));
  command->add_flag("--split", arguments->split, "Before | after with a divider");
  command->add_option("--before", arguments->before, "Layer left of the divider (implies --split)")
      ->check(CLI::IsMember(names(kLayerNames)));
  command->add_option("--color", arguments->color,
                      "plain, albedo, image:NUMBER, normals, depth, delta, uncertainty or error");
  command->add_option("--material", arguments->material, "How the surface answers the light")
      ->check(CLI::IsMember(names(kMaterialNames)));
  command
      ->add_option("--light", arguments->light,
                   "Direction to the light, degrees: azimuth (0 right, 90 above), elevation (0 grazing)")
      ->type_name("AZ,EL");
  command->add_option("--view", arguments->view, "Where to look from")
      ->check(CLI::IsMember(names(kViewNames)));
  command->add_option("--azimuth", arguments->azimuth, "Degrees to walk to the right from there");
  command->add_option("--elevation", arguments->elevation, "Degrees to rise from there")
      ->check(CLI::Range(-90, 90));
  command->add_flag("--orthographic", arguments->orthographic, "No perspective");
  command->add_flag("--points", arguments->points, "Points");
  command->add_flag("--mesh", arguments->mesh, "A mesh")->excludes("--points");
  command->add_option("--background", arguments->background, "Behind the object")
      ->check(CLI::IsMember(names(kBackgroundNames)));
  command->add_option("--size", arguments->size, "Picture or window, pixels")->type_name("WxH");
  command->add_option("--turntable", arguments->turntable, "So many pictures around the object")
      ->check(CLI::Range(1, 9999))
      ->needs("--screenshot");
  command->add_flag("--no-legend", arguments->no_legend, "No scale bar and no names in the picture")
      ->needs("--screenshot");
  command->callback([arguments, &exit_code] {
    run(*arguments);
    exit_code = 0;
  });
}

}  // namespace rakelight::cli
