// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/stack_io.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "stack/errors.h"
#include "tests/support/file_edits.h"
#include "tests/support/message_of.h"
#include "tests/support/small_stack.h"
#include "tests/support/temporary_folder.h"

namespace rakelight {
namespace {

namespace fs = std::filesystem;
using test::expect_same;
using test::message_of;
using test::small_stack;
using testing::AllOf;
using testing::HasSubstr;

class StackIo : public testing::Test {
 protected:
  void SetUp() override { write_stack(small_stack(), stack); }

  std::string refusal() const {
    return message_of<InputError>([&] { read_stack(stack); });
  }
  void replace_in_manifest(const std::string& from, const std::string& to) const {
    test::replace_in_file(stack / "stack.json", from, to);
  }
  void claim_large_colour() const {
    replace_in_manifest("\"width\": 24,\n    \"height\": 16", "\"width\": 16384,\n    \"height\": 4096");
  }

  test::TemporaryFolder folder;
  fs::path stack = folder / "stack";
};

TEST_F(StackIo, a_stack_comes_back_the_same_in_every_field_and_pixel) {
  for (const int bits : {8, 16}) {
    const LightStack written = small_stack(bits);
    write_stack(written, stack);
    const LightStack read = read_stack(stack);
    expect_same(written, read);
    EXPECT_EQ(read.origin, stack.string());
  }
}

TEST_F(StackIo, writing_does_not_change_the_callers_pixels) {
  const LightStack written = small_stack();
  write_stack(written, stack);
  expect_same(written, small_stack());
}

TEST_F(StackIo, unknown_keys_come_back_wherever_they_stood) {
  LightStack written = small_stack();
  written.unknown_keys = R"({"frames":{"2":{"note":[1,2]}},"lights":{"red":{"watts":3}},"rig":{"name":"x"},)"
                         R"("sensor":{"firmware":"1.2"}})";
  write_stack(written, stack);
  expect_same(written, read_stack(stack));
  replace_in_manifest("\"version\": 1,", "\"version\": 1, \"later\": [{\"a\": null}],");
  write_stack(read_stack(stack), stack);
  EXPECT_THAT(test::text_of(stack / "stack.json"),
              AllOf(HasSubstr("firmware"), HasSubstr("watts"), HasSubstr("later")));
}

TEST_F(StackIo, unknown_keys_may_not_smuggle_in_known_ones) {
  LightStack written = small_stack();
  written.unknown_keys = R"({"frames":{"2":{"lit_check":1}}, "depth_unit_m": 7})";
  EXPECT_THAT(message_of<InputError>([&] { write_stack(written, stack); }), HasSubstr("lit_check"));
  written.unknown_keys = R"({"depth_unit_m": 7})";
  write_stack(written, stack);
  EXPECT_EQ(read_stack(stack).depth_unit_m, small_stack().depth_unit_m);
}

TEST_F(StackIo, the_truth_goes_beside_the_stack) {
  write_stack(small_stack(), stack, test::small_truth());
  EXPECT_TRUE(test::same_pixels(read_truth(stack).albedo, test::small_truth().albedo));
}

TEST_F(StackIo, colours_left_on_the_disk_are_the_same_when_they_are_asked_for) {
  LightStack written = small_stack();
  written.frames[2].color = cv::Mat();
  write_stack(written, stack);
  const LightStack left = read_stack(stack, Colors::on_disk);
  for (const Frame& frame : left.frames) EXPECT_TRUE(frame.color.empty());
  EXPECT_FALSE(has_color(left.frames[2]));
  EXPECT_TRUE(has_color(left.frames[1]));
  EXPECT_TRUE(test::same_pixels(with_color(left.frames[1]).color, written.frames[1].color));
  expect_same(written, in_memory(left));
  write_stack(left, folder / "copy");
  expect_same(written, read_stack(folder / "copy"));
}

TEST_F(StackIo, colours_left_on_the_disk_are_never_those_of_a_scan_written_since) {
  write_stack(small_stack(16, 0), stack);
  const LightStack left = read_stack(stack, Colors::on_disk);
  write_stack(small_stack(16, 1), stack);
  EXPECT_THAT(message_of<BusyError>([&] { in_memory(left); }), HasSubstr("replaced"));
}

TEST_F(StackIo, a_stack_without_mask_and_without_some_images_comes_back) {
  LightStack written = small_stack();
  written.mask = cv::Mat1b();
  written.frames[0].color = cv::Mat();
  for (Frame& frame : written.frames) frame.lit_check.reset();
  written.exposure_us.reset();
  written.gain.reset();
  written.white_balance.reset();
  write_stack(written, stack);
  expect_same(written, read_stack(stack));
}

TEST_F(StackIo, refuses_to_write_what_it_could_not_read) {
  const auto refused = [&](const auto& spoil) {
    LightStack spoilt = small_stack(16, 1);
    spoil(spoilt);
    const std::string message = message_of<InputError>([&] { write_stack(spoilt, stack); });
    expect_same(small_stack(), read_stack(stack));
    return message;
  };
  EXPECT_THAT(refused([](LightStack& s) { s.depth_unit_m = std::nan(""); }), HasSubstr("depth_unit_m"));
  EXPECT_THAT(refused([](LightStack& s) { s.color_camera.fx = -1; }), HasSubstr("fx"));
  EXPECT_THAT(refused([](LightStack& s) { s.lights[0].id = s.lights[1].id; }), HasSubstr("taken"));
  EXPECT_THAT(refused([](LightStack& s) { s.frames[0].light = "nobody"; }), HasSubstr("nobody"));
  EXPECT_THAT(refused([](LightStack& s) { s.frames[0].color = cv::Mat3f(16, 24); }), HasSubstr("RGB"));
  EXPECT_THAT(refused([](LightStack& s) { s.frames[1].depth = cv::Mat1w(3, 3); }), HasSubstr("depth"));
  EXPECT_THAT(refused([](LightStack& s) { s.mask = cv::Mat1b(3, 3); }), HasSubstr("mask"));
  EXPECT_THAT(refused([](LightStack& s) { s.unknown_keys = "{"; }), HasSubstr("unknown keys"));
}

TEST_F(StackIo, a_folder_without_a_manifest_is_an_unfinished_scan) {
  fs::remove(stack / "stack.json");
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr(stack.string()), HasSubstr("no stack.json"), HasSubstr("record it again")));
  EXPECT_THAT(message_of<InputError>([&] { read_stack(folder / "none"); }), HasSubstr("does not exist"));
}

