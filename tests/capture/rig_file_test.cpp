// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/rig_file.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "stack/errors.h"
#include "tests/support/file_edits.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace rakelight::test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const std::filesystem::path kExamples = std::filesystem::path(RAKELIGHT_SOURCE_DIR) / "hw" / "rigs";

/// A rig of two lamps on named lines. @param more lines put before the lamps
std::string small_rig(const std::string& more = "") {
  return more + R"(
[[lamps]]
id = "left"   # on the short arm
line = "LED1"

[[lamps]]
id = "right"
line = "LED2"
)";
}

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { parse_rig(text, "desk.toml"); });
}

TEST(RigFile, ReadsWhatItSaysAndLeavesTheRestAtItsDefault) {
  const Rig rig = parse_rig(small_rig("repeats = 3\n[sensor]\nuri = \"1d27/0609@2/1\"\nreadout_us = 20000.5\n"
                                      "color = { width = 1280, height = 1024 }\n"),
                            "somewhere/desk.toml");
  EXPECT_EQ(rig.name, "desk");
  EXPECT_EQ(rig.repeats, 3);
  EXPECT_EQ(rig.sensor.uri, "1d27/0609@2/1");
  EXPECT_EQ(rig.sensor.readout_us, 20000.5);
  EXPECT_EQ(rig.sensor.color.width, 1280);
  EXPECT_EQ(rig.sensor.color.fps, 30);
  EXPECT_EQ(rig.sensor.depth.width, 640);
  EXPECT_EQ(rig.max_on_ms, Rig().max_on_ms);
  ASSERT_EQ(rig.lamps.size(), 2u);
  EXPECT_EQ(rig.lamps[1].id, "right");
  EXPECT_EQ(rig.lamps[1].line.name, "LED2");
  EXPECT_FALSE(rig.virtual_rig);
}

TEST(RigFile, VirtualLampsThatHangOnLinesNeedLines) {
  const std::string virtual_rig = "[virtual_rig]\nlamps_on_lines = true\n";
  EXPECT_TRUE(parse_rig(small_rig(virtual_rig), "desk.toml").virtual_rig->lamps_on_lines);
  EXPECT_THAT(refusal(virtual_rig + "[[lamps]]\nid = \"left\"\n"), HasSubstr("'left' names none"));
}

TEST(RigFile, FindsLampsByLabelAndOffset) {
  const Rig rig = read_rig(kExamples / "cp2112.toml");
  EXPECT_EQ(rig.lamps[5].line.chip, "cp2112_gpio");
  EXPECT_EQ(rig.lamps[5].line.offset, 5u);
  EXPECT_EQ(rig.lamps[5].line.name, "");
}

TEST(RigFile, EveryExampleIsARigOfAtLeastFourWhiteLamps) {
  int examples = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kExamples)) {
    const Rig rig = read_rig(entry.path());
    EXPECT_EQ(rig.name, entry.path().stem().string());
    const auto white = std::count_if(rig.lamps.begin(), rig.lamps.end(),
                                     [](const RigLamp& lamp) { return lamp.color == LampColor::white; });
    EXPECT_GE(white, 4) << entry.path();
    ++examples;
  }
  EXPECT_GE(examples, 4);
}

