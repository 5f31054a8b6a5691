// SPDX-License-Identifier: Apache-2.0
//
// The pages that are open, by names that they give themselves. Each has one computation at a time and the sets that the
// last one gave, for what is asked about them afterwards.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/studio/pages/computation.h"
#include "apps/studio/pages/kept_set.h"
#include "nef/polyhedron.h"

namespace nef::studio {

/// What a computation has left: sets by name.
using Sets = std::map<std::string, KeptSet>;

class PageTable {
 public:
  /// At most so many pages are remembered, the last used ones.
  static constexpr std::size_t kMostPages = 16;
  /// At most so many pages compute at once.
  static constexpr std::size_t kMostComputations = 4;

  PageTable(unsigned threads, const ComputationLimits& limits) : threads_(threads), limits_(limits) {}

  /// Computes for a page by the thread that calls, and keeps the sets that `work` returns; without any, those that are
  /// there stay. What the page computes now is cancelled first; if a newer call comes while this one waits for that, it
  /// is Cancelled. Throws Error if too many pages compute, and what Computation::run throws.
  void compute(const std::string& page, const std::function<std::optional<Sets>(const Monitor&)>& work);

  /// Cancels what a page computes, if it does.
  void cancel(const std::string& page);
  /// Cancels everything, and refuses to compute from now on.
  void close();

  /// How far a page's computation has come; nothing if it computes nothing.
  [[nodiscard]] std::optional<Computation::Progress> progress(const std::string& page) const;
  /// A set of a page's last computation. Throws InputError if there is none of this name.
  [[nodiscard]] KeptSet set(const std::string& page, const std::string& name) const;

  /// Keeps what the layers of a page's scene were drawn from, in place of those of the scene before; `scene` is its
  /// number.
  void keep_drawn(const std::string& page, std::uint64_t scene, std::vector<Polyhedron> sources);
  /// What a layer of a page's last scene was drawn from. Throws InputError if `scene` is another one, or has no such
  /// layer.
  [[nodiscard]] Polyhedron drawn(const std::string& page, std::uint64_t scene, std::size_t layer) const;

 private:
  struct Page {
    std::uint64_t used = 0;
    std::uint64_t wanted = 0;  // the number of the last call of compute
    std::shared_ptr<Computation> running;
    Sets sets;
    std::uint64_t scene = 0;
    std::vector<Polyhedron> drawn;  // of the layers of the scene
  };

  Page& page_of(const std::string& name);

  unsigned threads_;
  ComputationLimits limits_;
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  std::map<std::string, Page> pages_;
  std::uint64_t clock_ = 0;
  std::size_t computing_ = 0;
  bool closed_ = false;
};

}  // namespace nef::studio
