// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/replace_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "stack/checked_file.h"
#include "stack/errors.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

/// A new sibling of the file, locked; removed unless it has taken the file's place.
class Replacement {
 public:
  explicit Replacement(const fs::path& target)
      : target_(target), path_(target.parent_path() / ("." + target.filename().string() + ".partial")) {
    do open_locked();
    while (!still_named());  // the last holder renamed or removed it between our open and lock
  }
  ~Replacement() {
    if (!in_place_) ::unlink(path_.c_str());
    ::close(fd_);
  }
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  void commit(const std::string& text) {
    struct stat old {};
    if (::stat(target_.c_str(), &old) != 0) throw_io_error("read", target_, errno);
    if (::ftruncate(fd_, 0) != 0) throw_io_error("write", path_, errno);  // what a crash has left
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t written = ::write(fd_, text.data() + done, text.size() - done);
      if (written < 0 && errno != EINTR) throw_io_error("write", path_, errno);
      if (written > 0) done += static_cast<std::size_t>(written);
    }
    if (::fchmod(fd_, old.st_mode & 07777) != 0) throw_io_error("write", path_, errno);
    if (::fsync(fd_) != 0) throw_io_error("write", path_, errno);
    if (::rename(path_.c_str(), target_.c_str()) != 0) throw_io_error("rename to", target_, errno);
    in_place_ = true;
  }

 private:
  void open_locked() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (fd_ < 0) throw_io_error("create", path_, errno);
    if (::flock(fd_, LOCK_EX | LOCK_NB) == 0) return;
    const int error = errno;
    ::close(fd_);
    if (error != EWOULDBLOCK) throw_io_error("lock", path_, error);
    throw BusyError(target_.string() + ": another program is changing it; try again when it is done");
  }

  bool still_named() const {
    struct stat ours {
    }, named{};
    return ::fstat(fd_, &ours) == 0 && ::stat(path_.c_str(), &named) == 0 && ours.st_ino == named.st_ino &&
           ours.st_dev == named.st_dev;
  }

  fs::path target_, path_;
  int fd_ = -1;
  bool in_place_ = false;
};

}  // namespace

void edit_file(const fs::path& file, std::uint64_t max_bytes,
               const std::function<std::string(const std::string&)>& edit) {
  std::error_code error;
  fs::path target = fs::canonical(file, error);
  if (error) target = file;  // read_file says what is wrong with it
  read_file(target, max_bytes);
  Replacement replacement(target);
  const Bytes bytes = read_file(target, max_bytes);
  const std::string before(bytes.begin(), bytes.end());
  const std::string after = edit(before);
  if (after != before) replacement.commit(after);
}

}  // namespace rakelight
