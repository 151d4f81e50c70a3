// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/checked_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "stack/errors.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void throw_read_error(const fs::path& file, int error) {
  if (error == ENOENT || error == ENOTDIR) {
    throw InputError(file.string(), "missing", "check the path, or copy or record the data again");
  }
  if (error == EIO || error == ENOMEM || error == EMFILE || error == ENFILE) {
    throw_io_error("read", file, error);
  }
  throw InputError(file.string(), "cannot be read (" + reason(error) + ")",
                   "check the file and its permissions");
}

/// Opens a regular file; O_NONBLOCK so that a pipe without a writer does not hang.
int open_regular(const fs::path& file, std::uint64_t& size) {
  Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (descriptor.get() < 0) throw_read_error(file, errno);
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0) throw_read_error(file, errno);
  if (!S_ISREG(status.st_mode)) {
    throw InputError(file.string(), "is not a regular file", "put the data itself there");
  }
  size = static_cast<std::uint64_t>(status.st_size);
  return descriptor.release();
}

Bytes read_bytes(const fs::path& file, int fd, std::size_t count) {
  Bytes bytes(count);
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got = ::read(fd, bytes.data() + done, count - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw_read_error(file, errno);
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

bool has_control_character(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

}  // namespace

void throw_io_error(const std::string& action, const fs::path& path, int error) {
  std::string cure = "check the disk";
  if (error == ENOSPC || error == EDQUOT || error == EFBIG) cure = "free some space";
  if (error == EROFS || error == EACCES || error == EPERM) cure = "choose a place you may write to";
  throw IoError("cannot " + action + " " + path.string() + ": " + reason(error) + "; " + cure);
}

Bytes read_file_start(const fs::path& file, std::size_t count) {
  std::uint64_t size = 0;
  const Descriptor descriptor(open_regular(file, size));
  return read_bytes(file, descriptor.get(), static_cast<std::size_t>(std::min<std::uint64_t>(size, count)));
}

Bytes read_file(const fs::path& file, std::uint64_t max_bytes) {
  std::uint64_t size = 0;
  const Descriptor descriptor(open_regular(file, size));
  if (size > max_bytes) {
    throw InputError(file.string(), "is larger than its content can be (" + std::to_string(size) + " bytes)",
                     "check that it is the right file");
  }
  return read_bytes(file, descriptor.get(), static_cast<std::size_t>(size));
}

void write_file(const fs::path& file, const void* data, std::size_t size) {
  Descriptor descriptor(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (descriptor.get() < 0) throw_io_error("create", file, errno);
  const char* from = static_cast<const char*>(data);
  std::size_t left = size;
  while (left > 0) {
    const ssize_t put = ::write(descriptor.get(), from, left);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) throw_io_error("write", file, errno);
    from += put;
    left -= static_cast<std::size_t>(put);
  }
  if (::close(descriptor.release()) != 0) throw_io_error("write", file, errno);
}

void write_file(const fs::path& file, const std::string& text) { write_file(file, text.data(), text.size()); }

fs::path path_inside(const fs::path& folder, const std::string& relative) {
  const std::string cure = "use a relative path inside the folder";
  if (relative.empty()) throw InputError(folder.string(), "names a file with an empty path", cure);
  if (has_control_character(relative)) {
    throw InputError(folder.string(), "names a file with a control character in its path", cure);
  }
  const fs::path path(relative);
  const bool climbs = std::find(path.begin(), path.end(), fs::path("..")) != path.end();
  if (path.is_absolute() || climbs) {
    throw InputError(folder.string(), "names the file '" + relative + "', which leaves the folder", cure);
  }
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) throw_read_error(folder, error.value());
  const fs::path resolved = fs::weakly_canonical(root / path, error);
  if (error) throw_read_error(folder / path, error.value());
  const bool inside =
      std::mismatch(root.begin(), root.end(), resolved.begin(), resolved.end()).first == root.end();
  if (!inside) {
    throw InputError((folder / path).string(), "is a link that leads out of the folder",
                     "put the file itself there");
  }
  return folder / path;
}

}  // namespace rakelight
