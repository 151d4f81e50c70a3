// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// result.json: what was done, with which parameters, and how it ended (docs/result-format.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "refine/refine.h"

namespace rakelight {

inline constexpr const char* kResultFormat = "rakelight-result";
inline constexpr int kResultVersion = 1;

/// Where the stack lies that a result was made from.
struct StackPlace {
  std::filesystem::path
      relative;  ///< to the result folder, for both may be moved together; empty if there is no way
  std::filesystem::path absolute;
};

/// The text of result.json.
std::string result_json(const RefineResult& result, const std::optional<StackPlace>& stack = std::nullopt);

/// `converged`, `max_iterations` or `diverged`.
std::string to_string(Termination termination);

}  // namespace rakelight
