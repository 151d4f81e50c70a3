// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/select_image.h"

#include <algorithm>
#include <array>
#include <optional>

#include "stack/errors.h"

namespace rakelight {
namespace {

SelectedImage selected(const Observations& images, int i) {
  const size_t k = static_cast<size_t>(i);
  return {images.only(i),
          "frame " + std::to_string(images.frame_index[k]) + " (lamp " + images.light_ids[k] + ") was used"};
}

int image_of_frame(const Observations& images, int frame) {
  const auto found = std::find(images.frame_index.begin(), images.frame_index.end(), frame);
  if (found == images.frame_index.end()) {
    throw UsageError("frame " + std::to_string(frame) +
                     " is not a lit colour frame of the stack; see rakelight info");
  }
  return static_cast<int>(found - images.frame_index.begin());
}

/// First image lit by a lamp of this colour alone.
std::optional<int> image_lit(const LightStack& stack, const Observations& images, LampColor color) {
  for (int i = 0; i < images.images; ++i) {
    const std::string& id = images.light_ids[static_cast<size_t>(i)];
    const auto light = std::find_if(stack.lights.begin(), stack.lights.end(),
                                    [&](const Light& each) { return each.id == id; });
    if (light != stack.lights.end() && light->color == color) return i;
  }
  return std::nullopt;
}

/// Red channel of the red-lit image, green of the green-lit, blue of the blue-lit.
std::optional<SelectedImage> composed(const LightStack& stack, const Observations& images) {
  const std::array lit{image_lit(stack, images, LampColor::red), image_lit(stack, images, LampColor::green),
                       image_lit(stack, images, LampColor::blue)};
  if (!lit[0] || !lit[1] || !lit[2]) return std::nullopt;
  SelectedImage result{images.only(*lit[0]), "frames"};
  for (int c = 0; c < 3; ++c) {
    const int i = *lit[static_cast<size_t>(c)];
    result.image.copy_channel(images, i, 0, c);
    result.explanation += (c == 0 ? " " : ", ") + std::to_string(images.frame_index[static_cast<size_t>(i)]);
  }
  result.explanation += " (red, green and blue lamps) were put together";
  return result;
}

}  // namespace

SelectedImage select_any_image(const Observations& images, int frame) {
  return selected(images, frame < 0 ? 0 : image_of_frame(images, frame));
}

SelectedImage select_colored_image(const LightStack& stack, const Observations& images, int frame) {
  if (frame >= 0) return selected(images, image_of_frame(images, frame));
  if (images.images == 1) return selected(images, 0);
  const auto colored = std::find(images.colored_lamps.begin(), images.colored_lamps.end(), true);
  if (colored != images.colored_lamps.end())
    return selected(images, static_cast<int>(colored - images.colored_lamps.begin()));
  if (auto image = composed(stack, images)) return *image;
  throw InputError(stack.origin,
                   "none of its " + std::to_string(images.images) +
                       " images was taken under red, green and blue lamps, which rgb-ratio needs",
                   "use --method multi-light for four and more images under one lamp each, fusion-like for "
                   "any one image, or "
                   "--frame N if an image is colour-lit");
}

}  // namespace rakelight
