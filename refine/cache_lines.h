// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vectors that begin with a cache line: of those that do not, every whole-line access of a vector kernel touches two.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace rakelight {

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};

  CacheLineAllocator() = default;
  template <class Other>
  CacheLineAllocator(const CacheLineAllocator<Other>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kLine)); }
  void deallocate(T* at, std::size_t) { ::operator delete(at, kLine); }

  template <class Other>
  bool operator==(const CacheLineAllocator<Other>&) const {
    return true;
  }
  template <class Other>
  bool operator!=(const CacheLineAllocator<Other>&) const {
    return false;
  }
};

template <class T>
using CacheLineVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace rakelight
