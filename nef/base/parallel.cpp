// SPDX-License-Identifier: Apache-2.0
#include "nef/base/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <mutex>

#include "nef/base/predicate_counts.h"

namespace nef {

PredicateCounts& predicate_counts() {
  thread_local PredicateCounts counts;
  return counts;
}

void parallel_for(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& body) {
  if (threads == 1 || count < 2) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  // Every call is booked on the thread it ran on, the caller's own included: the caller's reading
  // is set back and the sum put in its place. A call that runs others inside is set back likewise.
  PredicateCounts& own = predicate_counts();
  const PredicateCounts before = own;
  PredicateCounts sum;
  std::mutex mutex;
  // More threads than cores gain nothing, and make oneTBB print a warning.
  const int cores = tbb::info::default_concurrency();
  const bool all = threads == 0 || threads > static_cast<unsigned>(cores);
  tbb::task_arena arena(all ? cores : static_cast<int>(threads));
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      // A thread that waits inside the body could take up another call of this loop, whose counts
      // would then be added twice; isolation keeps it from that.
      tbb::this_task_arena::isolate([&] {
        PredicateCounts& here = predicate_counts();
        const PredicateCounts saved = here;
        here = {};
        body(i);
        const std::scoped_lock lock(mutex);
        sum += here;
        here = saved;
      });
    });
  });
  own = before;
  own += sum;
}

}  // namespace nef
