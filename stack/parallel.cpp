// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/parallel.h"

#include <exception>
#include <opencv2/core/utility.hpp>

namespace rakelight {

void in_parallel(int count, const std::function<void(int)>& body) {
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(count));
  cv::parallel_for_(cv::Range(0, count), [&](const cv::Range& range) {
    for (int k = range.start; k < range.end; ++k) {
      try {
        body(k);
      } catch (...) { failures[static_cast<std::size_t>(k)] = std::current_exception(); }
    }
  });
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

void in_parallel(const std::vector<std::function<void()>>& jobs) {
  in_parallel(static_cast<int>(jobs.size()), [&](int k) { jobs[static_cast<std::size_t>(k)](); });
}

}  // namespace rakelight
