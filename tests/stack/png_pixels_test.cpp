// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Against OpenCV's codec, which goes by libpng.
#include "stack/png_pixels.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/small_stack.h"

namespace rakelight {
namespace {

/// Ramps with noise, which every filter predicts somewhere, and values that wrap around.
cv::Mat sample_image(int type, cv::Size size) {
  cv::Mat noise(size, CV_MAKETYPE(CV_16U, CV_MAT_CN(type))), image;
  cv::RNG random(7);
  random.fill(noise, cv::RNG::UNIFORM, 0, 900);
  for (int y = 0; y < size.height; ++y) {
    auto* row = noise.ptr<std::uint16_t>(y);
    for (int k = 0; k < size.width * noise.channels(); ++k)
      row[k] = static_cast<std::uint16_t>(row[k] + 700 * k + 2300 * y);
  }
  if (CV_MAT_DEPTH(type) == CV_16U) return noise;
  noise.convertTo(image, CV_8U, 1.0 / 257);
  return image;
}

cv::Mat red_first(const cv::Mat& image) {
  if (image.channels() != 3) return image;
  cv::Mat turned;
  cv::cvtColor(image, turned, cv::COLOR_BGR2RGB);
  return turned;
}

PngHeader header_of(const Bytes& png) { return parse_png_header(png.data(), png.size(), "test"); }

class PngPixels : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  cv::Mat image = sample_image(std::get<0>(GetParam()), {std::get<1>(GetParam()), 19});
};

TEST_P(PngPixels, come_back_as_they_were_whatever_the_filter_and_the_width) {
  Bytes png;
  cv::imencode(".png", red_first(image), png);
  EXPECT_TRUE(test::same_pixels(png_pixels(png, header_of(png)), image));
}

TEST_P(PngPixels, are_encoded_so_that_another_decoder_reads_them) {
  const Bytes png = png_bytes(image);
  ASSERT_FALSE(png.empty());
  EXPECT_TRUE(test::same_pixels(red_first(cv::imdecode(png, cv::IMREAD_UNCHANGED)), image));
  EXPECT_TRUE(test::same_pixels(png_pixels(png, header_of(png)), image));
}

TEST_P(PngPixels, of_a_part_of_a_larger_image_are_encoded_alone) {
  const cv::Mat part = image(cv::Rect(1, 2, image.cols - 1, 11));
  const Bytes png = png_bytes(part);
  EXPECT_TRUE(test::same_pixels(png_pixels(png, header_of(png)), part.clone()));
}

INSTANTIATE_TEST_SUITE_P(EveryKind, PngPixels,
                         testing::Combine(testing::Values(CV_8UC1, CV_16UC1, CV_8UC3, CV_16UC3),
                                          testing::Values(2, 3, 31, 64)));

TEST(PngRgba, reads_grey_and_colour_of_8_and_16_bits) {
  for (const int type : {CV_8UC1, CV_16UC1, CV_8UC3, CV_16UC3}) {
    const cv::Mat image = sample_image(type, {9, 5});
    const Bytes png = png_bytes(image);
    cv::Mat expected, rgba = png_rgba(png, header_of(png));
    cv::cvtColor(image, expected, image.channels() == 1 ? cv::COLOR_GRAY2RGBA : cv::COLOR_RGB2RGBA);
    EXPECT_TRUE(test::same_pixels(rgba, expected)) << type;
  }
}

TEST(PngPixels, of_an_image_that_has_none_are_refused) {
  EXPECT_TRUE(png_bytes(cv::Mat()).empty());
  EXPECT_TRUE(png_bytes(cv::Mat1f(3, 3, 0.0f)).empty());
}

}  // namespace
}  // namespace rakelight
