// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lights/guard_process.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <thread>

#include "lights/descriptors.h"

namespace rakelight {
namespace {

/// Out of the terminal's reach: what ends the program must leave its guard alive.
void detach() {
  prctl(PR_SET_NAME, "lamp-guard");
  setsid();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP, SIGUSR1, SIGUSR2})
    std::signal(signal, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// A transfer may fail once on a busy bus; a device that has gone fails for ever.
void switch_off(LineBank& bank) {
  const std::vector<bool> dark(bank.size(), false);
  for (int attempt = 0; attempt < 3; ++attempt) {
    try {
      return bank.write(dark);
    } catch (...) { std::this_thread::sleep_for(std::chrono::milliseconds(50)); }
  }
}

enum class News { dark, lit, overdue, goodbye, death };

/// @param limit_ms as of poll(): how long to wait, -1 for ever
News listen(int socket, int limit_ms) {
  pollfd watched = {socket, POLLIN, 0};
  const int ready = poll(&watched, 1, limit_ms);
  if (ready == 0) return News::overdue;
  char messages[64];
  const ssize_t count = recv(socket, messages, sizeof messages, 0);
  if (count < 0 && errno == EINTR) return listen(socket, limit_ms);
  if (count <= 0) return News::death;
  switch (static_cast<GuardMessage>(messages[count - 1])) {  // the newest
    case GuardMessage::lit:
      return News::lit;
    case GuardMessage::dark:
      return News::dark;
    case GuardMessage::goodbye:
      return News::goodbye;
  }
  return News::death;
}

}  // namespace

void run_guard(LineBank& bank, int socket, std::vector<int> keep, std::chrono::milliseconds max_on) {
  detach();
  close_all_but(std::move(keep));
  const int limit_ms = static_cast<int>(max_on.count());
  News news = News::dark;
  while (news != News::goodbye && news != News::death) {
    news = listen(socket, news == News::lit ? limit_ms : -1);
    if (news == News::overdue || news == News::death) switch_off(bank);
  }
  _exit(0);
}

}  // namespace rakelight
