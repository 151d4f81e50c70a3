// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/open_files.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>

namespace rakelight {
namespace fs = std::filesystem;
namespace {

/// The number a folder of /proc has for a process, or 0.
pid_t pid_of(const std::string& folder) {
  pid_t pid = 0;
  const char* end = folder.data() + folder.size();
  const auto parsed = std::from_chars(folder.data(), end, pid);
  return parsed.ec == std::errc() && parsed.ptr == end ? pid : 0;
}

bool has_open(const fs::path& process, const std::string& target) {
  std::error_code error;  // another user's process, or one that has ended
  for (const auto& file : fs::directory_iterator(process / "fd", error)) {
    const fs::path opened = fs::read_symlink(file.path(), error);
    if (!error && opened.string().rfind(target, 0) == 0) return true;
  }
  return false;
}

}  // namespace

std::vector<Process> processes_with_open(const std::string& target, const fs::path& proc) {
  std::vector<Process> processes;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(proc, error)) {
    Process process;
    process.pid = pid_of(entry.path().filename().string());
    if (process.pid == 0 || process.pid == ::getpid() || !has_open(entry.path(), target)) continue;
    std::getline(std::ifstream(entry.path() / "comm"), process.name);
    processes.push_back(process);
  }
  std::sort(processes.begin(), processes.end(),
            [](const Process& a, const Process& b) { return a.pid < b.pid; });
  return processes;
}

std::string to_string(const std::vector<Process>& processes) {
  std::string text;
  for (const Process& process : processes) {
    text += (text.empty() ? "" : ", ") + process.name + " (process " + std::to_string(process.pid) + ")";
  }
  return text;
}

}  // namespace rakelight
