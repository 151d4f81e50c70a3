// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parallel loops whose result does not depend on the number of threads: the work is cut into blocks of fixed size, and
// sums are added up in the order of the blocks.
#pragma once

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <vector>

namespace rakelight {

constexpr int kPixelBlock = 4096;

/// Calls body(begin, end) for blocks of [0, count).
template <class Body>
void for_each_block(int count, const Body& body) {
  const int blocks = (count + kPixelBlock - 1) / kPixelBlock;
  cv::parallel_for_(cv::Range(0, blocks), [&](const cv::Range& range) {
    for (int b = range.start; b < range.end; ++b) {
      body(b * kPixelBlock, std::min(count, (b + 1) * kPixelBlock));
    }
  });
}

/// Sum over blocks of body(begin, end) -> Sum, added in block order.
template <class Sum, class Body>
Sum sum_over_blocks(int count, Sum zero, const Body& body) {
  std::vector<Sum> parts(static_cast<size_t>((count + kPixelBlock - 1) / kPixelBlock), zero);
  for_each_block(
      count, [&](int begin, int end) { parts[static_cast<size_t>(begin / kPixelBlock)] = body(begin, end); });
  for (const Sum& part : parts) zero += part;
  return zero;
}

}  // namespace rakelight
