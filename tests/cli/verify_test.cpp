// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include <algorithm>

#include "stack/stack_io.h"
#include "tests/support/file_edits.h"
#include "tests/support/run_program.h"
#include "tests/support/small_stack.h"
#include "tests/support/temporary_folder.h"

namespace rakelight::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Verify : public testing::Test {
 protected:
  void SetUp() override { write_stack(small_stack(), stack, small_truth()); }

  TemporaryFolder home;
  std::filesystem::path stack = home / "stack";
};

TEST_F(Verify, PassesAWholeStack) {
  const Ran ran = run({"verify", stack});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("whole; 13 images read and checked"));
}

TEST_F(Verify, NamesADamagedImageInOneLine) {
  std::string bytes = text_of(stack / "depth/0002.png");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  set_text(stack / "depth/0002.png", bytes);
  const Ran ran = run({"verify", stack});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err,
              AllOf(HasSubstr("depth/0002.png"), HasSubstr("damaged"), HasSubstr("copy or record it again")));
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
}

TEST_F(Verify, ChecksTheTruthToo) {
  std::filesystem::remove(stack / "truth/normals.tiff");
  EXPECT_THAT(run({"verify", stack}).err, HasSubstr("normals.tiff"));
}

TEST_F(Verify, ChecksTheContentToo) {
  LightStack dark = small_stack();
  for (Frame& frame : dark.frames) frame.color.setTo(0);
  write_stack(dark, stack);
  const Ran ran = run({"verify", stack, "--json"});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_THAT(ran.out, AllOf(testing::StartsWith("{\n"), HasSubstr("\"whole\": false"), HasSubstr("black"),
                             testing::EndsWith("}\n")));
}

}  // namespace
}  // namespace rakelight::test
