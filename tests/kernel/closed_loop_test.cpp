// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole loop without hardware: `rakelight scan` writes GPIO lines of a running kernel, the virtual sensor of the real
// OpenNI2 renders the lamps whose lines the kernel's chip says are on, and the scan proves each lamp by its picture.
// To be run by tests/kernel/run_in_vm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/kernel/fake_adapter.h"
#include "tests/support/file_edits.h"
#include "tests/support/run_program.h"

namespace rakelight::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr int kLamps = 6;
constexpr const char* kRig = "/run/rig.toml";
constexpr const char* kStack = "/run/scan";

class ScanOnAKernel : public testing::Test {
 protected:
  ScanOnAKernel() {
    std::filesystem::remove_all(kStack);
    std::ofstream rig(kRig);
    rig << "[sensor]\n"
           "color = { width = 96, height = 72 }\ndepth = { width = 96, height = 72 }\n"
           "[virtual_rig]\nscene = \"sphere\"\nlamps_on_lines = true\n";
    for (int k = 0; k < kLamps; ++k) {
      const double turn = 2 * M_PI * (k + 0.3) / kLamps, angle = (k % 2 == 0 ? 48 : 32) * M_PI / 180;
      char lamp[256];
      std::snprintf(lamp, sizeof lamp,
                    "[[lamps]]\nid = \"lamp-%d\"\nchip = \"cp2112_gpio\"\noffset = %d\nactive_low = %s\n"
                    "position_m = [%.3f, %.3f, %.3f]\n",
                    k, k, active_low(k) ? "true" : "false", 8 * std::sin(angle) * std::cos(turn),
                    8 * std::sin(angle) * std::sin(turn), 1 - 8 * std::cos(angle));
      rig << lamp;
    }
  }

  static bool active_low(int lamp) { return lamp == 4; }
  static constexpr int kDark = 1 << 4;

  json scan() {
    const Ran ran = run({"scan", "--rig", kRig, "-o", kStack, "--json"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return ran.exit_code == 0 ? json::parse(ran.out) : json();
  }

  /// A scan whose images are all proven. The emulated machine runs in what time the real one leaves it: a scan that was starved of
  /// it says so by its checks, and is made anew.
  json proven_scan() {
    constexpr int kAttempts = 4;
    json report;
    for (int attempt = 1; attempt <= kAttempts; ++attempt) {
      std::filesystem::remove_all(kStack);
      report = scan();
      if (report.is_null() || all_proven()) break;
      std::printf("scan %d was not proven throughout\n", attempt);
    }
    return report;
  }

  static bool all_proven() {
    const json stack = json::parse(text_of(std::filesystem::path(kStack) / "stack.json"));
    return std::all_of(stack.at("frames").begin(), stack.at("frames").end(), [](const json& frame) {
      return !frame.contains("color") || frame.at("lit_check").at("matches").get<bool>();
    });
  }

  /// Images that were kept of each lamp and proven by picture; "" is the dark.
  static std::map<std::string, int> proven_images() {
    std::map<std::string, int> images;
    const json stack = json::parse(text_of(std::filesystem::path(kStack) / "stack.json"));
    for (const json& frame : stack.at("frames")) {
      if (!frame.contains("color")) continue;
      EXPECT_TRUE(frame.at("lit_check").at("matches").get<bool>()) << frame;
      ++images[frame.at("light").is_null() ? "" : frame.at("light").get<std::string>()];
    }
    return images;
  }

  FakeAdapter adapter;
};

TEST_F(ScanOnAKernel, ProvesEachLampByThePictureThatItsLineLit) {
  const json report = proven_scan();
  EXPECT_EQ(report["faults"], json::array());
  const std::map<std::string, int> images = proven_images();
  EXPECT_EQ(images.size(), kLamps + 1U);
  for (const auto& [lamp, count] : images) EXPECT_EQ(count, lamp.empty() ? 2 : 1) << lamp;
  EXPECT_EQ(adapter.levels(), kDark) << "all lamps are off in the end";
  std::printf("FIGURE closed loop: %s images taken again, lag %s ms\n", report["retaken"].dump().c_str(),
              report["lag_ms"].dump().c_str());
}

TEST_F(ScanOnAKernel, NamesTheLampsWhoseLinesAreStuck) {
  adapter.hold(1, false);
  adapter.hold(4, false);  // active-low
  std::vector<std::string> named;
  const json report = proven_scan();
  for (const json& fault : report["faults"])
    named.push_back(fault["kind"].get<std::string>() + " " + fault["lamp"].get<std::string>());
  EXPECT_THAT(named, testing::UnorderedElementsAre("no-light lamp-1", "stuck-on lamp-4"));
  EXPECT_EQ(proven_images().count("lamp-1"), 0U);
}

TEST_F(ScanOnAKernel, LampTestReadsBackWhichLineIsStuck) {
  adapter.hold(2, false);
  const Ran ran = run({"lights", "test", "--rig", kRig, "--each", "0.02"});
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_THAT(ran.err, HasSubstr("does not read so under lamp-2;"));
  EXPECT_THAT(ran.out, HasSubstr("NOT LIT"));
}

}  // namespace
}  // namespace rakelight::test
