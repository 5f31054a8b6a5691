// SPDX-License-Identifier: Apache-2.0
//
// Who watches a computation: stops it, is told how far it has come, counts its predicates, and says how many threads it
// may use. Whatever may take long is given its monitor as an argument and hands it on to what it calls; there is no
// state behind it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

#include "nef/base/interruption.h"
#include "nef/base/progress.h"
#include "nef/base/timing/predicate_counts.h"

namespace nef {

class StopQuestion;

/// A handle to those who watch; copies watch for the same. What it refers to must outlive the computation. A monitor
/// belongs to one thread at a time: parallel_for makes one for each of its calls, which its body must use instead of
/// the caller's.
class Monitor {
 public:
  /// Nobody watches; one thread.
  Monitor() = default;

  /// The same with up to so many threads to use; 0: as many as the machine has. No result depends on it.
  [[nodiscard]] Monitor on_threads(unsigned threads) const {
    Monitor result = *this;
    result.threads_ = threads;
    return result;
  }

  /// The same for who also stops once `stop` has become true, instead of the flag known before; null changes nothing.
  [[nodiscard]] Monitor stopped_by(const std::atomic<bool>* stop) const {
    Monitor result = *this;
    if (stop != nullptr) {
      result.stop_ = stop;
      result.question_ = nullptr;
      result.asks_ = false;
    }
    return result;
  }
  /// The same, with `told` to tell, always by the thread of this monitor; what it throws ends the computation. An empty
  /// function: nobody is told.
  [[nodiscard]] Monitor telling(const ProgressFunction& told) const {
    Monitor result = *this;
    result.progress_ = told ? &told : nullptr;
    return result;
  }
  /// The same without anybody to tell: for one of many small computations that tell of themselves as one.
  [[nodiscard]] Monitor quiet() const {
    Monitor result = *this;
    result.progress_ = nullptr;
    return result;
  }
  /// The same, counting into `counts` only.
  [[nodiscard]] Monitor counting(PredicateCounts& counts) const {
    Monitor result = *this;
    result.counts_ = &counts;
    return result;
  }
  /// The same for another thread, which neither tells nor asks, but is stopped with this one.
  [[nodiscard]] Monitor of_other_thread() const {
    Monitor result = quiet();
    result.asks_ = false;
    return result;
  }

  /// How many threads to use at most; 0: as many as the machine has.
  [[nodiscard]] unsigned threads() const { return threads_; }

  /// Throws Interrupted if the computation is to stop. Costs about a nanosecond; long loops call it in each round.
  inline void check_interruption() const;

  /// Tells who listens, if anybody does.
  void tell_progress(const char* phase, std::size_t done, std::size_t total) const {
    if (progress_ != nullptr) (*progress_)(phase, done, total);
  }
  /// The same from a loop over many small items, now and then.
  void tell_progress_of_item(const char* phase, std::size_t item, std::size_t total) const {
    constexpr std::size_t kBetween = 4096;
    if (item % kBetween == 0) tell_progress(phase, item, total);
  }

  /// Books signs on whoever counts, if anybody does: known by identity, by a filter, exactly.
  void count_identity() const {
    if (counts_ != nullptr) ++counts_->identity;
  }
  void count_filter(std::uint64_t signs = 1) const {
    if (counts_ != nullptr) counts_->filter += signs;
  }
  void count_exact() const {
    if (counts_ != nullptr) ++counts_->exact;
  }
  void count(const PredicateCounts& signs) const {
    if (counts_ != nullptr) *counts_ += signs;
  }

 private:
  friend class StopQuestion;

  [[nodiscard]] inline bool is_stopped() const;

  const std::atomic<bool>* stop_ = nullptr;
  StopQuestion* question_ = nullptr;  // whose flag stop_ is, if it is one's
  bool asks_ = false;                 // the thread of this monitor is the one to ask the question
  const ProgressFunction* progress_ = nullptr;
  PredicateCounts* counts_ = nullptr;
  unsigned threads_ = 1;
};

/// A function that is asked now and then whether to stop, by the thread that put the question, and the flag that tells
/// all threads what it said.
class StopQuestion {
 public:
  /// `stop` stops once it has said true; an empty one never does. What stops `outer` goes on doing so.
  explicit StopQuestion(std::function<bool()> stop, const Monitor& outer = {})
      : stop_(std::move(stop)), outer_(outer), monitor_(outer) {
    if (!stop_) return;
    monitor_.stop_ = &said_;
    monitor_.question_ = this;
    monitor_.asks_ = true;
  }
  StopQuestion(const StopQuestion&) = delete;
  StopQuestion& operator=(const StopQuestion&) = delete;

  /// The outer monitor, stopped by the question, too. The question must outlive what it watches.
  [[nodiscard]] const Monitor& monitor() const { return monitor_; }

  /// Stops from now on, without asking. Any thread may call it. Nothing for an empty function.
  void stop() { said_.store(true, std::memory_order_relaxed); }

 private:
  friend class Monitor;

  // Asks every few calls, as a look at a clock costs more than a flag.
  void ask() {
    if (outer_.asks_) outer_.question_->ask();
    if (++calls_ % 8 == 0 && stop_()) stop();
  }

  std::function<bool()> stop_;
  Monitor outer_;
  Monitor monitor_;
  std::atomic<bool> said_{false};
  unsigned calls_ = 0;
};

// By any of the flags, one question inside of another. Those of the outer ones are read, too, as the thread that asks
// may be waiting for others.
inline bool Monitor::is_stopped() const {
  for (const Monitor* watched = this; watched->stop_ != nullptr; watched = &watched->question_->outer_) {
    if (watched->stop_->load(std::memory_order_relaxed)) return true;
    if (watched->question_ == nullptr) return false;
  }
  return false;
}

inline void Monitor::check_interruption() const {
  if (stop_ == nullptr) return;
  if (asks_) question_->ask();
  if (is_stopped()) throw Interrupted();
}

}  // namespace nef
