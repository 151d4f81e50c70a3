// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program before a USB that umockdev plays: a sensor that is there, may not be opened, has gone.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "tests/support/file_edits.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace rakelight::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kNode = "$UMOCKDEV_DIR/dev/bus/usb/002/005";  // of xtion.umockdev

/// What a shell says about a command line, its standard output in `out`.
Ran shell(const std::string& command) {
  Ran ran;
  FILE* pipe = popen(command.c_str(), "r");
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) ran.out += static_cast<char>(c);
  const int status = pclose(pipe);
  ran.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return ran;
}

class DoctorOnAPlayedUsb : public testing::Test {
 protected:
  void SetUp() override {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "umockdev and the address sanitizer both want to be loaded first";
#endif
    if (shell("umockdev-run --version 2>/dev/null").exit_code != 0)
      GTEST_SKIP() << "umockdev is not installed";
    // A plain user must reach them, and root would be refused nothing.
    fs::permissions(home_.path(), fs::perms(0755));
    fs::copy_file(RAKELIGHT_PROGRAM, home_ / "rakelight");
    fs::copy_file(fs::path(RAKELIGHT_SOURCE_DIR) / "tests/cli/xtion.umockdev", home_ / "xtion.umockdev");
  }

  /// The program as a plain user, after `before` has been done to the USB.
  Ran doctor(const std::string& arguments, const std::string& before = ":") const {
    const std::string plain = geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
    return shell("cd '" + home_.path().string() + "' && " + plain +
                 "umockdev-run -d xtion.umockdev -- sh -c '" + before + "; exec ./rakelight doctor " +
                 arguments + "'");
  }

  TemporaryFolder home_;
};

TEST_F(DoctorOnAPlayedUsb, SeesASensorAndItsSpeedAndThatOpenniSeesItToo) {
  const Ran ran = doctor("--json");
  EXPECT_EQ(ran.exit_code, 0) << ran.out;
  const auto report = nlohmann::json::parse(ran.out);
  ASSERT_EQ(report["sensors"].size(), 1u) << "the root hub is no sensor";
  EXPECT_EQ(report["sensors"][0]["usb_id"], "1d27:0601");
  EXPECT_EQ(report["sensors"][0]["access"], "usable");
  EXPECT_EQ(report["sensors"][0]["megabits"], 480);
  EXPECT_EQ(report["openni"]["devices"][0]["uri"], "1d27/0601@2/5");
}

TEST_F(DoctorOnAPlayedUsb, SaysThatPermissionIsMissingAndTheRule) {
  const Ran ran = doctor("", std::string("chmod 0 \"") + kNode + "\"");
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_THAT(ran.out, HasSubstr("no permission for /dev/bus/usb/002/005"));
  EXPECT_THAT(ran.out, HasSubstr("ATTR{idVendor}==\"1d27\""));
}

TEST_F(DoctorOnAPlayedUsb, SaysThatASensorHasGone) {
  const Ran ran = doctor("", std::string("rm \"") + kNode + "\"");
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_THAT(ran.out, HasSubstr("went away while it was looked at"));
}

TEST(Doctor, MissesWhatTheRigNamesWithExitCode4) {
  const fs::path rigs = fs::path(RAKELIGHT_SOURCE_DIR) / "hw" / "rigs";
  const TemporaryFolder home;
  set_text(home / "rig.toml", "[[lamps]]\nid = \"a\"\nline = \"no such line\"\n");
  const Ran ran = run({"doctor", "--rig", home / "rig.toml"});
  EXPECT_EQ(ran.exit_code, 4) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("problem  lamp a: cannot find line \"no such line\""));
  EXPECT_EQ(run({"doctor", "--rig", rigs / "virtual.toml"}).exit_code, 0) << "needs no hardware";
  EXPECT_EQ(run({"doctor", "--rig", home / "none.toml"}).exit_code, 3);
}

}  // namespace
}  // namespace rakelight::test
