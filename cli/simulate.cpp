// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/simulate.h"

#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "stack/color_response.h"
#include "stack/errors.h"
#include "stack/stack_io.h"

namespace rakelight::cli {
namespace {

constexpr const char* kFooter = R"(Examples:
  rakelight simulate -o vase                                   a vase under 16 far lamps, as a real rig sees it
  rakelight simulate -o coin --scene coin --albedo simple --color-scale 2     colour twice as fine as depth
  rakelight simulate -o drape --scene drape --lamps near --layout swayed      a hand-held lamp, 0.8 m away
  rakelight simulate -o head --mesh igea.ply --albedo complicated --lights 8  a mesh file
  rakelight simulate -o led --rgb --lights 0 --frames 10       one image under red, green and blue lamps at once
  rakelight simulate -o ball --scene sphere --realism ideal    first-order harmonics: a known answer
  rakelight simulate -o exact --realism ideal --no-depth-noise depth as it is, too)";

/// Single options change what `--realism` sets up, in whatever order they are written.
using Change = std::function<void(SimulateOptions&)>;

struct Arguments {
  std::filesystem::path output;
  Realism realism = Realism::real;
  std::vector<Change> changes;
  bool json = false;
};

const std::map<std::string, SceneKind> kScenes{{"vase", SceneKind::vase},
                                               {"coin", SceneKind::coin},
                                               {"drape", SceneKind::drape},
                                               {"sphere", SceneKind::sphere},
                                               {"plane", SceneKind::plane}};
const std::map<std::string, AlbedoKind> kAlbedos{{"simple", AlbedoKind::simple},
                                                 {"pattern", AlbedoKind::pattern},
                                                 {"complicated", AlbedoKind::complicated}};
const std::map<std::string, LampLayout> kLayouts{{"ring", LampLayout::ring}, {"swayed", LampLayout::swayed}};
const std::map<std::string, bool> kLamps{{"far", false}, {"near", true}};
const std::map<std::string, Realism> kRealisms{{"ideal", Realism::ideal}, {"real", Realism::real}};

/// Adds options and flags that become changes.
class Changes {
 public:
  Changes(CLI::App& command, std::shared_ptr<Arguments> arguments)
      : command_(command), arguments_(std::move(arguments)) {}

  template <class T, class Set>
  CLI::Option* option(const std::string& names, const std::string& help, Set set) {
    const auto keep = [arguments = arguments_, set](const T& value) {
      arguments->changes.push_back([set, value](SimulateOptions& options) { set(options, value); });
    };
    return command_.add_option_function<T>(names, keep, help);
  }

  template <class Enum, class Set>
  CLI::Option* choice(const std::string& names, const std::map<std::string, Enum>& values,
                      const std::string& help, Set set) {
    std::vector<std::string> words;
    for (const auto& [word, value] : values) words.push_back(word);
    const auto by_name = [set, values](SimulateOptions& o, const std::string& word) {
      set(o, values.at(word));
    };
    return option<std::string>(names, help, by_name)->check(CLI::IsMember(words));
  }

  void flag(const std::string& names, const std::string& help, const Change& change) {
    command_.add_flag_callback(
        names, [arguments = arguments_, change] { arguments->changes.push_back(change); }, help);
  }

