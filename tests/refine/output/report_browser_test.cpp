// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The report in a real browser. What is tried there is in report_browser.py.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "refine/output/result_io.h"
#include "tests/support/bump_stack.h"
#include "tests/support/file_edits.h"
#include "tests/support/temporary_folder.h"

namespace rakelight {
namespace {

constexpr int kNoBrowser = 77;

/// What a shell command says and its exit code.
struct Said {
  int exit_code;
  std::string words;
};

Said run_shell(const std::string& command, const std::filesystem::path& log) {
  const int status = std::system((command + " > '" + log.string() + "' 2>&1").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, test::text_of(log)};
}

TEST(ReportInABrowser, WorksByMouseAndKeysWithAndWithoutWebGl) {
  const std::string hostile = "</script><img src=x onerror=hostile=1>";
  LightStack stack = test::bump_stack();
  for (Frame& frame : stack.frames) {
    if (frame.light == stack.lights.front().id) frame.light = hostile;
  }
  stack.lights.front().id = hostile;
  RefineOptions options = preset_options(Preset::robust);
  options.max_iterations = 5;
  const test::TemporaryFolder folder;
  write_result(refine_depth(stack, options), folder / "out", &stack);

  const std::string script = RAKELIGHT_SOURCE_DIR "/tests/refine/output/report_browser.py";
  const Said said =
      run_shell("python3 '" + script + "' '" + (folder / "out/report.html").string() + "' '" + hostile + "'",
                folder / "log");
  if (said.exit_code == kNoBrowser || said.exit_code == 127) GTEST_SKIP() << said.words;
  EXPECT_EQ(said.exit_code, 0) << said.words;
}

}  // namespace
}  // namespace rakelight
