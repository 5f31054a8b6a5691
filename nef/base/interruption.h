// SPDX-License-Identifier: Apache-2.0
//
// How a long computation is stopped from outside: by the thread that waits for it, a user interface, a signal.
#pragma once

#include <atomic>

#include "nef/base/error.h"

namespace nef {

/// Thrown out of a computation that was stopped. Nothing is left half done: results are made whole or not at all.
class Interrupted : public Error {
 public:
  Interrupted() : Error("interrupted") {}
};

namespace detail {
/// What stops the work of this thread; null if nothing does. Belongs to the Interruptible that is alive in it.
inline thread_local const std::atomic<bool>* stop_flag = nullptr;
}  // namespace detail

/// While one is alive, the work of the calling thread, and what parallel_for hands on from it, ends by an exception
/// soon after `stop` has become true. They nest; the innermost counts.
class Interruptible {
 public:
  /// `stop` must outlive the object; null: not to be stopped.
  explicit Interruptible(const std::atomic<bool>* stop) : outer_(detail::stop_flag) { detail::stop_flag = stop; }
  ~Interruptible() { detail::stop_flag = outer_; }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  /// What stops the calling thread, to be handed on to another one.
  static const std::atomic<bool>* current() { return detail::stop_flag; }

 private:
  const std::atomic<bool>* outer_;
};

/// Throws Interrupted if the calling thread is to stop. Costs about a nanosecond; long loops call it in each round.
inline void check_interruption() {
  if (detail::stop_flag != nullptr && detail::stop_flag->load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace nef
