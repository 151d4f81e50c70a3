// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// rakelight simulate: options -> simulate_stack -> a stack folder.
#include <filesystem>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/commands.h"
#include "simulate/simulate.h"
#include "stack/color_response.h"
#include "stack/errors.h"
#include "stack/stack_io.h"

namespace rakelight::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  rakelight simulate -o vase                                      16 far lamps, a vase, all effects, 8-bit
  rakelight simulate -o vase2 --color-scale 2 --albedo complicated     colour twice as fine as depth
  rakelight simulate -o ball --scene sphere --realism ideal       a scene with a known answer)";

struct Arguments {
  std::filesystem::path output;
  Realism realism = Realism::real;
  SimulateOptions options;
};

const std::map<std::string, SceneKind> kScenes{
    {"vase", SceneKind::vase}, {"sphere", SceneKind::sphere}, {"plane", SceneKind::plane}};
const std::map<std::string, AlbedoKind> kAlbedos{{"simple", AlbedoKind::simple},
                                                 {"pattern", AlbedoKind::pattern},
                                                 {"complicated", AlbedoKind::complicated}};
const std::map<std::string, Realism> kRealisms{{"ideal", Realism::ideal}, {"real", Realism::real}};

}  // namespace

void add_simulate_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("simulate", "Render a stack with its truth: a synthetic scan.");
  command->footer(kExamples);
  auto arguments = std::make_shared<Arguments>();
  command->add_option("-o,--output", arguments->output, "Stack folder to write")->required();
  SimulateOptions& options = arguments->options;
  command->add_option("--realism", arguments->realism, "ideal or real")
      ->transform(CLI::CheckedTransformer(kRealisms));
  command->add_option("--scene", options.scene.kind, "Object")->transform(CLI::CheckedTransformer(kScenes));
  command->add_option("--albedo", options.scene.albedo, "Paint")
      ->transform(CLI::CheckedTransformer(kAlbedos));
  command->add_option("--lights", options.lamps.count, "Number of lamps");
  command->add_option("--seed", options.seed, "Seed");
  command->add_option("--color-scale", options.color_scale, "Colour size / depth size");
  command->callback([arguments, &exit_code] {
    SimulateOptions resolved = realism_options(arguments->realism);
    resolved.scene = arguments->options.scene;
    resolved.lamps.count = arguments->options.lamps.count;
    resolved.seed = arguments->options.seed;
    resolved.color_scale = arguments->options.color_scale;
    const Simulated scan = simulate_stack(resolved);
    write_stack(scan.stack, arguments->output, scan.truth);
    std::cout << "wrote " << arguments->output.string() << '\n';
    exit_code = 0;
  });
}

}  // namespace rakelight::cli
