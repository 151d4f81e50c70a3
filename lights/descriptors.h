// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// File descriptors: one owned, and those of the process.
#pragma once

#include <unistd.h>

#include <utility>
#include <vector>

namespace rakelight {

/// Owns a descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() { close(); }

  int get() const { return fd_; }
  void close() {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  }

 private:
  int fd_;
};

/// Those of this process, sorted.
std::vector<int> open_descriptors();

/// Closes all others; standard input, output and error become /dev/null, so that nobody waits for their end.
void close_all_but(std::vector<int> keep);

}  // namespace rakelight
