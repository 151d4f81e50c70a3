// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any text is a manifest or an InputError; a manifest that was read can be written and read again.
#include <cstddef>
#include <cstdint>

#include "stack/errors.h"
#include "stack/manifest.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  try {
    const rakelight::Manifest manifest = rakelight::parse_manifest(text, "stack.json");
    rakelight::manifest_text(manifest.stack, manifest.files);
  } catch (const rakelight::InputError&) {}
  return 0;
}
