// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/image_sensor.h"

#include <gtest/gtest.h>

#include "stack/color_response.h"

namespace rakelight {
namespace {

SimulateOptions quiet(int bits) {
  SimulateOptions options;
  options.image.bits = bits;
  options.image.shot_noise = options.image.read_noise = 0;
  return options;
}

/// One pixel of 16 bits as a share of full scale.
Eigen::Vector3d exposed(const SimulateOptions& options, const Eigen::Vector3f& radiance,
                        double exposure = 1) {
  const ImageSensor sensor(options, exposure);
  cv::Mat image = sensor.blank({1, 1});
  sensor.expose(radiance, 0, {0, 0}, image);
  const auto value = image.at<cv::Vec3w>(0, 0);
  return Eigen::Vector3d(value[0], value[1], value[2]) / 65535;
}

TEST(ImageSensor, ExposureScalesAndFullScaleClips) {
  const Eigen::Vector3d value = exposed(quiet(16), {0.1f, 0.3f, 0.9f}, 2);
  EXPECT_NEAR(value.x(), 0.2, 1e-5);
  EXPECT_NEAR(value.y(), 0.6, 1e-5);
  EXPECT_EQ(value.z(), 1.0);
}

TEST(ImageSensor, EncodesByTheColourResponse) {
  SimulateOptions options = quiet(16);
  options.image.response = parse_color_response("srgb");
  EXPECT_NEAR(decode(options.image.response, exposed(options, {0.2f, 0.2f, 0.2f}).x()), 0.2, 1e-4);
  EXPECT_GT(exposed(options, {0.2f, 0.2f, 0.2f}).x(), 0.4);
}

TEST(ImageSensor, CrosstalkLeaksIntoAdjacentChannels) {
  SimulateOptions options = quiet(16);
  options.image.crosstalk = 0.1;
  const Eigen::Vector3d red = exposed(options, {0.5f, 0, 0}), green = exposed(options, {0, 0.5f, 0});
  EXPECT_NEAR(red.y(), 0.05, 1e-5);
  EXPECT_EQ(red.z(), 0);
  EXPECT_NEAR(green.x(), 0.05, 1e-5);
  EXPECT_NEAR(green.z(), 0.05, 1e-5);
}

TEST(ImageSensor, EightBitsRoundToTheNearestStep) {
  const SimulateOptions options = quiet(8);
  const ImageSensor sensor(options, 1);
  cv::Mat image = sensor.blank({1, 1});
  ASSERT_EQ(image.type(), CV_8UC3);
  sensor.expose(Eigen::Vector3f(100.4f, 100.6f, 300.0f) / 255, 0, {0, 0}, image);
  EXPECT_EQ(image.at<cv::Vec3b>(0, 0), cv::Vec3b(100, 101, 255));
}

/// Mean and deviation of a flat 16-bit image's green channel, as shares of full scale.
std::pair<double, double> statistics(const SimulateOptions& options, float radiance, int index = 0) {
  const ImageSensor sensor(options, 1);
  cv::Mat image = sensor.blank({100, 100});
  for (int k = 0; k < 10000; ++k) {
    sensor.expose({radiance, radiance, radiance}, index, {k % 100, k / 100}, image);
  }
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  return {mean[1] / 65535, deviation[1] / 65535};
}

TEST(ImageSensor, NoiseGrowsWithTheRootOfRadiance) {
  SimulateOptions options = quiet(16);
  options.image.shot_noise = 0.02;
  const auto [mean, deviation] = statistics(options, 0.5f);
  EXPECT_NEAR(mean, 0.5, 1e-3);
  EXPECT_NEAR(deviation, 0.02 * std::sqrt(0.5), 5e-4);
  EXPECT_NEAR(statistics(options, 0.05f).second, 0.02 * std::sqrt(0.05), 3e-4);
}

TEST(ImageSensor, ReadNoiseIsThereInTheDark) {
  SimulateOptions options = quiet(16);
  options.image.read_noise = 0.01;
  EXPECT_NEAR(statistics(options, 0.3f).second, 0.01, 3e-4);
}

TEST(ImageSensor, EveryImageHasItsOwnNoise) {
  SimulateOptions options = quiet(16);
  options.image.read_noise = 0.01;
  const ImageSensor sensor(options, 1);
  cv::Mat image = sensor.blank({2, 1});
  const Eigen::Vector3f gray(0.5f, 0.5f, 0.5f);
  sensor.expose(gray, 0, {0, 0}, image);
  const auto first = image.at<cv::Vec3w>(0, 0);
  sensor.expose(gray, 1, {0, 0}, image);
  sensor.expose(gray, 0, {1, 0}, image);
  EXPECT_NE(image.at<cv::Vec3w>(0, 0), first);
  EXPECT_NE(image.at<cv::Vec3w>(0, 1), first);
}

}  // namespace
}  // namespace rakelight
