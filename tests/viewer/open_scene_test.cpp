// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/open_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "refine/output/result_io.h"
#include "stack/errors.h"
#include "stack/stack_io.h"
#include "tests/support/bump_stack.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/bump_result.h"

namespace rakelight {
namespace {

using testing::HasSubstr;

class OpenScene : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  std::string refusal(const std::filesystem::path& path) {
    return test::message_of<InputError>([&] { open_scene({path, {}}); });
  }
};

TEST_F(OpenScene, AResultHasItsLayersMapsAndHistory) {
  write_result(test::bump_result(), folder_ / "out");
  const Scene scene = open_scene({folder_ / "out", {}});
  EXPECT_NE(scene.find(LayerKind::preprocessed), nullptr);
  EXPECT_NE(scene.find(LayerKind::refined), nullptr);
  EXPECT_EQ(scene.find(LayerKind::sensor), nullptr);
  EXPECT_FALSE(scene.albedo.empty());
  EXPECT_FALSE(scene.uncertainty.empty());
  ASSERT_EQ(scene.iterations.size(), 5u);
  EXPECT_DOUBLE_EQ(scene.iterations[1].energy, 5);
  EXPECT_EQ(scene.message, "settled after 5 iterations");
}

TEST_F(OpenScene, AScanHasItsDepthImagesAndTruth) {
  write_stack(test::bump_stack(), folder_ / "scan", test::bump_truth());
  const Scene scene = open_scene({folder_ / "scan", {}});
  EXPECT_EQ(scene.find(LayerKind::sensor)->depth.size(), cv::Size(48, 36));
  EXPECT_EQ(scene.frames.size(), 8u);
  ASSERT_NE(scene.find(LayerKind::truth), nullptr);
  const Camera& camera = scene.find(LayerKind::truth)->camera;
  EXPECT_EQ(camera.size(), scene.find(LayerKind::truth)->depth.size());
}

TEST_F(OpenScene, AResultWithItsScanHasBoth) {
  write_result(test::bump_result(), folder_ / "out");
  write_stack(test::bump_stack(), folder_ / "scan");
  const Scene scene = open_scene({folder_ / "out", folder_ / "scan"});
  EXPECT_EQ(scene.layers.size(), 3u);
  EXPECT_EQ(scene.frames.size(), 8u);
}

TEST_F(OpenScene, AResultFindsItsScanAlsoWhenBothWereMoved) {
  std::filesystem::create_directory(folder_ / "here");
  write_stack(test::bump_stack(), folder_ / "here/scan", test::bump_truth());
  const LightStack stack = read_stack(folder_ / "here/scan");
  write_result(test::bump_result(), folder_ / "here/out", &stack);
  std::filesystem::rename(folder_ / "here", folder_ / "there");
  const Scene scene = open_scene({folder_ / "there/out", {}});
  EXPECT_EQ(scene.stack, folder_ / "there/scan");
  EXPECT_TRUE(scene.frames.empty()) << "a result opens without the time that takes";
  const Scene more = with_stack(scene);
  EXPECT_EQ(more.frames.size(), 8u);
  EXPECT_NE(more.find(LayerKind::truth), nullptr);
  std::filesystem::rename(folder_ / "there/out", folder_ / "out");
  EXPECT_TRUE(open_scene({folder_ / "out", {}}).stack.empty()) << "neither place holds it now";
}

TEST_F(OpenScene, AResultWhoseScanIsBrokenShowsWhatItHas) {
  write_stack(test::bump_stack(), folder_ / "scan");
  const LightStack stack = read_stack(folder_ / "scan");
  write_result(test::bump_result(), folder_ / "out", &stack);
  std::filesystem::remove(folder_ / "scan/stack.json");
  const Scene more = with_stack(open_scene({folder_ / "out", {}}));
  EXPECT_EQ(more.layers.size(), 2u);
  EXPECT_TRUE(more.stack.empty());
}

TEST_F(OpenScene, RefusesWhatIsNeitherScanNorResult) {
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("is neither a stack"));
  EXPECT_THAT(refusal(folder_ / "nowhere"), HasSubstr("does not exist"));
}

TEST_F(OpenScene, RefusesAHalfWrittenResult) {
  write_result(test::bump_result(), folder_ / "out");
  std::filesystem::remove(folder_ / "out" / "result.json");
  EXPECT_THAT(refusal(folder_ / "out"), HasSubstr("is an unfinished result"));
  write_result(test::bump_result(), folder_ / "cut");
  std::filesystem::resize_file(folder_ / "cut" / "normals.tiff", 100);
  EXPECT_THAT(refusal(folder_ / "cut"), HasSubstr("normals.tiff"));
}

TEST_F(OpenScene, RefusesAStackBesideAStack) {
  write_stack(test::bump_stack(), folder_ / "scan");
  EXPECT_THROW(open_scene({folder_ / "scan", folder_ / "scan"}), UsageError);
}

}  // namespace
}  // namespace rakelight
