// SPDX-License-Identifier: Apache-2.0
//
// How a long computation tells how far it has come.
#pragma once

#include <cstddef>
#include <functional>

namespace nef {

/// Told what is being done, how much of it is done, and how much there is; a total of 0 means that it is not known.
using ProgressFunction = std::function<void(const char* phase, std::size_t done, std::size_t total)>;

namespace detail {
/// Who listens to the work of this thread; null if nobody does. Belongs to the ProgressListener that is alive in it.
inline thread_local const ProgressFunction* progress = nullptr;
}  // namespace detail

/// While one is alive, Booleans, topological operations and meshes that the calling thread computes tell `told` about
/// their phases, some hundred times for a large one. Always called by that thread, also where others help it; what it
/// throws ends the computation. They nest; the innermost counts.
class ProgressListener {
 public:
  /// `told` must outlive the object; an empty one: nobody listens.
  explicit ProgressListener(const ProgressFunction& told) : outer_(detail::progress) {
    detail::progress = told ? &told : nullptr;
  }
  ~ProgressListener() { detail::progress = outer_; }
  ProgressListener(const ProgressListener&) = delete;
  ProgressListener& operator=(const ProgressListener&) = delete;

 private:
  const ProgressFunction* outer_;
};

/// Tells who listens to the calling thread, if anybody does.
inline void tell_progress(const char* phase, std::size_t done, std::size_t total) {
  if (detail::progress != nullptr) (*detail::progress)(phase, done, total);
}

/// The same from a loop over many small items, now and then.
inline void tell_progress_of_item(const char* phase, std::size_t item, std::size_t total) {
  constexpr std::size_t kBetween = 4096;
  if (item % kBetween == 0) tell_progress(phase, item, total);
}

}  // namespace nef
