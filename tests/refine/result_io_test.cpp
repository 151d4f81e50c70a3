// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/result_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "refine/output/images.h"
#include "stack/atomic_folder.h"
#include "stack/errors.h"
#include "stack/float_tiff.h"
#include "stack/image_file.h"
#include "tests/support/file_edits.h"
#include "tests/support/message_of.h"
#include "tests/support/sample_result.h"
#include "tests/support/tiny_disk.h"

namespace rakelight {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::set_text;
using test::text_of;
using testing::HasSubstr;

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename());
  return names;
}

nlohmann::json manifest(const fs::path& folder) {
  return nlohmann::json::parse(text_of(folder / "result.json"));
}

/// Same bits, NaN included.
template <class T>
void expect_same(const cv::Mat_<T>& a, const cv::Mat_<T>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data, b.data, a.total() * a.elemSize()), 0);
}

TEST(ResultIo, WritesEveryFileOfTheFormatAndLeavesNothingBeside) {
  const test::TemporaryFolder folder;
  write_result(test::sample_result(), folder / "out");
  EXPECT_EQ(names_in(folder / "out"),
            (std::set<std::string>{"depth.tiff", "depth.png", "initial_depth.tiff", "normals.tiff",
                                   "normals.png", "albedo.tiff", "albedo.png", "mesh.ply", "mesh.glb",
                                   "before_after.png", "report.html", "result.json"}));
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"out"});
}

TEST(ResultIo, SaysWhereItsStackLies) {
  const test::TemporaryFolder folder;
  write_result(test::sample_result(), folder / "out");
  EXPECT_TRUE(manifest(folder / "out")["stack"].is_null());
  LightStack stack;
  fs::create_directory(folder / "scan");
  stack.origin = folder / "scan";
  write_result(test::sample_result(), folder / "out", &stack);
  EXPECT_EQ(manifest(folder / "out")["stack"]["relative"], "../scan");
  EXPECT_EQ(manifest(folder / "out")["stack"]["absolute"], fs::canonical(folder / "scan").string());
  EXPECT_EQ(read_result(folder / "out").stack, folder / "scan");
}

TEST(ResultIo, ReadsBackExactlyWhatItWrote) {
  const test::TemporaryFolder folder;
  const RefineResult written = test::sample_result();
  write_result(written, folder / "out");
  const StoredResult read = read_result(folder / "out");
  expect_same(read.depth, written.depth);
  expect_same(read.initial_depth, written.initial_depth);
  expect_same(read.normals, written.normals);
  expect_same(read_float3_tiff(folder / "out/albedo.tiff"), written.albedo);
  EXPECT_EQ(read.camera.fx, written.camera.fx);
  EXPECT_EQ(read.camera.cy, written.camera.cy);
}

TEST(ResultIo, StoresDepthAsSixteenBitsInTheUnitItSays) {
  const test::TemporaryFolder folder;
  const RefineResult result = test::sample_result();
  write_result(result, folder / "out");
  const double unit = manifest(folder / "out").at("depth_png_unit_m");
  const cv::Mat1w raw = read_depth_png(folder / "out/depth.png");
  EXPECT_EQ(raw(0, 0), 0);
  EXPECT_NEAR(raw(5, 5) * unit, static_cast<double>(result.depth(5, 5)), unit / 2);
  EXPECT_NEAR(raw(5, 20) * unit, static_cast<double>(result.depth(5, 20)), unit / 2);
}

TEST(ResultIo, PaintsNormalsAsOpenGlToolsDo) {
  const test::TemporaryFolder folder;
  write_result(test::sample_result(), folder / "out");
  const cv::Mat picture = read_color_png(folder / "out/normals.png");
  ASSERT_EQ(picture.type(), CV_16UC3);
  const auto color = picture.at<cv::Vec3w>(5, 5);
  const cv::Vec3f n = cv::normalize(cv::Vec3f(0.1f, -0.2f, -1.0f));
  EXPECT_NEAR(color[0], (n[0] + 1) * 32767.5f, 1);
  EXPECT_NEAR(color[1], (-n[1] + 1) * 32767.5f, 1);
  EXPECT_NEAR(color[2], (-n[2] + 1) * 32767.5f, 1);
  EXPECT_EQ(picture.at<cv::Vec3w>(0, 0), cv::Vec3w(0, 0, 0));
}

TEST(ResultIo, RecordsHowItEndedWithEveryParameter) {
  const test::TemporaryFolder folder;
  RefineResult result = test::sample_result();
  result.options.preprocess.bilateral_sigma_px = 1.75;
  write_result(result, folder / "out");
  const nlohmann::json json = manifest(folder / "out");
  EXPECT_EQ(json.at("format"), "rakelight-result");
  EXPECT_EQ(json.at("termination"), "converged");
  EXPECT_EQ(json.at("message"), "The depth no longer changed.");
  EXPECT_EQ(json.at("warnings").at(0), "A tenth of the object is saturated.");
  EXPECT_EQ(json.at("options").at("method"), "multi-light");
  EXPECT_EQ(json.at("options").at("preprocess").at("bilateral_sigma_px"), 1.75);
  EXPECT_EQ(json.at("iterations").at(0).at("energy"), 0.25);
  EXPECT_EQ(json.at("iterations").at(0).at("seconds"), 0.125);
  EXPECT_EQ(json.at("lights").at(0).at("id"), "lamp \"7\"");
  EXPECT_EQ(json.at("lights").at(0).at("sh_rgb").at(2).at(3), 1.2);
  EXPECT_EQ(json.at("quality").at("coverage"), 0.9);
  for (const char* name : {"rakelight", "opencv", "eigen", "cholmod"}) {
    EXPECT_FALSE(json.at("versions").at(name).get<std::string>().empty()) << name;
  }
}

