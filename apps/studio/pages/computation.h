// SPDX-License-Identifier: Apache-2.0
//
// One computation with its bounds: who wants it to stop, how long it may take, how much memory the program may have
// meanwhile, and how far it has come.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>

#include "nef/base/monitor.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::studio {

/// Bounds of one computation.
struct ComputationLimits {
  double seconds = 300;
  std::size_t bytes = std::size_t{4} << 30U;  ///< that the whole program may have in memory
};

/// Bytes that this process has in memory now.
std::size_t resident_bytes();

class Computation {
 public:
  explicit Computation(const ComputationLimits& limits) : limits_(limits) {}

  /// How far it has come, for any thread.
  struct Progress {
    std::string phase;
    std::size_t done = 0;
    std::size_t total = 0;
    double seconds = 0;
  };

  /// Calls `work` with a monitor of `threads` threads. What stops it becomes an Error that says why.
  void run(unsigned threads, const std::function<void(const Monitor&)>& work);

  /// Stops it soon; by any thread.
  void cancel() { cancelled_ = true; }
  [[nodiscard]] Progress progress() const;

 private:
  bool must_stop();

  ComputationLimits limits_;
  Stopwatch watch_;
  std::atomic<bool> cancelled_{false};
  double memory_asked_s_ = 0;
  std::string reason_;  // why it was stopped, by the thread that computes
  mutable std::mutex mutex_;
  Progress progress_;
};

/// The error of a computation that was cancelled, or that a newer one has replaced.
class Cancelled : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "cancelled"; }
};

}  // namespace nef::studio
