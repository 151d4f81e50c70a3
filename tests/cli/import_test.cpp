// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "stack/stack_io.h"
#include "tests/support/file_edits.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/small_stack.h"
#include "tests/support/temporary_folder.h"

namespace rakelight::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Import, TurnsASourceFolderIntoAStackWithItsTruth) {
  RAKELIGHT_NEED_SHARED_DATA(source, "bear-x2");
  const TemporaryFolder home;
  const std::string stack = home / "stack";
  const Ran ran = run({"import", "photometric-sr", source, "-o", stack});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("20 colour and 1 depth images, and the truth"));
  LightStack expected = read_stack(source);
  const LightStack imported = read_stack(stack);
  EXPECT_THAT(imported.created, testing::MatchesRegex("[0-9-]+T[0-9:]+Z"));
  expected.created = imported.created;
  expect_same(expected, imported);
  EXPECT_TRUE(same_pixels(read_truth(source).depth > 0, read_truth(stack).depth > 0));
}

TEST(Import, ReplacesTheResponseAndPrintsOneJsonObject) {
  RAKELIGHT_NEED_SHARED_DATA(source, "vase");
  const TemporaryFolder home;
  const Ran ran =
      run({"import", "photometric-sr", source, "-o", home / "stack", "--response", "srgb", "--json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out,
              AllOf(testing::StartsWith("{\n"), HasSubstr("\"truth\": false"), testing::EndsWith("}\n")));
  EXPECT_EQ(read_stack(home / "stack").color_response.kind, ColorResponse::Kind::srgb);
}

TEST(Import, RefusesUnknownKindsAndResponsesAsUsage) {
  EXPECT_EQ(run({"import", "tape", "src", "-o", "out"}).exit_code, 2);
  EXPECT_EQ(run({"import", "photometric-sr", "src"}).exit_code, 2);
  EXPECT_EQ(run({"import", "diligent", "src", "-o", "out", "--response", "srgb"}).exit_code, 2);
}

TEST(Import, LeavesAFolderAloneThatIsNoStack) {
  RAKELIGHT_NEED_SHARED_DATA(source, "vase");
  const TemporaryFolder home;
  set_text(home / "notes.txt", "mine");
  const Ran ran = run({"import", "photometric-sr", source, "-o", home.path()});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_THAT(ran.err, AllOf(HasSubstr(home.path().string()), HasSubstr("is not a stack")));
  EXPECT_EQ(text_of(home / "notes.txt"), "mine");
}

TEST(Import, NamesWhatASourceFolderLacks) {
  const TemporaryFolder home;
  const Ran ran = run({"import", "diligent", home.path(), "-o", home / "stack"});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_THAT(ran.err, HasSubstr("filenames.txt: missing"));
}

}  // namespace
}  // namespace rakelight::test
