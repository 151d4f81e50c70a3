// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What memory allows: the yardstick of every figure in docs/performance.md.
#pragma once

namespace rakelight::bench {

/// Bytes a second at which all of OpenCV's threads together read a buffer far larger than the caches: best of several runs.
double stream_read_speed();

/// Bytes that 10 outer iterations of multi-light must move (docs/performance.md): the stack twice an iteration, one byte a
/// sample, and the state of each pixel.
double bytes_that_must_move(double pixels, double images, double iterations = 10);

}  // namespace rakelight::bench
