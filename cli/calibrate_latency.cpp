// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "capture/latency.h"
#include "capture/open_rig.h"
#include "capture/rig_file.h"
#include "cli/calibrate.h"
#include "cli/interrupt.h"
#include "stack/errors.h"

namespace rakelight::cli {
namespace {

using json = nlohmann::ordered_json;

constexpr const char* kFooter =
    R"(One lamp is switched on and off, and its edges are found in the rows of the picture. Point the sensor at something that the
lamp lights. The lag is for your information, for every scan measures its own; its jitter, rounded up to 0.1 ms, is stored:
a scan waits that much longer before it trusts a frame.

Examples:
  rakelight calibrate latency                                       the virtual rig
  rakelight calibrate latency --rig my-rig.toml --toggles 50)";

struct Arguments {
  std::string lamp;  // empty: the rig's first
  int toggles = 20;
};

void check_lamp(const Rig& rig, const std::string& id) {
  const auto named = [&id](const RigLamp& lamp) { return lamp.id == id; };
  if (std::any_of(rig.lamps.begin(), rig.lamps.end(), named)) return;
  throw UsageError("--lamp: '" + id + "' is no lamp of rig '" + rig.name +
                   "'; 'rakelight lights list' shows them");
}

LatencyCalibration measure(const Rig& rig, const std::string& lamp, int toggles) {
  LatencyOptions options;
  options.toggles = toggles;
  options.response = rig.calibration.color_response.value_or(options.response);
  const auto lights = open_lights(rig);  // first: it forks the lamps' guard, before there are threads
  const auto source = open_frame_source(rig);
  return calibrate_latency(*source, *lights, monotonic_clock(), rig.sensor, lamp, options,
                           [] { return !interrupted(); });
}

std::string report(const std::string& lamp, const LatencyCalibration& found) {
  char text[160];
  std::snprintf(text, sizeof text,
                "lamp '%s': %.2f ms from write to picture, jitter %.2f ms, over %d edges\n", lamp.c_str(),
                found.lag_us / 1000, found.jitter_us / 1000, found.edges);
  return text;
}

void run(const Arguments& arguments, const CalibrateTarget& target) {
  catch_interrupts();
  const Rig rig = target.rig.empty() ? virtual_rig() : read_rig(target.rig);
  if (rig.lamps.empty()) throw UsageError("rig '" + rig.name + "' has no lamps; add [[lamps]] to its file");
  const std::string lamp = arguments.lamp.empty() ? rig.lamps.front().id : arguments.lamp;
  check_lamp(rig, lamp);
  const LatencyCalibration found = measure(rig, lamp, arguments.toggles);
  const double jitter_us = 100 * std::ceil(found.jitter_us / 100);
  store(target, [jitter_us](Rig& stored) { stored.sensor.lamp_jitter_us = jitter_us; });
  const json result = {{"lamp", lamp},
                       {"lag_us", std::round(found.lag_us)},
                       {"jitter_us", std::round(found.jitter_us)},
                       {"lamp_jitter_us", jitter_us},
                       {"edges", found.edges}};
  print_result(target, report(lamp, found), result);
}

}  // namespace

void add_calibrate_latency(CLI::App& calibrate, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      calibrate.add_subcommand("latency", "How long lamps take from the write to the picture");
  command->footer(kFooter);
  command->add_option("--lamp", arguments->lamp, "The lamp that is switched; default: the rig's first");
  command->add_option("--toggles", arguments->toggles, "Times on and off; default: 20")
      ->check(CLI::Range(1, 1000));
  auto target = add_target(*command);
  command->callback([arguments, target, &exit_code] {
    run(*arguments, *target);
    exit_code = 0;
  });
}

}  // namespace rakelight::cli
