// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any bytes are a PNG or TIFF header or an InputError.
#include <cstddef>
#include <cstdint>

#include "stack/errors.h"
#include "stack/png_header.h"
#include "stack/tiff_header.h"

namespace {

template <typename Parse>
void try_to(const Parse& parse) {
  try {
    parse();
  } catch (const rakelight::InputError&) {}
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_to([&] { rakelight::parse_png_header(data, size, "file"); });
  try_to([&] { rakelight::check_png_bytes(data, size, "file"); });
  try_to([&] { rakelight::parse_tiff_header(data, size, "file"); });
  return 0;
}
