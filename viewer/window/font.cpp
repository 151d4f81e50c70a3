// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/font.h"

#include <imgui.h>

#include <filesystem>

namespace rakelight {
namespace {

constexpr const char* kFontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

}  // namespace

void load_font(float height_px) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  std::error_code ignored;
  if (std::filesystem::exists(kFontFile, ignored) &&
      fonts.AddFontFromFileTTF(kFontFile, height_px) != nullptr)
    return;
  ImFontConfig config;
  config.SizePixels = height_px;
  fonts.AddFontDefault(&config);
}

}  // namespace rakelight
