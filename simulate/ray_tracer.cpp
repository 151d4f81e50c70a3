// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/ray_tracer.h"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace rakelight {
namespace {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

RTCRay make_ray(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float reach) {
  RTCRay ray{};
  ray.org_x = origin.x(), ray.org_y = origin.y(), ray.org_z = origin.z();
  ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
  ray.tnear = 0;
  ray.tfar = reach;
  ray.mask = ~0U;
  return ray;
}

}  // namespace

struct RayTracer::Scene {
  SceneMesh mesh;
  Device device;
  EmbreeScene scene;
  float lift = 0;  ///< shadow rays start this far off the facet, metres
};

RayTracer::RayTracer(SceneMesh mesh) : scene_(std::make_unique<Scene>()) {
  scene_->mesh = std::move(mesh);
  // One build thread: the tree, and with it every tie between facets, is the same on any machine.
  scene_->device.reset(rtcNewDevice(nullptr));
  if (!scene_->device) throw std::runtime_error("ray casting: Embree did not start");
  scene_->scene.reset(rtcNewScene(scene_->device.get()));
  rtcSetSceneFlags(scene_->scene.get(), RTC_SCENE_FLAG_ROBUST);
  const SceneMesh& m = scene_->mesh;
  RTCGeometry geometry = rtcNewGeometry(scene_->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), m.vertices.size()));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), m.triangles.size()));
  if (vertices == nullptr || indices == nullptr) {
    rtcReleaseGeometry(geometry);
    throw std::runtime_error("ray casting: Embree could not allocate the mesh");
  }
  for (const auto& v : m.vertices) vertices = std::copy_n(v.data(), 3, vertices);
  for (const auto& t : m.triangles) indices = std::copy_n(t.data(), 3, indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_->scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_->scene.get());
  if (rtcGetDeviceError(scene_->device.get()) != RTC_ERROR_NONE) {
    throw std::runtime_error("ray casting: Embree could not build the scene");
  }
  scene_->lift = static_cast<float>(std::clamp(0.1 * mean_edge_length(m), 1e-4, 5e-4));
}

RayTracer::~RayTracer() = default;

std::optional<SurfaceHit> RayTracer::trace(const Eigen::Vector3f& origin,
                                           const Eigen::Vector3f& direction) const {
  RTCRayHit query{};
  query.ray = make_ray(origin, direction, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_->scene.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  const SceneMesh& m = scene_->mesh;
  const auto& [a, b, c] = m.triangles[query.hit.primID];
  const float u = query.hit.u, v = query.hit.v, w = 1 - u - v;
  SurfaceHit hit;
  hit.position = w * m.vertices[a] + u * m.vertices[b] + v * m.vertices[c];
  hit.facet = (m.vertices[b] - m.vertices[a]).cross(m.vertices[c] - m.vertices[a]).normalized();
  if (hit.facet.dot(direction) > 0) hit.facet = -hit.facet;
  hit.normal = (w * m.normals[a] + u * m.normals[b] + v * m.normals[c]).normalized();
  if (hit.normal.dot(hit.facet) < 0) hit.normal = -hit.normal;
  hit.texture = w * m.texture[a] + u * m.texture[b] + v * m.texture[c];
  return hit;
}

void RayTracer::find_occluded(const std::vector<ShadowRay>& rays, std::vector<bool>& occluded) const {
  thread_local std::vector<RTCRay> queries;
  queries.clear();
  for (const ShadowRay& ray : rays) {
    queries.push_back(
        make_ray(ray.from->position + scene_->lift * ray.from->facet, ray.direction, ray.distance));
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded1M(scene_->scene.get(), &context, queries.data(), static_cast<unsigned>(queries.size()),
                sizeof(RTCRay));
  occluded.clear();
  for (const RTCRay& query : queries)
    occluded.push_back(query.tfar < 0);  // Embree marks a blocked ray by -inf
}

}  // namespace rakelight
