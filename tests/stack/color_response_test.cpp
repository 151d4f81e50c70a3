// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/color_response.h"

#include <gmock/gmock.h>

#include "stack/errors.h"
#include "tests/support/message_of.h"

namespace rakelight {
namespace {

using test::message_of;
using testing::HasSubstr;

TEST(ColorResponse, is_read_from_words_and_written_back_the_same) {
  for (const char* text : {"linear", "srgb", "2.2", "0.45454545454545453"}) {
    EXPECT_EQ(to_string(parse_color_response(text)), text);
  }
  EXPECT_EQ(to_string(parse_color_response("1.0")), "1");
}

TEST(ColorResponse, refuses_words_it_does_not_know) {
  for (const char* text : {"", "sRGB", "0", "-1", "nan", "inf", "2.2x", " 2", "1e999"}) {
    EXPECT_THAT(message_of<UsageError>([&] { parse_color_response(text); }), HasSubstr("linear, srgb"))
        << text;
  }
}

TEST(ColorResponse, srgb_matches_published_values) {
  const ColorResponse srgb{ColorResponse::Kind::srgb, 1};
  EXPECT_NEAR(decode(srgb, 0.5), 0.21404114, 1e-7);
  EXPECT_NEAR(decode(srgb, 0.04), 0.0030959752, 1e-9);
  EXPECT_DOUBLE_EQ(decode(srgb, 1), 1);
}

TEST(ColorResponse, decoding_undoes_encoding) {
  for (const char* text : {"linear", "srgb", "2.2", "0.5"}) {
    const ColorResponse response = parse_color_response(text);
    for (int i = 0; i <= 100; ++i)
      EXPECT_NEAR(decode(response, encode(response, i / 100.0)), i / 100.0, 1e-7) << text;
  }
}

/// A stack of one colour image.
LightStack of_image(const cv::Mat& color, const char* response) {
  LightStack stack;
  stack.color_response = parse_color_response(response);
  stack.frames.emplace_back();
  stack.frames[0].color = color;
  return stack;
}

TEST(LinearColor, decodes_8_and_16_bit_values) {
  const LightStack eight = of_image(cv::Mat(1, 1, CV_8UC3, cv::Scalar(0, 128, 255)), "srgb");
  const cv::Vec3f a = linear_color(eight, eight.frames[0])(0, 0);
  EXPECT_FLOAT_EQ(a[0], 0);
  EXPECT_NEAR(a[1], 0.2158605, 1e-6);
  EXPECT_FLOAT_EQ(a[2], 1);
  const LightStack sixteen = of_image(cv::Mat(1, 1, CV_16UC3, cv::Scalar(0, 32896, 65535)), "2");
  const cv::Vec3f b = linear_color(sixteen, sixteen.frames[0])(0, 0);
  EXPECT_NEAR(b[1], 0.2519646, 1e-6);
  EXPECT_FLOAT_EQ(b[2], 1);
}

TEST(LinearColor, undoes_crosstalk_after_linearising) {
  const Eigen::Vector3d lamps(0.2, 0.5, 0.3);
  Eigen::Matrix3d crosstalk;
  crosstalk << 0.9, 0.2, 0, 0.1, 0.7, 0.1, 0, 0.1, 0.8;
  const Eigen::Vector3d seen = crosstalk * lamps;
  cv::Mat color(1, 1, CV_16UC3);
  for (int c = 0; c < 3; ++c)
    color.at<cv::Vec3w>(0, 0)[c] = static_cast<std::uint16_t>(std::sqrt(seen[c]) * 65535);
  LightStack stack = of_image(color, "2");
  stack.color_crosstalk = crosstalk;
  const cv::Vec3f found = linear_color(stack, stack.frames[0])(0, 0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], lamps[c], 1e-4);
}

TEST(LinearColor, of_a_frame_without_colour_is_empty) {
  EXPECT_TRUE(linear_color(LightStack(), Frame()).empty());
  EXPECT_TRUE(saturated(Frame()).empty());
}

TEST(Saturated, marks_pixels_with_any_channel_at_the_top) {
  Frame frame;
  frame.color = cv::Mat(1, 2, CV_8UC3, cv::Scalar(253, 253, 253));
  frame.color.at<cv::Vec3b>(0, 1) = {0, 0, 254};
  EXPECT_EQ(saturated(frame)(0, 0), 0);
  EXPECT_EQ(saturated(frame)(0, 1), 255);
  frame.color = cv::Mat(1, 2, CV_16UC3, cv::Scalar(65278, 65278, 65278));
  frame.color.at<cv::Vec3w>(0, 0) = {65279, 0, 0};
  EXPECT_EQ(saturated(frame)(0, 0), 255);
  EXPECT_EQ(saturated(frame)(0, 1), 0);
}

}  // namespace
}  // namespace rakelight
