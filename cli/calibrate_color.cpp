// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <vector>

#include "capture/color_calibration.h"
#include "capture/rig_file.h"
#include "cli/calibrate.h"
#include "refine/response_estimate.h"
#include "stack/color_response.h"
#include "stack/stack_io.h"

namespace rakelight::cli {
namespace {

using json = nlohmann::ordered_json;
using Stacks = std::vector<std::filesystem::path>;

constexpr const char* kResponseFooter =
    R"(Give several stacks of one scene, recorded with another exposure_us each and otherwise alike: that settles it. Or
give one stack of an object under at least six lamps: then the exponent is what makes the images consistent with the
lighting model, and is stored only if they determine it.

Examples:
  rakelight calibrate response at-4ms at-8ms at-16ms --rig my-rig.toml
  rakelight calibrate response my-scan)";

constexpr const char* kCrosstalkFooter =
    R"(STACK shows a white, matt card under the red, green and blue lamps one by one, and a dark frame. Calibrate the response
first: the stack's values are decoded by the rig's response if it has one, else by the stack's.

Examples:
  rakelight calibrate crosstalk white-card --rig my-rig.toml)";

json rows_of(const Eigen::Matrix3d& matrix) {
  json rows = json::array();
  for (int r = 0; r < 3; ++r) rows.push_back({matrix(r, 0), matrix(r, 1), matrix(r, 2)});
  return rows;
}

void finish_response(const CalibrateTarget& target, const ColorResponse& response, bool sure,
                     const std::string& text, json result) {
  if (sure) store(target, [&](Rig& rig) { rig.calibration.color_response = response; });
  result["color_response"] = to_string(response);
  result["sure"] = sure;
  CalibrateTarget stored = target;
  if (!sure) stored.rig.clear();
  print_result(stored, text, result);
}

void response_of_sweep(const Stacks& folders, const CalibrateTarget& target) {
  std::vector<LightStack> sweep;
  for (const auto& folder : folders) sweep.push_back(read_stack(folder));
  const ResponseFit fit = measure_response(sweep);
  char text[200];
  std::snprintf(text, sizeof text,
                "response: %s (best exponent %.3f +- %.3f); radiance is off by %.1f %% rms\n",
                to_string(fit.response).c_str(), fit.gamma, fit.deviation, 100 * fit.error);
  finish_response(
      target, fit.response, true, text,
      {{"gamma", fit.gamma}, {"deviation", fit.deviation}, {"error", fit.error}, {"samples", fit.samples}});
}

void response_of_scan(const std::filesystem::path& folder, const CalibrateTarget& target) {
  const ResponseEstimate estimate = estimate_response(read_stack(folder), preset_options(Preset::robust));
  if (!estimate.sure)
    spdlog::warn("the images do not determine the response: nothing is stored; record an exposure sweep");
  const ColorResponse response{ColorResponse::Kind::gamma, estimate.gamma};
  finish_response(
      target, response, estimate.sure, estimate.message + "\n",
      {{"gamma", estimate.gamma}, {"deviation", estimate.deviation}, {"message", estimate.message}});
}

void run_crosstalk(const std::filesystem::path& folder, const CalibrateTarget& target) {
  LightStack stack = read_stack(folder);
  if (!target.rig.empty()) {
    const Rig rig = read_rig(target.rig);
    stack.color_response = rig.calibration.color_response.value_or(stack.color_response);
  }
  const CrosstalkFit fit = measure_crosstalk(stack);
  std::string text = "light of the red, green and blue LED in the sensor's red, green and blue:\n";
  for (int r = 0; r < 3; ++r) {
    char row[160];
    std::snprintf(row, sizeof row, "  %.4f +- %.4f   %.4f +- %.4f   %.4f +- %.4f\n", fit.crosstalk(r, 0),
                  fit.deviation(r, 0), fit.crosstalk(r, 1), fit.deviation(r, 1), fit.crosstalk(r, 2),
                  fit.deviation(r, 2));
    text += row;
  }
  store(target, [&](Rig& rig) { rig.calibration.color_crosstalk = fit.crosstalk; });
  print_result(target, text,
               {{"color_crosstalk", rows_of(fit.crosstalk)},
                {"deviation", rows_of(fit.deviation)},
                {"color_response", to_string(stack.color_response)},
                {"pixels", fit.pixels}});
}

}  // namespace

void add_calibrate_response(CLI::App& calibrate, int& exit_code) {
  auto stacks = std::make_shared<Stacks>();
  CLI::App* command = calibrate.add_subcommand("response", "How colour values encode light");
  command->footer(kResponseFooter);
  command->add_option("STACK", *stacks, "Stacks of an exposure sweep, or one of an object")->required();
  auto target = add_target(*command);
  command->callback([stacks, target, &exit_code] {
    stacks->size() > 1 ? response_of_sweep(*stacks, *target) : response_of_scan(stacks->front(), *target);
    exit_code = 0;
  });
}

void add_calibrate_crosstalk(CLI::App& calibrate, int& exit_code) {
  auto stack = std::make_shared<std::filesystem::path>();
  CLI::App* command =
      calibrate.add_subcommand("crosstalk", "How much of each LED's light leaks into other channels");
  command->footer(kCrosstalkFooter);
  command->add_option("STACK", *stack, "Stack of a white card")->required();
  auto target = add_target(*command);
  command->callback([stack, target, &exit_code] {
    run_crosstalk(*stack, *target);
    exit_code = 0;
  });
}

}  // namespace rakelight::cli