TEST_F(StackIo, names_the_image_that_is_missing) {
  fs::remove(stack / "depth" / "0001.png");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("depth/0001.png"), HasSubstr("missing")));
}

TEST_F(StackIo, refuses_images_of_another_size_or_kind) {
  const std::string color = (stack / "color" / "0002.png").string(),
                    depth = (stack / "depth" / "0001.png").string();
  cv::imwrite(color, cv::Mat(15, 24, CV_8UC3, cv::Scalar::all(9)));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("color/0002.png"), HasSubstr("24 x 15"), HasSubstr("24 x 16")));
  cv::imwrite(color, cv::Mat(16, 24, CV_8UC1, cv::Scalar::all(9)));
  EXPECT_THAT(refusal(), HasSubstr("not an RGB image"));
  cv::imwrite(color, cv::Mat(16, 24, CV_8UC4, cv::Scalar::all(9)));
  EXPECT_THAT(refusal(), HasSubstr("not an RGB image"));
  cv::imwrite(color, cv::Mat(16, 24, CV_8UC3, cv::Scalar::all(9)));
  cv::imwrite(depth, cv::Mat(8, 12, CV_8UC1, cv::Scalar::all(9)));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("depth/0001.png"), HasSubstr("16-bit grey")));
  cv::imwrite(depth, cv::Mat(8, 12, CV_16UC1, cv::Scalar::all(9)));
  cv::imwrite((stack / "mask.png").string(), cv::Mat1b(5, 5, std::uint8_t{255}));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("mask.png"), HasSubstr("5 x 5")));
}

TEST_F(StackIo, a_path_may_not_leave_the_folder) {
  fs::copy_file(stack / "color" / "0000.png", folder / "outside.png");
  const auto with_path = [&](const std::string& path) {
    write_stack(small_stack(), stack);
    replace_in_manifest("color/0000.png", path);
    return refusal();
  };
  EXPECT_THAT(with_path("../outside.png"), HasSubstr("leaves the folder"));
  EXPECT_THAT(with_path("color/../../outside.png"), HasSubstr("leaves the folder"));
  EXPECT_THAT(with_path((folder / "outside.png").string()), HasSubstr("leaves the folder"));
  EXPECT_THAT(with_path("color/\\u0000.png"), HasSubstr("control character"));
  EXPECT_THAT(with_path("color"), HasSubstr("not a regular file"));
}

