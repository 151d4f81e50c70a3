// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/doctor.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "capture/rig_file.h"
#include "cli/commands.h"

namespace rakelight::cli {
namespace {

using json = nlohmann::ordered_json;

constexpr int kDevice = 4;

struct Arguments {
  std::filesystem::path rig;
  bool json = false;
};

constexpr const char* kFooter = R"(Examples:
  rakelight doctor                        sensors on the USB, OpenNI2's drivers, GPIO chips, and what is wrong
  rakelight doctor --rig my-rig.toml      whether everything the rig file names is there and free
  rakelight doctor --json | jq '.findings[] | select(.level == "problem")'

Exit code 4 when a scan would fail: something the rig names is missing, held by another program, or may not be used.)";

std::string speed_text(double megabits) {
  char text[32];
  std::snprintf(text, sizeof text, "%g Mbit/s", megabits);
  return megabits > 0 ? text : "speed unknown";
}

void print_row(const char* name, const std::string& text) { std::printf("  %-10s%s\n", name, text.c_str()); }

void print_sensors(const Hardware& hardware) {
  for (const UsbSensor& sensor : hardware.sensors) {
    print_row("sensor", sensor.usb_id() + " " + sensor.kind.model + ", bus " + std::to_string(sensor.bus) +
                            " port " + (sensor.port.empty() ? "?" : sensor.port) + ", " +
                            speed_text(sensor.megabits) + ", " + to_string(sensor.access));
  }
  if (hardware.sensors.empty()) print_row("sensor", "none");
}

void print_openni(const OpenniInstall& openni) {
  std::string drivers;
  for (const std::string& name : openni.drivers.loaded) drivers += " " + name;
  print_row("OpenNI2", openni.version + ", drivers in " + openni.drivers.folder.string() + ":" + drivers);
  for (const FoundDevice& device : openni.devices) {
    print_row("", device.uri + ": " + device.vendor + " " + device.name);
  }
}

void print_chips(const std::vector<GpioChip>& chips) {
  for (const GpioChip& chip : chips) {
    if (chip.fault) {
      print_row("gpio", chip.path + ": " + chip.fault.message());
      continue;
    }
    const auto used =
        std::count_if(chip.lines.begin(), chip.lines.end(), [](const auto& line) { return line.used; });
    print_row("gpio", chip.name + " (" + chip.label + "): " + std::to_string(chip.lines.size()) + " lines, " +
                          std::to_string(used) + " in use");
  }
  if (chips.empty()) print_row("gpio", "none");
}

void print_findings(const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) {
    std::printf("  %-8s %s: %s%s%s\n", to_string(finding.level).c_str(), finding.subject.c_str(),
                finding.what.c_str(), finding.cure.empty() ? "" : "\n           ", finding.cure.c_str());
  }
}

json sensors_json(const Hardware& hardware) {
  json list = json::array();
  for (const UsbSensor& sensor : hardware.sensors) {
    list.push_back({{"usb_id", sensor.usb_id()},
                    {"model", sensor.kind.model},
                    {"driver", sensor.kind.driver},
                    {"bus", sensor.bus},
                    {"port", sensor.port},
                    {"node", sensor.node()},
                    {"megabits", sensor.megabits},
                    {"access", to_string(sensor.access)}});
  }
  return list;
}

json openni_json(const OpenniInstall& openni) {
  json devices = json::array();
  for (const FoundDevice& device : openni.devices) {
    devices.push_back(
        {{"uri", device.uri}, {"vendor", device.vendor}, {"name", device.name}, {"usb_id", device.usb_id}});
  }
  return {{"version", openni.version},
          {"drivers_folder", openni.drivers.folder.string()},
          {"drivers", openni.drivers.loaded},
          {"passed_over", openni.drivers.skipped},
          {"devices", devices},
          {"trouble", openni.trouble}};
}

json chips_json(const std::vector<GpioChip>& chips) {
  json list = json::array();
  for (const GpioChip& chip : chips) {
    json lines = json::array();
    for (const GpioLineInfo& line : chip.lines) {
      lines.push_back(
          {{"offset", line.offset}, {"name", line.name}, {"used", line.used}, {"consumer", line.consumer}});
    }
    list.push_back({{"path", chip.path},
                    {"label", chip.label},
                    {"trouble", chip.fault ? chip.fault.message() : ""},
                    {"lines", lines}});
  }
  return list;
}

json findings_json(const std::vector<Finding>& findings) {
  json list = json::array();
  for (const Finding& finding : findings) {
    list.push_back({{"level", to_string(finding.level)},
                    {"subject", finding.subject},
                    {"what", finding.what},
                    {"cure", finding.cure}});
  }
  return list;
}

void print_json(const Hardware& hardware, const std::vector<Finding>& findings) {
  const json report = {{"sensors", sensors_json(hardware)},
                       {"openni", openni_json(hardware.openni)},
                       {"gpio", chips_json(hardware.chips)},
                       {"findings", findings_json(findings)}};
  std::cout << report.dump(2, ' ', false, json::error_handler_t::replace) << "\n";
}

void print_text(const Hardware& hardware, const std::vector<Finding>& findings) {
  print_sensors(hardware);
  print_openni(hardware.openni);
  print_chips(hardware.chips);
  std::printf("\n");
  print_findings(findings);
}

int run(const Arguments& arguments) {
  std::optional<Rig> rig;
  if (!arguments.rig.empty()) rig = read_rig(arguments.rig);
  const Hardware hardware = survey_hardware();
  const std::vector<Finding> findings = diagnose(hardware, rig ? &*rig : nullptr);
  (arguments.json ? print_json : print_text)(hardware, findings);
  const bool fails = std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.level == Finding::Level::problem;
  });
  return fails ? kDevice : 0;
}

}  // namespace

void add_doctor_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      program.add_subcommand("doctor", "What is plugged in, what is wrong with it, what cures it");
  command->footer(kFooter);
  command->add_option("--rig", arguments->rig, "Rig file: also check that what it names is there")
      ->type_name("FILE");
  command->add_flag("--json", arguments->json, "Print one JSON object on stdout and nothing else there");
  command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace rakelight::cli
