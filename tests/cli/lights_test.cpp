// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What `rakelight lights` says where no line is at hand; tests/kernel has it switch some.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/support/file_edits.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace rakelight::test {
namespace {

using testing::HasSubstr;

std::string rig(const std::string& name) { return RAKELIGHT_SOURCE_DIR "/hw/rigs/" + name + ".toml"; }

void expect_refusal(const Ran& ran, int exit_code, const std::string& reason) {
  EXPECT_EQ(ran.exit_code, exit_code) << ran.err;
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err, HasSubstr(reason));
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
}

TEST(Lights, NeedsAnAction) { EXPECT_EQ(run({"lights"}).exit_code, 2); }

TEST(Lights, NeedsARigToSwitchAnything) {
  for (const char* action : {"on", "off", "test"}) EXPECT_EQ(run({"lights", action}).exit_code, 2) << action;
}

TEST(Lights, RefusesALampThatTheRigDoesNotHave) {
  expect_refusal(run({"lights", "on", "sun", "--rig", rig("cp2112")}), 2, "is called \"sun\"");
}

TEST(Lights, RefusesToLightALampForLongerThanTheRigAllows) {
  expect_refusal(run({"lights", "on", "white-0", "--for", "3", "--rig", rig("cp2112")}), 2, "at most 2 s");
  expect_refusal(run({"lights", "test", "--each", "3", "--rig", rig("cp2112")}), 2, "at most 2 s");
}

TEST(Lights, SaysThatNobodyWouldSeeAVirtualLampThatIsLitByHand) {
  expect_refusal(run({"lights", "on", "white-00", "--rig", rig("virtual")}), 2, "'rakelight lights test'");
  expect_refusal(run({"lights", "off", "--rig", rig("virtual")}), 2, "virtual");
}

TEST(Lights, TestsVirtualLampsAndNamesThoseThatDoNotFollow) {
  const TemporaryFolder home;
  set_text(home / "rig.toml",
           "[sensor]\ncolor = { width = 64, height = 48 }\ndepth = { width = 64, height = 48 }\n"
           "[virtual_rig]\nscene = \"plane\"\nstuck_off = [\"b\"]\n"
           "[[lamps]]\nid = \"a\"\n[[lamps]]\nid = \"b\"\n[[lamps]]\nid = \"c\"\n");
  const Ran ran = run({"lights", "test", "--each", "0.02", "--json", "--rig", home / "rig.toml"});
  EXPECT_EQ(ran.exit_code, 4) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("does not read so under b;"));
  const auto report = nlohmann::json::parse(ran.out);
  for (const auto& lamp : report.at("tested")) EXPECT_EQ(lamp["as_written"], lamp["id"] != "b") << lamp;
}

TEST(Lights, ExitsWithADeviceErrorWithoutTheBoard) {
  expect_refusal(run({"lights", "off", "--rig", rig("cp2112")}), 4,
                 "cannot find line 0 of chip \"cp2112_gpio\"");
}

TEST(Lights, ListsChipsAsJson) {
  const Ran ran = run({"lights", "list", "--json"});
  const auto report = nlohmann::json::parse(ran.out);
  EXPECT_TRUE(report.at("chips").is_array());
}

}  // namespace
}  // namespace rakelight::test
