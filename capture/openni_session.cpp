// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/openni_session.h"

#include <OpenNI.h>

#include <algorithm>

namespace rakelight {

namespace {

/// Shut down when the program ends.
struct Library {
  bool started = openni::OpenNI::initialize() == openni::STATUS_OK;
  ~Library() {
    if (started) openni::OpenNI::shutdown();
  }
};

}  // namespace

void require_openni() {
  static Library library;
  if (!library.started) library.started = openni::OpenNI::initialize() == openni::STATUS_OK;
  if (library.started) return;
  throw openni_error(std::errc::no_such_device, "cannot start OpenNI2",
                     "rakelight doctor says what is missing");
}

std::system_error openni_error(std::errc code, const std::string& attempt, const std::string& cure) {
  std::string reason = openni::OpenNI::getExtendedError();
  std::replace_if(
      reason.begin(), reason.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  reason.erase(reason.find_last_not_of(' ') + 1);
  if (!reason.empty()) reason = ": " + reason;
  return {std::make_error_code(code), attempt + reason + "; " + cure};
}

}  // namespace rakelight
