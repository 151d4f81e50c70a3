// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/atomic_folder.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>

#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/stack_io.h"
#include "tests/support/file_edits.h"
#include "tests/support/message_of.h"
#include "tests/support/small_stack.h"
#include "tests/support/tiny_disk.h"

namespace rakelight {
namespace {

namespace fs = std::filesystem;
using test::expect_same;
using test::message_of;
using test::small_stack;
using testing::AllOf;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;

const FolderKind kKind = {"thing", "thing.json", {"data"}};

/// Names in a folder, sorted.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

void write_thing(const fs::path& target, const std::string& content) {
  AtomicFolder out(target, kKind);
  write_file(out.path() / "data", content);
  write_file(out.path() / "thing.json", content);
  out.commit();
}

class AtomicFolderTest : public testing::Test {
 protected:
  test::TemporaryFolder home;
  fs::path target = home / "thing";
};

TEST_F(AtomicFolderTest, appears_only_on_commit_and_leaves_nothing_beside_it) {
  {
    AtomicFolder out(target, kKind);
    write_file(out.path() / "thing.json", "1");
    EXPECT_FALSE(fs::exists(target));
    out.commit();
  }
  EXPECT_THAT(names_in(home.path()), ElementsAre("thing"));
  EXPECT_THAT(names_in(target), ElementsAre("thing.json"));
}

TEST_F(AtomicFolderTest, replaces_an_older_folder_of_its_kind_wholly) {
  write_thing(target, "old");
  {
    AtomicFolder out(target, kKind);
    write_file(out.path() / "thing.json", "new");
    EXPECT_EQ(test::text_of(target / "thing.json"), "old");
    out.commit();
  }
  EXPECT_EQ(test::text_of(target / "thing.json"), "new");
  EXPECT_THAT(names_in(target), ElementsAre("thing.json"));
  EXPECT_THAT(names_in(home.path()), ElementsAre("thing"));
}

TEST_F(AtomicFolderTest, without_commit_the_old_folder_stays_and_the_temporary_goes) {
  write_thing(target, "old");
  {
    AtomicFolder out(target, kKind);
    write_file(out.path() / "thing.json", "new");
  }
  EXPECT_EQ(test::text_of(target / "thing.json"), "old");
  EXPECT_THAT(names_in(home.path()), ElementsAre("thing"));
}

TEST_F(AtomicFolderTest, refuses_a_folder_of_another_kind_or_with_other_things_in_it) {
  fs::create_directory(target);
  EXPECT_NO_THROW(write_thing(target, "an empty folder may be filled"));
  test::set_text(target / "notes.txt", "mine");
  EXPECT_THAT(message_of<InputError>([&] { write_thing(target, "x"); }), HasSubstr("holds 'notes.txt'"));
  fs::remove(target / "thing.json");
  EXPECT_THAT(message_of<InputError>([&] { write_thing(target, "x"); }), HasSubstr("is not a thing"));
  EXPECT_EQ(test::text_of(target / "notes.txt"), "mine");
  EXPECT_THAT(message_of<InputError>([&] { write_thing(target / "notes.txt", "x"); }),
              HasSubstr("is no folder"));
  EXPECT_THAT(names_in(home.path()), ElementsAre("thing"));
}

TEST_F(AtomicFolderTest, a_trailing_slash_and_missing_parents_are_fine) {
  write_thing(home / "a/b/thing/", "x");
  EXPECT_THAT(names_in(home / "a/b"), ElementsAre("thing"));
}

TEST_F(AtomicFolderTest, through_a_link_the_folder_it_leads_to_is_replaced) {
  write_thing(target, "old");
  fs::create_directory_symlink(target, home / "link");
  write_thing(home / "link", "new");
  EXPECT_TRUE(fs::is_symlink(home / "link"));
  EXPECT_EQ(test::text_of(target / "thing.json"), "new");
}

TEST_F(AtomicFolderTest, a_second_writer_is_told_that_the_folder_is_busy) {
  {
    AtomicFolder first(target, kKind);
    write_file(first.path() / "thing.json", "first");
    EXPECT_THAT(message_of<BusyError>([&] { AtomicFolder second(target, kKind); }),
                HasSubstr(target.string()));
    EXPECT_TRUE(fs::exists(first.path() / "thing.json"));
    first.commit();
  }
  EXPECT_NO_THROW(write_thing(target, "second"));
}

TEST_F(AtomicFolderTest, what_a_killed_writer_left_is_put_right) {
  write_thing(target, "old");
  fs::rename(target, home / ".thing.old");  // killed between the two renames
  fs::create_directory(home / ".thing.partial");
  test::set_text(home / ".thing.partial/data", "half");
  test::set_text(home / ".thing.lock", "");
  {
    AtomicFolder out(target, kKind);
    EXPECT_EQ(test::text_of(target / "thing.json"), "old");
    EXPECT_TRUE(fs::is_empty(out.path()));
  }
  EXPECT_THAT(names_in(home.path()), ElementsAre("thing"));
}

TEST_F(AtomicFolderTest, a_folder_that_is_replaced_has_another_identity) {
  EXPECT_EQ(file_identity(target), FileIdentity());
  write_thing(target, "old");
  const FileIdentity old = file_identity(target);
  EXPECT_EQ(file_identity(target), old);
  write_thing(target, "new");
  EXPECT_FALSE(file_identity(target) == old);
}

TEST_F(AtomicFolderTest, a_full_disk_is_an_io_error_and_the_old_stack_stays) {
  const test::TinyDisk disk(120);
  if (!disk.mounted()) GTEST_SKIP() << "cannot mount a tmpfs here (needs root)";
  const fs::path stack = disk.path() / "stack";
  write_stack(small_stack(), stack);
  LightStack large = small_stack();
  for (int i = 10; i < 100; ++i) {
    large.frames.push_back(large.frames[0]);
    large.frames.back().index = i;
  }
  EXPECT_THAT(message_of<IoError>([&] { write_stack(large, stack, test::small_truth()); }),
              AllOf(HasSubstr("No space left"), HasSubstr("free some space")));
  expect_same(small_stack(), read_stack(stack));
  EXPECT_THAT(names_in(disk.path()), ElementsAre("stack"));
}

TEST_F(AtomicFolderTest, a_read_only_disk_is_an_io_error) {
  const test::TinyDisk disk(120);
  if (!disk.mounted()) GTEST_SKIP() << "cannot mount a tmpfs here (needs root)";
  write_stack(small_stack(), disk.path() / "stack");
  ASSERT_EQ(::mount("tmpfs", disk.path().c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, ""), 0);
  EXPECT_THAT(message_of<IoError>([&] { write_stack(small_stack(16, 1), disk.path() / "stack"); }),
              HasSubstr("Read-only"));
  expect_same(small_stack(), read_stack(disk.path() / "stack"));
}

/// Runs `action` in a child process and returns its exit code.
template <typename Action>
int exit_code_of(const Action& action) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(action());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST_F(AtomicFolderTest, a_limit_on_file_sizes_is_an_io_error_and_the_old_stack_stays) {
  write_stack(small_stack(), target);
  const int code = exit_code_of([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {2000, 2000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_stack(small_stack(16, 1), target);
    } catch (const IoError&) { return 6; }
    return 0;
  });
  EXPECT_EQ(code, 6);
  expect_same(small_stack(), read_stack(target));
  EXPECT_THAT(names_in(home.path()), ElementsAre("thing"));
}

/// The generation of a stack that must be one of small_stack's, whole.
int generation_of(const LightStack& stack) {
  const int generation = stack.created.back() - '0';
  expect_same(small_stack(16, generation), stack);
  return generation;
}

/// A process that writes stacks of changing generation over one another until it is killed.
pid_t start_writer(const fs::path& target, int first_generation) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  const LightStack stacks[] = {small_stack(16, first_generation), small_stack(16, first_generation + 1)};
  for (int i = 0;; ++i) {
    try {
      write_stack(stacks[i % 2], target);
      ::usleep(1000);  // lets another writer have its turn
    } catch (const BusyError&) { ::usleep(100); } catch (const std::exception&) {
      ::_exit(1);
    }
  }
}

/// Kills a writer at `count` random moments: the stack must always be one of the two, whole.
void kill_writers(const fs::path& target, int count) {
  write_stack(small_stack(), target);
  std::mt19937 random(20260101);
  for (int i = 0; i < count; ++i) {
    const pid_t writer = start_writer(target, 0);
    ::usleep(std::uniform_int_distribution<useconds_t>(0, 40000)(random));
    ::kill(writer, SIGKILL);
    int status = 0;
    ::waitpid(writer, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer failed by itself";
    ASSERT_THAT(generation_of(read_stack(target)), AnyOf(0, 1)) << "kill " << i;
  }
  write_stack(small_stack(16, 2), target);
  EXPECT_EQ(generation_of(read_stack(target)), 2);
  EXPECT_THAT(names_in(target.parent_path()), ElementsAre(target.filename().string()));
}

TEST_F(AtomicFolderTest, a_writer_killed_50_times_never_leaves_half_a_stack) { kill_writers(target, 50); }

TEST(AtomicFolderSlowTest, a_writer_killed_1000_times_never_leaves_half_a_stack) {
  const test::TemporaryFolder home;
  kill_writers(home / "stack", 1000);
}

TEST_F(AtomicFolderTest, two_writers_and_a_reader_never_see_a_mixture) {
  write_stack(small_stack(), target);
  const pid_t writers[] = {start_writer(target, 0), start_writer(target, 2)};
  std::vector<int> seen(4, 0);
  int reads = 0, busy = 0;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  const auto both_seen = [&] { return seen[0] + seen[1] > 0 && seen[2] + seen[3] > 0; };
  while ((reads < 300 || !both_seen()) && std::chrono::steady_clock::now() < deadline) {
    ++reads;
    try {
      ++seen[std::size_t(generation_of(read_stack(target)))];
    } catch (const BusyError&) { ++busy; }
  }
  for (const pid_t writer : writers) {
    ::kill(writer, SIGKILL);
    int status = 0;
    ::waitpid(writer, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "the writer failed by itself";
  }
  EXPECT_TRUE(both_seen());
  EXPECT_LT(busy, reads / 10);
}

}  // namespace
}  // namespace rakelight
