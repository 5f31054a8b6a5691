// SPDX-License-Identifier: Apache-2.0
//
// One run of the pipeline, as its steps see it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull {

using Views = std::vector<ViewResult>;

/// What every step needs to know about the run.
struct Run {
  const Options& options;
  /// Tells the monitor of the run. All steps have a monitor that does not tell by itself, since what is told is about
  /// views, not about the operations on their sets.
  nef::ProgressFunction show;

  /// The options must outlive it.
  Run(const Options& its_options, const nef::Monitor& monitor);

  /// Tells that so much of a phase is done, of one view or of all (an empty name). By the thread of the run.
  void tell(Phase phase, const std::string& view, std::size_t done, std::size_t total) const;

  /// body(i, own) for every view, on as many threads as the user allows.
  void each_view(Phase phase, const Views& views, const nef::Monitor& monitor,
                 const std::function<void(std::size_t, const nef::Monitor& own)>& body) const;
};

}  // namespace nef::visual_hull
