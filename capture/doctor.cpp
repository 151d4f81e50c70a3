// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/doctor.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "lights/gpio_lookup.h"

namespace rakelight {
namespace {

using Level = Finding::Level;

constexpr double kNeededMegabits = 480;  // VGA depth and colour at 30 fps is about 230 Mbit/s
constexpr std::uint16_t kEarlyXtion = 0x0600;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Finding access_finding(const UsbSensor& sensor, const std::vector<Process>& users) {
  const std::string subject = "sensor " + sensor.usb_id();
  switch (sensor.access) {
    case UsbAccess::usable:
      return {Level::good, subject, sensor.kind.model + " may be used", ""};
    case UsbAccess::denied:
      return {Level::problem, subject, sensor.kind.model + ": no permission for " + sensor.node(),
              "write this line into /etc/udev/rules.d/60-rakelight.rules, run 'udevadm control --reload' as "
              "root and "
              "plug the sensor in again: " +
                  udev_rule(sensor.vendor)};
    case UsbAccess::busy:
      return {Level::problem, subject,
              sensor.kind.model + ": in use by " + (users.empty() ? "another program" : to_string(users)),
              "end that program"};
    case UsbAccess::gone:
      return {Level::problem, subject, sensor.kind.model + ": went away while it was looked at",
              "check cable and power, and plug it in again"};
    case UsbAccess::trouble:
      break;
  }
  return {Level::problem, subject, sensor.kind.model + ": cannot be opened: " + sensor.trouble,
          "plug it in again; see dmesg"};
}

void add_driver_finding(const UsbSensor& sensor, const OpenniDrivers& drivers,
                        std::vector<Finding>& findings) {
  const std::string subject = "sensor " + sensor.usb_id();
  const std::string& driver = sensor.kind.driver;
  if (driver.empty()) {
    findings.push_back({Level::problem, subject,
                        "no OpenNI2 driver is known for it: most such cameras are UVC devices",
                        "use a sensor that speaks OpenNI's protocol (1d27:*, 2bc5:04xx)"});
    return;
  }
  if (contains(drivers.loaded, driver)) return;
  const std::string cure =
      sensor.kind.packaged
          ? "install the package libopenni2-0 anew"
          : "copy the maker's driver there under exactly this name: the library loads no other";
  findings.push_back(
      {Level::problem, subject, "its driver " + driver + " is not in " + drivers.folder.string(), cure});
}

void add_sensor_findings(const Hardware& hardware, std::vector<Finding>& findings) {
  for (std::size_t k = 0; k < hardware.sensors.size(); ++k) {
    const UsbSensor& sensor = hardware.sensors[k];
    const std::string subject = "sensor " + sensor.usb_id();
    findings.push_back(access_finding(sensor, hardware.sensor_users.at(k)));
    add_driver_finding(sensor, hardware.openni.drivers, findings);
    if (sensor.megabits > 0 && sensor.megabits < kNeededMegabits) {
      char speed[64];
      std::snprintf(speed, sizeof speed, "runs at %g Mbit/s, too slow for depth and colour", sensor.megabits);
      findings.push_back(
          {Level::problem, subject, speed, "plug it into the computer itself, with another cable"});
    }
    if (sensor.product == kEarlyXtion) {
      findings.push_back(
          {Level::note, subject, "early firmware fails on many USB 3 ports",
           "if streams do not start: a USB 2 port, UsbInterface=0 in PS1080.ini, or firmware 5.8.22"});
    }
  }
}

void add_openni_findings(const OpenniInstall& openni, std::vector<Finding>& findings) {
  if (!openni.trouble.empty())
    findings.push_back(
        {Level::problem, "OpenNI2", "cannot start: " + openni.trouble, "reinstall libopenni2-0"});
  if (openni.drivers.loaded.empty()) {
    findings.push_back({Level::problem, "OpenNI2", "no driver in " + openni.drivers.folder.string(),
                        "install libopenni2-0"});
  }
  for (const std::string& name : openni.drivers.skipped) {
    findings.push_back({Level::note, "OpenNI2", "passes over the driver " + name, "name it lib....so.0"});
  }
}

Finding wanted_sensor(const Hardware& hardware, const SensorSetup& setup) {
  const std::string cure = "plug it in, or correct uri under [sensor]";
  if (setup.uri == "virtual") return {Level::good, "rig's sensor", "virtual: nothing to plug in", ""};
  const auto& devices = hardware.openni.devices;
  if (setup.uri.empty()) {
    if (!devices.empty()) return {Level::good, "rig's sensor", "the first: " + devices.front().uri, ""};
    return {Level::problem, "rig's sensor", "OpenNI2 sees no device",
            "plug a sensor in; see what is said about it above"};
  }
  const bool listed = std::any_of(devices.begin(), devices.end(),
                                  [&](const FoundDevice& device) { return device.uri == setup.uri; });
  if (listed || std::filesystem::is_regular_file(setup.uri))
    return {Level::good, "rig's sensor", setup.uri, ""};
  return {Level::problem, "rig's sensor", "OpenNI2 sees no " + setup.uri, cure};
}

const GpioLineInfo& line_of(const FoundLine& line, const std::vector<GpioChip>& chips) {
  const auto chip = std::find_if(chips.begin(), chips.end(),
                                 [&](const GpioChip& candidate) { return candidate.path == line.chip_path; });
  return chip->lines.at(line.offset);
}

/// The error's one line, "what: why; cure: errno in words", in its parts.
Finding lookup_problem(const std::string& subject, const std::system_error& error) {
  std::string text = error.what();
  const std::string reason = ": " + error.code().message();
  if (text.size() > reason.size() && text.compare(text.size() - reason.size(), reason.size(), reason) == 0)
    text.resize(text.size() - reason.size());
  const auto cut = text.find("; ");
  if (cut == std::string::npos) return {Level::problem, subject, text, ""};
  return {Level::problem, subject, text.substr(0, cut), text.substr(cut + 2)};
}

Finding lamp_finding(const RigLamp& lamp, const Hardware& hardware) {
  const std::string subject = "lamp " + lamp.id;
  const LineAddress& wire = lamp.line;
  try {
    const FoundLine line =
        find_lines({{wire.name, wire.chip, wire.offset, wire.active_low}}, hardware.chips).front();
    const GpioLineInfo& info = line_of(line, hardware.chips);
    if (!info.used) return {Level::good, subject, to_string(line) + " is free", ""};
    const std::string holder =
        info.consumer.empty() ? "the kernel or another program" : "'" + info.consumer + "'";
    const std::string processes =
        hardware.line_holders.empty() ? "" : "; GPIO lines are held by " + to_string(hardware.line_holders);
    return {Level::problem, subject, to_string(line) + " is held by " + holder + processes,
            "end that program"};
  } catch (const std::system_error& error) { return lookup_problem(subject, error); }
}

}  // namespace

std::string udev_rule(std::uint16_t vendor) {
  char rule[128];
  std::snprintf(
      rule, sizeof rule,
      "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"%04x\", MODE=\"0660\", GROUP=\"plugdev\", TAG+=\"uaccess\"",
      vendor);
  return rule;
}

std::string to_string(Finding::Level level) {
  switch (level) {
    case Level::good:
      return "good";
    case Level::note:
      return "note";
    case Level::problem:
      return "problem";
  }
  return "problem";
}

Hardware survey_hardware() {
  Hardware hardware;
  hardware.sensors = find_usb_sensors();
  for (const UsbSensor& sensor : hardware.sensors) {
    hardware.sensor_users.push_back(processes_with_open(sensor.node()));
  }
  hardware.openni = examine_openni();
  hardware.chips = list_gpio_chips();
  hardware.line_holders = processes_with_open("anon_inode:gpio-line");
  return hardware;
}

std::vector<Finding> diagnose(const Hardware& hardware, const Rig* rig) {
  std::vector<Finding> findings;
  add_openni_findings(hardware.openni, findings);
  add_sensor_findings(hardware, findings);
  if (rig == nullptr) {
    if (hardware.sensors.empty())
      findings.push_back(
          {Level::note, "sensor", "no RGB-D sensor on the USB", "plug one in, or use the virtual rig"});
    return findings;
  }
  findings.push_back(wanted_sensor(hardware, rig->sensor));
  if (rig->virtual_rig) return findings;
  for (const RigLamp& lamp : rig->lamps) findings.push_back(lamp_finding(lamp, hardware));
  return findings;
}

}  // namespace rakelight
