// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/stack_io.h"

#include "stack/checked_file.h"
#include "stack/errors.h"
#include "stack/image_file.h"
#include "stack/importers/photometric_sr.h"

namespace rakelight {
namespace fs = std::filesystem;

LightStack read_stack(const fs::path& folder) {
  if (is_photometric_sr(folder)) return import_photometric_sr(folder);
  throw InputError(folder.string(), "is not a stack", "give a stack folder or a source folder");
}

cv::Mat1b read_mask(const fs::path& file) { return read_mask_png(file); }

}  // namespace rakelight
