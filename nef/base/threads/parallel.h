// SPDX-License-Identifier: Apache-2.0
//
// The one way in which this library uses several threads.
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>

#include "nef/base/monitor.h"

namespace nef {

/// Calls body(0, own) .. body(count - 1, own), each once, in any order, on up to `threads` threads (0: as many
/// as the machine has); one thread is a plain loop in order. Returns when all are done. `own` is the monitor of that
/// call, on whichever thread it runs: it tells only in the caller's thread, is stopped with `monitor`, and what it
/// counts goes to `monitor` at the end. If calls throw, the exception of the first of them in the order of the indices
/// arrives in the caller, whatever the number of threads, and calls behind it may be left out. If the caller is
/// interrupted, calls that have not begun are left out.
void parallel_for(std::size_t count, unsigned threads, const Monitor& monitor,
                  const std::function<void(std::size_t, const Monitor& own)>& body);

/// The same for ranges of at most `size` indices that cover 0 .. count - 1: calls body(first, last, own) for each.
void parallel_for_ranges(std::size_t count, std::size_t size, unsigned threads, const Monitor& monitor,
                         const std::function<void(std::size_t, std::size_t, const Monitor& own)>& body);

/// Calls all of these, as parallel_for does.
void parallel_calls(unsigned threads, const Monitor& monitor,
                    std::initializer_list<std::function<void(const Monitor& own)>> calls);

}  // namespace nef
