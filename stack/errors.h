// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The project's typed errors: each message is one line that says what was attempted, on what, why it failed and
// what to do. The command line maps them to exit codes.
#pragma once

#include <stdexcept>
#include <string>

namespace rakelight {

/// The data given cannot be used (exit 3).
class InputError : public std::runtime_error {
 public:
  /// @param subject the file, folder or thing at fault  @param fault what is wrong  @param cure what to do
  InputError(const std::string& subject, const std::string& fault, const std::string& cure)
      : std::runtime_error(subject + ": " + fault + "; " + cure) {}
};

/// An option asks for what this data cannot give (exit 2).
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Another writer holds the output (exit 5).
class BusyError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Disk or I/O failed (exit 6).
class IoError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A device is gone or does not do its work (exit 4). What the system itself reports is a std::system_error.
class DeviceError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The caller asked to stop (exit 130).
class Cancelled : public std::runtime_error {
 public:
  explicit Cancelled(const std::string& kept = "nothing was written")
      : std::runtime_error("interrupted; " + kept) {}
};

}  // namespace rakelight
