// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "capture/open_rig.h"
#include "capture/rig_file.h"
#include "capture/rig_lights.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/lights_list.h"
#include "cli/read_back.h"
#include "stack/errors.h"

namespace rakelight::cli {
namespace {

using json = nlohmann::ordered_json;

struct Arguments {
  std::filesystem::path rig;
  std::vector<std::string> lamps;
  double seconds = 0;  ///< 0: the default of the action
  bool json = false;
};

constexpr const char* kFooter = R"(Examples:
  rakelight lights list                              GPIO chips, their lines, and who holds them
  rakelight lights list --rig my-rig.toml            and which lamp is on which line
  rakelight lights test --rig my-rig.toml            each lamp in turn, half a second each: look whether names fit.
                                                     What lines read back is compared with what was written
  rakelight lights on white-3 --rig my-rig.toml      one lamp, as long as the rig allows (max_on_ms)
  rakelight lights on red green blue --for 0.5 --rig my-rig.toml
  rakelight lights off --rig my-rig.toml             writes "off" to every line

No lamp stays lit: not after Ctrl-C, not after kill -9. Exit code 4: a line is missing, held by another program, may
not be used, or does not follow what is written.)";

void print_json(const json& report) {
  std::cout << report.dump(2, ' ', false, json::error_handler_t::replace) << "\n";
}

/// @throws UsageError where the rig does not allow that long
std::chrono::duration<double> checked_time(double seconds, const Rig& rig) {
  if (1000 * seconds > rig.max_on_ms) {
    char text[160];
    std::snprintf(
        text, sizeof text,
        "%g s are longer than this rig allows a lamp to be lit; give at most %g s or raise max_on_ms",
        seconds, rig.max_on_ms / 1000.0);
    throw UsageError(text);
  }
  return std::chrono::duration<double>(seconds);
}

/// @throws Cancelled, upon which the lamps go off, as with any exception
void wait(std::chrono::duration<double> time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) {
    if (interrupted()) throw Cancelled("the lamps are off");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

double milliseconds(const SwitchTime& time) {
  return static_cast<double>(time.after_us - time.before_us) / 1000.0;
}

/// Virtual lamps last as long as the program that switches them: one lit by hand would be seen by nobody.
void refuse_virtual_lamps(const Rig& rig) {
  if (!rig.virtual_rig || rig.virtual_rig->lamps_on_lines) return;
  throw UsageError(
      "the lamps of \"" + rig.name +
      "\" are virtual and nobody would see them; try each with 'rakelight lights test', or scan");
}

void run_on(const Arguments& arguments) {
  const Rig rig = read_rig(arguments.rig);
  for (const std::string& id : arguments.lamps) {
    const bool known =
        std::any_of(rig.lamps.begin(), rig.lamps.end(), [&](const RigLamp& lamp) { return lamp.id == id; });
    if (!known) throw UsageError("no lamp of " + arguments.rig.string() + " is called \"" + id + "\"");
  }
  const auto time = checked_time(arguments.seconds > 0 ? arguments.seconds : rig.max_on_ms / 1000.0, rig);
  refuse_virtual_lamps(rig);
  catch_interrupts();
  const auto lights = open_lights(rig);
  lights->show(arguments.lamps);
  wait(time);
  lights->all_off();
  if (arguments.json) print_json({{"lamps", arguments.lamps}, {"seconds", time.count()}});
}

void run_off(const Arguments& arguments) {
  const Rig rig = read_rig(arguments.rig);
  refuse_virtual_lamps(rig);
  const auto lights = open_lights(rig);
  const SwitchTime time = lights->all_off();
  if (arguments.json) print_json({{"off", lights->ids()}, {"write_ms", milliseconds(time)}});
}

json test_lamp(Lights& lights, const RigLamp& lamp, std::chrono::duration<double> time, bool print) {
  const SwitchTime switched = lights.show({lamp.id});
  wait(time);
  const ReadBack found = read_back(lights, lamp.id);
  lights.all_off();
  if (print) {
    std::printf("  %-16s %-6s %s, switched in %.1f ms: %s\n", lamp.id.c_str(), to_string(lamp.color).c_str(),
                line_text(lamp.line).c_str(), milliseconds(switched), to_string(found).c_str());
    std::fflush(stdout);
  }
  return {{"id", lamp.id},
          {"line", line_text(lamp.line)},
          {"switch_ms", milliseconds(switched)},
          {"read_back", to_string(found)},
          {"as_written", found.as_written()}};
}

void run_test(const Arguments& arguments) {
  const Rig rig = read_rig(arguments.rig);
  const auto time = checked_time(arguments.seconds > 0 ? arguments.seconds : 0.5, rig);
  catch_interrupts();
  const auto lights = open_lights(rig);
  json tested = json::array();
  std::string faulty;
  for (const RigLamp& lamp : rig.lamps) {
    tested.push_back(test_lamp(*lights, lamp, time, !arguments.json));
    if (!tested.back()["as_written"]) faulty += (faulty.empty() ? "" : ", ") + lamp.id;
  }
  if (arguments.json) print_json({{"tested", tested}});
  if (!faulty.empty()) {
    throw DeviceError("switched each lamp on alone, but it does not read so under " + faulty +
                      "; check what drives and what loads these lines");
  }
}

CLI::App* add_action(CLI::App& lights, const char* name, const char* what,
                     const std::shared_ptr<Arguments>& arguments, bool needs_rig = true) {
  CLI::App* action = lights.add_subcommand(name, what);
  CLI::Option* rig = action->add_option("--rig", arguments->rig, "Rig file")->type_name("FILE");
  if (needs_rig) rig->required();
  action->add_flag("--json", arguments->json, "Print one JSON object on stdout and nothing else there");
  return action;
}

}  // namespace

void add_lights_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* lights = program.add_subcommand("lights", "Switch the lamps of a rig by hand");
  lights->footer(kFooter);
  lights->require_subcommand(1);

  CLI::App* list = add_action(*lights, "list", "GPIO chips, lines, who holds them", arguments, false);
  list->callback([arguments, &exit_code] {
    std::optional<Rig> rig;
    if (!arguments->rig.empty()) rig = read_rig(arguments->rig);
    exit_code = list_lights(rig ? &*rig : nullptr, arguments->json);
  });

  CLI::App* on = add_action(*lights, "on", "Light lamps together for a while", arguments);
  on->add_option("LAMP", arguments->lamps, "Lamp ids of the rig file")->required();
  on->add_option("--for", arguments->seconds, "Seconds; at most, and by default, the rig's max_on_ms")
      ->check(CLI::PositiveNumber);
  on->callback([arguments] { run_on(*arguments); });

  CLI::App* off = add_action(*lights, "off", "Write \"off\" to every line", arguments);
  off->callback([arguments] { run_off(*arguments); });

  CLI::App* test = add_action(*lights, "test", "Light each lamp in turn", arguments);
  test->add_option("--each", arguments->seconds, "Seconds a lamp (0.5)")->check(CLI::PositiveNumber);
  test->callback([arguments] { run_test(*arguments); });
}

}  // namespace rakelight::cli
