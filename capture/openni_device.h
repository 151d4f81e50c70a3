// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An opened OpenNI2 device. Opening it twice gives two handles to one device.
#pragma once

#include <cstddef>
#include <memory>

#include "capture/rig.h"

namespace openni {
class Device;
}

namespace rakelight {

class OpenniDevice {
 public:
  /// An empty uri: the first device. @throws std::system_error
  explicit OpenniDevice(const std::string& uri);
  ~OpenniDevice();
  OpenniDevice(const OpenniDevice&) = delete;
  OpenniDevice& operator=(const OpenniDevice&) = delete;

  openni::Device& get() { return *device_; }
  bool set_property(int id, const void* data, std::size_t size);
  bool get_property(int id, void* data, std::size_t size);

 private:
  std::unique_ptr<openni::Device> device_;
};

/// To be told of a device that has been unplugged, so that a virtual one can be opened anew.
void note_unplugged(const std::string& uri);

/// The rig's sensor; a virtual one is told what the rig says and has rendered its scene when this returns.
std::unique_ptr<OpenniDevice> open_openni_device(const Rig& rig);

}  // namespace rakelight
