// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/timing/predicate_counts.h"
#include "nef/base/timing/stopwatch.h"

namespace nef {

/// Measures one phase of some work: adds, at its end, the time on the wall and the predicates that this thread and the
/// parallel loops that it started asked meanwhile. Refers to both sums.
class PhaseTimer {
 public:
  PhaseTimer(double& seconds, PredicateCounts& predicates)
      : seconds_(seconds), predicates_(predicates), before_(predicate_counts()) {}
  ~PhaseTimer() {
    seconds_ += watch_.seconds();
    const PredicateCounts& after = predicate_counts();
    predicates_ += {after.identity - before_.identity, after.filter - before_.filter, after.exact - before_.exact};
  }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  double& seconds_;
  PredicateCounts& predicates_;
  PredicateCounts before_;
  Stopwatch watch_;
};

}  // namespace nef
