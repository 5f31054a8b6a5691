// SPDX-License-Identifier: Apache-2.0
//
// Loops are oneTBB's, or plain threads under ThreadSanitizer. Each call counts on a sum of its own and fails on its
// own; sums are added, and the first failure in the order of the calls is thrown, when all are done.
#include "nef/base/threads/parallel.h"

#if defined(__SANITIZE_THREAD__)
#define NEF_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define NEF_THREAD_SANITIZER
#endif
#endif

#include <atomic>
#include <thread>

#ifndef NEF_THREAD_SANITIZER
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

#include <algorithm>
#include <exception>
#include <limits>
#include <mutex>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "nef/base/error.h"

namespace nef {

namespace {

/// What the first of the failed calls threw. Calls before it still run, so that the error a user reads does not depend
/// on which thread was faster.
class FirstFailure {
 public:
  void record(std::size_t index, std::exception_ptr thrown) {
    const std::scoped_lock lock(mutex_);
    if (index >= index_) return;
    index_ = index;
    thrown_ = std::move(thrown);
  }

  bool precedes(std::size_t index) {
    const std::scoped_lock lock(mutex_);
    return index_ < index;
  }

  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::mutex mutex_;
  std::size_t index_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr thrown_;
};

// used_threads: how many a loop uses that may use so many (0: as many as the machine has). run_on_threads: body(0) ..
// body(count - 1) on several threads; body does not throw.

#ifdef NEF_THREAD_SANITIZER

unsigned used_threads(unsigned threads) { return threads == 0 ? 4 : threads; }

/// oneTBB comes without instrumentation, so ThreadSanitizer does not see how it hands work from thread to thread, and
/// what it reports inside its tasks cannot be told from our own races. Under the sanitizer plain threads take its
/// place.
void run_on_threads(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) body(i);
  };
  std::vector<std::thread> workers;
  for (unsigned i = 1; i < used_threads(threads); ++i) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();
}

#else

// More threads than cores gain nothing, and make oneTBB print a warning.
unsigned used_threads(unsigned threads) {
  const auto cores = static_cast<unsigned>(tbb::info::default_concurrency());
  return threads == 0 ? cores : std::min(threads, cores);
}

void run_on_threads(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& body) {
  const auto loop = [&] {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      // A thread that waits inside the body could take up another call of this loop, and what stops or tells there
      // would happen in the middle of this one; isolation keeps it from that.
      tbb::this_task_arena::isolate([&] { body(i); });
    });
  };
  const auto used = static_cast<int>(used_threads(threads));
  try {
    // To make an arena takes a tenth of a millisecond, as long as many a loop. A loop inside of another one has one
    // already, and so has one on all cores.
    if (used == tbb::this_task_arena::max_concurrency()) {
      loop();
    } else {
      tbb::task_arena(used).execute(loop);
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    // The body throws nothing, so this comes from oneTBB.
    throw Error(std::string("threads cannot be started (") + failure.what() +
                "); use one (--threads 1), or raise the limits of processes and memory (ulimit -u, -v)");
  }
}

#endif

}  // namespace

std::size_t size_of_ranges(std::size_t count, const Monitor& monitor) {
  const std::size_t threads = monitor.threads() == 1 ? 1 : used_threads(monitor.threads());
  return std::max<std::size_t>((count + threads - 1) / threads, 1);
}

void parallel_for(std::size_t count, const Monitor& monitor,
                  const std::function<void(std::size_t, const Monitor&)>& body) {
  if (monitor.threads() == 1 || count < 2) {
    for (std::size_t i = 0; i < count; ++i) {
      monitor.check_interruption();
      body(i, monitor);
    }
    return;
  }
  // Every call is booked on a sum of its own, wherever it runs; all go to the caller, also if a call throws.
  std::vector<PredicateCounts> sums(count);
  FirstFailure failure;
  const std::thread::id here = std::this_thread::get_id();
  run_on_threads(count, monitor.threads(), [&](std::size_t i) {
    if (failure.precedes(i)) return;
    try {
      const bool is_here = std::this_thread::get_id() == here;
      const Monitor own = (is_here ? monitor : monitor.of_other_thread()).counting(sums[i]).on_threads(1);
      own.check_interruption();
      body(i, own);
    } catch (...) {
      failure.record(i, std::current_exception());
    }
  });
  for (const PredicateCounts& sum : sums) monitor.count(sum);
  failure.rethrow();
}

void parallel_for_ranges(std::size_t count, std::size_t size, const Monitor& monitor,
                         const std::function<void(std::size_t, std::size_t, const Monitor&)>& body) {
  parallel_for((count + size - 1) / size, monitor,
               [&](std::size_t i, const Monitor& own) { body(i * size, std::min(count, (i + 1) * size), own); });
}

void parallel_calls(const Monitor& monitor, std::initializer_list<std::function<void(const Monitor&)>> calls) {
  parallel_for(calls.size(), monitor,
               [&](std::size_t i, const Monitor& own) { calls.begin()[i](own.on_threads(monitor.threads())); });
}

}  // namespace nef
