// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory as the program keeps it (cli/main.cpp).
#pragma once

#include <limits>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace rakelight::bench {

inline void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace rakelight::bench
