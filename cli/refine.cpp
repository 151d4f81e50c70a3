// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/refine.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/config_file.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "refine/option_fields.h"
#include "refine/output/result_io.h"
#include "refine/output/result_json.h"
#include "stack/color_response.h"
#include "stack/errors.h"
#include "stack/stack_io.h"

namespace rakelight::cli {
namespace {

constexpr int kNotConverged = 7;

struct Arguments {
  std::filesystem::path stack, output, config;
  std::optional<std::string> method, preset, mask, response, lamps, lamp_positions, solver;
  std::optional<int> scale, iterations, threads, frame, harmonics;
  std::vector<std::string> outputs;
  bool json = false, no_smoothness = false;
};

constexpr const char* kFooter = R"(Examples:
  rakelight refine my-scan -o my-surface                  as fine as the colour images, robust preset
  rakelight refine my-scan -o out --scale 1               on the depth camera's own grid
  rakelight refine my-scan -o out --preset paper          the paper to the letter
  rakelight refine my-scan -o out --mask object.png       another mask; 'auto': every pixel with depth
  rakelight refine my-scan -o out --response auto         find out whether colour values are linear
  rakelight refine my-scan -o out --outputs depth,normals   no mesh, pictures, report: quicker
  rakelight refine my-scan -o out --config tuned.toml     parameters by their names in result.json
  rakelight refine my-scan -o out --json | jq .quality    the summary for scripts)";

/// The value whose name is `text`; the command line has already refused what is none.
template <class Enum>
std::optional<Enum> value_named(const std::optional<std::string>& text) {
  for (const Enum value : kValuesOf<Enum>) {
    if (text && *text == to_string(value)) return value;
  }
  return std::nullopt;
}

template <class Enum>
std::vector<std::string> names_of() {
  std::vector<std::string> names;
  for (const Enum value : kValuesOf<Enum>) names.push_back(to_string(value));
  return names;
}

std::vector<std::string> output_names() {
  std::vector<std::string> names;
  for (const Output output : kAllOutputs) names.push_back(to_string(output));
  return names;
}

RefineOptions options_of(const Arguments& arguments) {
  RefineOptions options = read_options(
      arguments.config, {value_named<Preset>(arguments.preset), value_named<Method>(arguments.method)});
  options.scale = arguments.scale.value_or(options.scale);
  options.max_iterations = arguments.iterations.value_or(options.max_iterations);
  options.frame = arguments.frame.value_or(options.frame);
  options.estimate_response = options.estimate_response || arguments.response == "auto";
  if (arguments.no_smoothness) options.depth.smoothness = 0;
  options.threads = arguments.threads.value_or(options.threads);
  options.lamps.model = value_named<LampModel>(arguments.lamps).value_or(options.lamps.model);
  options.lamps.positions =
      value_named<LampPositions>(arguments.lamp_positions).value_or(options.lamps.positions);
  options.lamps.harmonics = arguments.harmonics.value_or(options.lamps.harmonics);
  options.depth.solver = value_named<Solver>(arguments.solver).value_or(options.depth.solver);
  return options;
}

std::vector<Output> outputs_of(const Arguments& arguments) {
  if (arguments.outputs.empty()) return kAllOutputs;
  std::vector<Output> outputs;
  for (const Output output : kAllOutputs) {
    const auto& names = arguments.outputs;
    if (std::find(names.begin(), names.end(), to_string(output)) != names.end()) outputs.push_back(output);
  }
  return outputs;
}

LightStack stack_of(const Arguments& arguments) {
  LightStack stack = read_stack(arguments.stack, Colors::on_disk);
  if (arguments.response && *arguments.response != "auto")
    stack.color_response = parse_color_response(*arguments.response);
  if (arguments.mask) stack.mask = *arguments.mask == "auto" ? cv::Mat1b() : read_mask(*arguments.mask);
  return stack;
}

RefineResult refine_with_bar(const LightStack& stack, const RefineOptions& options) {
  using Clock = std::chrono::steady_clock;
  ProgressBar bar;
  std::vector<Clock::time_point> ends;  // of the preparation and of each iteration
  RefineResult result = refine_depth(stack, options, [&](const Progress& progress) {
    bar.show(progress);
    ends.resize(static_cast<size_t>(progress.iteration) + 1, Clock::now());
    return !interrupted();
  });
  for (size_t i = 0; i < result.iterations.size() && i + 1 < ends.size(); ++i)
    result.iterations[i].seconds = std::chrono::duration<double>(ends[i + 1] - ends[i]).count();
  return result;
}

void print_json(const RefineResult& result, const std::filesystem::path& folder) {
  auto summary = nlohmann::ordered_json::parse(result_json(result));
  summary["folder"] = folder.string();
  std::cout << summary.dump(2) << "\n";
}

bool has(const std::vector<Output>& outputs, Output output) {
  return std::find(outputs.begin(), outputs.end(), output) != outputs.end();
}

void print_report(const RefineResult& result, const std::filesystem::path& folder,
                  const std::vector<Output>& outputs) {
  std::cout << result.message << "\n"
            << folder.string() << ": " << result.camera.width << "x" << result.camera.height << " (scale "
            << result.scale << "), " << result.iterations.size() << " iterations\n";
  if (has(outputs, Output::mesh)) std::cout << "  surface  " << (folder / "mesh.ply").string() << "\n";
  if (has(outputs, Output::pictures))
    std::cout << "  picture  " << (folder / "before_after.png").string() << "\n";
  if (has(outputs, Output::report)) std::cout << "  report   " << (folder / "report.html").string() << "\n";
}

int run(const Arguments& arguments) {
  catch_interrupts();
  RefineOptions options = options_of(arguments);
  const std::vector<Output> outputs = outputs_of(arguments);
  if (!has(outputs, Output::uncertainty)) options.uncertainty_samples = 0;
  check_result_folder(arguments.output);
  const LightStack stack = stack_of(arguments);
  const RefineResult result = refine_with_bar(stack, options);
  if (interrupted()) throw Cancelled();
  for (const std::string& warning : result.warnings) spdlog::warn("{}", warning);
  write_result(result, arguments.output, &stack, outputs);
  arguments.json ? print_json(result, arguments.output) : print_report(result, arguments.output, outputs);
  if (result.termination != Termination::diverged) return 0;
  spdlog::warn("refine: did not converge: {}", result.message);
  return kNotConverged;
}

}  // namespace

