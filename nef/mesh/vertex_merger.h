// SPDX-License-Identifier: Apache-2.0
//
// One index for each exact point.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/number/number.h"

namespace nef {

/// Appends points to a vector so that equal ones share an index. Expected O(1) for each.
class VertexMerger {
 public:
  /// `points` must outlive the merger and not be changed by others.
  explicit VertexMerger(std::vector<Rational3>& points) : points_(points), slots_(64, kFree) {}

  /// The index of an equal point, or of a new copy of this one.
  std::uint32_t add(const Rational3& point);

 private:
  static constexpr std::uint32_t kFree = 0xffffffffU;
  void grow();

  std::vector<Rational3>& points_;
  std::vector<std::uint64_t> hashes_;
  std::vector<std::uint32_t> slots_;  // open addressing, a power of two, at most half full
};

/// For each point the smallest index of a point with the same coordinates. Expected O(n).
std::vector<std::uint32_t> merge_equal(std::span<const Rational3> points);
/// The same for points whose coordinates are doubles.
std::vector<std::uint32_t> merge_equal(std::span<const std::array<double, 3>> points);

}  // namespace nef
