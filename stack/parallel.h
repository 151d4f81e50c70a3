// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Jobs of any kind side by side, on OpenCV's threads.
#pragma once

#include <functional>
#include <vector>

namespace rakelight {

/// Runs body(0) ... body(count - 1), each once, in any order. When some throw, the exception of the lowest number is thrown
/// after all have ended: what a person is told does not depend on the threads.
void in_parallel(int count, const std::function<void(int)>& body);

/// The same for a list of jobs.
void in_parallel(const std::vector<std::function<void()>>& jobs);

}  // namespace rakelight
