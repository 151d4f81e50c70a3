// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/image_file.h"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>

#include "stack/errors.h"
#include "stack/stack_io.h"
#include "tests/support/file_edits.h"
#include "tests/support/message_of.h"
#include "tests/support/small_stack.h"
#include "tests/support/temporary_folder.h"

namespace rakelight {
namespace {

using test::message_of;
using testing::AllOf;
using testing::HasSubstr;

class ImageFile : public testing::Test {
 protected:
  std::string refusal() const {
    return message_of<InputError>([&] { read_color_png(file); });
  }

  test::TemporaryFolder folder;
  std::filesystem::path file = folder / "image.png";
  cv::Mat image = test::small_stack().frames[0].color;
};

TEST_F(ImageFile, colour_comes_back_as_red_green_blue) {
  write_png(file, cv::Mat(2, 2, CV_8UC3, cv::Scalar(10, 20, 30)));
  EXPECT_EQ(cv::imread(file.string()).at<cv::Vec3b>(0, 0), cv::Vec3b(30, 20, 10))
      << "OpenCV reads blue first";
  EXPECT_EQ(read_color_png(file).at<cv::Vec3b>(0, 0), cv::Vec3b(10, 20, 30));
}

TEST_F(ImageFile, an_image_cut_at_any_byte_is_refused) {
  write_png(file, image);
  const std::string whole = test::text_of(file);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    test::set_text(file, whole.substr(0, size));
    ASSERT_THAT(refusal(), HasSubstr(file.string())) << "cut at " << size;
  }
}

TEST_F(ImageFile, a_flipped_bit_anywhere_is_refused) {
  write_png(file, image);
  const std::string whole = test::text_of(file);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (at % 8)));
    test::set_text(file, flipped);
    ASSERT_THAT(refusal(), HasSubstr(file.string())) << "flipped at " << at;
  }
}

TEST_F(ImageFile, data_after_the_end_is_refused) {
  write_png(file, image);
  test::set_text(file, test::text_of(file) + "x");
  EXPECT_THAT(refusal(), HasSubstr("after the end"));
}

TEST_F(ImageFile, an_image_whose_pixels_are_missing_is_refused) {
  test::write_png_bomb(file, 100, 100);  // whole chunks, but no pixels in them
  EXPECT_THAT(refusal(), HasSubstr("cannot be decoded"));
}

TEST_F(ImageFile, another_format_under_the_name_png_is_refused) {
  cv::imwrite((folder / "image.jpg").string(), cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(9)));
  std::filesystem::rename(folder / "image.jpg", file);
  EXPECT_THAT(refusal(), HasSubstr("not a PNG"));
}

TEST_F(ImageFile, sizes_beyond_the_bounds_are_refused) {
  for (const auto& [width, height] : {std::pair{0, 5}, {16385, 1}, {1, 16385}, {16384, 4097}}) {
    test::write_png_bomb(file, std::uint32_t(width), std::uint32_t(height));
    EXPECT_THAT(refusal(), testing::AnyOf(HasSubstr("too large"), HasSubstr("no pixels")))
        << width << "x" << height;
  }
}

TEST_F(ImageFile, a_file_much_larger_than_its_pixels_is_refused) {
  write_png(file, image);
  std::filesystem::resize_file(file, 1 << 30);
  EXPECT_THAT(refusal(), HasSubstr("larger than its content"));
}

TEST_F(ImageFile, a_mask_may_be_grey_or_colour_and_becomes_0_or_255) {
  cv::Mat1b grey(1, 4);
  grey << 0, 127, 128, 255;
  const cv::Mat1b expected = (cv::Mat1b(1, 4) << 0, 0, 255, 255);
  cv::Mat rgb;
  cv::merge(std::vector<cv::Mat>(3, grey), rgb);
  for (const cv::Mat& stored : {cv::Mat(grey), rgb}) {
    cv::imwrite(file.string(), stored);
    EXPECT_TRUE(test::same_pixels(read_mask(file), expected));
  }
  cv::imwrite(file.string(), cv::Mat1w(2, 2, std::uint16_t{65535}));
  EXPECT_THAT(message_of<InputError>([&] { read_mask(file); }), HasSubstr("16 bits"));
  EXPECT_THAT(message_of<InputError>([&] { read_mask(folder / "none.png"); }),
              AllOf(HasSubstr("none.png"), HasSubstr("missing")));
}

}  // namespace
}  // namespace rakelight
