// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/usb_sensors.h"

#include <libusb.h>

#include <array>
#include <cstdio>
#include <memory>
#include <system_error>

namespace rakelight {
namespace {

using Context = std::unique_ptr<libusb_context, decltype(&libusb_exit)>;
using Handle = std::unique_ptr<libusb_device_handle, decltype(&libusb_close)>;

/// Devices are counted references: freed with the list.
struct FreeList {
  void operator()(libusb_device** list) const { libusb_free_device_list(list, 1); }
};

[[noreturn]] void fail(int error) {
  const auto code = error == LIBUSB_ERROR_ACCESS ? std::errc::permission_denied : std::errc::io_error;
  throw std::system_error(std::make_error_code(code), std::string("cannot list USB devices: ") +
                                                          libusb_strerror(error) +
                                                          "; is /sys/bus/usb or /dev/bus/usb there?");
}

UsbAccess access_of(int error) {
  switch (error) {
    case LIBUSB_SUCCESS:
      return UsbAccess::usable;
    case LIBUSB_ERROR_ACCESS:
      return UsbAccess::denied;
    case LIBUSB_ERROR_BUSY:
      return UsbAccess::busy;
    case LIBUSB_ERROR_NO_DEVICE:
    case LIBUSB_ERROR_NOT_FOUND:
      return UsbAccess::gone;
    default:
      return UsbAccess::trouble;
  }
}

/// Opening says whether we may; claiming the first interface, whether somebody else streams.
int try_open(libusb_device* device) {
  libusb_device_handle* opened = nullptr;
  if (const int error = libusb_open(device, &opened); error != LIBUSB_SUCCESS) return error;
  const Handle handle(opened, libusb_close);
  const int claimed = libusb_claim_interface(handle.get(), 0);
  if (claimed == LIBUSB_SUCCESS) libusb_release_interface(handle.get(), 0);
  return claimed == LIBUSB_ERROR_BUSY ? claimed : LIBUSB_SUCCESS;
}

double megabits(libusb_device* device) {
  switch (libusb_get_device_speed(device)) {
    case LIBUSB_SPEED_LOW:
      return 1.5;
    case LIBUSB_SPEED_FULL:
      return 12;
    case LIBUSB_SPEED_HIGH:
      return 480;
    case LIBUSB_SPEED_SUPER:
      return 5000;
    case LIBUSB_SPEED_SUPER_PLUS:
      return 10000;
    default:
      return 0;
  }
}

std::string port_of(libusb_device* device) {
  std::array<std::uint8_t, 7> ports{};  // the deepest chain of hubs USB allows
  const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
  std::string text;
  for (int k = 0; k < depth; ++k) {
    text += (k == 0 ? "" : ".") + std::to_string(ports[static_cast<std::size_t>(k)]);
  }
  return text;
}

UsbSensor examine(libusb_device* device, const libusb_device_descriptor& descriptor,
                  const KnownSensor& kind) {
  UsbSensor sensor;
  sensor.vendor = descriptor.idVendor;
  sensor.product = descriptor.idProduct;
  sensor.kind = kind;
  sensor.bus = libusb_get_bus_number(device);
  sensor.address = libusb_get_device_address(device);
  sensor.port = port_of(device);
  sensor.megabits = megabits(device);
  const int error = try_open(device);
  sensor.access = access_of(error);
  if (sensor.access == UsbAccess::trouble) sensor.trouble = libusb_strerror(error);
  return sensor;
}

}  // namespace

std::string to_string(UsbAccess access) {
  switch (access) {
    case UsbAccess::usable:
      return "usable";
    case UsbAccess::denied:
      return "no permission";
    case UsbAccess::busy:
      return "busy";
    case UsbAccess::gone:
      return "gone";
    case UsbAccess::trouble:
      return "trouble";
  }
  return "trouble";
}

std::string UsbSensor::usb_id() const {
  char text[16];
  std::snprintf(text, sizeof text, "%04x:%04x", vendor, product);
  return text;
}

std::string UsbSensor::node() const {
  char text[40];
  std::snprintf(text, sizeof text, "/dev/bus/usb/%03d/%03d", bus, address);
  return text;
}

std::vector<UsbSensor> find_usb_sensors() {
  libusb_context* opened = nullptr;
  if (const int error = libusb_init(&opened); error != LIBUSB_SUCCESS) fail(error);
  const Context context(opened, libusb_exit);
  libusb_device** devices = nullptr;
  const ssize_t count = libusb_get_device_list(context.get(), &devices);
  if (count < 0) fail(static_cast<int>(count));
  const std::unique_ptr<libusb_device*[], FreeList> list(devices);
  std::vector<UsbSensor> sensors;
  for (ssize_t k = 0; k < count; ++k) {
    libusb_device_descriptor descriptor{};
    libusb_device* device = list[static_cast<std::size_t>(k)];
    if (libusb_get_device_descriptor(device, &descriptor) != LIBUSB_SUCCESS) continue;
    const auto kind = known_sensor(descriptor.idVendor, descriptor.idProduct);
    if (kind) sensors.push_back(examine(device, descriptor, *kind));
  }
  return sensors;
}

}  // namespace rakelight
