// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lights/guard.h"

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "lights/descriptors.h"
#include "lights/guard_process.h"
#include "lights/signals_blocked.h"

namespace rakelight {
namespace {

class GuardedBank : public LineBank {
 public:
  GuardedBank(std::unique_ptr<LineBank> bank, Descriptor guard, pid_t pid)
      : bank_(std::move(bank)), guard_(std::move(guard)), pid_(pid) {}

  ~GuardedBank() override {
    // If the last "off" failed, the guard hears no goodbye: it takes the program for dead and tries itself.
    if (!lit_) tell(GuardMessage::goodbye);
    guard_.close();
    waitpid(pid_, nullptr, 0);
  }
  GuardedBank(const GuardedBank&) = delete;
  GuardedBank& operator=(const GuardedBank&) = delete;

  std::size_t size() const override { return bank_->size(); }

  void write(const std::vector<bool>& lit) override {
    announced(lit, [&] { bank_->write(lit); });
  }
  void write_changes(const std::vector<bool>& lit) override {
    announced(lit, [&] { bank_->write_changes(lit); });
  }
  std::vector<bool> read() override { return bank_->read(); }

 private:
  /// The guard learns of light before there is any, and of darkness when it is certain.
  template <class Write>
  void announced(const std::vector<bool>& lit, Write write) {
    const bool any = std::find(lit.begin(), lit.end(), true) != lit.end();
    if (any) tell(GuardMessage::lit);
    lit_ = lit_ || any;
    write();
    if (!any && lit_) tell(GuardMessage::dark);
    lit_ = any;
  }

  void tell(GuardMessage message) const { send(guard_.get(), &message, 1, MSG_NOSIGNAL); }

  std::unique_ptr<LineBank> bank_;
  Descriptor guard_;
  pid_t pid_;
  bool lit_ = false;
};

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(),
                          std::string("cannot start the process that guards the lamps: ") + what);
}

}  // namespace

std::unique_ptr<LineBank> open_guarded(const std::function<std::unique_ptr<LineBank>()>& open,
                                       const GuardOptions& options) {
  const std::vector<int> before = open_descriptors();
  std::unique_ptr<LineBank> bank = open();
  std::vector<int> lines = open_descriptors();
  lines.erase(std::remove_if(lines.begin(), lines.end(),
                             [&](int fd) { return std::binary_search(before.begin(), before.end(), fd); }),
              lines.end());

  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail("no socket");
  Descriptor ours(ends[0]), theirs(ends[1]);
  const SignalsBlocked blocked;  // until the guard ignores what it must not die of
  const pid_t pid = fork();
  if (pid < 0) fail("no process");
  if (pid == 0) {
    lines.push_back(theirs.get());
    run_guard(*bank, theirs.get(), std::move(lines), options.max_on);
  }
  return std::make_unique<GuardedBank>(std::move(bank), std::move(ours), pid);
}

}  // namespace rakelight
