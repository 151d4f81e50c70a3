// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/run_program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "tests/support/file_edits.h"

namespace rakelight::test {
namespace {

void redirect(int fd, const std::filesystem::path& file) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT, 0600);
  if (opened < 0 || dup2(opened, fd) < 0) _exit(126);
}

}  // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& out) {
  std::string pattern = (std::filesystem::temp_directory_path() / "rakelight-run-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::system_error(errno, std::generic_category(), "mkdtemp");
  folder_ = pattern;
  std::vector<std::string> words{RAKELIGHT_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (pid_ == 0) {
    redirect(STDOUT_FILENO, out.empty() ? folder_ / "out" : out);
    redirect(STDERR_FILENO, folder_ / "err");
    execv(argv[0], argv.data());
    _exit(127);
  }
}

RunningProgram::~RunningProgram() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void RunningProgram::send(int signal) const { kill(pid_, signal); }

Ran RunningProgram::wait() {
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {}
  pid_ = 0;
  Ran ran;
  ran.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (std::filesystem::exists(folder_ / "out")) ran.out = text_of(folder_ / "out");
  ran.err = text_of(folder_ / "err");
  return ran;
}

Ran run(const std::vector<std::string>& arguments, const std::filesystem::path& out) {
  return RunningProgram(arguments, out).wait();
}

}  // namespace rakelight::test
