// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/atomic_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "stack/checked_file.h"
#include "stack/errors.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

/// The target with links resolved and no trailing slash, so that its siblings have names.
fs::path resolved(const fs::path& target) {
  std::error_code error;
  const fs::path path = fs::weakly_canonical(fs::absolute(target), error);
  if (error) throw_io_error("resolve", target, error.value());
  return path.has_filename() ? path : path.parent_path();
}

fs::path sibling(const fs::path& target, const std::string& suffix) {
  return target.parent_path() / ("." + target.filename().string() + suffix);
}

/// Waits until the disk has a file, or a folder's list of names.
void sync(const fs::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) throw_io_error("write", path, errno);
  const int error = ::fsync(fd) == 0 ? 0 : errno;
  ::close(fd);
  // EINVAL: a file system that knows no fsync for folders.
  if (error != 0 && error != EINVAL) throw_io_error("write", path, error);
}

void sync_tree(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) sync(entry.path());
  sync(folder);
}

bool same_file(int fd, const fs::path& path) {
  struct stat open_file {
  }, named{};
  return ::fstat(fd, &open_file) == 0 && ::stat(path.c_str(), &named) == 0 &&
         open_file.st_ino == named.st_ino && open_file.st_dev == named.st_dev;
}

void rename_or_throw(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) throw_io_error("rename to", to, errno);
}

}  // namespace

AtomicFolder::AtomicFolder(const fs::path& target, const FolderKind& kind)
    : target_(resolved(target)),
      temporary_(sibling(target_, ".partial")),
      old_(sibling(target_, ".old")),
      lock_file_(sibling(target_, ".lock")) {
  std::error_code error;
  fs::create_directories(target_.parent_path(), error);
  if (error) throw_io_error("create", target_.parent_path(), error.value());
  lock();
  try {
    recover_interrupted();
    check_replaceable(kind);
    if (!fs::create_directory(temporary_, error) || error)
      throw_io_error("create", temporary_, error.value());
  } catch (...) {
    ::unlink(lock_file_.c_str());
    ::close(lock_fd_);
    throw;
  }
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
  // Removed while still locked: whoever opened it meanwhile sees that the name is gone and starts over.
  ::unlink(lock_file_.c_str());
  ::close(lock_fd_);
}

void AtomicFolder::lock() {
  // A regular file, not the folder: network file systems refuse to lock folders.
  for (;;) {
    lock_fd_ = ::open(lock_file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (lock_fd_ < 0) throw_io_error("create", lock_file_, errno);
    if (::flock(lock_fd_, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      ::close(lock_fd_);
      if (error == EINTR) continue;
      if (error != EWOULDBLOCK) throw_io_error("lock", lock_file_, error);
      throw BusyError(target_.string() +
                      ": another program is writing it; wait for it or choose another folder");
    }
    if (same_file(lock_fd_, lock_file_)) return;
    ::close(lock_fd_);  // the last holder removed it between open and flock
  }
}

void AtomicFolder::recover_interrupted() {
  std::error_code error;
  if (fs::exists(old_) && !fs::exists(target_)) rename_or_throw(old_, target_);
  for (const fs::path& left : {old_, temporary_}) {
    fs::remove_all(left, error);
    if (error) throw_io_error("remove", left, error.value());
  }
}

void AtomicFolder::check_replaceable(const FolderKind& kind) const {
  const std::string cure = "choose another folder or move it away";
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) throw InputError(target_.string(), "exists and is no folder", cure);
  if (fs::is_empty(target_, error)) return;
  if (error) throw_io_error("list", target_, error.value());
  if (!fs::exists(target_ / kind.marker)) {
    throw InputError(target_.string(), "exists and is not a " + kind.name + " (no " + kind.marker + ")",
                     cure);
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(target_)) {
    const std::string name = entry.path().filename().string();
    const bool known = std::find(kind.entries.begin(), kind.entries.end(), name) != kind.entries.end();
    if (name != kind.marker && !known) {
      throw InputError(target_.string(), "holds '" + name + "', which is not part of a " + kind.name, cure);
    }
  }
}

void AtomicFolder::replace_target() {
  if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) throw_io_error("rename to", target_, errno);
  // No exchange on this file system: the old folder steps aside (recover_interrupted brings it back).
  rename_or_throw(target_, old_);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    const int error = errno;
    rename_or_throw(old_, target_);
    throw_io_error("rename to", target_, error);
  }
}

void AtomicFolder::commit() {
  sync_tree(temporary_);
  if (fs::exists(target_)) {
    replace_target();
  } else {
    rename_or_throw(temporary_, target_);
  }
  sync(target_.parent_path());
  std::error_code ignored;
  fs::remove_all(old_, ignored);
}

FileIdentity file_identity(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {};
  return {status.st_dev, status.st_ino, status.st_ctim.tv_sec, status.st_ctim.tv_nsec};
}

}  // namespace rakelight
