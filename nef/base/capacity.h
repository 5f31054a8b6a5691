// SPDX-License-Identifier: Apache-2.0
//
// What arrays hold beyond what they need.
#pragma once

namespace nef {

/// Gives memory back that an array has reserved and not used, where that is an eighth of it or more.
template <typename Array>
void trim_capacity(Array& array) {
  if (array.capacity() - array.size() > array.capacity() / 8) array.shrink_to_fit();
}

}  // namespace nef
