// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "stack/stack_io.h"
#include "tests/support/run_program.h"
#include "tests/support/small_stack.h"
#include "tests/support/temporary_folder.h"

namespace rakelight::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Info, TellsInWordsWhatAStackHolds) {
  const TemporaryFolder home;
  write_stack(small_stack(8), home / "stack", small_truth());
  const Ran ran = run({"info", home / "stack"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(
      ran.out,
      AllOf(HasSubstr("24 x 16"), HasSubstr("12 x 8"), HasSubstr("5 images of 8 bits, 1 of them dark"),
            HasSubstr("4: 1 blue, 1 red, 1 rgb, 1 white"), HasSubstr("response 2.2"),
            HasSubstr("steps of 0.1 mm"), HasSubstr("240 pixels"), Not(HasSubstr("warning"))));
}

TEST(Info, SaysThatAStackCannotBeRefinedAndWhy) {
  const TemporaryFolder home;
  LightStack stack = small_stack();
  stack.mask.setTo(0);
  write_stack(stack, home / "stack");
  EXPECT_THAT(run({"info", home / "stack"}).out, AllOf(HasSubstr("warning"), HasSubstr("mask is empty")));
}

TEST(Info, PrintsOneJsonObjectAndNothingElse) {
  const TemporaryFolder home;
  write_stack(small_stack(), home / "stack");
  const Ran ran = run({"info", home / "stack", "--json"});
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_EQ(ran.err, "");
  EXPECT_THAT(ran.out,
              AllOf(testing::StartsWith("{\n"), HasSubstr("\"color_images\": 5"), testing::EndsWith("}\n")));
}

}  // namespace
}  // namespace rakelight::test
