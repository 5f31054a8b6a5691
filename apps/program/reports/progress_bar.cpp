// SPDX-License-Identifier: Apache-2.0
#include "apps/program/reports/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace nef {

ProgressBar::ProgressBar(bool wanted) : active_(wanted && isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::show(const std::string& phase, std::size_t done, std::size_t total) {
  if (!active_) return;
  const std::scoped_lock lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (shown_ && phase == last_phase_ && now - last_ < std::chrono::milliseconds(50)) return;
  shown_ = true;
  last_ = now;
  last_phase_ = phase;
  std::cerr << '\r' << phase;
  if (total > 0) {
    constexpr std::size_t kWidth = 30;
    const std::size_t filled = std::min(done, total) * kWidth / total;
    std::cerr << " [" << std::string(filled, '#') << std::string(kWidth - filled, '.') << "] " << done << '/' << total;
  }
  std::cerr << "\x1b[K" << std::flush;
}

void ProgressBar::clear() {
  const std::scoped_lock lock(mutex_);
  if (!shown_) return;
  shown_ = false;
  std::cerr << "\r\x1b[K" << std::flush;
}

}  // namespace nef
