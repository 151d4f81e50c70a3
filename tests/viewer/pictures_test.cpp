// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Drawn without a display. Where no OpenGL is to be had, these are skipped aloud.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "stack/errors.h"
#include "stack/image_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/bump_result.h"
#include "viewer/gl/offscreen_context.h"
#include "viewer/viewer.h"

namespace rakelight {
namespace {

const cv::Size kSize(240, 180);

class Pictures : public testing::Test {
 protected:
  void SetUp() override {
    try {
      make_offscreen_context();
    } catch (const std::system_error& error) { GTEST_SKIP() << "no OpenGL: " << error.what(); }
  }
  cv::Mat3b picture(const Look& look, const ViewPoint& view = {}) {
    PictureOptions options{folder_ / "picture.png", kSize, 0, false};
    save_pictures(scene_, look, view, options);
    return read_color_png(options.file, kSize);
  }
  test::TemporaryFolder folder_;
  const Scene scene_ = test::bump_scene();
};

/// Mean over pixels and channels, 0 to 255.
double mean_difference(const cv::Mat3b& a, const cv::Mat3b& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(3 * a.total());
}

double brightness(const cv::Mat3b& picture, const cv::Rect& part) {
  const cv::Scalar mean = cv::mean(picture(part));
  return (mean[0] + mean[1] + mean[2]) / 3;
}

const cv::Rect kLeftFlank(90, 80, 20, 20), kRightFlank(130, 80, 20, 20);

TEST_F(Pictures, SayHowTheyWereDrawn) {
  const PictureReport report = save_pictures(scene_, {}, {}, {folder_ / "p.png", kSize, 0, true});
  EXPECT_TRUE(report.path.find("EGL without a display on ") == 0 ||
              report.path.find("a hidden window on ") == 0)
      << report.path;
  EXPECT_EQ(report.files.size(), 1u);
}

TEST_F(Pictures, LightFromTheLeftBrightensTheLeftFlank) {
  Look look;
  for (const Material material : {Material::matte, Material::clay, Material::chrome}) {
    look.material = material;
    look.light = {180, 20};
    const cv::Mat3b from_left = picture(look);
    look.light = {0, 20};
    const cv::Mat3b from_right = picture(look);
    EXPECT_GT(brightness(from_left, kLeftFlank), brightness(from_left, kRightFlank) + 5);
    EXPECT_GT(brightness(from_right, kRightFlank), brightness(from_right, kLeftFlank) + 5);
  }
}

TEST_F(Pictures, ARakingLightShowsTheReliefOfTheRefinedSurfaceAlone) {
  Look look;
  look.light = {180, 15};
  const auto contrast = [&](LayerKind layer) {
    look.layer = layer;
    cv::Scalar mean, deviation;
    cv::meanStdDev(picture(look)(cv::Rect(80, 60, 80, 60)), mean, deviation);
    return deviation[0];
  };
  EXPECT_GT(contrast(LayerKind::refined), 10 * contrast(LayerKind::preprocessed) + 10);
}

TEST_F(Pictures, SplitShowsBeforeLeftAndAfterRightOfTheDivider) {
  Look look;
  look.before = LayerKind::preprocessed;
  look.divider = 0.6;
  const cv::Mat3b after = picture(look);
  look.layer = LayerKind::preprocessed;
  const cv::Mat3b before = picture(look);
  look.layer = LayerKind::refined;
  look.split = true;
  const cv::Mat3b both = picture(look);
  const cv::Rect left(0, 0, 142, 180), right(146, 0, 94, 180);
  EXPECT_EQ(mean_difference(both(left), before(left)), 0);
  EXPECT_EQ(mean_difference(both(right), after(right)), 0);
  EXPECT_GT(mean_difference(both, after), 1);
}

TEST_F(Pictures, MapsAreShownInTheColoursOfTheirBar) {
  Look look;
  look.coloring = Coloring::delta;
  const cv::Mat3b delta = picture(look);
  EXPECT_EQ(delta(90, 120), cv::Vec3b(33, 102, 172))
      << "the bump is nearer by more than the range: full blue";
  EXPECT_LT(cv::norm(delta(20, 30), cv::Vec3b(247, 247, 247)), 4) << "the plane has not moved";
}

TEST_F(Pictures, PointsCoverWhatTheMeshCovers) {
  Look look;
  look.coloring = Coloring::albedo;
  const cv::Mat3b mesh = picture(look);
  look.points = true;
  EXPECT_LT(mean_difference(mesh, picture(look)), 12);
}

TEST_F(Pictures, OrthographicShowsTheBumpNoLarger) {
  Look look;
  const cv::Mat3b perspective = picture(look);
  ViewPoint view;
  view.orthographic = true;
  EXPECT_GT(mean_difference(perspective, picture(look, view)), 0.5);
}

TEST_F(Pictures, OfATurntableAreNumberedAndGoAround) {
  const PictureReport report = save_pictures(scene_, {}, {}, {folder_ / "turn.png", kSize, 4, false});
  ASSERT_EQ(report.files.size(), 4u);
  EXPECT_EQ(report.files[3], folder_ / "turn0003.png");
  const auto at = [&](std::size_t i) { return cv::Mat3b(read_color_png(report.files[i], kSize)); };
  const cv::Vec3b background = at(0)(0, 0);
  EXPECT_NE(at(0)(90, 20), background);
  EXPECT_EQ(at(1)(90, 20), background) << "from the side, the plane is a line";
  EXPECT_NE(at(2)(90, 60), background);
  EXPECT_LT(brightness(at(2), {60, 60, 40, 40}), brightness(at(0), {60, 60, 40, 40})) << "the back is dark";
}

TEST_F(Pictures, TooLargeForTheDriverAreRefused) {
  EXPECT_THROW(save_pictures(scene_, {}, {}, {folder_ / "p.png", {1 << 20, 16}, 0, true}), std::system_error);
}

TEST_F(Pictures, ToAFullDiskOrNoFolderAreIoErrors) {
  EXPECT_THROW(save_pictures(scene_, {}, {}, {folder_ / "nowhere" / "p.png", kSize, 0, true}), IoError);
}

/// Stored pictures; RAKELIGHT_WRITE_REFERENCES=1 draws them anew, to be looked at before they are committed.
class StoredPictures : public Pictures, public testing::WithParamInterface<const char*> {};

TEST_P(StoredPictures, AreDrawnAgain) {
  const std::string name = GetParam();
  Look look;
  look.before = LayerKind::preprocessed;
  ViewPoint view;
  view.azimuth_deg = 25;
  view.elevation_deg = 20;
  if (name == "chrome") look.material = Material::chrome;
  if (name == "albedo") look.coloring = Coloring::albedo;
  if (name == "split-delta") look.split = true, look.coloring = Coloring::delta;
  const std::filesystem::path stored =
      std::filesystem::path(RAKELIGHT_SOURCE_DIR) / "tests/viewer/references" / (name + ".png");
  const PictureOptions options{folder_ / "now.png", kSize, 0, false};
  save_pictures(scene_, look, view, options);
  if (std::getenv("RAKELIGHT_WRITE_REFERENCES") != nullptr)
    std::filesystem::copy_file(options.file, stored, std::filesystem::copy_options::overwrite_existing);
  // Drivers round outlines and shades differently; a wrong light, layer or view differs by far more.
  EXPECT_LT(mean_difference(read_color_png(options.file, kSize), read_color_png(stored, kSize)), 2.0);
}

INSTANTIATE_TEST_SUITE_P(, StoredPictures, testing::Values("clay", "chrome", "albedo", "split-delta"),
                         [](const auto& test) {
                           std::string name = test.param;
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

}  // namespace
}  // namespace rakelight
