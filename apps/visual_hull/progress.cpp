// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace visual_hull {

ProgressBar::ProgressBar(bool wanted) : terminal_(wanted && isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::show(Phase phase, const std::string& view, std::size_t done, std::size_t total) {
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (shown_ && phase == last_phase_ && now - last_ < std::chrono::milliseconds(50)) return;
  shown_ = true;
  last_ = now;
  last_phase_ = phase;
  constexpr std::size_t kWidth = 30;
  const std::size_t filled = total == 0 ? 0 : done * kWidth / total;
  const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
  const std::string text = fmt::format("\r{:12} [{}] {}/{} {:.30}\x1b[K", phase_name(phase), bar, done, total, view);
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!terminal_ || !shown_) return;
  shown_ = false;
  std::fwrite("\r\x1b[K", 1, 4, stderr);
  std::fflush(stderr);
}

}  // namespace visual_hull
