// SPDX-License-Identifier: Apache-2.0
//
// The first of some trials that succeeds, on several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/base/threads/parallel.h"

namespace nef::planner {

/// The first index i of 0 .. count - 1 for which test(i, own) is true; `count` if there is none. As parallel_for, but
/// once an index is known, calls behind it are left out or stopped (Interrupted), and so is what they throw: the result
/// does not depend on the number of threads. Calls that may use several threads themselves say so by own.on_threads.
inline std::size_t first_true(std::size_t count, const Monitor& monitor,
                              const std::function<bool(std::size_t, const Monitor& own)>& test) {
  std::vector<std::exception_ptr> thrown(count);
  std::atomic<std::size_t> first{count};
  parallel_for(count, monitor, [&](std::size_t i, const Monitor& own) {
    if (first.load() < i) return;
    try {
      if (monitor.threads() == 1) {  // those before it are done
        if (!test(i, own)) return;
      } else {
        const StopQuestion stop([&first, i] { return first.load() < i; }, own);
        if (!test(i, stop.monitor())) return;
      }
    } catch (...) {
      thrown[i] = std::current_exception();
    }
    std::size_t before = first.load();
    while (i < before && !first.compare_exchange_weak(before, i)) {
    }
  });
  if (first < count && thrown[first]) std::rethrow_exception(thrown[first]);
  return first;
}

}  // namespace nef::planner
