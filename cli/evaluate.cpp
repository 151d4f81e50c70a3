// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/evaluate.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.h"
#include "refine/output/error_plots.h"
#include "refine/output/result_io.h"
#include "stack/stack_io.h"

namespace rakelight::cli {
namespace {

struct Arguments {
  std::filesystem::path result, truth, plots;
  bool json = false;
};

constexpr const char* kFooter = R"(Examples:
  rakelight evaluate my-surface --truth my-scan           errors of a refined simulated scan
  rakelight evaluate my-surface --truth my-scan/truth     the same
  rakelight evaluate my-surface --truth my-scan --json    for scripts
  rakelight evaluate my-surface --truth my-scan --plots figures    error maps and histograms as PNG

RMSE: of depth. Unbiased: after removing the mean error. MAE and median: angles between the true normals and those
of depth by forward differences; own: of normals.tiff. Error bars: share of errors inside one standard deviation of
uncertainty.tiff, 68 % for perfect ones. Grids of different size are compared on the finer one.)";

nlohmann::ordered_json json_of(const Evaluation& evaluation) {
  return {{"rmse_mm", evaluation.rmse_mm},       {"mae_deg", evaluation.mae_deg},
          {"median_deg", evaluation.median_deg}, {"rmse_unbiased_mm", evaluation.rmse_unbiased_mm},
          {"complete", evaluation.completeness}, {"mae_own_normals_deg", evaluation.own_normals_mae_deg}};
}

void print_row(const char* name, const Evaluation& evaluation) {
  char line[160];
  std::snprintf(line, sizeof line, "%-8s %9.3f %12.3f %9.3f %11.3f %10.1f", name, evaluation.rmse_mm,
                evaluation.rmse_unbiased_mm, evaluation.mae_deg, evaluation.median_deg,
                100 * evaluation.completeness);
  std::cout << line;
  if (std::isfinite(evaluation.own_normals_mae_deg)) {
    std::snprintf(line, sizeof line, " %9.3f", evaluation.own_normals_mae_deg);
    std::cout << line;
  }
  std::cout << "\n";
}

void run(const Arguments& arguments) {
  const StoredResult result = read_result(arguments.result);
  const GroundTruth truth = read_truth(arguments.truth);
  const Evaluation before = evaluate(result.camera, result.initial_depth, {}, truth);
  const Evaluation after = evaluate(result.camera, result.depth, result.normals, truth);
  std::optional<ErrorBarReport> bars;
  if (!result.uncertainty.empty())
    bars = evaluate_error_bars(result.camera, result.depth, result.normals, result.uncertainty, truth);
  if (!arguments.plots.empty())
    write_error_plots(error_maps(result.camera, result.initial_depth, truth),
                      error_maps(result.camera, result.depth, truth), arguments.plots);
  if (arguments.json) {
    auto json = json_of(after);
    json["before"] = json_of(before);
    if (bars) json["within_error_bars"] = {{"depth", bars->depth_within}, {"normals", bars->normal_within}};
    std::cout << json.dump(2) << "\n";
    return;
  }
  std::cout << "          RMSE mm  unbiased mm   MAE deg  median deg  complete %   own deg\n";
  print_row("before", before);
  print_row("after", after);
  if (!bars) return;
  char line[160];
  std::snprintf(line, sizeof line,
                "error bars hold %.0f %% of the depth errors and %.0f %% of the normals'\n",
                100 * bars->depth_within, 100 * bars->normal_within);
  std::cout << line;
}

}  // namespace

void add_evaluate_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("evaluate", "Errors of a result against the truth");
  command->footer(kFooter);
  command->add_option("OUT", arguments->result, "Result folder")->required();
  command->add_option("--truth", arguments->truth, "Stack that has a truth/ folder, or that folder")
      ->required()
      ->type_name("DIR");
  command->add_option("--plots", arguments->plots, "Folder for figures of the errors before and after (PNG)")
      ->type_name("DIR");
  command->add_flag("--json", arguments->json, "Print one JSON object on stdout and nothing else there");
  command->callback([arguments, &exit_code] {
    run(*arguments);
    exit_code = 0;
  });
}

}  // namespace rakelight::cli