TEST(RigFile, TheVirtualExampleIsTheVirtualRig) {
  const Rig file = read_rig(kExamples / "virtual.toml");
  const Rig rig = virtual_rig();
  EXPECT_EQ(file.name, rig.name);
  EXPECT_EQ(file.max_on_ms, rig.max_on_ms);
  EXPECT_EQ(file.repeats, rig.repeats);
  EXPECT_EQ(file.rgb_shot, rig.rgb_shot);
  EXPECT_EQ(file.sensor.uri, rig.sensor.uri);
  EXPECT_EQ(file.sensor.exposure_us, rig.sensor.exposure_us);
  EXPECT_EQ(file.sensor.lamp_jitter_us, rig.sensor.lamp_jitter_us);
  EXPECT_EQ(file.sensor.readout_us, rig.sensor.readout_us);
  ASSERT_EQ(file.lamps.size(), rig.lamps.size());
  for (std::size_t k = 0; k < rig.lamps.size(); ++k) {
    EXPECT_EQ(file.lamps[k].id, rig.lamps[k].id);
    EXPECT_EQ(file.lamps[k].color, rig.lamps[k].color);
    EXPECT_EQ(file.lamps[k].line.chip, rig.lamps[k].line.chip);
    EXPECT_EQ(file.lamps[k].line.offset, rig.lamps[k].line.offset);
    ASSERT_TRUE(file.lamps[k].position_m && rig.lamps[k].position_m);
    EXPECT_LT((*file.lamps[k].position_m - *rig.lamps[k].position_m).norm(), 1e-9) << "metres, lamp " << k;
  }
  ASSERT_TRUE(file.virtual_rig);
  EXPECT_EQ(file.virtual_rig->scene, rig.virtual_rig->scene);
  EXPECT_EQ(file.virtual_rig->albedo, rig.virtual_rig->albedo);
  EXPECT_EQ(file.virtual_rig->seed, rig.virtual_rig->seed);
  EXPECT_EQ(file.virtual_rig->lamp_latency_us, rig.virtual_rig->lamp_latency_us);
  EXPECT_EQ(file.virtual_rig->delivery_latency_us, rig.virtual_rig->delivery_latency_us);
  EXPECT_EQ(file.virtual_rig->delivery_jitter_us, rig.virtual_rig->delivery_jitter_us);
  EXPECT_EQ(file.virtual_rig->unplug_at_frame, rig.virtual_rig->unplug_at_frame);
}

TEST(RigFile, ReadsTheFaultsOfAVirtualRig) {
  const Rig rig =
      parse_rig(small_rig("[virtual_rig]\nstuck_on = [\"left\"]\nswapped = [[\"left\", \"right\"]]\n"
                          "drop_share = 0.05\nunplug_at_frame = 7\n"),
                "v.toml");
  EXPECT_EQ(rig.sensor.uri, "virtual");
  EXPECT_EQ(rig.virtual_rig->stuck_on, std::vector<std::string>{"left"});
  EXPECT_EQ(rig.virtual_rig->swapped.at(0)[1], "right");
  EXPECT_EQ(rig.virtual_rig->drop_share, 0.05);
  EXPECT_EQ(rig.virtual_rig->unplug_at_frame, 7);
}

TEST(RigFile, SaysFileLineAndColumnOfASyntaxError) {
  EXPECT_THAT(refusal("name = \"x\"\nrepeats = = 2\n"), StartsWith("desk.toml:2:11: "));
}

TEST(RigFile, SaysFileLineAndColumnOfAWrongValue) {
  EXPECT_EQ(refusal(small_rig("[sensor]\n  gain = \"high\"\n")),
            "desk.toml:2:10: 'gain' of [sensor] is no number from 0 to 1000000; write such a number");
  EXPECT_THAT(refusal(small_rig("[sensor]\ngain = nan\n")), StartsWith("desk.toml:2:8: "));
  EXPECT_THAT(refusal(small_rig("repeats = 0\n")), HasSubstr("is no whole number from 1 to 100"));
  EXPECT_THAT(refusal(small_rig("repeats = 2.5\n")), HasSubstr("is no whole number"));
  EXPECT_THAT(refusal(small_rig("rgb_shot = 1\n")), HasSubstr("is neither true nor false"));
  EXPECT_THAT(refusal(small_rig("sensor = 3\n")), HasSubstr("desk.toml:1:10: 'sensor' is no table"));
}

TEST(RigFile, RefusesAnUnknownKeyAndSuggestsTheNearest) {
  EXPECT_EQ(refusal(small_rig("[sensor]\nexposure_ms = 8\n")),
            "desk.toml:2:1: 'exposure_ms' of [sensor] is not known; did you mean 'exposure_us'?");
  EXPECT_THAT(refusal(small_rig("[lamp_board]\n")), HasSubstr("known here: calibration, lamps, max_on_ms"));
  EXPECT_THAT(refusal(small_rig() + "colour = \"red\"\n"),
              AllOf(StartsWith("desk.toml:9:1: "), EndsWith("did you mean 'color'?")));
}

