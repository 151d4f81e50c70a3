// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/scan_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/image_file.h"
#include "stack/stack_io.h"

namespace rakelight {
namespace fs = std::filesystem;
namespace {

constexpr const char* kState = "scan.json";
constexpr const char* kLock = "scan.lock";
constexpr const char* kManifest = "stack.json";
constexpr std::uint64_t kMaxStateBytes = 16 << 20;

fs::path without_slash(const fs::path& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

fs::path sibling_of(const fs::path& folder) {
  return folder.parent_path() / (folder.filename().string() + ".unfinished");
}

std::string image_name(const char* folder, int index) {
  char name[32];
  std::snprintf(name, sizeof name, "%s/%04d.png", folder, index);
  return name;
}

FrameFiles files_of(const Frame& frame) {
  return {frame.color.empty() ? "" : image_name("color", frame.index),
          frame.depth.empty() ? "" : image_name("depth", frame.index)};
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw_io_error("create", folder, error.value());
}

/// Waits until the disk has everything of the folder's file system.
void sync_file_system(const fs::path& folder) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) throw_io_error("open", folder, errno);
  const int error = ::syncfs(fd) == 0 ? 0 : errno;
  ::close(fd);
  if (error != 0) throw_io_error("write", folder, error);
}

}  // namespace

ScanFolder::ScanFolder(const fs::path& folder, bool resume)
    : target_(without_slash(folder)), place_(target_) {
  const bool finished = fs::exists(target_ / kManifest);
  if (finished) place_ = sibling_of(target_);
  const bool begun = fs::exists(place_ / kState);
  if (begun && !resume) {
    throw InputError(place_.string(), "holds an unfinished scan",
                     "complete it with --resume, or remove it, or choose another folder");
  }
  if (finished && resume && !begun)
    throw UsageError(target_.string() + " is finished: there is nothing to resume");
  if (!begun && !fs::exists(place_ / kLock)) check_stack_folder(target_);
  make_folder(place_);
  lock();
  if (begun) read_unfinished();
  for (const char* sub : {"color", "depth"}) make_folder(place_ / sub);
}

ScanFolder::~ScanFolder() {
  {
    const std::lock_guard<std::mutex> guard(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  if (writer_.joinable()) writer_.join();
  remove_if_empty();
  ::close(lock_fd_);
}

/// A scan that kept nothing leaves nothing.
void ScanFolder::remove_if_empty() {
  std::error_code ignored;
  if (fs::exists(place_ / kState, ignored) || fs::exists(place_ / kManifest, ignored)) return;
  for (const char* name : {"color", "depth", kLock}) fs::remove(place_ / name, ignored);
  fs::remove(place_, ignored);
}

void ScanFolder::lock() {
  const fs::path file = place_ / kLock;
  lock_fd_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (lock_fd_ < 0) throw_io_error("create", file, errno);
  if (::flock(lock_fd_, LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  ::close(lock_fd_);
  if (error != EWOULDBLOCK) throw_io_error("lock", file, error);
  throw BusyError(place_.string() +
                  ": another program is scanning into it; wait for it or choose another folder");
}

void ScanFolder::read_unfinished() {
  const fs::path file = place_ / kState;
  const Bytes bytes = read_file(file, kMaxStateBytes);
  Manifest manifest = parse_manifest(std::string(bytes.begin(), bytes.end()), file.string());
  LightStack& stack = manifest.stack;
  for (std::size_t i = 0; i < stack.frames.size(); ++i) {
    const auto& [color, depth] = manifest.files[i];
    Frame& frame = stack.frames[i];
    if (!color.empty()) frame.color = read_color_png(path_inside(place_, color), stack.color_camera.size());
    if (!depth.empty()) frame.depth = read_depth_png(path_inside(place_, depth), stack.depth_camera.size());
  }
  unfinished_ = parse_scan_state(stack, file.string());
  header_ = stack;
  files_ = manifest.files;
  for (Frame& frame : header_.frames) frame.color.release(), frame.depth.release();
}

void ScanFolder::record(const ScanState& state, const Frame& frame) {
  {
    const std::lock_guard<std::mutex> guard(mutex_);
    rethrow_failure();
    if (header_.color_camera.width == 0) {
      header_ = state.stack;
      header_.frames.clear();
      header_.unknown_keys = scan_keys(state);
    }
    queue_.push_back(frame);
    // Not before the first frame: the guard of the lamps is forked from a program without threads.
    if (!writer_.joinable()) writer_ = std::thread([this] { write_frames(); });
  }
  changed_.notify_all();
}

void ScanFolder::write_frames() {
  std::unique_lock<std::mutex> guard(mutex_);
  for (;;) {
    changed_.wait(guard, [this] { return closing_ || !queue_.empty(); });
    if (queue_.empty()) return;
    const Frame frame = std::move(queue_.front());
    queue_.pop_front();
    busy_ = true;
    guard.unlock();
    std::exception_ptr failure;
    try {
      write_frame(frame);
    } catch (...) { failure = std::current_exception(); }
    guard.lock();
    busy_ = false;
    if (failure) failure_ = failure;
    changed_.notify_all();
  }
}

void ScanFolder::write_frame(const Frame& frame) {
  const FrameFiles files = files_of(frame);
  if (!files.color.empty()) write_png(place_ / files.color, frame.color);
  if (!files.depth.empty()) write_png(place_ / files.depth, frame.depth);
  Frame entry = frame;
  entry.color.release();
  entry.depth.release();
  LightStack now;
  std::vector<FrameFiles> all;
  {
    const std::lock_guard<std::mutex> guard(mutex_);
    header_.frames.push_back(entry);
    files_.push_back(files);
    now = header_;
    all = files_;
  }
  write_manifest(kState, now, all);
}

/// As a whole: the old file or the new one is there at any moment.
void ScanFolder::write_manifest(const char* name, const LightStack& stack,
                                const std::vector<FrameFiles>& files) const {
  const fs::path file = place_ / name, fresh = place_ / (std::string(".") + name);
  std::error_code ignored;
  fs::remove(fresh, ignored);
  write_file(fresh, manifest_text(stack, files));
  if (std::rename(fresh.c_str(), file.c_str()) != 0) throw_io_error("rename to", file, errno);
}

void ScanFolder::rethrow_failure() {
  if (failure_) std::rethrow_exception(failure_);
}

void ScanFolder::flush() {
  std::unique_lock<std::mutex> guard(mutex_);
  changed_.wait(guard, [this] { return queue_.empty() && !busy_; });
  rethrow_failure();
}

int ScanFolder::frames_kept() {
  const std::lock_guard<std::mutex> guard(mutex_);
  return static_cast<int>(
      std::count_if(files_.begin(), files_.end(), [](const FrameFiles& f) { return !f.color.empty(); }));
}

void ScanFolder::finish(const LightStack& stack) {
  flush();
  if (place_ != target_) {
    write_stack(stack, target_);
    std::error_code ignored;
    fs::remove_all(place_, ignored);
    return;
  }
  if (!stack.mask.empty()) write_png(place_ / "mask.png", stack.mask);
  std::vector<FrameFiles> files;
  for (const Frame& frame : stack.frames) files.push_back(files_of(frame));
  sync_file_system(place_);
  write_manifest(kManifest, stack, files);
  sync_file_system(place_);
  std::error_code ignored;
  for (const char* name : {kState, kLock}) fs::remove(place_ / name, ignored);
}

}  // namespace rakelight
