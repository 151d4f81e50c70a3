// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "refine/table.h"
#include "stack/stack_io.h"
#include "tests/support/bump_stack.h"
#include "tests/support/file_edits.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace rakelight::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A folder with the stack `scan` in it, eight white lamps.
class Table : public testing::Test {
 protected:
  void SetUp() override { write_stack(bump_stack(), scan(), bump_truth()); }

  fs::path scan() const { return folder_ / "scan"; }
  fs::path out() const { return folder_ / "out"; }
  /// Exit code as expected and one line that holds `text`.
  void expect_refused(const Ran& ran, int exit_code, const std::string& text) const {
    EXPECT_EQ(ran.exit_code, exit_code) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.err, HasSubstr(text));
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  }

  TemporaryFolder folder_;
};

TEST_F(Table, RunsEveryMethodAndKeepsSurfacesPicturesAndTheTable) {
  const Ran ran = run({"table", scan(), "-o", out(), "--scale", "1"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
  EXPECT_EQ(ran.out, text_of(out() / "table" / "table.md"));
  EXPECT_THAT(ran.out, HasSubstr("| Method | scan: RMSE mm | MAE ° |\n"));
  const auto json = nlohmann::json::parse(text_of(out() / "table" / "table.json"));
  const auto& rows = json.at("rows");
  ASSERT_EQ(rows.size(), table_variants().size() + 1);
  EXPECT_EQ(rows[0].at("name"), "input");
  const fs::path pictures = out() / "scan" / "pictures";
  for (const char* file : {"input-relief.png", "truth-normals.png", "error-scale.png", "sheet.jpg"})
    EXPECT_TRUE(fs::exists(pictures / file)) << file;
  for (const TableVariant& variant : table_variants()) {
    EXPECT_THAT(ran.out, HasSubstr("| " + variant.name + " |"));
    const bool fits = variant.options.method != Method::rgb_ratio;  // no image of this stack is colour-lit
    EXPECT_EQ(fs::exists(out() / "scan" / variant.slug / "result.json"), fits) << variant.slug;
    for (const char* what : {"relief", "normals", "albedo", "error"})
      EXPECT_EQ(fs::exists(pictures / (variant.slug + "-" + what + ".png")), fits) << variant.slug;
  }
  EXPECT_THAT(ran.out, HasSubstr("| rgb-ratio, paper | –<sup>1</sup> | – |"));
  EXPECT_THAT(ran.out, HasSubstr("<sup>1</sup> " + scan().string()));
}

TEST_F(Table, EqualsWhatRefineAndEvaluateSay) {
  const Ran table = run({"table", scan(), "--method", "multi-light", "--scale", "1", "--json"});
  ASSERT_EQ(table.exit_code, 0) << table.err;
  const auto rows = nlohmann::json::parse(table.out).at("rows");
  ASSERT_EQ(rows.size(), 3U);
  ASSERT_EQ(run({"refine", scan(), "-o", out(), "--scale", "1"}).exit_code, 0);
  const auto errors = nlohmann::json::parse(run({"evaluate", out(), "--truth", scan(), "--json"}).out);
  EXPECT_EQ(rows[2].at("name"), "multi-light, robust");
  for (const char* measure : {"rmse_mm", "mae_deg"}) {
    EXPECT_NEAR(rows[2].at("cells")[0].at(measure), errors.at(measure), 1e-6);
    EXPECT_NEAR(rows[0].at("cells")[0].at(measure), errors.at("before").at(measure), 1e-6);
  }
}

TEST_F(Table, ReplacesAnEarlierTableButNoOtherFolder) {
  const std::vector<std::string> command{"table",   scan(), "-o",       out(),
                                         "--scale", "1",    "--method", "fusion-like"};
  ASSERT_EQ(run(command).exit_code, 0);
  EXPECT_EQ(run(command).exit_code, 0);
  set_text(out() / "scan" / "fusion-like-robust" / "letter.txt", "dear");
  expect_refused(run(command), 3, "letter.txt");
}

TEST_F(Table, RefusesAStackWithoutTruthBeforeAnyWork) {
  write_stack(bump_stack(), folder_ / "field");
  expect_refused(run({"table", scan(), folder_ / "field", "-o", out()}), 3, "field");
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Table, RefusesWhatIsNoStack) { expect_refused(run({"table", folder_ / "absent"}), 3, "absent"); }

TEST_F(Table, RefusesStacksOfOneName) {
  fs::create_directory(folder_ / "other");
  write_stack(bump_stack(), folder_ / "other" / "scan", bump_truth());
  expect_refused(run({"table", scan(), folder_ / "other" / "scan/"}), 2, "two stacks are called scan");
}

TEST_F(Table, RefusesOptionsOutOfRange) {
  expect_refused(run({"table", scan(), "--method", "magic"}), 2, "magic");
  expect_refused(run({"table", scan(), "--scale", "5"}), 2, "--scale");
  expect_refused(run({"table"}), 2, "STACK");
}

TEST_F(Table, StopsOnAnInterruptAndSaysWhatIsKept) {
  RunningProgram program({"table", scan(), "-o", out()});
  while (!fs::exists(out())) std::this_thread::sleep_for(std::chrono::milliseconds(1));  // it has begun
  program.send(SIGINT);
  const Ran ran = program.wait();
  EXPECT_EQ(ran.exit_code, 130) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("the table is not"));
  EXPECT_FALSE(fs::exists(out() / "table"));
}

}  // namespace
}  // namespace rakelight::test
