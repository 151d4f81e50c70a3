// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Refines a stack without frames: the engine must be linked whole, and must refuse it.
#include <iostream>

#include "refine/output/result_io.h"
#include "refine/refine.h"
#include "stack/errors.h"

int main() {
  try {
    rakelight::write_result(rakelight::refine_depth({}, {}), "never-written");
  } catch (const rakelight::InputError& error) {
    std::cout << "refused as it should: " << error.what() << "\n";
    return 0;
  }
  std::cout << "an empty stack was refined\n";
  return 1;
}
