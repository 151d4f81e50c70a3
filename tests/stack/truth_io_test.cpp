// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/truth_io.h"

#include <gmock/gmock.h>

#include <cmath>

#include "stack/errors.h"
#include "stack/float_tiff.h"
#include "tests/support/file_edits.h"
#include "tests/support/message_of.h"
#include "tests/support/small_stack.h"
#include "tests/support/temporary_folder.h"

namespace rakelight {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::small_truth;
using testing::HasSubstr;

/// Same numbers, and NaN at the same places.
bool same_floats(const cv::Mat& a, const cv::Mat& b) {
  if (a.type() != b.type() || a.size() != b.size()) return false;
  const auto channels = [](const cv::Mat& image) { return image.reshape(1); };
  for (int y = 0; y < a.rows; ++y) {
    for (int x = 0; x < a.cols * a.channels(); ++x) {
      const float p = channels(a).at<float>(y, x), q = channels(b).at<float>(y, x);
      if (p != q && !(std::isnan(p) && std::isnan(q))) return false;
    }
  }
  return true;
}

class TruthIo : public testing::Test {
 protected:
  void write(const GroundTruth& truth) const {
    fs::remove_all(home.path() / "truth");
    fs::create_directory(home.path() / "truth");
    write_truth(truth, home.path() / "truth");
  }
  std::string refusal() const {
    return message_of<InputError>([&] { read_truth(home.path()); });
  }

  test::TemporaryFolder home;
};

TEST_F(TruthIo, comes_back_the_same_with_its_lamps) {
  const GroundTruth truth = small_truth();
  write(truth);
  for (const fs::path& place : {home.path(), home / "truth"}) {
    const GroundTruth read = read_truth(place);
    EXPECT_TRUE(same_floats(read.depth, truth.depth));
    EXPECT_TRUE(same_floats(read.normals, truth.normals));
    EXPECT_TRUE(same_floats(read.albedo, truth.albedo));
    ASSERT_EQ(read.lamps.size(), truth.lamps.size());
    for (std::size_t i = 0; i < read.lamps.size(); ++i) {
      EXPECT_EQ(read.lamps[i].id, truth.lamps[i].id);
      EXPECT_EQ(read.lamps[i].color, truth.lamps[i].color);
      EXPECT_EQ(read.lamps[i].near, truth.lamps[i].near);
      EXPECT_EQ(read.lamps[i].position_m, truth.lamps[i].position_m);
      EXPECT_EQ(read.lamps[i].direction, truth.lamps[i].direction);
      EXPECT_EQ(read.lamps[i].strength, truth.lamps[i].strength);
    }
  }
}

TEST_F(TruthIo, albedo_and_lamps_may_be_missing) {
  GroundTruth truth = small_truth();
  truth.albedo = cv::Mat3f();
  truth.lamps.clear();
  write(truth);
  EXPECT_TRUE(read_truth(home.path()).albedo.empty());
}

TEST_F(TruthIo, what_is_missing_or_wrong_is_named) {
  EXPECT_THAT(refusal(), HasSubstr("depth.tiff"));
  GroundTruth truth = small_truth();
  write(truth);
  fs::remove(home / "truth/normals.tiff");
  EXPECT_THAT(refusal(), HasSubstr("normals.tiff"));
  truth.depth(1, 1) = -1;
  write(truth);
  EXPECT_THAT(refusal(), HasSubstr("no positive number"));
  truth.depth(1, 1) = std::numeric_limits<float>::infinity();
  write(truth);
  EXPECT_THAT(refusal(), HasSubstr("no positive number"));
  truth = small_truth();
  truth.normals(2, 2) = {0, 0, -2};
  write(truth);
  EXPECT_THAT(refusal(), HasSubstr("unit length"));
  truth = small_truth();
  truth.depth.setTo(std::nanf(""));
  write(truth);
  EXPECT_THAT(refusal(), HasSubstr("holds no depth"));
  write(small_truth());
  fs::remove(home / "truth/albedo.tiff");
  write_tiff(home / "truth/albedo.tiff", cv::Mat3f(3, 3, cv::Vec3f(1, 1, 1)));
  EXPECT_THAT(refusal(), HasSubstr("albedo.tiff"));
  fs::remove(home / "truth/albedo.tiff");
  write_tiff(home / "truth/albedo.tiff", cv::Mat1f(16, 24, 1.0f));
  EXPECT_THAT(refusal(), HasSubstr("three floats"));
}

TEST_F(TruthIo, a_tiff_cut_at_any_byte_is_refused) {
  write(small_truth());
  const fs::path file = home / "truth/depth.tiff";
  const std::string whole = test::text_of(file);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    test::set_text(file, whole.substr(0, size));
    ASSERT_THAT(refusal(), HasSubstr("depth.tiff")) << "cut at " << size << " of " << whole.size();
  }
}

TEST_F(TruthIo, a_flipped_byte_in_a_tiff_is_refused_or_harmless) {
  write(small_truth());
  const fs::path file = home / "truth/depth.tiff";
  const std::string whole = test::text_of(file);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int bit : {0, 4, 7}) {
      std::string flipped = whole;
      flipped[at] = static_cast<char>(flipped[at] ^ (1 << bit));
      test::set_text(file, flipped);
      try {
        EXPECT_EQ(read_truth(home.path()).depth.size(), cv::Size(24, 16));
      } catch (const InputError&) {}
    }
  }
}

}  // namespace
}  // namespace rakelight
