// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any text is rows of numbers or an InputError.
#include <cstddef>
#include <cstdint>

#include "stack/errors.h"
#include "stack/importers/number_rows.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    rakelight::parse_number_rows({reinterpret_cast<const char*>(data), size}, "K.txt");
  } catch (const rakelight::InputError&) {}
  return 0;
}
