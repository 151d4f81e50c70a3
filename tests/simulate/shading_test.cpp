// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/shading.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulate/objects/objects.h"
#include "tests/simulate/small_rig.h"

namespace rakelight {
namespace {

using test::ideal_rig;

LampTruth far_lamp(const Eigen::Vector3d& direction) {
  LampTruth lamp;
  lamp.direction = direction.normalized();
  lamp.strength = {1, 1, 1};
  return lamp;
}

SceneMesh shifted(SceneMesh mesh, const Eigen::Vector3f& by, float scale) {
  for (auto& v : mesh.vertices) v = scale * v + by;
  return mesh;
}

/// A wall at z = 1 and, before it at z = 0.8, a small square.
SceneMesh wall_and_screen() {
  SceneMesh mesh = shifted(make_plane(), {0, 0, 1}, 1.0f);
  const SceneMesh screen = shifted(make_plane(), {0, 0, 0.8f}, 0.05f);
  const auto offset = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), screen.vertices.begin(), screen.vertices.end());
  mesh.normals.insert(mesh.normals.end(), screen.normals.begin(), screen.normals.end());
  mesh.texture.insert(mesh.texture.end(), screen.texture.begin(), screen.texture.end());
  for (const auto& t : screen.triangles)
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return mesh;
}

/// A white sample where the camera's ray through (x, y, 1) meets the scene.
SurfaceSample look_at(const RayTracer& tracer, float x, float y) {
  const Eigen::Vector3f ray(x, y, 1);
  return {tracer.trace(Eigen::Vector3f::Zero(), ray).value(), {1, 1, 1}, -ray.normalized()};
}

float shade(const SimulateOptions& options, const RayTracer& tracer, const SurfaceSample& sample,
            const LampTruth& lamp) {
  return total_radiance({options, tracer, {0, 0, 1}}, {sample}, {lamp}).x();
}

TEST(Shading, AMattWallFollowsLambertsCosine) {
  const RayTracer tracer(shifted(make_plane(), {0, 0, 1}, 1.0f));
  SimulateOptions options = ideal_rig(SceneKind::plane);
  options.image.attached_shadows = true;
  for (const double angle : {0.0, 0.5, 1.2}) {
    const LampTruth lamp = far_lamp({std::sin(angle), 0, -std::cos(angle)});
    EXPECT_NEAR(shade(options, tracer, look_at(tracer, 0.1f, 0.2f), lamp), std::cos(angle), 1e-5);
  }
}

TEST(Shading, ALampBehindTheWallLightsItOnlyUnderHarmonics) {
  const RayTracer tracer(shifted(make_plane(), {0, 0, 1}, 1.0f));
  SimulateOptions options = ideal_rig(SceneKind::plane);
  const LampTruth behind = far_lamp({std::sqrt(0.99), 0, 0.1});
  EXPECT_NEAR(shade(options, tracer, look_at(tracer, 0, 0), behind), 0.25 - 0.75 * 0.1, 1e-4);
  options.image.attached_shadows = true;
  EXPECT_EQ(shade(options, tracer, look_at(tracer, 0, 0), behind), 0);
}

TEST(Shading, AScreenCastsItsShadowWhereTheLampSaysSo) {
  const RayTracer tracer(wall_and_screen());
  SimulateOptions options = ideal_rig(SceneKind::plane);
  options.image.attached_shadows = options.image.cast_shadows = true;
  const LampTruth lamp = far_lamp({1, 0, -1});  // from the right: the shadow falls 0.2 m to the left
  const float lit = shade(options, tracer, look_at(tracer, 0.2f, 0), lamp);
  EXPECT_NEAR(lit, std::sqrt(0.5), 1e-4);
  EXPECT_EQ(shade(options, tracer, look_at(tracer, -0.2f, 0), lamp), 0);
  EXPECT_EQ(shade(options, tracer, look_at(tracer, -0.24f, 0.04f), lamp), 0);
  EXPECT_NEAR(shade(options, tracer, look_at(tracer, -0.26f, 0), lamp), lit, 1e-5);
  EXPECT_NEAR(shade(options, tracer, look_at(tracer, -0.2f, 0.06f), lamp), lit, 1e-5);
  options.image.cast_shadows = false;
  EXPECT_NEAR(shade(options, tracer, look_at(tracer, -0.2f, 0), lamp), lit, 1e-5);
}

TEST(Shading, ANearLampBeforeTheScreenIsNotBlockedByIt) {
  const RayTracer tracer(wall_and_screen());
  SimulateOptions options = ideal_rig(SceneKind::plane);
  options.image.attached_shadows = options.image.cast_shadows = true;
  LampTruth lamp = far_lamp({1, 0, -1});
  lamp.near = true;
  lamp.position_m = Eigen::Vector3d(0.06, 0, 0.9);  // between the wall and the screen, which lies beyond it
  EXPECT_GT(shade(options, tracer, look_at(tracer, 0.12f, 0), lamp), 0.1f);
  lamp.position_m = Eigen::Vector3d(-0.06, 0, 0.7);  // the screen lies between
  EXPECT_EQ(shade(options, tracer, look_at(tracer, 0.12f, 0), lamp), 0);
}

TEST(Shading, AHighlightPeaksAtTheMirrorDirection) {
  const RayTracer tracer(shifted(make_plane(), {0, 0, 1}, 1.0f));
  SimulateOptions options = ideal_rig(SceneKind::plane);
  options.image.attached_shadows = true;
  options.image.highlight = 0.4;
  const SurfaceSample sample = look_at(tracer, 0.3f, 0);
  const Eigen::Vector3d mirror(-0.3, 0,
                               -1);  // the eye's direction reflected at the wall, seen from the sample
  const Eigen::Vector3d to_eye = sample.to_eye.cast<double>();
  const LampTruth at_mirror = far_lamp({-to_eye.x(), -to_eye.y(), to_eye.z()}),
                  beside = far_lamp({0.6, 0.5, -1});
  const double cosine = -at_mirror.direction.z();
  EXPECT_NEAR(shade(options, tracer, sample, at_mirror), cosine + 0.4, 1e-4);
  EXPECT_LT(shade(options, tracer, sample, beside), -beside.direction.z() + 0.2);
  options.image.highlight = 0;
  EXPECT_NEAR(shade(options, tracer, sample, at_mirror), cosine, 1e-5);
}

TEST(Shading, AnIdealScanIsAlbedoTimesFirstOrderHarmonics) {
  SimulateOptions options = ideal_rig(SceneKind::sphere);
  options.lamps.count = 3;
  const Simulated scan = simulate_stack(options);
  for (std::size_t k = 0; k < 3; ++k) {
    const LampTruth& lamp = scan.truth.lamps[k];
    const cv::Mat& image = scan.stack.frames[k].color;
    for (int v = 0; v < image.rows; ++v) {
      for (int u = 0; u < image.cols; ++u) {
        if (scan.stack.mask(v, u) == 0) continue;
        const cv::Vec3f n = scan.truth.normals(v, u);
        const double shading = 0.75 * lamp.direction.dot(Eigen::Vector3d(n[0], n[1], n[2])) + 0.25;
        for (int c = 0; c < 3; ++c) {
          const double expected =
              static_cast<double>(scan.truth.albedo(v, u)[c]) * lamp.strength[c] * shading;
          ASSERT_NEAR(image.at<cv::Vec3w>(v, u)[c] / 65535.0, std::max(0.0, expected), 2e-5);
        }
      }
    }
  }
}

}  // namespace
}  // namespace rakelight
