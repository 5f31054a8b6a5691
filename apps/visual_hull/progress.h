// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "apps/visual_hull/visual_hull.h"

namespace visual_hull {

/// A progress bar on standard error; silent unless that is a terminal and the bar is wanted.
class ProgressBar {
 public:
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Shows a state, at most twenty times a second.
  void show(Phase phase, const std::string& view, std::size_t done, std::size_t total);

  /// Removes the bar.
  void clear();

 private:
  bool terminal_;
  bool shown_ = false;
  Phase last_phase_ = Phase::kLoad;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace visual_hull
