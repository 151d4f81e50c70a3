// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What holds for every command: help, usage errors, output that cannot be written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/run_program.h"

namespace rakelight::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class EveryCommand : public testing::TestWithParam<const char*> {};

TEST_P(EveryCommand, ExplainsItselfWithExamples) {
  const Ran ran = run({GetParam(), "--help"});
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_THAT(ran.out, HasSubstr("Examples:\n  rakelight " + std::string(GetParam())));
  EXPECT_EQ(ran.err, "");
}

TEST_P(EveryCommand, RefusesUnknownOptionsInOneLine) {
  const Ran ran = run({GetParam(), "--no-such-option"});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err, StartsWith("rakelight: error: " + std::string(GetParam()) + ": "));
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
}

std::string name_of(const testing::TestParamInfo<const char*>& command) { return command.param; }

INSTANTIATE_TEST_SUITE_P(Of, EveryCommand, testing::Values("refine", "evaluate", "import", "info", "verify"),
                         name_of);
#ifdef RAKELIGHT_HAS_SIMULATE
INSTANTIATE_TEST_SUITE_P(OfSimulation, EveryCommand, testing::Values("simulate"), name_of);
#endif

#ifdef RAKELIGHT_HAS_CAPTURE
INSTANTIATE_TEST_SUITE_P(OfCapture, EveryCommand, testing::Values("doctor", "lights"), name_of);
#endif

TEST(Program, ShowsAnOverviewWithExamplesAndExitCodes) {
  const Ran ran = run({"--help"});
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_THAT(ran.out, HasSubstr("Examples:"));
  EXPECT_THAT(ran.out, HasSubstr("Exit codes:"));
  for (const char* command : {"refine", "evaluate", "import", "info", "verify"})
    EXPECT_THAT(ran.out, HasSubstr(command));
}

TEST(Program, TellsItsVersion) {
  const Ran ran = run({"--version"});
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_THAT(ran.out, StartsWith("rakelight "));
}

TEST(Program, AsksForACommand) {
  EXPECT_EQ(run({}).exit_code, 2);
  EXPECT_EQ(run({"no-such-command"}).exit_code, 2);
}

TEST(Program, NoticesThatItsOutputCannotBeWritten) {
  const Ran ran = run({"--help"}, "/dev/full");
  EXPECT_EQ(ran.exit_code, 6);
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
}

TEST(Program, DoesNotMindAReaderThatLeavesEarly) {
  const std::string command = std::string(RAKELIGHT_PROGRAM) + " --help";
  FILE* pipe = popen((command + "; test $? -eq 0 || exit 9").c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  EXPECT_EQ(pclose(pipe), 0);  // closed before a byte was read
}

}  // namespace
}  // namespace rakelight::test
