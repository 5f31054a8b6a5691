// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/monitor.h"
#include "nef/base/timing/stopwatch.h"

namespace nef {

/// Measures one phase of some work: adds, at its end, the time on the wall and the predicates that the work counted
/// with monitor(). Refers to both sums.
class PhaseTimer {
 public:
  /// What is counted goes to `outer`, too.
  PhaseTimer(double& seconds, PredicateCounts& predicates, const Monitor& outer = {})
      : seconds_(seconds), predicates_(predicates), outer_(outer), monitor_(outer.counting(counts_)) {}
  ~PhaseTimer() {
    seconds_ += watch_.seconds();
    predicates_ += counts_;
    outer_.count(counts_);
  }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

  /// The outer monitor, counting for this phase.
  [[nodiscard]] const Monitor& monitor() const { return monitor_; }

 private:
  double& seconds_;
  PredicateCounts& predicates_;
  Monitor outer_;
  PredicateCounts counts_;
  Monitor monitor_;
  Stopwatch watch_;
};

}  // namespace nef
