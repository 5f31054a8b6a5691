// SPDX-License-Identifier: Apache-2.0
//
// How a computation is stopped when its time is up.
#pragma once

#include <functional>
#include <optional>

#include "nef/base/monitor.h"
#include "nef/base/timing/stopwatch.h"

namespace nef {

/// Stops what its monitor watches once so many seconds have passed since the object was made.
class TimeLimit {
 public:
  /// Without `seconds` there is no limit. What stops `outer` goes on doing so, and is told what the monitor is told.
  explicit TimeLimit(std::optional<double> seconds, const Monitor& outer = {})
      : question_(
            seconds ? std::function<bool()>([this, most = *seconds] { return watch_.seconds() >= most; }) : nullptr,
            outer) {}

  /// The limit must outlive what this watches.
  [[nodiscard]] const Monitor& monitor() const { return question_.monitor(); }
  /// How many seconds have passed.
  [[nodiscard]] double passed() const { return watch_.seconds(); }

 private:
  Stopwatch watch_;
  StopQuestion question_;
};

}  // namespace nef
