// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps of an outer iteration of multi-light one by one, on a refinement of VGA x 10 in its middle.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace rakelight::bench {

struct Step {
  std::string name;
  double bytes;               ///< read and written, of all pixels together
  double worst;               ///< time over that of reading the bytes, above which something has gone wrong
  std::function<void()> run;  ///< once
};

/// Runs in one thread from then on.
std::vector<Step> iteration_steps();

}  // namespace rakelight::bench
