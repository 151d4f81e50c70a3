// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// fake_cp2112 PINS: plays a Silicon Labs CP2112 (HID 10c4:ea90, 8 GPIO pins) through /dev/uhid, so that the kernel's own
// hid-cp2112 driver makes a real GPIO chip of it. Ends, and so is unplugged, by any signal.
// Report numbers: Silicon Labs AN495, "CP2112 interface specification".
#include <fcntl.h>
#include <linux/hid.h>
#include <linux/input.h>
#include <linux/uhid.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "tests/kernel/pins.h"

namespace {

using rakelight::test::PinEvent;
using rakelight::test::Pins;

constexpr std::uint8_t kGpioConfig = 2, kGpioGet = 3, kGpioSet = 4, kVersion = 5, kSmbusConfig = 6;

// One vendor-defined feature report: the driver knows the reports without being told.
constexpr std::uint8_t kDescriptor[] = {0x06, 0x00, 0xff, 0x09, 0x01, 0xa1, 0x01, 0x85,
                                        0x02, 0x15, 0x00, 0x26, 0xff, 0x00, 0x75, 0x08,
                                        0x95, 0x04, 0x09, 0x01, 0xb1, 0x02, 0xc0};

std::int64_t now_us() {
  using namespace std::chrono;
  return duration_cast<microseconds>(steady_clock::now().time_since_epoch()).count();
}

Pins* map_pins(const char* file) {
  const int fd = open(file, O_RDWR | O_CREAT, 0600);
  if (fd < 0 || ftruncate(fd, sizeof(Pins)) != 0) return nullptr;
  void* memory = mmap(nullptr, sizeof(Pins), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  close(fd);
  return memory == MAP_FAILED ? nullptr : static_cast<Pins*>(memory);
}

void set_pins(Pins& pins, std::uint8_t levels, std::uint8_t mask) {
  const int free = mask & ~pins.held;
  pins.levels = static_cast<std::uint8_t>((pins.levels & ~free) | (levels & free));
  for (std::uint8_t offset = 0; offset < 8; ++offset) {
    if (((mask >> offset) & 1) == 0) continue;
    pins.events[pins.count % Pins::kCapacity] = {now_us(), offset,
                                                 static_cast<std::uint8_t>((levels >> offset) & 1)};
    ++pins.count;
  }
}

bool send(int device, const uhid_event& event) {
  return write(device, &event, sizeof event) == static_cast<ssize_t>(sizeof event);
}

bool plug_in(int device) {
  uhid_event event = {};
  event.type = UHID_CREATE2;
  uhid_create2_req& request = event.u.create2;
  std::snprintf(reinterpret_cast<char*>(request.name), sizeof request.name, "CP2112 HID USB-to-SMBus Bridge");
  request.bus = BUS_USB;
  request.vendor = 0x10c4;
  request.product = 0xea90;
  request.rd_size = sizeof kDescriptor;
  std::memcpy(request.rd_data, kDescriptor, sizeof kDescriptor);
  return send(device, event);
}

bool answer_get(int device, const uhid_get_report_req& asked, const Pins& pins) {
  uhid_event event = {};
  event.type = UHID_GET_REPORT_REPLY;
  uhid_get_report_reply_req& reply = event.u.get_report_reply;
  reply.id = asked.id;
  reply.data[0] = asked.rnum;
  switch (asked.rnum) {
    case kGpioConfig:
      reply.size = 5;
      reply.data[1] = pins.outputs;
      reply.data[2] = 0xff;  // push-pull
      break;
    case kGpioGet:
      reply.size = 2;
      reply.data[1] = pins.levels;
      break;
    case kVersion:
      reply.size = 3;
      reply.data[1] = 0x0c;  // part
      reply.data[2] = 0x06;  // revision
      break;
    case kSmbusConfig:
      reply.size = 14;
      break;
    default:
      reply.err = EIO;
  }
  return send(device, event);
}

bool obey_set(int device, const uhid_set_report_req& told, Pins& pins) {
  if (told.rnum == kGpioConfig) pins.outputs = told.data[1];
  if (told.rnum == kGpioSet) set_pins(pins, told.data[1], told.data[2]);
  uhid_event event = {};
  event.type = UHID_SET_REPORT_REPLY;
  event.u.set_report_reply.id = told.id;
  return send(device, event);
}

int serve(int device, Pins& pins) {
  uhid_event event;
  bool good = plug_in(device);
  while (good && read(device, &event, sizeof event) > 0) {
    if (event.type == UHID_GET_REPORT) good = answer_get(device, event.u.get_report, pins);
    if (event.type == UHID_SET_REPORT) good = obey_set(device, event.u.set_report, pins);
  }
  std::perror("fake_cp2112: /dev/uhid");
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  Pins* pins = map_pins(argv[1]);
  const int device = open("/dev/uhid", O_RDWR | O_CLOEXEC);
  if (pins == nullptr || device < 0) {
    std::perror("fake_cp2112");
    return 1;
  }
  return serve(device, *pins);
}
