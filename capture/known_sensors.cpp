// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/known_sensors.h"

#include <array>

namespace rakelight {
namespace {

constexpr std::uint16_t kPrimeSense = 0x1d27, kOrbbec = 0x2bc5;
constexpr const char* kPs1080 = "libPS1080.so.0";
constexpr const char* kPsLink = "libPSLink.so.0";
constexpr const char* kOrbbecDriver = "liborbbec.so.0";  // the core loads only lib*.so.0

struct Product {
  std::uint16_t id;
  const char* model;
  const char* driver;
};
constexpr std::array kPrimeSenseProducts{
    Product{0x0500, "PrimeSense reference design", kPs1080},
    Product{0x0600, "ASUS Xtion PRO or PRO LIVE, early firmware", kPs1080},
    Product{0x0601, "ASUS Xtion PRO LIVE", kPs1080},
    Product{0x0609, "PrimeSense Carmine or ASUS Xtion", kPs1080},
    Product{0x1280, "PrimeSense PSLink", kPsLink},
};

/// Orbbec gives 04xx to cameras of the OpenNI protocol, 05xx to the colour halves of some, others to UVC cameras.
std::optional<KnownSensor> orbbec(std::uint16_t product) {
  if (product >> 8 == 0x04) return KnownSensor{"Orbbec Astra family", kOrbbecDriver, false};
  if (product >> 8 == 0x05) return {};  // the other half is the sensor
  return KnownSensor{"Orbbec camera of a newer kind", "", false};
}

}  // namespace

std::optional<KnownSensor> known_sensor(std::uint16_t vendor, std::uint16_t product) {
  if (vendor == kOrbbec) return orbbec(product);
  if (vendor != kPrimeSense) return {};
  for (const Product& known : kPrimeSenseProducts) {
    if (known.id == product) return KnownSensor{known.model, known.driver, true};
  }
  return {};
}

}  // namespace rakelight
