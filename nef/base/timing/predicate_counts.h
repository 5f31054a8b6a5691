// SPDX-License-Identifier: Apache-2.0
//
// How many signs each stage of the predicates' ladders has answered.
#pragma once

#include <cstdint>

namespace nef {

/// Answers by stage: known from what made the operands, by a floating-point filter with a proven
/// bound, by exact arithmetic. They feed reports, never an answer.
struct PredicateCounts {
  std::uint64_t identity = 0;
  std::uint64_t filter = 0;
  std::uint64_t exact = 0;

  PredicateCounts& operator+=(const PredicateCounts& other) {
    identity += other.identity;
    filter += other.filter;
    exact += other.exact;
    return *this;
  }
};

}  // namespace nef
