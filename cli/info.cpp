// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "stack/color_response.h"
#include "stack/stack_io.h"
#include "stack/summary.h"
#include "stack/truth_io.h"

namespace rakelight::cli {
namespace {

using json = nlohmann::ordered_json;

struct Arguments {
  std::filesystem::path stack;
  bool json = false;
};

constexpr const char* kFooter = R"(Examples:
  rakelight info my-scan           cameras, lamps, images, depth, saturation and what to mind
  rakelight info mitten            of a source folder (see rakelight import --help)
  rakelight info my-scan --json    for scripts)";

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  char text[256];
  va_list values;
  va_start(values, pattern);
  std::vsnprintf(text, sizeof text, pattern, values);
  va_end(values);
  return text;
}

std::string camera_text(const Camera& camera) {
  return format("%d x %d, fx %.1f fy %.1f cx %.1f cy %.1f%s", camera.width, camera.height, camera.fx,
                camera.fy, camera.cx, camera.cy, camera.distortion.empty() ? "" : ", distorted");
}

/// `20: 19 white, 1 rgb, 3 with a position`.
std::string lamps_text(const LightStack& stack) {
  std::map<std::string, int> counts;
  int placed = 0;
  for (const Light& light : stack.lights) {
    ++counts[to_string(light.color)];
    placed += light.position_m ? 1 : 0;
  }
  std::string text = std::to_string(stack.lights.size()) + ":";
  for (const auto& [color, count] : counts) text += format(" %d %s,", count, color.c_str());
  return text + format(" %d with a known position", placed);
}

void print_line(const char* name, const std::string& text) {
  std::cout << format("  %-10s", name) << text << "\n";
}

void print_text(const LightStack& stack, const StackSummary& s, bool truth) {
  std::cout << stack.origin << ": light stack" << (stack.created.empty() ? "" : " of " + stack.created)
            << "\n";
  const Sensor& sensor = stack.sensor;
  print_line("sensor", sensor.vendor + (sensor.vendor.empty() ? "" : " ") + sensor.name +
                           (sensor.driver.empty() ? "" : " (" + sensor.driver + ")"));
  print_line("colour", camera_text(stack.color_camera));
  print_line("", format("%d images of %d bits, %d of them dark, response ", s.color_images, s.color_bits,
                        s.dark_images) +
                     to_string(stack.color_response));
  print_line("depth", camera_text(stack.depth_camera));
  print_line("",
             format("%d images, %.3f to %.3f m in steps of %.4g mm, on %.1f %% of the object", s.depth_images,
                    s.nearest_m, s.farthest_m, 1000 * stack.depth_unit_m, 100 * s.depth_coverage));
  print_line("lamps", lamps_text(stack));
  print_line("mask", stack.mask.empty() ? "none" : format("%d pixels", s.object_pixels));
  print_line("saturated", format("%.2f %% of the object in the mean image, %.2f %% in the worst",
                                 100 * s.saturated_mean, 100 * s.saturated_worst));
  if (s.lit_checked > 0) {
    print_line("lit check", format("%d of %d frames show their lamp", s.lit_matching, s.lit_checked));
  }
  print_line("truth", truth ? "yes" : "none");
  for (const std::string& warning : s.warnings) print_line("warning", warning);
}

json camera_json(const Camera& camera) {
  return {{"width", camera.width}, {"height", camera.height}, {"fx", camera.fx},
          {"fy", camera.fy},       {"cx", camera.cx},         {"cy", camera.cy}};
}

void print_json(const LightStack& stack, const StackSummary& s, bool truth) {
  json lights = json::array();
  for (const Light& light : stack.lights)
    lights.push_back({{"id", light.id}, {"color", to_string(light.color)}});
  const json report = {{"stack", stack.origin},
                       {"created", stack.created},
                       {"color_camera", camera_json(stack.color_camera)},
                       {"depth_camera", camera_json(stack.depth_camera)},
                       {"color_response", to_string(stack.color_response)},
                       {"color_images", s.color_images},
                       {"color_bits", s.color_bits},
                       {"dark_images", s.dark_images},
                       {"depth_images", s.depth_images},
                       {"depth_unit_m", stack.depth_unit_m},
                       {"nearest_m", s.nearest_m},
                       {"farthest_m", s.farthest_m},
                       {"depth_coverage", s.depth_coverage},
                       {"object_pixels", s.object_pixels},
                       {"saturated_mean", s.saturated_mean},
                       {"saturated_worst", s.saturated_worst},
                       {"lights", lights},
                       {"lit_checked", s.lit_checked},
                       {"lit_matching", s.lit_matching},
                       {"truth", truth},
                       {"warnings", s.warnings}};
  std::cout << report.dump(2, ' ', false, json::error_handler_t::replace) << "\n";
}

void run(const Arguments& arguments) {
  const LightStack stack = read_stack(arguments.stack);
  const StackSummary summary = summarise(stack);
  (arguments.json ? print_json : print_text)(stack, summary, has_truth(arguments.stack));
}

}  // namespace

void add_info_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("info", "What a stack holds, in words");
  command->footer(kFooter);
  command->add_option("STACK", arguments->stack, "Stack or source folder")->required();
  command->add_flag("--json", arguments->json, "Print one JSON object on stdout and nothing else there");
  command->callback([arguments, &exit_code] {
    run(*arguments);
    exit_code = 0;
  });
}

}  // namespace rakelight::cli