TEST_F(StackIo, a_link_may_not_lead_out_of_the_folder) {
  fs::copy_file(stack / "color" / "0000.png", folder / "outside.png");
  const fs::path image = stack / "color" / "0000.png";
  fs::remove(image);
  fs::create_symlink("../../outside.png", image);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("color/0000.png"), HasSubstr("leads out of the folder")));
  fs::remove_all(stack / "color");
  fs::create_directory_symlink(folder.path(), stack / "color");
  EXPECT_THAT(refusal(), HasSubstr("leads out of the folder"));
}

TEST_F(StackIo, a_link_within_the_folder_is_followed) {
  const fs::path image = stack / "color" / "0000.png";
  fs::rename(image, stack / "color" / "first.png");
  fs::create_symlink("first.png", image);
  expect_same(small_stack(), read_stack(stack));
}

TEST_F(StackIo, a_manifest_or_mask_that_is_a_link_out_is_refused) {
  fs::rename(stack / "mask.png", folder / "mask.png");
  fs::create_symlink(folder / "mask.png", stack / "mask.png");
  EXPECT_THAT(refusal(), HasSubstr("leads out of the folder"));
  fs::rename(stack / "stack.json", folder / "stack.json");
  fs::create_symlink(folder / "stack.json", stack / "stack.json");
  EXPECT_THAT(refusal(), HasSubstr("leads out of the folder"));
}

TEST_F(StackIo, a_pipe_in_place_of_an_image_does_not_hang) {
  const fs::path image = stack / "color" / "0000.png";
  fs::remove(image);
  ASSERT_EQ(::mkfifo(image.c_str(), 0600), 0);
  EXPECT_THAT(refusal(), HasSubstr("not a regular file"));
}

TEST_F(StackIo, a_manifest_cut_at_any_byte_is_refused) {
  const std::string whole = test::text_of(stack / "stack.json");
  for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
    test::set_text(stack / "stack.json", whole.substr(0, size));
    ASSERT_THAT(refusal(), HasSubstr("stack.json")) << "cut at " << size;
  }
}

TEST_F(StackIo, a_flipped_byte_in_the_manifest_is_refused_or_harmless) {
  const std::string whole = test::text_of(stack / "stack.json");
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (at % 8)));
    test::set_text(stack / "stack.json", flipped);
    try {
      read_stack(stack);  // a digit may have become another digit
    } catch (const InputError&) {}
  }
}

TEST_F(StackIo, a_manifest_far_too_large_is_refused_before_it_is_read) {
  fs::resize_file(stack / "stack.json", std::uintmax_t{1} << 33);
  EXPECT_THAT(refusal(), HasSubstr("larger than"));
}

TEST_F(StackIo, a_manifest_that_lists_more_pixels_than_memory_holds_is_refused) {
  claim_large_colour();
  std::string frames;
  for (int i = 0; i < 20; ++i) {
    frames += R"({"index": )" + std::to_string(100 + i) + R"(, "color": "c)" + std::to_string(i) + "\"},";
  }
  replace_in_manifest("\"frames\": [", "\"frames\": [" + frames);
  EXPECT_THAT(refusal(), HasSubstr("more pixels than can be held"));
}

TEST_F(StackIo, a_header_bomb_is_refused_before_memory_is_taken) {
  test::write_png_bomb(stack / "color" / "0000.png", 20000, 20000);
  claim_large_colour();
  const auto peak_kb = [] {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const pid_t child = ::fork();
  if (child == 0) {
    const long before = peak_kb();
    int code = 1;
    try {
      read_stack(stack);
    } catch (const InputError&) { code = 0; }
    ::_exit(peak_kb() - before < 50 * 1024 ? code : 2);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0) << "1: not refused, 2: more than 50 MB taken";
  EXPECT_THAT(refusal(), AllOf(HasSubstr("too large"), HasSubstr("20000 x 20000")));
}

}  // namespace
}  // namespace rakelight
