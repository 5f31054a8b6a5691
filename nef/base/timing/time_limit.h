// SPDX-License-Identifier: Apache-2.0
//
// How a computation is stopped when its time is over.
#pragma once

#include <optional>
#include <thread>

#include "nef/base/monitor.h"
#include "nef/base/timing/stopwatch.h"

namespace nef {

/// Stops what its monitor watches once so many seconds have passed since the object was made. A thread of its own waits
/// for that, so all threads of the computation stop, also while the one that began it waits for others.
class TimeLimit {
 public:
  /// Without `seconds` there is no limit; 0 stops at once. What stops `outer` goes on doing so, and is told what the
  /// monitor is told. Throws Error if the thread cannot be started.
  explicit TimeLimit(std::optional<double> seconds, const Monitor& outer = {});

  /// The limit must outlive what this watches.
  [[nodiscard]] const Monitor& monitor() const { return question_.monitor(); }
  /// How many seconds have passed.
  [[nodiscard]] double passed() const { return watch_.seconds(); }

 private:
  Stopwatch watch_;
  StopQuestion question_;
  std::jthread timer_;  // ends before the question
};

}  // namespace nef
