// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

#include "apps/minkowski/minkowski.h"
#include "nef/base/interruption.h"

namespace nef::minkowski {

/// Tells the progress function which share of the work is done, in thousandths that never decrease.
class WorkProgress {
 public:
  /// The options must outlive the object.
  explicit WorkProgress(const MinkowskiOptions& options) : options_(options) {}

  /// `share` is from 0 to 1. Throws Interrupted if the progress function says so.
  void operator()(double share) const {
    constexpr std::size_t kAll = 1000;
    const double done = std::clamp(share, 0.0, 1.0) * static_cast<double>(kAll);
    last_ = std::max(last_, static_cast<std::size_t>(done));
    if (options_.progress && !options_.progress(last_, kAll)) throw Interrupted();
  }

 private:
  const MinkowskiOptions& options_;
  mutable std::size_t last_ = 0;
};

}  // namespace nef::minkowski
