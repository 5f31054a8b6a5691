// SPDX-License-Identifier: Apache-2.0
//
// How sums tell their progress: one phase, whatever is done inside of it.
#pragma once

#include <algorithm>
#include <cstddef>

#include "apps/minkowski/minkowski.h"
#include "nef/base/monitor.h"

namespace nef::minkowski {

/// Some of the work of a sum. What its monitor is told of kSumPhase goes on to the monitor of the whole as the share of
/// the whole between two others, in thousandths that never decrease; other phases stay here, and the computation stops
/// there, if it is to.
class PartOfSum {
 public:
  /// `from` and `to`: shares of `whole`, 0 to 1.
  explicit PartOfSum(const Monitor& whole, double from = 0, double to = 1)
      : whole_(whole), from_(from), size_(to - from), monitor_(whole.telling(told_)) {}
  PartOfSum(const PartOfSum&) = delete;
  PartOfSum& operator=(const PartOfSum&) = delete;

  /// It must not outlive the object.
  [[nodiscard]] const Monitor& monitor() const { return monitor_; }

 private:
  void tell(const char* phase, std::size_t done, std::size_t total) {
    constexpr std::size_t kAll = 1000;
    if (phase != kSumPhase) return;
    const double share = total == 0 ? 1 : std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
    last_ = std::max(last_, static_cast<std::size_t>((from_ + size_ * share) * static_cast<double>(kAll)));
    whole_.tell_progress(kSumPhase, last_, kAll);
    whole_.check_interruption();
  }

  Monitor whole_;
  double from_;
  double size_;
  std::size_t last_ = 0;
  ProgressFunction told_ = [this](const char* phase, std::size_t done, std::size_t total) { tell(phase, done, total); };
  Monitor monitor_;
};

}  // namespace nef::minkowski
