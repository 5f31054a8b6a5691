// SPDX-License-Identifier: Apache-2.0
#include "nef/base/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <exception>
#include <mutex>

#include "nef/base/predicate_counts.h"

namespace nef {

PredicateCounts& predicate_counts() {
  thread_local PredicateCounts counts;
  return counts;
}

namespace {

/// Books what is counted on this thread, until its end, on a sum; also if an exception ends it.
///
/// The lock at both ends, and the caller's before and after the loop, also show ThreadSanitizer in which order things
/// happen: it does not see into oneTBB, which comes without instrumentation.
class Booking {
 public:
  Booking(PredicateCounts& sum, std::mutex& mutex) : sum_(sum), mutex_(mutex), saved_(predicate_counts()) {
    const std::scoped_lock lock(mutex_);
    predicate_counts() = {};
  }
  ~Booking() {
    const std::scoped_lock lock(mutex_);
    sum_ += predicate_counts();
    predicate_counts() = saved_;
  }
  Booking(const Booking&) = delete;
  Booking& operator=(const Booking&) = delete;

 private:
  PredicateCounts& sum_;
  std::mutex& mutex_;
  PredicateCounts saved_;
};

}  // namespace

void parallel_for(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& body) {
  if (threads == 1 || count < 2) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  // Every call is booked on the sum, wherever it runs, the caller's thread included; the sum goes to the caller, also
  // if a call throws.
  PredicateCounts sum;
  std::mutex mutex;
  std::exception_ptr failure;
  // More threads than cores gain nothing, and make oneTBB print a warning.
  const int cores = tbb::info::default_concurrency();
  const bool all = threads == 0 || threads > static_cast<unsigned>(cores);
  { const std::scoped_lock lock(mutex); }
  tbb::task_arena arena(all ? cores : static_cast<int>(threads));
  try {
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        // A thread that waits inside the body could take up another call of this loop, whose counts
        // would then be added twice; isolation keeps it from that.
        tbb::this_task_arena::isolate([&] {
          const Booking booking(sum, mutex);
          body(i);
        });
      });
    });
  } catch (...) {
    failure = std::current_exception();
  }
  const std::scoped_lock lock(mutex);
  predicate_counts() += sum;
  if (failure) std::rethrow_exception(failure);
}

}  // namespace nef
