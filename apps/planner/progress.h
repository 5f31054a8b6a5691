// SPDX-License-Identifier: Apache-2.0
//
// What long work tells about itself, and a bar that shows it.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace nef::planner {

/// Called with what is being done and how much of it is done; a total of 0 means that it is not known. From one thread
/// at a time.
using Progress = std::function<void(const std::string& phase, std::size_t done, std::size_t total)>;

/// A progress bar on standard error; silent unless that is a terminal. It vanishes with the object.
class ProgressBar {
 public:
  /// A bar that is not `wanted` is never shown.
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Shows a state, at most twenty times a second within one phase.
  void show(const std::string& phase, std::size_t done, std::size_t total);
  /// Removes the bar.
  void clear();

 private:
  bool active_;
  bool shown_ = false;
  std::string last_phase_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace nef::planner
