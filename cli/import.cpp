// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#ifdef RAKELIGHT_HAS_CAPTURE
#include "capture/oni_file.h"
#endif
#include "cli/commands.h"
#include "stack/color_response.h"
#include "stack/errors.h"
#include "stack/importers/diligent.h"
#include "stack/importers/photometric_sr.h"
#include "stack/stack_io.h"
#include "stack/summary.h"
#include "stack/truth_io.h"

namespace rakelight::cli {
namespace {

struct Arguments {
  std::string kind, response;
  std::filesystem::path source, stack;
  std::vector<std::string> lights;
  int every = 1;
  bool json = false;
};

constexpr const char* kFooter = R"(Kinds:
  photometric-sr   RGB/I_1.png ..., Depth/z0_1.png ..., K.txt, mask.png, optional response.txt and truth/
  diligent         filenames.txt, light_directions.txt, light_intensities.txt, mask.png, optional K.txt (no depth)

  oni              an OpenNI2 recording of colour and depth; lamps are named by --lights (where the program has OpenNI2)

Examples:
  rakelight import oni scan.oni -o scan --lights dark,white-00,white-01
  rakelight import photometric-sr mitten -o mitten-stack
  rakelight import photometric-sr vase -o vase-stack --response srgb
  rakelight import diligent bearPNG -o bear-stack

Every command that takes a stack takes such a source folder too, without importing it first.)";

/// RFC 3339, UTC.
std::string now() {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

LightStack import_source(const Arguments& arguments) {
#ifdef RAKELIGHT_HAS_CAPTURE
  if (arguments.kind == "oni") return import_oni(arguments.source, {arguments.lights, arguments.every});
#endif
  if (!arguments.lights.empty() || arguments.every != 1) {
    throw UsageError("--lights and --every belong to the kind oni; leave them out");
  }
  if (arguments.kind == "photometric-sr") return import_photometric_sr(arguments.source);
  if (!arguments.response.empty()) {
    throw UsageError(
        "--response: diligent images are linear and divided by their lamps; leave the option out");
  }
  return import_diligent(arguments.source);
}

std::vector<std::string> kinds() {
  std::vector<std::string> words{"photometric-sr", "diligent"};
#ifdef RAKELIGHT_HAS_CAPTURE
  words.emplace_back("oni");
#endif
  return words;
}

void run(const Arguments& arguments) {
  LightStack stack = import_source(arguments);
  if (!arguments.response.empty()) stack.color_response = parse_color_response(arguments.response);
  stack.created = now();
  std::optional<GroundTruth> truth;
  if (has_truth(arguments.source)) truth = read_truth(arguments.source);
  write_stack(stack, arguments.stack, truth);

  const StackSummary summary = summarise(stack);
  if (arguments.json) {
    const nlohmann::ordered_json report = {
        {"stack", arguments.stack.string()},    {"color_images", summary.color_images},
        {"depth_images", summary.depth_images}, {"lights", stack.lights.size()},
        {"truth", truth.has_value()},           {"warnings", summary.warnings}};
    std::cout << report.dump(2) << "\n";
    return;
  }
  std::cout << arguments.stack.string() << ": " << summary.color_images << " colour and "
            << summary.depth_images << " depth images" << (truth ? ", and the truth" : "") << "\n";
  for (const std::string& warning : summary.warnings) spdlog::warn(warning);
}

}  // namespace

void add_import_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("import", "Turn a public data set's folder into a stack");
  command->footer(kFooter);
  command->add_option("KIND", arguments->kind, "Layout of the source folder")
      ->required()
      ->check(CLI::IsMember(kinds()));
  command->add_option("SRC", arguments->source, "Source folder, or file of the kind oni")->required();
  command
      ->add_option("-o,--output", arguments->stack, "Stack folder to write; an older stack there is replaced")
      ->required()
      ->type_name("STACK");
  command->add_option("--response", arguments->response,
                      "How colour values encode radiance: linear, srgb or a gamma (instead of response.txt)");
  command
      ->add_option("--lights", arguments->lights,
                   "oni: which lamp lit each frame, or 'dark'; without it every frame is a lamp of its own")
      ->delimiter(',');
  command->add_option("--every", arguments->every, "oni: take every n-th frame; default: 1")
      ->check(CLI::PositiveNumber);
  command->add_flag("--json", arguments->json, "Print one JSON object on stdout and nothing else there");
  command->callback([arguments, &exit_code] {
    run(*arguments);
    exit_code = 0;
  });
}

}  // namespace rakelight::cli