TEST(RigFile, RefusesLampsThatCannotBeToldApart) {
  EXPECT_THAT(refusal(small_rig() + "[[lamps]]\nid = \"left\"\nline = \"LED3\"\n"),
              HasSubstr("desk.toml:10:6: 'id' of [[lamps]] 3 'left' is taken by another lamp"));
  EXPECT_THAT(refusal(small_rig() + "[[lamps]]\nid = \"top\"\nline = \"LED2\"\n"),
              HasSubstr("is wired to line 'LED2', as lamp 'right' is"));
  EXPECT_THAT(refusal("name = \"x\"\n"), HasSubstr("'lamps' are missing"));
}

TEST(RigFile, RefusesALampWithoutOneLine) {
  const auto lamp = [](const std::string& wiring) { return refusal("[[lamps]]\nid = \"a\"\n" + wiring); };
  EXPECT_THAT(lamp(""), HasSubstr("by neither line nor chip and offset"));
  EXPECT_THAT(lamp("offset = 3\n"), HasSubstr("counts lines of no chip"));
  EXPECT_THAT(lamp("chip = \"c\"\n"), HasSubstr("add offset"));
  EXPECT_THAT(lamp("line = \"L\"\nchip = \"c\"\noffset = 1\n"), HasSubstr("keep one of the two"));
  EXPECT_THAT(lamp("line = \"L\"\ncolor = \"rgb\"\n"), HasSubstr("is no colour of a lamp"));
}

TEST(RigFile, RefusesSettingsThatContradictEachOther) {
  EXPECT_THAT(refusal(small_rig("[sensor]\nexposure_us = 40000\n")),
              HasSubstr("is longer than a frame at 30 fps"));
  EXPECT_THAT(refusal(small_rig("rgb_shot = true\n")), HasSubstr("needs a red lamp"));
  EXPECT_THAT(refusal(small_rig("[virtual_rig]\ndim = [\"middle\"]\n")),
              HasSubstr("names 'middle', which is no lamp"));
}

TEST(RigFile, RefusesACalibrationThatCannotBe) {
  EXPECT_THAT(refusal(small_rig("[calibration]\ncolor_crosstalk = [[1,0,0],[1,0,0],[0,0,1]]\n")),
              HasSubstr("singular"));
  EXPECT_THAT(refusal(small_rig("[calibration]\ncolor_crosstalk = [[1,0],[0,1]]\n")), HasSubstr("3 x 3"));
  EXPECT_THAT(
      refusal(small_rig("[calibration]\nT_color_depth = [[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]\n")),
      HasSubstr("is no rigid motion"));
  EXPECT_THAT(refusal(small_rig("[calibration]\ncolor_camera = { width = 640 }\n")), HasSubstr("'height'"));
  EXPECT_THAT(refusal(small_rig("[calibration]\ncolor_response = \"film\"\n")), HasSubstr("is no response"));
}

TEST(RigFile, NamesAFileThatIsNotThere) {
  EXPECT_THAT(message_of<InputError>([] { read_rig("/nowhere/rig.toml"); }), HasSubstr("/nowhere/rig.toml"));
}

/// A rig with everything calibration measures.
Rig calibrated(Rig rig) {
  rig.sensor.lamp_jitter_us = 2345.6;
  rig.lamps[0].position_m = Eigen::Vector3d(0.1, -0.25, 1.0 / 3);
  rig.calibration.color_camera =
      Camera{1280, 960, 1049.5, 1050.25, 640.125, 479.5, {0.1, -0.2, 0.001, 0.002, 0.05}};
  rig.calibration.depth_camera = Camera{640, 480, 575, 576, 320, 240, {}};
  rig.calibration.T_color_depth = Eigen::Matrix4d::Identity();
  (*rig.calibration.T_color_depth)(0, 3) = -0.0251;
  rig.calibration.color_response = ColorResponse{ColorResponse::Kind::gamma, 2.2};
  rig.calibration.color_crosstalk = Eigen::Matrix3d::Identity();
  (*rig.calibration.color_crosstalk)(0, 1) = 0.08;
  return rig;
}

