// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "cli/calibrate.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "refine/refine.h"
#include "stack/errors.h"
#include "stack/stack_io.h"

namespace rakelight::cli {
namespace {

using json = nlohmann::ordered_json;

constexpr const char* kFooter =
    R"(STACK is a scan of any matt object that fills the view, with depth; the better its relief, the better the positions.

Examples:
  rakelight calibrate lamps my-scan --rig my-rig.toml
  rakelight refine another-scan -o out --lamp-positions start)";

RefineResult refine_with_near_lamps(const LightStack& stack) {
  RefineOptions options = preset_options(Preset::robust);
  options.scale = 1;  // lamps need no fine surface
  options.lamps.model = LampModel::near;
  options.uncertainty_samples = 0;
  ProgressBar bar;
  RefineResult result = refine_depth(stack, options, [&](const Progress& progress) {
    bar.show(progress);
    return !interrupted();
  });
  if (interrupted()) throw Cancelled();
  return result;
}

std::string lamp_text(const LightEstimate& lamp) {
  const Eigen::Vector3d& p = *lamp.position_m;
  char text[200];
  std::snprintf(text, sizeof text,
                "  %-12s %7.3f %7.3f %7.3f m, distance +- %.1f mm, direction +- %.2f degrees\n",
                lamp.id.c_str(), p.x(), p.y(), p.z(), 1000 * lamp.distance_deviation_m,
                lamp.direction_deviation_rad * 180 / M_PI);
  return text;
}

/// Each lamp's images vote with the inverse of their variance.
void put_positions(const std::vector<LightEstimate>& estimates, Rig& rig, const std::string& origin) {
  int placed = 0;
  for (RigLamp& lamp : rig.lamps) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weight = 0;
    for (const LightEstimate& estimate : estimates) {
      if (estimate.id != lamp.id || !estimate.position_m) continue;
      const double w = 1 / std::max(1e-8, estimate.distance_deviation_m * estimate.distance_deviation_m);
      sum += w * *estimate.position_m;
      weight += w;
    }
    if (weight <= 0) continue;
    lamp.position_m = sum / weight;
    ++placed;
  }
  if (placed == 0) {
    throw InputError(origin, "has none of the rig file's lamps",
                     "scan with this rig, or correct the ids under [[lamps]]");
  }
}

void run(const std::filesystem::path& folder, const CalibrateTarget& target) {
  catch_interrupts();
  const RefineResult result = refine_with_near_lamps(read_stack(folder));
  for (const std::string& warning : result.warnings) spdlog::warn("{}", warning);
  std::string text =
      "lamps in colour-camera coordinates (x right, y down, z forward), +- the statistical spread only:\n";
  json lamps = json::array();
  for (const LightEstimate& lamp : result.lights) {
    if (!lamp.position_m) continue;
    text += lamp_text(lamp);
    lamps.push_back({{"id", lamp.id},
                     {"position_m", std::vector<double>(lamp.position_m->begin(), lamp.position_m->end())},
                     {"distance_deviation_m", lamp.distance_deviation_m},
                     {"direction_deviation_rad", lamp.direction_deviation_rad}});
  }
  if (lamps.empty()) {
    throw InputError(folder.string(), "gives no lamp positions: " + result.message,
                     "scan a matt object with more relief, lamps within a few times its size");
  }
  store(target, [&](Rig& rig) { put_positions(result.lights, rig, folder.string()); });
  print_result(target, text, {{"lamps", lamps}});
}

}  // namespace

void add_calibrate_lamps(CLI::App& calibrate, int& exit_code) {
  auto stack = std::make_shared<std::filesystem::path>();
  CLI::App* command =
      calibrate.add_subcommand("lamps", "Where near lamps stand, from a scan of any matt object");
  command->footer(kFooter);
  command->add_option("STACK", *stack, "A scan")->required();
  auto target = add_target(*command);
  command->callback([stack, target, &exit_code] {
    run(*stack, *target);
    exit_code = 0;
  });
}

}  // namespace rakelight::cli
