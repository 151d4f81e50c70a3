// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lights/descriptors.h"

#include <dirent.h>
#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <system_error>

namespace rakelight {
namespace {

struct CloseFolder {
  void operator()(DIR* folder) const { closedir(folder); }
};

}  // namespace

std::vector<int> open_descriptors() {
  const std::unique_ptr<DIR, CloseFolder> folder(opendir("/proc/self/fd"));
  if (!folder)
    throw std::system_error(errno, std::generic_category(), "cannot list /proc/self/fd; is /proc mounted?");
  std::vector<int> open;
  while (const dirent* entry = readdir(folder.get())) {
    if (entry->d_name[0] == '.') continue;
    const int fd = std::atoi(entry->d_name);
    if (fd != dirfd(folder.get())) open.push_back(fd);
  }
  std::sort(open.begin(), open.end());
  return open;
}

void close_all_but(std::vector<int> keep) {
  const int nothing = open("/dev/null", O_RDWR);
  for (int standard = 0; standard <= 2; ++standard) {
    if (nothing >= 0) dup2(nothing, standard);
  }
  std::sort(keep.begin(), keep.end());
  for (const int fd : open_descriptors()) {
    if (fd > 2 && !std::binary_search(keep.begin(), keep.end(), fd)) close(fd);
  }
}

}  // namespace rakelight