 private:
  CLI::App& command_;
  std::shared_ptr<Arguments> arguments_;
};

void set_size(SimulateOptions& options, const std::string& text) {
  int width = 0, height = 0;
  char times = 0, more = 0;
  if (std::sscanf(text.c_str(), "%5d%c%5d%c", &width, &times, &height, &more) != 3 || times != 'x') {
    throw UsageError("--size is " + text + "; give WIDTHxHEIGHT, such as 640x480");
  }
  options.width = width;
  options.height = height;
}

using Options = SimulateOptions;

void add_scene_options(CLI::App& command, Changes& add) {
  command.option_defaults()->group("Scene");
  auto* scene = add.choice("--scene", kScenes, "Object; default: vase",
                           [](Options& o, SceneKind v) { o.scene.kind = v; });
  add.option<std::string>("--mesh", "A PLY or OBJ file instead, y up, z to the viewer",
                          [](Options& o, const std::string& v) {
                            o.scene.kind = SceneKind::mesh;
                            o.scene.mesh = v;
                          })
      ->type_name("FILE")
      ->excludes(scene);
  add.choice("--albedo", kAlbedos, "Paint; default: pattern",
             [](Options& o, AlbedoKind v) { o.scene.albedo = v; });
  add.option<double>("--distance", "Of the object's centre; default: 1",
                     [](Options& o, double v) { o.scene.distance_m = v; })
      ->type_name("M");
  add.option<std::vector<double>>("--rotate", "Turn the object: yaw, pitch, roll in degrees",
                                  [](Options& o, const std::vector<double>& v) {
                                    o.scene.rotation_deg = {v[0], v[1], v[2]};
                                  })
      ->delimiter(',')
      ->expected(3)
      ->type_name("Y,P,R");
  add.option<std::string>("--size", "Depth grid; default: 640x480", set_size)->type_name("WxH");
  add.option<int>("--color-scale", "Colour size / depth size, 1 to 4; default: 1",
                  [](Options& o, int v) { o.color_scale = v; });
}

void add_lamp_options(CLI::App& command, Changes& add) {
  command.option_defaults()->group("Lamps");
  add.option<int>("--lights", "White lamps, lit in turn; default: 16",
                  [](Options& o, int v) { o.lamps.count = v; });
  add.flag("--rgb", "First an image under a red, a green and a blue lamp at once",
           [](Options& o) { o.lamps.rgb = true; });
  add.choice("--layout", kLayouts, "Rings, or a lamp swayed by hand; default: ring",
             [](Options& o, LampLayout v) { o.lamps.layout = v; });
  add.choice("--lamps", kLamps, "Parallel light, or lamps nearby; default: far",
             [](Options& o, bool v) { o.lamps.near = v; });
  add.option<double>("--lamp-distance", "Of near lamps from the object; default: 0.8",
                     [](Options& o, double v) { o.lamps.distance_m = v; })
      ->type_name("M");
  add.option<double>("--lamp-distance-spread", "Share by which distances vary; default: 0.15",
                     [](Options& o, double v) { o.lamps.distance_spread = v; });
  add.option<double>("--lamp-angle", "Mean angle to the optical axis; default: 40",
                     [](Options& o, double v) { o.lamps.angle_deg = v; })
      ->type_name("DEG");
  add.flag("--lamp-positions", "Write where near lamps stand into the stack",
           [](Options& o) { o.lamps.write_positions = true; });
  add.option<double>("--ambient", "Room light, share of a lamp's; real: 0.03",
                     [](Options& o, double v) { o.lamps.ambient = v; });
  add.flag("--dark-frame", "First a frame with all lamps off (real: on)",
           [](Options& o) { o.lamps.dark_frame = true; });
  add.flag("--no-dark-frame", "No such frame", [](Options& o) { o.lamps.dark_frame = false; });
}

void add_image_options(CLI::App& command, Changes& add) {
  command.option_defaults()->group("Images");
  add.option<int>("--bits", "8 or 16; real: 8, ideal: 16", [](Options& o, int v) { o.image.bits = v; });
  add.option<std::string>(
         "--response", "How values encode radiance; default: linear",
         [](Options& o, const std::string& v) { o.image.response = parse_color_response(v); })
      ->type_name("linear|srgb|GAMMA");
  add.option<int>("--samples", "Rays a pixel, a side; default: 4",
                  [](Options& o, int v) { o.image.samples = v; });
  add.flag("--shadows", "Attached and cast shadows (real: on)",
           [](Options& o) { o.image.attached_shadows = o.image.cast_shadows = true; });
  add.flag("--no-shadows", "Neither; shading is 0.75 l.n + 0.25",
           [](Options& o) { o.image.attached_shadows = o.image.cast_shadows = false; });
  add.flag("--no-cast-shadows", "Attached shadows only", [](Options& o) { o.image.cast_shadows = false; });
  add.option<double>("--highlights", "Peak of the highlights, share of a white surface; real: 0.25",
                     [](Options& o, double v) { o.image.highlight = v; });
  add.flag("--no-highlights", "A matt surface", [](Options& o) { o.image.highlight = 0; });
  add.option<double>("--image-noise", "Deviation at full scale; a third of it in the dark; real: 0.01",
                     [](Options& o, double v) {
                       o.image.shot_noise = v;
                       o.image.read_noise = 0.3 * v;
                     });
  add.flag("--no-noise", "Images without noise",
           [](Options& o) { o.image.shot_noise = o.image.read_noise = 0; });
  add.option<double>("--clip-share", "Share of the object's pixels that clip; real: 0.002",
                     [](Options& o, double v) { o.image.clip_share = v; });
  add.option<double>("--crosstalk", "Share of a LED's light that leaks into adjacent channels",
                     [](Options& o, double v) { o.image.crosstalk = v; });
}

void add_depth_options(CLI::App& command, Changes& add) {
  command.option_defaults()->group("Depth sensor");
  add.option<int>("--frames", "Depth frames; default: one an image",
                  [](Options& o, int v) { o.depth.frames = v; });
  add.option<double>(
         "--depth-noise-mm",
         "Deviation at 1 m of the noise correlated in space; default: 3.6; white noise is a third",
         [](Options& o, double v) {
           o.depth.noise_mm = v;
           o.depth.white_noise_mm = v / 3;
         })
      ->type_name("MM");
  add.option<double>("--disparity-step", "Quantisation; default: 0.125",
                     [](Options& o, double v) { o.depth.disparity_step_px = v; })
      ->type_name("PX");
  add.flag("--no-holes", "A reading everywhere", [](Options& o) { o.depth.holes = false; });
  add.flag("--no-depth-noise", "Depth as it is: no noise, steps or holes", [](Options& o) {
    o.depth.noise_mm = o.depth.white_noise_mm = o.depth.disparity_step_px = 0;
    o.depth.holes = false;
  });
}

Simulated simulate_with_bar(const SimulateOptions& options) {
  ProgressBar bar;
  return simulate_stack(options, [&bar](double fraction) {
    bar.show({"rendering", fraction});
    return !interrupted();
  });
}

void print_json(const Simulated& scan, const SimulateOptions& options, const std::filesystem::path& folder) {
  const LightStack& stack = scan.stack;
  nlohmann::ordered_json summary{{"folder", folder.string()},
                                 {"truth", (folder / "truth").string()},
                                 {"seed", options.seed},
                                 {"color_size", {stack.color_camera.width, stack.color_camera.height}},
                                 {"depth_size", {stack.depth_camera.width, stack.depth_camera.height}},
                                 {"lights", stack.lights.size()},
                                 {"frames", stack.frames.size()},
                                 {"object_pixels", cv::countNonZero(stack.mask)}};
  std::cout << summary.dump(2) << "\n";
}

void print_report(const Simulated& scan, const std::filesystem::path& folder) {
  const LightStack& stack = scan.stack;
  std::cout << folder.string() << ": " << stack.frames.size() << " frames, " << stack.lights.size()
            << " lights, colour " << stack.color_camera.width << "x" << stack.color_camera.height
            << ", depth " << stack.depth_camera.width << "x" << stack.depth_camera.height << "\n"
            << "  truth    " << (folder / "truth").string() << "\n";
}

int run(const Arguments& arguments) {
  catch_interrupts();
  SimulateOptions options = realism_options(arguments.realism);
  for (const Change& change : arguments.changes) change(options);
  check_stack_folder(arguments.output);
  const Simulated scan = simulate_with_bar(options);
  if (interrupted()) throw Cancelled();
  write_stack(scan.stack, arguments.output, scan.truth);
  arguments.json ? print_json(scan, options, arguments.output) : print_report(scan, arguments.output);
  return 0;
}

}  // namespace

void add_simulate_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      program.add_subcommand("simulate", "Render a stack with its truth: a scan of a synthetic object");
  command->footer(kFooter);
  command->add_option("-o,--output", arguments->output, "Stack folder to write")
      ->required()
      ->type_name("STACK");
  const auto set_realism = [arguments](const std::string& word) { arguments->realism = kRealisms.at(word); };
  command
      ->add_option_function<std::string>(
          "--realism", set_realism,
          "What other options start from. real (default): shadows, highlights, noise, 8-bit; "
          "ideal: first-order harmonics, 16-bit")
      ->check(CLI::IsMember({"ideal", "real"}));
  Changes add(*command, arguments);
  add.option<std::uint64_t>("--seed", "Equal seeds give equal bytes; default: 1",
                            [](Options& o, std::uint64_t v) { o.seed = v; });
  add.option<int>("--threads", "0 (default): all; the result is the same",
                  [](Options& o, int v) { o.threads = v; });
  command->add_flag("--json", arguments->json, "Print one JSON object on stdout and nothing else there");
  add_scene_options(*command, add);
  add_lamp_options(*command, add);
  add_image_options(*command, add);
  add_depth_options(*command, add);
  command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace rakelight::cli
