// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/observations.h"

#include <algorithm>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "stack/color_response.h"
#include "stack/errors.h"
#include "stack/parallel.h"

namespace rakelight {
namespace {

cv::Matx33d intrinsic_matrix(const Camera& camera) {
  return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}

/// Brings full-size colour images to the grid: removes lens distortion, then averages blocks.
class ColorSampler {
 public:
  ColorSampler(const Camera& color_camera, const Camera& grid_camera)
      : full_(color_camera.size()), size_(grid_camera.size()) {
    if (color_camera.distortion.empty()) return;
    const cv::Matx33d K = intrinsic_matrix(color_camera);
    cv::initUndistortRectifyMap(K, color_camera.distortion, cv::noArray(), K, color_camera.size(), CV_32FC1,
                                map_x_, map_y_);
  }

  /// The part of the full-size image that a part of the grid is sampled from: that part where pixels stay where they are,
  /// else everything.
  cv::Rect needed(const cv::Rect& part, cv::Size full) const {
    return map_x_.empty() && full == size_ ? part : cv::Rect({0, 0}, full);
  }

  template <class Image>
  Image operator()(const Image& full) const {
    Image straight = full;
    if (!map_x_.empty()) cv::remap(full, straight, map_x_, map_y_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
    if (straight.size() == size_ || straight.size() != full_) return straight;
    Image small;
    cv::resize(straight, small, size_, 0, 0, cv::INTER_AREA);
    return small;
  }

 private:
  cv::Size full_, size_;
  cv::Mat map_x_, map_y_;
};

/// Mean of the dark frames, empty if there are none.
cv::Mat3f ambient_image(const LightStack& stack, const FrameVisitor& visit) {
  cv::Mat3f sum;
  int count = 0;
  for (size_t at = 0; at < stack.frames.size(); ++at) {
    if (stack.frames[at].light || !has_color(stack.frames[at])) continue;
    const Frame frame = with_color(stack.frames[at]);
    visit(at, frame);
    const cv::Mat3f dark = linear_color(stack, frame);
    if (sum.empty())
      sum = dark;
    else
      sum += dark;
    ++count;
  }
  return sum.empty() ? sum : cv::Mat3f(sum / count);
}

const Light& light_of(const LightStack& stack, const Frame& frame) {
  for (const Light& light : stack.lights)
    if (light.id == *frame.light) return light;
  throw InputError(stack.origin,
                   "frame " + std::to_string(frame.index) + " names the unknown light " + *frame.light,
                   "list it under lights");
}

/// Colour of the grid's pixels as an image's samples. @param origin of the images on the grid's camera
void set_image(const PixelGrid& grid, const cv::Mat3f& color, const cv::Mat3b& clipped, cv::Point origin,
               int image, Observations& out) {
  std::vector<float> radiance(static_cast<size_t>(grid.size()));
  std::vector<unsigned char> usable(radiance.size());
  for (int c = 0; c < 3; ++c) {
    for (size_t p = 0; p < radiance.size(); ++p) {
      radiance[p] = color(grid.pixels[p] - origin)[c];
      usable[p] = clipped(grid.pixels[p] - origin)[c] == 0;
    }
    out.set_channel(image, c, radiance.data(), usable.data());
  }
}

/// Whole tiles, and one more than a multiple of four: the channels' runs of a tile, which are read together, then lie in
/// different sets of the first-level cache (4096 bytes apart they would push each other out).
size_t channel_stride(int pixels) {
  constexpr size_t kTile = kernels::kTilePixels, kApart = 4;
  const size_t tiles = (static_cast<size_t>(pixels) + kTile - 1) / kTile;
  return ((tiles + kApart - 2) / kApart * kApart + 1) * kTile;
}

}  // namespace

Observations::Observations(int pixel_count, int image_count)
    : pixels(pixel_count),
      images(image_count),
      pieces_(static_cast<size_t>(pixel_count + kernels::kPiecePixels - 1) / kernels::kPiecePixels),
      stride_(channel_stride(pixel_count)),
      codes_(3 * static_cast<size_t>(image_count) * stride_, ChannelSamples::kUnusable),
      encoding_(3 * static_cast<size_t>(image_count)),
      whole_(encoding_.size() * pieces_, 0) {}

void Observations::set_channel(int image, int channel, const float* radiance, const unsigned char* usable) {
  constexpr float kSteps = 65534;
  float least = std::numeric_limits<float>::infinity(), most = -least;
  for (int p = 0; p < pixels; ++p) {
    if (usable[p] == 0) continue;
    least = std::min(least, radiance[p]);
    most = std::max(most, radiance[p]);
  }
  const size_t at = 3 * static_cast<size_t>(image) + static_cast<size_t>(channel);
  std::uint16_t* codes = codes_.data() + at * stride_;
  if (!(most >= least)) {
    std::fill_n(codes, pixels, ChannelSamples::kUnusable);
    note_whole_pieces(at);
    return;
  }
  encoding_[at] = {(most - least) / kSteps, least};
  const float per_step = most > least ? kSteps / (most - least) : 0;
  for (int p = 0; p < pixels; ++p) {
    const auto code =
        static_cast<std::uint16_t>(std::min(kSteps, std::max(0.0f, (radiance[p] - least) * per_step)) + 0.5f);
    codes[p] = usable[p] != 0 ? code : ChannelSamples::kUnusable;
  }
  note_whole_pieces(at);
}

/// @param at of the image and channel
void Observations::note_whole_pieces(size_t at) {
  constexpr auto kPiece = static_cast<size_t>(kernels::kPiecePixels);
  const auto count = static_cast<size_t>(pixels);
  for (size_t piece = 0; piece < pieces_; ++piece) {
    const std::uint16_t* codes = codes_.data() + at * stride_ + piece * kPiece;
    whole_[at * pieces_ + piece] =
        (piece + 1) * kPiece <= count &&
        std::find(codes, codes + kPiece, ChannelSamples::kUnusable) == codes + kPiece;
  }
}

PlainSamples Observations::plain() const {
  PlainSamples samples;
  samples.radiance.reserve(codes_.size());
  samples.usable.reserve(codes_.size());
  for (int i = 0; i < images; ++i) {
    for (int c = 0; c < 3; ++c) {
      const ChannelSamples from = channel(i, c);
      for (int p = 0; p < pixels; ++p) {
        samples.radiance.push_back(from[p]);
        samples.usable.push_back(from.usable(p));
      }
    }
  }
  return samples;
}

void Observations::set(const PlainSamples& samples) {
  for (int i = 0; i < images; ++i) {
    for (int c = 0; c < 3; ++c) {
      const size_t at = (3 * static_cast<size_t>(i) + static_cast<size_t>(c)) * static_cast<size_t>(pixels);
      set_channel(i, c, samples.radiance.data() + at, samples.usable.data() + at);
    }
  }
}

Observations Observations::only(int image) const {
  const auto i = static_cast<size_t>(image);
  Observations one(pixels, 1);
  for (int c = 0; c < 3; ++c) one.copy_channel(*this, image, 0, c);
  one.light_ids = {light_ids[i]};
  one.frame_index = {frame_index[i]};
  one.colored_lamps = {colored_lamps[i]};
  one.lamp_positions = {lamp_positions[i]};
  return one;
}

void Observations::copy_channel(const Observations& from, int from_image, int image, int channel) {
  const size_t at = 3 * static_cast<size_t>(image) + static_cast<size_t>(channel),
               source = 3 * static_cast<size_t>(from_image) + static_cast<size_t>(channel);
  std::copy_n(from.codes_.data() + source * stride_, stride_, codes_.data() + at * stride_);
  encoding_[at] = from.encoding_[source];
  note_whole_pieces(at);
}

Observations observe(const LightStack& stack, const PixelGrid& grid, const FrameVisitor& visit_or_not) {
  const FrameVisitor visit = visit_or_not ? visit_or_not : [](std::size_t, const Frame&) {};
  std::vector<size_t> lit;
  for (size_t at = 0; at < stack.frames.size(); ++at)
    if (stack.frames[at].light && has_color(stack.frames[at])) lit.push_back(at);
  Observations out(grid.size(), static_cast<int>(lit.size()));
  for (const size_t at : lit) {
    const Light& light = light_of(stack, stack.frames[at]);
    out.light_ids.push_back(light.id);
    out.colored_lamps.push_back(light.color == LampColor::rgb);
    out.lamp_positions.push_back(light.position_m);
    out.frame_index.push_back(stack.frames[at].index);
  }
  const ColorSampler sample(stack.color_camera, grid.camera);
  const cv::Mat3f ambient = ambient_image(stack, visit);
  const cv::Rect needed = sample.needed(grid.box, stack.color_camera.size());
  in_parallel(out.images, [&](int i) {
    const size_t at = lit[static_cast<size_t>(i)];
    Frame frame = with_color(stack.frames[at]);
    visit(at, frame);
    frame.color = frame.color(needed);
    cv::Mat3f color = linear_color(stack, frame);
    if (!ambient.empty()) color -= ambient(needed);
    cv::Mat3b clipped = saturated_channels(frame);
    if (!stack.color_crosstalk.isIdentity()) cv::merge(std::vector<cv::Mat>(3, saturated(frame)), clipped);
    set_image(grid, sample(color), sample(clipped),
              needed.size() == grid.box.size() ? needed.tl() : cv::Point(), i, out);
  });
  return out;
}

}  // namespace rakelight
