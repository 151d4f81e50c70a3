// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenNI2 as this program finds it: its version, its drivers, the devices they see.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rakelight {

struct FoundDevice {
  std::string uri, vendor, name;
  std::string usb_id;  ///< "1d27:0601"
};

struct OpenniDrivers {
  std::filesystem::path folder;     ///< where the loaded library looks for them
  std::vector<std::string> loaded;  ///< file names, sorted
  std::vector<std::string>
      skipped;  ///< drivers by another name than lib*.so.0: the library passes them over silently
};

struct OpenniInstall {
  std::string version;  ///< "2.2.0.33"
  OpenniDrivers drivers;
  std::vector<FoundDevice> devices;
  std::string trouble;  ///< why devices could not be listed; empty: they could
};

/// Loads every driver, as opening a sensor does.
OpenniInstall examine_openni();

/// The drivers in a folder.
OpenniDrivers list_openni_drivers(const std::filesystem::path& folder);

}  // namespace rakelight
