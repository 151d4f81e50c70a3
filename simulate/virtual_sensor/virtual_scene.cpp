// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/virtual_scene.h"

#include <algorithm>
#include <limits>
#include <opencv2/core/eigen.hpp>

#include "simulate/image_sensor.h"
#include "simulate/render.h"
#include "simulate/scene.h"

namespace rakelight {
namespace {

constexpr int kSamples = 2;  // rays a pixel and dimension: pre-rendering shall not be felt
// Facets of half a pixel of this grid, 0.3 million for the vase: building their tree takes 0.1 s. Smooth normals carry the rest.
const cv::Size kMeshGrid{240, 180};
const cv::Size kMeteringGrid{160, 120};  // for the exposure, which is then the same for every mode

SimulateOptions simulate_options(const VirtualSensorSetup& setup) {
  SimulateOptions options;
  options.scene.kind = setup.scene;
  options.scene.albedo = setup.albedo;
  options.seed = setup.seed;
  options.image.samples = kSamples;
  options.image.response = setup.response;
  options.image.crosstalk = setup.crosstalk;
  options.width = setup.depth_size.width;
  options.height = setup.depth_size.height;
  options.lamps.count =
      static_cast<int>(std::count_if(setup.lamps.begin(), setup.lamps.end(),
                                     [](const VirtualLamp& lamp) { return lamp.color == LampColor::white; }));
  return options;
}

/// Channel that a lamp lights: 0 red, 1 green, 2 blue, -1 all.
int channel_of(LampColor color) {
  switch (color) {
    case LampColor::red:
      return 0;
    case LampColor::green:
      return 1;
    case LampColor::blue:
      return 2;
    default:
      return -1;
  }
}

/// Lamps without a position stand where `simulate` would place them: white ones on its ring, the others by channel.
std::vector<LampTruth> place_lamps(const VirtualSensorSetup& setup, const SimulateOptions& options) {
  std::vector<LampTruth> lamps;
  int placed[4] = {};
  for (const VirtualLamp& lamp : setup.lamps) {
    const int channel = channel_of(lamp.color);
    const int k = placed[channel + 1]++;
    const auto alike = std::count_if(setup.lamps.begin(), setup.lamps.end(),
                                     [&lamp](const VirtualLamp& other) { return other.color == lamp.color; });
    LampTruth truth = channel < 0 ? white_lamp(options, k).lamps.front()
                                  : channel_lamp(options, channel, k, static_cast<int>(alike));
    truth.id = lamp.id;
    if (lamp.position_m) {
      truth.near = true;
      truth.position_m = lamp.position_m;
      truth.direction = (*lamp.position_m - Eigen::Vector3d(0, 0, options.scene.distance_m)).normalized();
    }
    lamps.push_back(std::move(truth));
  }
  return lamps;
}

std::vector<LampSet> one_at_a_time(const std::vector<LampTruth>& lamps) {
  std::vector<LampSet> sets(lamps.size());
  for (std::size_t k = 0; k < lamps.size(); ++k) sets[k].lamps = {lamps[k]};
  return sets;
}

void expose(cv::Mat3f& image, const Eigen::Matrix3d& crosstalk, double exposure) {
  cv::Matx33f mix;
  cv::eigen2cv(Eigen::Matrix3f((exposure * crosstalk).cast<float>()), mix);
  for (cv::Vec3f& pixel : image) pixel = mix * pixel;
}

}  // namespace

struct VirtualScene::Parts {
  explicit Parts(const VirtualSensorSetup& setup)
      : options(simulate_options(setup)),
        lamps(place_lamps(setup, options)),
        tracer(make_scene(options.scene, structured_light_camera(kMeshGrid))) {
    SimulateOptions metering = options;
    metering.image.samples = 1;
    const ShadingContext context{metering, tracer, center()};
    exposure = auto_exposure(context, structured_light_camera(kMeteringGrid), one_at_a_time(lamps));
  }

  Eigen::Vector3f center() const { return {0, 0, static_cast<float>(options.scene.distance_m)}; }
  ShadingContext shading() const { return {options, tracer, center()}; }

  SimulateOptions options;
  std::vector<LampTruth> lamps;
  RayTracer tracer;
  double exposure = 1;  ///< radiance to full scale
};

VirtualScene::VirtualScene(const VirtualSensorSetup& setup) : parts_(std::make_unique<Parts>(setup)) {}
VirtualScene::~VirtualScene() = default;

const SimulateOptions& VirtualScene::options() const { return parts_->options; }

LampImages VirtualScene::render_color(cv::Size size) const {
  RadianceImages images = render_radiance(parts_->shading(), structured_light_camera(size), parts_->lamps);
  const Eigen::Matrix3d crosstalk = crosstalk_matrix(parts_->options.image.crosstalk);
  expose(images.ambient, crosstalk, parts_->exposure);
  for (cv::Mat3f& lamp : images.lamps) expose(lamp, crosstalk, parts_->exposure);
  return {images.ambient, images.lamps, images.albedo};
}

DepthSensor VirtualScene::depth_sensor(cv::Size size) const {
  return {parts_->options, structured_light_camera(size), parts_->tracer};
}

GroundTruth VirtualScene::truth(const LampImages& images) const {
  const SurfaceMaps surface = render_surface(parts_->tracer, structured_light_camera(images.albedo.size()));
  GroundTruth truth{surface.depth, surface.normals, images.albedo.clone(), parts_->lamps};
  truth.albedo.setTo(cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()),
                     cv::Mat1b(surface.depth != surface.depth));
  for (LampTruth& lamp : truth.lamps) lamp.strength *= parts_->exposure;
  return truth;
}

}  // namespace rakelight
