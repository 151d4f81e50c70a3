// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/openni_session.h"

#include <OpenNI.h>

#include <algorithm>

namespace rakelight {

OpenniSession::OpenniSession() {
  if (openni::OpenNI::initialize() != openni::STATUS_OK) {
    throw openni_error(std::errc::no_such_device, "cannot start OpenNI2",
                       "rakelight doctor says what is missing");
  }
}

OpenniSession::~OpenniSession() { openni::OpenNI::shutdown(); }

std::system_error openni_error(std::errc code, const std::string& attempt, const std::string& cure) {
  std::string reason = openni::OpenNI::getExtendedError();
  std::replace_if(
      reason.begin(), reason.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  reason.erase(reason.find_last_not_of(' ') + 1);
  if (!reason.empty()) reason = ": " + reason;
  return {std::make_error_code(code), attempt + reason + "; " + cure};
}

}  // namespace rakelight
