// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// result.json: what was done, with which parameters, and how it ended (docs/result-format.md).
#pragma once

#include <string>

#include "refine/refine.h"

namespace rakelight {

inline constexpr const char* kResultFormat = "rakelight-result";
inline constexpr int kResultVersion = 1;

/// The text of result.json.
std::string result_json(const RefineResult& result);

/// `converged`, `max_iterations` or `diverged`.
std::string to_string(Termination termination);

}  // namespace rakelight
