// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stack folder while it is being scanned: frames are written as they come, stack.json last.
//
//     my-scan/
//       scan.json        what is there so far; replaced as a whole after each frame, removed at the end
//       scan.lock        held by the program that scans
//       color/ depth/    named by the frame's index
//
// Where my-scan is a finished stack already, the new one grows in my-scan.unfinished and takes its place at the end.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

#include "capture/scan_state.h"
#include "stack/manifest.h"

namespace rakelight {

class ScanFolder {
 public:
  /// @param resume go on with what is there, if anything is
  /// @throws InputError if the folder is something else, or an unfinished scan and `resume` is false; UsageError if it is
  ///         finished and `resume` is true; BusyError; IoError
  ScanFolder(const std::filesystem::path& folder, bool resume);
  ~ScanFolder();
  ScanFolder(const ScanFolder&) = delete;
  ScanFolder& operator=(const ScanFolder&) = delete;

  /// What an earlier scan left, with its pixels.
  const std::optional<ScanState>& unfinished() const { return unfinished_; }

  /// Hands a frame to the thread that writes. @throws IoError of an earlier frame
  void record(const ScanState& state, const Frame& frame);

  /// Waits until all is written. @throws IoError
  void flush();
  int frames_kept();  ///< colour images that are written
  const std::filesystem::path& place() const { return place_; }

  /// Completes the stack: mask.png, then stack.json. @throws IoError, BusyError
  void finish(const LightStack& stack);

 private:
  void lock();
  void read_unfinished();
  void write_frames();
  void write_frame(const Frame& frame);
  void write_manifest(const char* name, const LightStack& stack, const std::vector<FrameFiles>& files) const;
  void rethrow_failure();
  void remove_if_empty();

  std::filesystem::path target_, place_;
  int lock_fd_ = -1;
  std::optional<ScanState> unfinished_;
  LightStack header_;              ///< of scan.json, its frames without pixels
  std::vector<FrameFiles> files_;  ///< of header_'s frames

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Frame> queue_;
  bool busy_ = false, closing_ = false;
  std::exception_ptr failure_;
  std::thread writer_;
};

}  // namespace rakelight
