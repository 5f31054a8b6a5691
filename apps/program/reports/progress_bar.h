// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace nef {

/// What a program is doing, on one line of standard error; silent unless that is a terminal. The line vanishes with
/// the object. May be called from several threads.
class ProgressBar {
 public:
  /// A bar that is not `wanted` is never shown.
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Shows a state, at most twenty times a second within one phase. A total of 0 means that it is not known.
  void show(const std::string& phase, std::size_t done = 0, std::size_t total = 0);
  /// Removes the line.
  void clear();

 private:
  bool active_;
  bool shown_ = false;
  std::string last_phase_;
  std::chrono::steady_clock::time_point last_;
  std::mutex mutex_;
};

}  // namespace nef
