// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "capture/auto_mask.h"
#include "capture/capture.h"
#include "capture/open_rig.h"
#include "capture/rig_file.h"
#include "capture/scan_folder.h"
#include "capture/virtual_sensor.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/scan_view.h"
#include "refine/output/result_io.h"
#include "refine/refine.h"
#include "stack/errors.h"
#include "stack/stack_io.h"
#include "stack/truth_io.h"

namespace rakelight::cli {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

constexpr int kNotConverged = 7;
constexpr double kFirstImage = 0.4;  ///< of the progress: from there on frames say which lamp they show

struct Arguments {
  fs::path rig, output, refined;
  std::string mask;
  std::optional<int> repeats;
  std::optional<bool> rgb_shot;
  int depth_frames = 2;
  bool resume = false, no_metering = false, view = false, json = false;
};

constexpr const char* kFooter = R"(Examples:
  rakelight scan -o my-scan                                  the virtual rig: no hardware needed
  rakelight scan --rig my-rig.toml -o my-scan --mask auto    a sensor and lamps, the object found by itself
  rakelight scan --rig my-rig.toml -o my-scan --refine out   and refined while the lamps are off
  rakelight scan -o my-scan --refine out --view              and watched: the lamps at work, then the surface
  rakelight scan --rig my-rig.toml -o my-scan --resume       go on with a scan that was cut off
  rakelight scan -o my-scan --json | jq .faults              what is wrong with the lamps

A scan that is interrupted (130; closing the window of --view does it, too) or loses its sensor (4) switches the lamps off and keeps the images it has.)";

Rig rig_of(const Arguments& arguments) {
  Rig rig = arguments.rig.empty() ? virtual_rig() : read_rig(arguments.rig);
  if (!is_recording(rig)) return rig;
  throw UsageError(
      "scan: the sensor of " + arguments.rig.string() + " is the recording " + rig.sensor.uri +
      ", which no lamp changes any more; refine a stack as it is, and turn an .oni file into one with "
      "'rakelight import oni'");
}

std::string lamp_text(const Frame& frame) { return frame.light ? "lamp " + *frame.light : "no lamp"; }

ScanOptions options_of(const Arguments& arguments, ScanFolder& folder, const ScanView& view) {
  ScanOptions options;
  options.repeats = arguments.repeats;
  options.rgb_shot = arguments.rgb_shot;
  options.depth_frames = arguments.depth_frames;
  options.meter = !arguments.no_metering;
  options.resume = folder.unfinished();
  options.on_frame = [&folder, &view](const ScanState& state, const Frame& frame) {
    folder.record(state, frame);
    view.say("scanning: " + lamp_text(frame));
  };
  return options;
}

/// What an interrupted scan leaves, and how to go on.
std::string kept(ScanFolder& folder, const Arguments& arguments) {
  folder.flush();
  const int images = folder.frames_kept();
  if (images == 0) return "the lamps are off; no image had been taken yet, so nothing is kept";
  const std::string rig = arguments.rig.empty() ? "" : " --rig " + arguments.rig.string();
  return "the lamps are off; " + std::to_string(images) + " images are kept in " + folder.place().string() +
         ": complete the scan with 'rakelight scan" + rig + " -o " + arguments.output.string() + " --resume'";
}

struct Scanned {
  ScanResult scan;
  std::optional<GroundTruth> truth;  ///< what a virtual sensor looked at
};

/// @param lights given back as soon as the scan is over, whatever follows
Scanned scan_with_bar(const Rig& rig, const std::unique_ptr<Lights> lights, const Arguments& arguments,
                      ScanFolder& folder, const ScanView& view) {
  ProgressBar bar;
  const auto show = [&](const ScanProgress& progress) {
    bar.show({progress.stage, progress.fraction_done});
    if (progress.fraction_done < kFirstImage) view.say(progress.stage);
    return !interrupted() && !view.closed();
  };
  try {
    const auto source =
        view.watched(open_frame_source(rig), rig.calibration.color_response.value_or(ColorResponse()));
    Scanned scanned{
        capture_stack({*source, *lights, monotonic_clock()}, rig, options_of(arguments, folder, view), show),
        {}};
    if (rig.virtual_rig) scanned.truth = virtual_truth(rig);
    return scanned;
  } catch (const Cancelled&) { throw Cancelled(kept(folder, arguments)); } catch (const SensorLost& lost) {
    throw DeviceError(std::string(lost.what()) + "; " + kept(folder, arguments));
  }
}

void put_mask(LightStack& stack, const std::string& mask) {
  if (mask.empty()) return;
  stack.mask = mask == "auto" ? auto_mask(stack) : read_mask(mask);
  if (stack.mask.empty())
    spdlog::warn("scan: no object stands out in depth and light, so the stack has no mask");
}

/// For `evaluate`, beside the images.
void write_truth_of(const fs::path& stack, const GroundTruth& truth) {
  fs::create_directories(stack / "truth");
  write_truth(truth, stack / "truth");
}

RefineResult refine_with_bar(const LightStack& stack, ScanView& view) {
  ProgressBar bar;
  return refine_depth(stack, RefineOptions(), [&](const Progress& progress) {
    bar.show(progress);
    view.show(progress);
    return !interrupted() && !view.closed();
  });
}

double rounded(double value, double steps) { return std::round(value * steps) / steps; }

json faults_json(const std::vector<LampFault>& faults) {
  json list = json::array();
  for (const LampFault& fault : faults) {
    json entry = {{"kind", to_string(fault.kind)}, {"lamp", fault.lamp}};
    if (!fault.other.empty()) entry["other"] = fault.other;
    entry["level"] = rounded(fault.level, 1000);
    entry["message"] = fault.message;
    list.push_back(std::move(entry));
  }
  return list;
}

