// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/frame_renderer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulate/virtual_sensor/virtual_scene.h"

namespace rakelight {
namespace {

VirtualSensorSetup small_setup() {
  VirtualSensorSetup setup;
  setup.color_size = setup.depth_size = {80, 60};
  setup.lamps = {
      {"white-0", LampColor::white, {}}, {"white-1", LampColor::white, {}}, {"green", LampColor::green, {}}};
  setup.wiring.lamps = setup.lamps.size();
  return setup;
}

ImageOptions without_noise() {
  ImageOptions options;
  options.shot_noise = options.read_noise = 0;
  return options;
}

std::vector<LampRows> lit(std::size_t lamp, float us, std::size_t rows = 60) {
  return {{lamp, std::vector<float>(rows, us)}};
}

class FrameRendererTest : public testing::Test {
 protected:
  cv::Mat3b render(const std::vector<LampRows>& light, const Exposure& exposure = {}, int frame = 0,
                   const ImageOptions& options = without_noise()) const {
    cv::Mat3b image;
    FrameRenderer(images_, options, 1).render(light, exposure, frame, image);
    return image;
  }

  const LampImages images_ = VirtualScene(small_setup()).render_color({80, 60});
};

TEST_F(FrameRendererTest, NoLampLeavesTheRoomsLightAndALampAddsItsImage) {
  const cv::Mat3b dark = render({}), bright = render(lit(0, 8000));
  EXPECT_GT(cv::sum(dark)[1], 0);
  EXPECT_GT(cv::sum(bright)[1], 5 * cv::sum(dark)[1]);
  EXPECT_EQ(cv::countNonZero(cv::Mat(bright.reshape(1) < dark.reshape(1))), 0);
}

TEST_F(FrameRendererTest, AGreenLampReachesTheGreenChannelAlone) {
  const cv::Mat3b dark = render({}), green = render(lit(2, 8000));
  const cv::Scalar gain = cv::sum(green) - cv::sum(dark);
  EXPECT_EQ(gain[0], 0);
  EXPECT_GT(gain[1], 1000);
  EXPECT_EQ(gain[2], 0);
}

TEST_F(FrameRendererTest, CrosstalkLeaksGreenIntoItsNeighbours) {
  VirtualSensorSetup setup = small_setup();
  setup.crosstalk = 0.2;
  const LampImages images = VirtualScene(setup).render_color({80, 60});
  const cv::Scalar sum = cv::sum(images.lamps[2]);
  EXPECT_NEAR(sum[0] / sum[1], 0.2, 1e-3);
  EXPECT_NEAR(sum[2] / sum[1], 0.2, 1e-3);
}

TEST_F(FrameRendererTest, HalfTheExposureAtTwiceTheGainIsAsBright) {
  const cv::Mat3b whole = render(lit(0, 8000)), half = render(lit(0, 4000), {4000, 200, {1, 1, 1}});
  EXPECT_LE(cv::norm(whole, half, cv::NORM_INF), 1);
}

TEST_F(FrameRendererTest, ARowIsAsBrightAsTheShareOfItsExposureThatWasLit) {
  std::vector<LampRows> light = lit(0, 8000);
  for (std::size_t row = 30; row < 60; ++row) light[0].lit_us[row] = 0;
  const cv::Mat3b split = render(light);
  EXPECT_EQ(cv::norm(split.rowRange(0, 30), render(lit(0, 8000)).rowRange(0, 30), cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(split.rowRange(30, 60), render({}).rowRange(30, 60), cv::NORM_INF), 0);
}

TEST_F(FrameRendererTest, NoiseIsDrawnAnewAFrameAndHasTheAskedDeviation) {
  ImageOptions options = without_noise();
  options.read_noise = 0.02;
  const Exposure exposure;
  const cv::Mat3b a = render(lit(0, 4000), exposure, 1, options),
                  b = render(lit(0, 4000), exposure, 2, options);
  EXPECT_EQ(cv::norm(a, render(lit(0, 4000), exposure, 1, options), cv::NORM_INF), 0);
  cv::Mat3f difference;
  cv::subtract(a, b, difference, cv::noArray(), CV_32F);
  cv::Scalar mean, deviation;
  const cv::Mat1b midtones = [&] {  // where neither end of the scale cuts the noise
    cv::Mat1b mask;
    cv::inRange(render(lit(0, 4000)), cv::Scalar::all(40), cv::Scalar::all(215), mask);
    return mask;
  }();
  cv::meanStdDev(difference, mean, deviation, midtones);
  EXPECT_NEAR(deviation[1], 0.02 * 255 * std::sqrt(2), 0.5);
}

TEST_F(FrameRendererTest, AnSrgbResponseBrightensTheMidtones) {
  ImageOptions options = without_noise();
  options.response = {ColorResponse::Kind::srgb, 1};
  EXPECT_GT(cv::sum(render(lit(0, 2000), {}, 0, options))[0], 1.5 * cv::sum(render(lit(0, 2000)))[0]);
}

TEST(VirtualScene, AtTheReferenceExposureFewPixelsClipUnderALampAndTheObjectIsNotDim) {
  const LampImages images = VirtualScene(small_setup()).render_color({80, 60});
  for (const cv::Mat3f& lamp : images.lamps) {
    double peak = 0;
    cv::minMaxLoc(cv::Mat3f(lamp + images.ambient).reshape(1), nullptr, &peak);
    EXPECT_GT(peak, 0.5);
    EXPECT_LT(cv::countNonZero(cv::Mat(cv::Mat3f(lamp + images.ambient).reshape(1) >= 1)),
              0.01 * 3 * 80 * 60);
  }
}

TEST(VirtualScene, ALampWithAPositionIsNearAndTheOthersStandApart) {
  VirtualSensorSetup setup = small_setup();
  setup.lamps[1].position_m = Eigen::Vector3d(0.3, -0.2, 0.2);
  const VirtualScene scene(setup);
  const GroundTruth truth = scene.truth(scene.render_color({80, 60}));
  ASSERT_EQ(truth.lamps.size(), 3u);
  EXPECT_FALSE(truth.lamps[0].near);
  EXPECT_TRUE(truth.lamps[1].near);
  EXPECT_NEAR(truth.lamps[1].position_m->x(), 0.3, 1e-9);
  EXPECT_EQ(truth.lamps[2].strength[0], 0);
  EXPECT_LT(truth.lamps[0].direction.dot(truth.lamps[2].direction), 0.99);
}

TEST(VirtualScene, DepthFramesSeeTheSurfaceAndDifferByNoise) {
  const VirtualScene scene(small_setup());
  const DepthSensor sensor = scene.depth_sensor({80, 60});
  const GroundTruth truth = scene.truth(scene.render_color({80, 60}));
  const double middle = sensor.frame(0)(30, 40) * scene.options().depth.unit_m;
  EXPECT_NEAR(middle, static_cast<double>(truth.depth(30, 40)), 0.03);
  EXPECT_GT(cv::norm(sensor.frame(0), sensor.frame(1), cv::NORM_L1), 0);
  EXPECT_EQ(cv::norm(sensor.frame(1), sensor.frame(1), cv::NORM_L1), 0);
}

}  // namespace
}  // namespace rakelight
