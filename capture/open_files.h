// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which processes hold a device open.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rakelight {

struct Process {
  pid_t pid = 0;
  std::string name;  ///< the kernel's, at most 15 characters
};

/// Processes with an open file whose target, as /proc shows it, begins with `target`: a device's path, or
/// "anon_inode:gpio-line" for requested GPIO lines. Those of other users are seen by root only. This one is left out.
std::vector<Process> processes_with_open(const std::string& target,
                                         const std::filesystem::path& proc = "/proc");

/// "gpioset (process 4711), ..." or empty.
std::string to_string(const std::vector<Process>& processes);

}  // namespace rakelight
