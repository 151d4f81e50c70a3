// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A folder that appears whole or not at all: stacks and results are written through this.
//
//     AtomicFolder out(folder, {"result", "result.json", {"depth.tiff", "mesh.ply"}});
//     write_file(out.path() / "depth.tiff", bytes);   // anything that throws removes the temporary
//     out.commit();
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rakelight {

/// How to tell a folder that may be replaced from one that holds somebody's other work.
struct FolderKind {
  std::string name;                  ///< for messages, e.g. "stack"
  std::string marker;                ///< the file every finished folder of this kind has
  std::vector<std::string> entries;  ///< what else may lie at its top level
};

/// Owns a temporary sibling of a target folder and the lock on the target.
/// A process killed at any moment leaves the old folder or the new one at the target; what it leaves beside them
/// (`.NAME.partial`, `.NAME.old`, `.NAME.lock`) the next writer of the target puts right.
class AtomicFolder {
 public:
  /// Locks the target and makes an empty temporary. Missing parent folders are made.
  /// @throws BusyError if another writer holds the target; InputError if the target exists and is neither empty nor
  ///         wholly of this kind; IoError.
  AtomicFolder(const std::filesystem::path& target, const FolderKind& kind);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// The temporary to fill.
  const std::filesystem::path& path() const { return temporary_; }

  /// Waits until the disk has every file, then puts the temporary at the target. Call once, last.
  /// @throws IoError: the target is then the old folder or the new one, whole.
  void commit();

 private:
  void lock();
  void recover_interrupted();
  void check_replaceable(const FolderKind& kind) const;
  void replace_target();

  std::filesystem::path target_, temporary_, old_, lock_file_;
  int lock_fd_ = -1;
};

/// What tells a file or folder from the one that replaced it: a reader compares it before and after.
struct FileIdentity {
  std::uint64_t device = 0, inode = 0;
  std::int64_t changed_s = 0, changed_ns = 0;  ///< an inode's number may be given again, but later

  bool operator==(const FileIdentity& other) const {
    return device == other.device && inode == other.inode && changed_s == other.changed_s &&
           changed_ns == other.changed_ns;
  }
};

/// All zero if there is no such file or folder.
FileIdentity file_identity(const std::filesystem::path& path);

}  // namespace rakelight