json report_json(const ScanResult& scan, const Arguments& arguments) {
  const LightStack& stack = scan.stack;
  return {{"stack", arguments.output.string()},
          {"lights", stack.lights.size()},
          {"frames", stack.frames.size()},
          {"sensor_time_ms", rounded(scan.sensor_time_us / 1000, 10)},
          {"lag_ms", rounded(scan.lag_us / 1000, 100)},
          {"exposure_us", stack.exposure_us.value_or(0)},
          {"gain", stack.gain.value_or(0)},
          {"saturated_share", rounded(scan.saturated, 1e5)},
          {"retaken", scan.retaken},
          {"dropped", scan.dropped},
          {"faults", faults_json(scan.faults)},
          {"warnings", scan.warnings}};
}

void print_report(const ScanResult& scan, const Arguments& arguments) {
  const LightStack& stack = scan.stack;
  std::printf("%s: %zu lights, %zu frames, colour %dx%d, depth %dx%d\n", arguments.output.c_str(),
              stack.lights.size(), stack.frames.size(), stack.color_camera.width, stack.color_camera.height,
              stack.depth_camera.width, stack.depth_camera.height);
  std::printf("  sequence  %.0f ms of sensor time, %d images taken again, %d frames dropped\n",
              scan.sensor_time_us / 1000, scan.retaken, scan.dropped);
  std::printf("  exposure  %.1f ms, gain %g: %.2f %% of the object saturated\n",
              stack.exposure_us.value_or(0) / 1000, stack.gain.value_or(0), scan.saturated * 100);
  std::fflush(stdout);
}

int refine_and_write(const LightStack& stack, const Arguments& arguments, json& report, ScanView& view) {
  const RefineResult result = refine_with_bar(stack, view);
  for (const std::string& warning : result.warnings) spdlog::warn("{}", warning);
  write_result(result, arguments.refined, &stack);
  report["refined"] = arguments.refined.string();
  report["refined_message"] = result.message;
  if (!arguments.json) {
    std::printf("%s: %s\n  picture   %s\n", arguments.refined.c_str(), result.message.c_str(),
                (arguments.refined / "before_after.png").c_str());
  }
  return result.termination == Termination::diverged ? kNotConverged : 0;
}

int scan_and_refine(const Rig& rig, std::unique_ptr<Lights> lights, const Arguments& arguments,
                    ScanView& view) {
  ScanFolder folder(arguments.output, arguments.resume);
  auto [scan, truth] = scan_with_bar(rig, std::move(lights), arguments, folder, view);
  scan.stack.origin = arguments.output.string();
  put_mask(scan.stack, arguments.mask);
  folder.finish(scan.stack);
  if (truth) write_truth_of(arguments.output, *truth);
  for (const std::string& warning : scan.warnings) spdlog::warn("scan: {}", warning);
  if (!arguments.json) print_report(scan, arguments);
  json report = report_json(scan, arguments);
  const int exit_code = arguments.refined.empty() ? 0 : refine_and_write(scan.stack, arguments, report, view);
  if (arguments.json) std::cout << report.dump(2) << std::endl;
  view.show(arguments.output, arguments.refined);
  return exit_code;
}

int run(const Arguments& arguments) {
  catch_interrupts();
  const Rig rig = rig_of(arguments);
  if (!arguments.refined.empty()) check_result_folder(arguments.refined);
  auto lights = open_lights(rig);  // first: it forks the lamps' guard, before there are threads
  ScanView nobody;
  if (!arguments.view) return scan_and_refine(rig, std::move(lights), arguments, nobody);
  int exit_code = 0;
  run_in_view([&](ScanView& view) { exit_code = scan_and_refine(rig, std::move(lights), arguments, view); });
  return exit_code;
}

}  // namespace

void add_scan_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("scan", "Run the light sequence on a sensor and write a stack");
  command->footer(kFooter);
  command->add_option("-o,--output", arguments->output, "Stack folder to write")
      ->required()
      ->type_name("STACK");
  command->add_option("--rig", arguments->rig, "What stands on the table; default: the virtual rig")
      ->type_name("RIG.toml");
  command->add_option("--refine", arguments->refined, "Refine, too, and write the result here")
      ->type_name("OUT");
  command
      ->add_option("--mask", arguments->mask,
                   "Mask image (255 = object), or auto: what is lit and stands in the middle by depth.\n"
                   "Without it every pixel with depth is the object")
      ->type_name("FILE|auto");
  command->add_flag("--resume", arguments->resume, "Complete an unfinished scan, if there is one");
  command->add_option("--repeats", arguments->repeats, "Images a lamp, instead of what the rig file says")
      ->check(CLI::Range(1, 64));
  command->add_flag_function(
      "--rgb,!--no-rgb", [arguments](std::int64_t count) { arguments->rgb_shot = count > 0; },
      "One image under the red, green and blue lamps at once, or none");
  command->add_option("--depth-frames", arguments->depth_frames, "Depth frames kept an image; default: 2")
      ->check(CLI::Range(1, 8));
  command->add_flag("--no-metering", arguments->no_metering,
                    "Take the rig file's exposure and gain as they are");
  command->add_flag("--view", arguments->view,
                    "A window: colour and depth while lamps switch, then the surface as it is refined");
  command->add_flag("--json", arguments->json, "Print one JSON object on stdout and nothing else there");
  command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace rakelight::cli
