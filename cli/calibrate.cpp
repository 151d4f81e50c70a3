// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/calibrate.h"

#include <iostream>

#include "capture/rig_file.h"
#include "cli/commands.h"

namespace rakelight::cli {
namespace {

constexpr const char* kFooter = R"(In this order (docs/calibration.md):
  rakelight calibrate latency --rig my-rig.toml                   lamps to picture, and how much it varies
  rakelight calibrate board -o board.png                          print it, paste it on something flat
  rakelight calibrate camera views --rig my-rig.toml              both cameras and the motion between them
  rakelight calibrate response at-4ms at-8ms at-16ms --rig my-rig.toml
  rakelight calibrate crosstalk white-card --rig my-rig.toml      red, green and blue LEDs only
  rakelight calibrate lamps my-scan --rig my-rig.toml             where near lamps stand

Without --rig a result is printed and not stored. In the rig file only what was measured changes; comments stay.)";

}  // namespace

std::shared_ptr<CalibrateTarget> add_target(CLI::App& command) {
  auto target = std::make_shared<CalibrateTarget>();
  command.add_option("--rig", target->rig, "Rig file to store the result in")->type_name("FILE");
  command.add_flag("--json", target->json, "Print one JSON object on stdout and nothing else there");
  return target;
}

void store(const CalibrateTarget& target, const std::function<void(Rig&)>& change) {
  if (target.rig.empty()) return;
  Rig rig = read_rig(target.rig);
  change(rig);
  store_calibration(rig, target.rig);
}

void print_result(const CalibrateTarget& target, const std::string& text, nlohmann::ordered_json result) {
  if (target.json) {
    result["rig"] = target.rig.string();
    std::cout << result.dump(2) << "\n";
    return;
  }
  std::cout << text;
  std::cout << (target.rig.empty() ? "not stored: give --rig FILE\n"
                                   : "stored in " + target.rig.string() + "\n");
}

void add_calibrate_command(CLI::App& program, int& exit_code) {
  CLI::App* calibrate = program.add_subcommand("calibrate", "Measure what a rig file needs to know");
  calibrate->footer(kFooter);
  calibrate->require_subcommand(1);
  add_calibrate_board(*calibrate, exit_code);
  add_calibrate_camera(*calibrate, exit_code);
  add_calibrate_response(*calibrate, exit_code);
  add_calibrate_crosstalk(*calibrate, exit_code);
  add_calibrate_latency(*calibrate, exit_code);
  add_calibrate_lamps(*calibrate, exit_code);
}

}  // namespace rakelight::cli