void add_refine_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("refine", "Refine a stack's depth by photometric stereo");
  command->footer(kFooter);
  command->add_option("STACK", arguments->stack, "Stack folder, or a source folder of an importer's layout")
      ->required();
  command->add_option("-o,--output", arguments->output, "Result folder to write")
      ->required()
      ->type_name("OUT");
  command->add_option("--method", arguments->method, "How to refine")
      ->check(CLI::IsMember(names_of<Method>()));
  command
      ->add_option("--preset", arguments->preset,
                   "robust (default): for real data; paper: the paper to the letter")
      ->check(CLI::IsMember(names_of<Preset>()));
  command
      ->add_option("--lamps", arguments->lamps,
                   "Lamp model: auto (default) takes near lamps if they explain the images clearly better")
      ->check(CLI::IsMember(names_of<LampModel>()));
  command
      ->add_option("--lamp-positions", arguments->lamp_positions,
                   "Of near lamps: estimated (default), start from the stack's position_m, or fixed there")
      ->check(CLI::IsMember(names_of<LampPositions>()));
  command
      ->add_option("--harmonics", arguments->harmonics,
                   "Order of the light's spherical harmonics: 1 (default), or 2 for broad and ambient light")
      ->check(CLI::Range(1, 2));
  command
      ->add_option("--scale", arguments->scale,
                   "Refined grid / depth grid, 1 to 4; default: as fine as the colour images")
      ->check(CLI::Range(1, 4));
  command->add_option("--mask", arguments->mask, "Mask image (255 = object), or auto: every pixel with depth")
      ->type_name("FILE|auto");
  command
      ->add_option("--response", arguments->response,
                   "What colour values mean, instead of what the stack says; auto finds the exponent that\n"
                   "agrees with the lighting model, and keeps what the stack says where it is not sure")
      ->type_name("linear|srgb|GAMMA|auto");
  command
      ->add_option("--outputs", arguments->outputs,
                   "Parts of the result to write, separated by commas; default: all")
      ->delimiter(',')
      ->check(CLI::IsMember(output_names()))
      ->type_name("depth,normals,albedo,uncertainty,mesh,pictures,report");
  command->add_option("--iterations", arguments->iterations, "Outer iterations at most")
      ->check(CLI::Range(1, 1000));
  command
      ->add_option("--solver", arguments->solver,
                   "Of the depth and albedo systems: multigrid (default), or exact, the slower reference")
      ->check(CLI::IsMember(names_of<Solver>()));
  command->add_option("--config", arguments->config, "Parameters from a TOML file; options here override it")
      ->type_name("FILE");
  command->add_option("--threads", arguments->threads, "Threads; 0 (default): all; the result is the same")
      ->check(CLI::Range(0, 1024));
  command
      ->add_option("--frame", arguments->frame,
                   "Single-image methods: index of the frame to use; default: the first that fits")
      ->check(CLI::Range(0, 1000000));
  command->add_flag("--ns", arguments->no_smoothness,
                    "Single-image methods: no Laplacian smoothness of the depth");
  command->add_flag("--json", arguments->json, "Print one JSON object on stdout and nothing else there");
  command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace rakelight::cli
