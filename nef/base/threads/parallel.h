// SPDX-License-Identifier: Apache-2.0
//
// The one way in which this library uses several threads.
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <vector>

#include "nef/base/monitor.h"

namespace nef {

/// Calls body(0, own) .. body(count - 1, own), each once, in any order, on up to monitor.threads() threads; one thread
/// is a plain loop in order. Returns when all are done. `own` is the monitor of that call, on whichever thread it runs:
/// it tells only in the caller's thread, is stopped with `monitor`, and what it counts goes to `monitor` at the end; it
/// has one thread to use if the loop uses several. If calls throw, the exception of the first of them in the order of
/// the indices arrives in the caller, whatever the number of threads, and calls behind it may be left out. If the
/// caller is interrupted, calls that have not begun are left out.
void parallel_for(std::size_t count, const Monitor& monitor,
                  const std::function<void(std::size_t, const Monitor& own)>& body);

/// The same for ranges of at most `size` indices that cover 0 .. count - 1: calls body(first, last, own) for each.
void parallel_for_ranges(std::size_t count, std::size_t size, const Monitor& monitor,
                         const std::function<void(std::size_t, std::size_t, const Monitor& own)>& body);

/// The size of ranges of which each thread that `monitor` has gets one; at least 1. For work whose result does not
/// depend on it.
[[nodiscard]] std::size_t size_of_ranges(std::size_t count, const Monitor& monitor);

/// make(0) .. make(count - 1), each a small piece of work that neither waits nor throws; on one thread without writing
/// memory twice.
template <typename Make>
[[nodiscard]] auto vector_of(std::size_t count, const Monitor& monitor, const Make& make) {
  std::vector<decltype(make(std::size_t{}))> result;
  if (monitor.threads() == 1) {
    result.reserve(count);
    for (std::size_t i = 0; i < count; ++i) result.push_back(make(i));
    return result;
  }
  constexpr std::size_t kTogether = 4096;
  result.resize(count);
  parallel_for_ranges(count, kTogether, monitor, [&](std::size_t first, std::size_t last, const Monitor&) {
    for (std::size_t i = first; i < last; ++i) result[i] = make(i);
  });
  return result;
}

/// make(first, last, own) of ranges that cover 0 .. count - 1, in their order: of ranges of `size` indices, but on one
/// thread of a single one, whose result may be taken as it is. At least one.
template <typename Make>
[[nodiscard]] auto blocks_of(std::size_t count, std::size_t size, const Monitor& monitor, const Make& make) {
  std::vector<decltype(make(count, count, monitor))> result;
  if (monitor.threads() == 1 || count <= size) {
    result.push_back(make(0, count, monitor));
    return result;
  }
  result.resize((count + size - 1) / size);
  parallel_for_ranges(count, size, monitor, [&](std::size_t first, std::size_t last, const Monitor& own) {
    result[first / size] = make(first, last, own);
  });
  return result;
}

/// Calls all of these, as parallel_for does, but each may use all threads of `monitor` itself.
void parallel_calls(const Monitor& monitor, std::initializer_list<std::function<void(const Monitor& own)>> calls);

/// The monitor for work on so many vertices: of few, one thread, as starting others costs more than they save.
[[nodiscard]] inline Monitor for_vertices(std::size_t count, const Monitor& monitor) {
  constexpr std::size_t kWorthThreads = 4000;
  return count < kWorthThreads ? monitor.on_threads(1) : monitor;
}

}  // namespace nef
