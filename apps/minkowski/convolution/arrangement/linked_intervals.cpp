// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/arrangement/linked_intervals.h"

#include <algorithm>

namespace nef::minkowski {

void remove_linked(std::vector<IntervalLink> links, std::vector<SurvivingInterval>& intervals) {
  std::sort(links.begin(), links.end());
  std::vector<std::array<std::uint32_t, 2>> at(intervals.size(), {kNone, kNone});  // first link of a triple
  std::vector<std::uint32_t> gone;
  std::vector<bool> is_gone(intervals.size(), false);
  const auto go = [&](std::uint32_t first) {
    for (std::size_t i = first; i < links.size() && links[i].at == links[first].at; ++i) {
      const std::uint32_t interval = links[i].interval;
      if (interval == kNone || is_gone[interval]) continue;
      is_gone[interval] = true;
      gone.push_back(interval);
    }
  };
  for (std::uint32_t first = 0; first < links.size();) {
    std::uint32_t end = first;
    bool broken = false;
    for (; end < links.size() && links[end].at == links[first].at; ++end) {
      broken = broken || links[end].interval == kNone;
    }
    if (end - first == (links[first].smooth ? 2U : 3U)) {
      for (std::uint32_t i = first; i < end; ++i) {
        if (links[i].interval == kNone) continue;
        std::array<std::uint32_t, 2>& two = at[links[i].interval];
        (two[0] == kNone ? two[0] : two[1]) = first;
      }
      if (broken) go(first);
    }
    first = end;
  }
  while (!gone.empty()) {
    const std::uint32_t interval = gone.back();
    gone.pop_back();
    for (const std::uint32_t first : at[interval]) {
      if (first != kNone) go(first);
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (!is_gone[i]) intervals[kept++] = intervals[i];
  }
  intervals.resize(kept);
}

}  // namespace nef::minkowski
