// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/image_agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rakelight {
namespace {

constexpr int kSize = 48, kLag = 6;

/// Normals of waves `wave` pixels long and `tilt` steep on a bowl, which fixes the light.
Eigen::Matrix3Xf wavy(const PixelGrid& grid, float tilt, float wave) {
  Eigen::Matrix3Xf normals(3, grid.size());
  for (int p = 0; p < grid.size(); ++p) {
    const cv::Point at = grid.pixels[static_cast<size_t>(p)];
    const float x = static_cast<float>(at.x - kSize / 2) / kSize,
                y = static_cast<float>(at.y - kSize / 2) / kSize;
    normals.col(p) =
        Eigen::Vector3f(x + tilt * std::sin(static_cast<float>(at.x) * 6.2832f / wave), y, -1).normalized();
  }
  return normals;
}

Eigen::Matrix3Xf noisy(Eigen::Matrix3Xf normals, float deviation) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal(0, deviation);
  for (Eigen::Index p = 0; p < normals.cols(); ++p)
    normals.col(p) = (normals.col(p) + Eigen::Vector3f(normal(random), normal(random), 0)).normalized();
  return normals;
}

/// The surface under one light, painted in stripes.
Observations image_of(const Eigen::Matrix3Xf& normals, const PixelGrid& grid, float paint,
                      unsigned char usable = 1) {
  const auto pixels = static_cast<size_t>(grid.size());
  const std::vector<unsigned char> all(pixels, usable);
  std::vector<float> radiance(pixels);
  for (size_t p = 0; p < pixels; ++p) {
    const float rho = grid.pixels[p].y % 24 < 12 ? 1.0f : paint;
    const Eigen::Vector3f n = normals.col(static_cast<Eigen::Index>(p));
    radiance[p] = rho * (n.dot(Eigen::Vector3f(0.4f, -0.2f, -0.6f)) + 0.1f);
  }
  Observations image(grid.size(), 1);
  for (int c = 0; c < 3; ++c) image.set_channel(0, c, radiance.data(), all.data());
  return image;
}

class ImageAgreementWithPaint : public testing::TestWithParam<float> {};
INSTANTIATE_TEST_SUITE_P(, ImageAgreementWithPaint, testing::Values(1.0f, 0.4f));

TEST_P(ImageAgreementWithPaint, IsBestForTheTrueSurfaceAgainstNoiseAndAgainstLostRelief) {
  const PixelGrid grid =
      make_pixel_grid({kSize, kSize, 50, 50, 24, 24, {}}, cv::Mat1b(kSize, kSize, uchar{255}));
  const Eigen::Matrix3Xf truth = wavy(grid, 0.3f, 13), broad = wavy(grid, 0, 13);
  const Observations image = image_of(truth, grid, GetParam());
  const ImageAgreement agreement(grid, image, broad, kLag);
  const double best = agreement.disagreement(truth);
  EXPECT_GT(agreement.disagreement(broad), 1.05 * best);
  EXPECT_GT(agreement.disagreement(noisy(truth, 0.2f)), 1.05 * best);
  EXPECT_GT(agreement.disagreement(noisy(truth, 0.4f)), agreement.disagreement(noisy(truth, 0.2f)));
}

TEST(ImageAgreement, SaysNothingWithoutUsablePixels) {
  const PixelGrid grid =
      make_pixel_grid({kSize, kSize, 50, 50, 24, 24, {}}, cv::Mat1b(kSize, kSize, uchar{255}));
  const Eigen::Matrix3Xf normals = wavy(grid, 0.3f, 13);
  const Observations image = image_of(normals, grid, 1, 0);
  EXPECT_EQ(ImageAgreement(grid, image, normals, kLag).disagreement(normals), 0);
}

}  // namespace
}  // namespace rakelight
