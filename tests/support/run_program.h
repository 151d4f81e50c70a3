// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs the built program as a user would.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rakelight::test {

struct Ran {
  int exit_code = 0;  ///< 128 + the signal that ended it, as a shell says it
  std::string out, err;
};

/// The program started with its output going to files.
class RunningProgram {
 public:
  /// @param out where its standard output goes; empty: to be read from Ran
  explicit RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& out = {});
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void send(int signal) const;
  Ran wait();

 private:
  std::filesystem::path folder_;
  pid_t pid_ = 0;
};

Ran run(const std::vector<std::string>& arguments, const std::filesystem::path& out = {});

}  // namespace rakelight::test
