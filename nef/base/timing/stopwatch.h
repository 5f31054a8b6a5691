// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <ctime>

namespace nef {

/// Seconds since its construction, or since the last lap, by a clock of the standard's kind.
template <typename Clock>
class BasicStopwatch {
 public:
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// The same, and starts again.
  double lap() {
    const auto now = Clock::now();
    const double passed = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return passed;
  }

 private:
  typename Clock::time_point start_ = Clock::now();
};

/// The time that this process (CLOCK_PROCESS_CPUTIME_ID) or this thread (CLOCK_THREAD_CPUTIME_ID) has worked.
template <clockid_t kId>
struct WorkClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<WorkClock>;
  static constexpr bool is_steady = true;
  static time_point now() {
    timespec time{};
    clock_gettime(kId, &time);
    return time_point(std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec));
  }
};

using Stopwatch = BasicStopwatch<std::chrono::steady_clock>;                   ///< time on the wall
using ProcessStopwatch = BasicStopwatch<WorkClock<CLOCK_PROCESS_CPUTIME_ID>>;  ///< of all threads together
using ThreadStopwatch = BasicStopwatch<WorkClock<CLOCK_THREAD_CPUTIME_ID>>;

}  // namespace nef
