// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/toml_edit.h"

#include <gmock/gmock.h>

#include "stack/errors.h"
#include "tests/support/message_of.h"

namespace rakelight::test {
namespace {

using testing::HasSubstr;

std::string edited(const std::string& text, const std::string& table, const std::string& key,
                   const std::string& value) {
  return with_toml_value(text, table, key, value, "rig.toml");
}

TEST(TomlEdit, ReplacesAValueAndLeavesTheRestOfItsLine) {
  EXPECT_EQ(
      edited("# top\n[sensor]\ngain = 100   # as metered\nexposure_us = 8000\n", "sensor", "gain", "50.5"),
      "# top\n[sensor]\ngain = 50.5   # as metered\nexposure_us = 8000\n");
}

TEST(TomlEdit, ReplacesAListThatSpansLines) {
  EXPECT_EQ(edited("[a]\nm = [\n  [1, 2],\n  [3, 4],\n]  # kept\nb = 1\n", "a", "m", "[[5]]"),
            "[a]\nm = [[5]]  # kept\nb = 1\n");
}

TEST(TomlEdit, CountsCodePointsNotBytes) {
  EXPECT_EQ(edited("[a]\nt = { \"\xC3\xA4\xE2\x82\xAC\" = 1, b = 2 } # \xC3\xA4\n", "a.t", "b", "3"),
            "[a]\nt = { \"\xC3\xA4\xE2\x82\xAC\" = 1, b = 3 } # \xC3\xA4\n");
}

TEST(TomlEdit, AddsAKeyAfterTheLastOfItsTable) {
  EXPECT_EQ(edited("[a]\nx = 1 # one\n\n# about b\n[b]\ny = 2\n", "a", "z", "3"),
            "[a]\nx = 1 # one\nz = 3\n\n# about b\n[b]\ny = 2\n");
  EXPECT_EQ(edited("[a]\nx = [\n 1,\n]\n[a.b]\ny = 2\n", "a", "z", "3"),
            "[a]\nx = [\n 1,\n]\nz = 3\n[a.b]\ny = 2\n");
}

TEST(TomlEdit, AddsAKeyBelowTheCommentsOfABareHeader) {
  EXPECT_EQ(edited("[calibration]\n# written by the program\n\n[b]\n", "calibration", "x", "1"),
            "[calibration]\n# written by the program\nx = 1\n\n[b]\n");
}

TEST(TomlEdit, AddsAKeyToOneOfSeveralTablesOfAList) {
  EXPECT_EQ(edited("[[lamps]]\nid = \"a\"\n\n[[lamps]]\nid = \"b\" # second\n\n[[lamps]]\nid = \"c\"",
                   "lamps[1]", "line", "7"),
            "[[lamps]]\nid = \"a\"\n\n[[lamps]]\nid = \"b\" # second\nline = 7\n\n[[lamps]]\nid = \"c\"");
  EXPECT_EQ(edited("lamps = [\n  { id = \"a\" },\n  {},\n]\n", "lamps[0]", "line", "7"),
            "lamps = [\n  { id = \"a\", line = 7 },\n  {},\n]\n");
  EXPECT_EQ(edited("lamps = [\n  { id = \"a\" },\n  {},\n]\n", "lamps[1]", "line", "7"),
            "lamps = [\n  { id = \"a\" },\n  { line = 7 },\n]\n");
}

TEST(TomlEdit, AddsAMissingTableAtTheEnd) {
  EXPECT_EQ(edited("x = 1", "calibration", "y", "2"), "x = 1\n\n[calibration]\ny = 2\n");
  EXPECT_EQ(edited("[c.camera]\nfx = 1\n", "c", "y", "2"), "[c.camera]\nfx = 1\n\n[c]\ny = 2\n");
}

TEST(TomlEdit, KeepsCarriageReturns) {
  EXPECT_EQ(edited("[a]\r\nx = 1\r\ny = 2\r\n", "a", "x", "3"), "[a]\r\nx = 3\r\ny = 2\r\n");
}

TEST(TomlEdit, RefusesWhatIsNoTable) {
  EXPECT_THAT(message_of<InputError>([] { edited("sensor = 3\n", "sensor", "gain", "1"); }),
              HasSubstr("'sensor' is no table"));
}

}  // namespace
}  // namespace rakelight::test
