// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A list without an allocation as long as it is short: fits of small clusters, of which there are thousands
// in a sweep, must not ask the allocator for anything.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace pcl_bv {

/// Up to N elements in place, more on the heap. For plain values, which need no destruction; what resize()
/// adds in place is whatever was there.
template <typename T, std::size_t N>
class SmallVector {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  SmallVector() {}  // leaves few_ as it is
  explicit SmallVector(std::size_t size) { resize(size); }
  SmallVector(std::size_t size, const T& value) : SmallVector(size) {
    for (T& element : *this)
      element = value;
  }

  SmallVector(const SmallVector& other) { *this = other; }
  SmallVector& operator=(const SmallVector& other) {
    if (this == &other) return *this;
    resize(other.size_);
    std::copy(other.begin(), other.end(), begin());
    return *this;
  }

  std::size_t size() const { return size_; }
  T* data() { return heap_.empty() ? few_ : heap_.data(); }
  const T* data() const { return heap_.empty() ? few_ : heap_.data(); }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }

  void resize(std::size_t size) {
    if (size > N || !heap_.empty()) {
      if (heap_.empty()) heap_.assign(few_, few_ + size_);
      heap_.resize(size);
    }
    size_ = size;
  }

  void push_back(const T& value) {
    resize(size_ + 1);
    data()[size_ - 1] = value;
  }

 private:
  std::size_t size_ = 0;
  T few_[N];
  std::vector<T> heap_;
};

}  // namespace pcl_bv
