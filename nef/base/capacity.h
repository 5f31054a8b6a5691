// SPDX-License-Identifier: Apache-2.0
//
// What arrays hold, and what of it is more than they need.
#pragma once

#include <cstddef>

namespace nef {

/// Bytes that an array holds, reserved ones included.
template <typename Array>
std::size_t held_bytes(const Array& array) {
  return array.capacity() * sizeof(*array.begin());
}

/// Gives memory back that an array has reserved and not used, where that is an eighth of it or more.
template <typename Array>
void trim_capacity(Array& array) {
  if (array.capacity() - array.size() > array.capacity() / 8) array.shrink_to_fit();
}

}  // namespace nef