void expect_calibrated(const Rig& rig) {
  EXPECT_EQ(rig.sensor.lamp_jitter_us, 2345.6);
  ASSERT_TRUE(rig.lamps[0].position_m);
  EXPECT_NEAR(rig.lamps[0].position_m->z(), 1.0 / 3, 1e-9);
  EXPECT_FALSE(rig.lamps[1].position_m);
  ASSERT_TRUE(rig.calibration.color_camera && rig.calibration.depth_camera);
  EXPECT_EQ(rig.calibration.color_camera->fy, 1050.25);
  EXPECT_EQ(rig.calibration.color_camera->distortion, (std::vector<double>{0.1, -0.2, 0.001, 0.002, 0.05}));
  EXPECT_EQ(rig.calibration.depth_camera->width, 640);
  EXPECT_EQ((*rig.calibration.T_color_depth)(0, 3), -0.0251);
  EXPECT_EQ(rig.calibration.color_response->gamma, 2.2);
  EXPECT_EQ((*rig.calibration.color_crosstalk)(0, 1), 0.08);
}

class StoreCalibration : public testing::TestWithParam<std::string> {};

TEST_P(StoreCalibration, ThenReadsItBackAndKeepsEveryLineOfTheUsers) {
  const TemporaryFolder home;
  const std::filesystem::path file = home / "desk.toml";
  set_text(file, GetParam());
  store_calibration(calibrated(read_rig(file)), file);
  expect_calibrated(read_rig(file));
  const std::string stored = text_of(file);
  EXPECT_THAT(stored, HasSubstr("id = \"left\"   # on the short arm"));
  store_calibration(read_rig(file), file);
  EXPECT_EQ(text_of(file), stored) << "nothing new, nothing written";
}

INSTANTIATE_TEST_SUITE_P(
    Layouts, StoreCalibration,
    testing::Values(
        small_rig(), small_rig("[calibration]\n# the program's own\n"),
        small_rig("[sensor]\nlamp_jitter_us = 1 # guessed\n[calibration.color_camera]\nwidth = 1\n"
                  "height = 1\nfx = 1\nfy = 1\ncx = 1\ncy = 1\n"),
        small_rig("[calibration]\ncolor_response = \"srgb\"\ncolor_camera = { width = 4, height = 4, "
                  "fx = 1, fy = 1, cx = 1, cy = 1 }\n")));

TEST(StoreCalibration, ChangesOnlyTheLinesItMeasured) {
  const TemporaryFolder home;
  const std::filesystem::path file = home / "pi.toml";
  const std::string before = text_of(kExamples / "raspberry-pi.toml");
  set_text(file, before);
  Rig rig = read_rig(file);
  rig.sensor.lamp_jitter_us = 731;
  store_calibration(rig, file);
  std::string expected = before;
  const std::string old = "lamp_jitter_us = 1000 ";
  ASSERT_NE(expected.find(old), std::string::npos);
  expected.replace(expected.find(old), old.size(), "lamp_jitter_us = 731.0 ");
  EXPECT_EQ(text_of(file), expected);
}

TEST(StoreCalibration, RefusesALayoutItCannotWriteIntoAndLeavesIt) {
  const TemporaryFolder home;
  const std::filesystem::path file = home / "desk.toml";
  for (const std::string layout :
       {"[calibration.color_response]\ngamma = 1.8\n", "calibration.color_response = \"srgb\"\n"}) {
    const std::string text = small_rig(layout);
    set_text(file, text);
    EXPECT_THAT(message_of<InputError>([&] { store_calibration(calibrated(read_rig(file)), file); }),
                HasSubstr("results cannot be put into"));
    EXPECT_EQ(text_of(file), text);
  }
}

TEST(StoreCalibration, RefusesAFileWhoseLampsHaveChanged) {
  const TemporaryFolder home;
  const std::filesystem::path file = home / "desk.toml";
  set_text(file, small_rig());
  const Rig rig = read_rig(file);
  replace_in_file(file, "\"left\"", "\"west\"");
  EXPECT_THAT(message_of<InputError>([&] { store_calibration(rig, file); }), HasSubstr("no longer those"));
}

}  // namespace
}  // namespace rakelight::test
