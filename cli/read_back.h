// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What lines read while one lamp should be lit, for `rakelight lights test`.
#pragma once

#include <string>

#include "lights/lights.h"

namespace rakelight::cli {

struct ReadBack {
  bool read = true;  ///< false: the chip does not tell levels of outputs
  bool lit = false;
  std::string others;  ///< lamps that are lit, too

  bool as_written() const { return !read || (lit && others.empty()); }
};

/// To be called while only lamp `id` should be lit.
ReadBack read_back(const Lights& lights, const std::string& id);

/// "lit", "NOT LIT, but so is white-3", "not read back".
std::string to_string(const ReadBack& found);

}  // namespace rakelight::cli
