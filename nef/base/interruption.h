// SPDX-License-Identifier: Apache-2.0
//
// How a long computation is stopped from outside: by the thread that waits for it, a user interface, a signal.
#pragma once

#include <atomic>
#include <functional>
#include <utility>

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

/// A function that is asked now and then whether to stop, and the flag that tells other threads what it said.
class Question {
 public:
  explicit Question(std::function<bool()> asks) : asks_(std::move(asks)) {}

  /// To be called by the thread that put the question; asks every few calls, as a look at a clock costs more than a
  /// flag.
  void ask() {
    if (++calls_ % 8 == 0 && asks_()) stop_.store(true, std::memory_order_relaxed);
  }
  [[nodiscard]] const std::atomic<bool>* flag() const { return &stop_; }

 private:
  std::function<bool()> asks_;
  std::atomic<bool> stop_{false};
  unsigned calls_ = 0;
};

/// The question that is behind stop_flag, if this thread is the one to ask it.
inline thread_local Question* question = nullptr;
}  // namespace detail

/// While one is alive, the work of the calling thread, and what parallel_for hands on from it, ends by an exception
/// soon after it is told to. They nest; the innermost counts.
class Interruptible {
 public:
  /// Stops once `stop` has become true. It must outlive the object; null: not to be stopped.
  explicit Interruptible(const std::atomic<bool>* stop) {
    // Handing on what stops the thread already, as parallel_for does, leaves the question with the thread that asks it.
    if (stop != detail::stop_flag) detail::question = nullptr;
    detail::stop_flag = stop;
  }
  /// Stops once `stop()` has said true, or what stopped the thread so far does. `stop` must outlive the object and is
  /// called in this thread only; an empty one changes nothing.
  explicit Interruptible(const std::function<bool()>& stop)
      : own_([&stop, flag = outer_flag_, outer = outer_question_] {
          if (outer != nullptr) outer->ask();
          return (flag != nullptr && flag->load(std::memory_order_relaxed)) || stop();
        }) {
    if (!stop) return;
    detail::stop_flag = own_.flag();
    detail::question = &own_;
  }
  ~Interruptible() {
    detail::stop_flag = outer_flag_;
    detail::question = outer_question_;
  }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  /// What stops the calling thread, to be handed on to another one.
  static const std::atomic<bool>* current() { return detail::stop_flag; }

 private:
  const std::atomic<bool>* outer_flag_ = detail::stop_flag;
  detail::Question* outer_question_ = detail::question;
  detail::Question own_{nullptr};
};

/// Throws Interrupted if the calling thread is to stop. Costs about a nanosecond; long loops call it in each round.
inline void check_interruption() {
  if (detail::stop_flag == nullptr) return;
  if (detail::question != nullptr) detail::question->ask();
  if (detail::stop_flag->load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace nef
