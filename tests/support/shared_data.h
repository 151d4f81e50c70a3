// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real recordings that are not part of the project: tests on them skip aloud where they are absent.
//
//     RAKELIGHT_NEED_SHARED_DATA(folder, "mitten");   // std::filesystem::path folder, or the test is skipped
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace rakelight::test {

/// From the environment's RAKELIGHT_SHARED_DATA, else beside the source folder.
inline std::filesystem::path shared_data() {
  const char* given = std::getenv("RAKELIGHT_SHARED_DATA");
  if (given != nullptr) return given;
  return std::filesystem::path(RAKELIGHT_SOURCE_DIR) / ".." / "shared" / "data";
}

}  // namespace rakelight::test

#define RAKELIGHT_NEED_SHARED_DATA(variable, name)                                  \
  const std::filesystem::path variable = ::rakelight::test::shared_data() / (name); \
  if (!std::filesystem::exists(variable)) GTEST_SKIP() << "no shared data at " << variable