TEST(ResultIo, SurvivesTextThatIsNoUtf8) {
  const test::TemporaryFolder folder;
  RefineResult result = test::sample_result();
  result.lights.front().id = "\xff\xfe";
  write_result(result, folder / "out");
  EXPECT_NO_THROW(manifest(folder / "out"));
}

TEST(ResultIo, ReplacesAnEarlierResult) {
  const test::TemporaryFolder folder;
  RefineResult result = test::sample_result();
  write_result(result, folder / "out");
  result.message = "Another one.";
  write_result(result, folder / "out");
  EXPECT_EQ(manifest(folder / "out").at("message"), "Another one.");
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"out"});
}

TEST(ResultIo, RefusesAFolderThatIsNoResultAndLeavesItAlone) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "photos");
  set_text(folder / "photos/holiday.jpg", "beach");
  EXPECT_THROW(check_result_folder(folder / "photos"), InputError);
  EXPECT_THROW(write_result(test::sample_result(), folder / "photos"), InputError);
  EXPECT_EQ(text_of(folder / "photos/holiday.jpg"), "beach");
  EXPECT_EQ(names_in(folder / "photos"), std::set<std::string>{"holiday.jpg"});
}

TEST(ResultIo, CheckingAFolderChangesNothing) {
  const test::TemporaryFolder folder;
  check_result_folder(folder / "new");
  EXPECT_TRUE(names_in(folder.path()).empty());
  write_result(test::sample_result(), folder / "old");
  const std::string before = text_of(folder / "old/result.json");
  check_result_folder(folder / "old");
  EXPECT_EQ(text_of(folder / "old/result.json"), before);
}

TEST(ResultIo, RefusesASecondWriterAtTheSameTime) {
  const test::TemporaryFolder folder;
  const AtomicFolder first(folder / "out", {"result", "result.json", {}});
  EXPECT_THROW(write_result(test::sample_result(), folder / "out"), BusyError);
}

TEST(ResultIo, KeepsTheEarlierResultWhenTheDiskIsFull) {
  const test::TinyDisk disk(256);
  if (!disk.mounted()) GTEST_SKIP() << "needs root to mount a small tmpfs";
  write_result(test::sample_result(), disk.path() / "out");
  const std::string before = text_of(disk.path() / "out/result.json");

  // Fill what is left, so that the second result does not fit beside the first.
  std::ofstream filler(disk.path() / "filler", std::ios::binary);
  while (filler.put('x').flush()) {}
  EXPECT_THROW(write_result(test::sample_result(), disk.path() / "out"), IoError);
  EXPECT_EQ(text_of(disk.path() / "out/result.json"), before);
  EXPECT_EQ(names_in(disk.path()), (std::set<std::string>{"out", "filler"}));
}

TEST(ResultIo, NamesTheFileWhenAResultIsDamaged) {
  const test::TemporaryFolder folder;
  write_result(test::sample_result(), folder / "out");
  const std::string whole = text_of(folder / "out/depth.tiff");
  set_text(folder / "out/depth.tiff", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(message_of<InputError>([&] { read_result(folder / "out"); }), HasSubstr("depth.tiff"));
}

TEST(ResultIo, RefusesManifestsThatAreNoResultsOrDescribeNoCamera) {
  const test::TemporaryFolder folder;
  write_result(test::sample_result(), folder / "out");
  const nlohmann::json good = manifest(folder / "out");
  const auto refuses = [&](const std::string& text) {
    set_text(folder / "out/result.json", text);
    EXPECT_THROW(read_result(folder / "out"), InputError) << text.substr(0, 80);
  };
  refuses("");
  refuses("[]");
  refuses("{\"format\": 7}");
  refuses("{\"format\": \"rakelight-result\", \"version\": 99}");
  for (const char* key : {"width", "height", "fx", "fy"}) {
    nlohmann::json bad = good;
    bad["camera"][key] = -1;
    refuses(bad.dump());
    bad["camera"][key] = "text";
    refuses(bad.dump());
    bad["camera"].erase(key);
    refuses(bad.dump());
  }
}

TEST(Images, ChooseTheFinestDepthUnitThatFits) {
  EXPECT_DOUBLE_EQ(depth_unit(cv::Mat1f(2, 2, 0.6f)), 1e-5);
  EXPECT_DOUBLE_EQ(depth_unit(cv::Mat1f(2, 2, 1.0f)), 2e-5);
  EXPECT_DOUBLE_EQ(depth_unit(cv::Mat1f(2, 2, 6.0f)), 1e-4);
  EXPECT_DOUBLE_EQ(depth_unit(cv::Mat1f(2, 2, 600.0f)), 1e-2);
}

TEST(Images, ShowTheBrightestAlbedoAsWhite) {
  cv::Mat3f albedo(10, 10, cv::Vec3f(0.5f, 0.5f, 0.5f));
  albedo.row(3).setTo(cv::Scalar::all(2));
  const cv::Mat3b picture = albedo_picture(albedo);
  EXPECT_EQ(picture(3, 0), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(picture(0, 0)[0], 137);  // sRGB of a quarter
}

}  // namespace
}  // namespace rakelight
