// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace rakelight::kernels {

/// Runs whose products are taken together; the number of runs is a multiple of it.
constexpr int kGramRuns = 4;

/// The products of all pairs of runs: out[a + runs b] = sum_k run_a[k] run_b[k] for a >= b and, here and there, a < b.
/// @param values run a begins at values + stride a  @param runs a multiple of kGramRuns  @param count of numbers of a run,
/// a multiple of kRunAlign
void gram(const float* values, std::ptrdiff_t stride, int runs, int count, float* out);

}  // namespace rakelight::kernels
