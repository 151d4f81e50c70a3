// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/openni_install.h"

#include <OpenNI.h>
#include <dlfcn.h>

#include <cstdio>
#include <regex>
#include <set>

namespace rakelight {
namespace fs = std::filesystem;
namespace {

/// The library looks beside the name it was loaded by, links not resolved.
fs::path drivers_folder() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<void*>(&oniGetVersion), &library) == 0 || library.dli_fname == nullptr)
    return {};
  return fs::path(library.dli_fname).parent_path() / "OpenNI2" / "Drivers";
}

std::string version_text(const openni::Version& version) {
  return std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
         std::to_string(version.maintenance) + "." + std::to_string(version.build);
}

FoundDevice device_of(const openni::DeviceInfo& info) {
  char usb_id[16];
  std::snprintf(usb_id, sizeof usb_id, "%04x:%04x", info.getUsbVendorId(), info.getUsbProductId());
  return {info.getUri(), info.getVendor(), info.getName(), usb_id};
}

}  // namespace

OpenniDrivers list_openni_drivers(const fs::path& folder) {
  static const std::regex loadable("lib.*\\.so\\.0"), driver("lib.*\\.so(\\..*)?");
  std::set<std::string> loaded, others;
  std::error_code error;  // no such folder: no drivers
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (std::regex_match(name, loadable))
      loaded.insert(name);
    else if (std::regex_match(name, driver))
      others.insert(name);
  }
  OpenniDrivers drivers{folder, {loaded.begin(), loaded.end()}, {}};
  for (const std::string& name : others) {
    if (loaded.count(name + ".0") == 0) drivers.skipped.push_back(name);  // else a link for developers
  }
  return drivers;
}

OpenniInstall examine_openni() {
  OpenniInstall install;
  install.version = version_text(openni::OpenNI::getVersion());
  install.drivers = list_openni_drivers(drivers_folder());
  if (openni::OpenNI::initialize() != openni::STATUS_OK) {
    install.trouble = openni::OpenNI::getExtendedError();
    return install;
  }
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  for (int k = 0; k < devices.getSize(); ++k) install.devices.push_back(device_of(devices[k]));
  openni::OpenNI::shutdown();
  return install;
}

}  // namespace rakelight
