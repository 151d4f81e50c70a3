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
    const float x = static_cast<float>(at.x - kSize / 2) / kSize, y = static_cast<float>(at.y - kSize / 2) / kSize;
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
Observations image_of(const Eigen::Matrix3Xf& normals, const PixelGrid& grid, float paint) {
  Observations image;
  image.pixels = grid.size();
  image.images = 1;
  image.usable.assign(static_cast<size_t>(3 * grid.size()), 1);
  for (int c = 0; c < 3; ++c) {
    for (int p = 0; p < grid.size(); ++p) {
      const float rho = grid.pixels[static_cast<size_t>(p)].y % 24 < 12 ? 1.0f : paint;
      image.radiance.push_back(rho * (normals.col(p).dot(Eigen::Vector3f(0.4f, -0.2f, -0.6f)) + 0.1f));
    }
  }
  return image;
}

class ImageAgreementWithPaint : public testing::TestWithParam<float> {};
INSTANTIATE_TEST_SUITE_P(, ImageAgreementWithPaint, testing::Values(1.0f, 0.4f));

TEST_P(ImageAgreementWithPaint, IsBestForTheTrueSurfaceAgainstNoiseAndAgainstLostRelief) {
  const PixelGrid grid = make_pixel_grid({kSize, kSize, 50, 50, 24, 24, {}}, cv::Mat1b(kSize, kSize, uchar{255}));
  const Eigen::Matrix3Xf truth = wavy(grid, 0.3f, 13), broad = wavy(grid, 0, 13);
  const Observations image = image_of(truth, grid, GetParam());
  const ImageAgreement agreement(grid, image, broad, kLag);
  const double best = agreement.disagreement(truth);
  EXPECT_GT(agreement.disagreement(broad), 1.05 * best);
  EXPECT_GT(agreement.disagreement(noisy(truth, 0.2f)), 1.05 * best);
  EXPECT_GT(agreement.disagreement(noisy(truth, 0.4f)), agreement.disagreement(noisy(truth, 0.2f)));
}

TEST(ImageAgreement, SaysNothingWithoutUsablePixels) {
  const PixelGrid grid = make_pixel_grid({kSize, kSize, 50, 50, 24, 24, {}}, cv::Mat1b(kSize, kSize, uchar{255}));
  const Eigen::Matrix3Xf normals = wavy(grid, 0.3f, 13);
  Observations image = image_of(normals, grid, 1);
  std::fill(image.usable.begin(), image.usable.end(), static_cast<unsigned char>(0));
  EXPECT_EQ(ImageAgreement(grid, image, normals, kLag).disagreement(normals), 0);
}

}  // namespace
}  // namespace rakelight
