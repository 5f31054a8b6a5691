// SPDX-License-Identifier: Apache-2.0
//
// The segments of each facet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/convolution/arrangement/facet_segments.h"

namespace nef::minkowski {

/// Which facets a facet has a segment with, and whether nothing of the first one is in front of the other one.
class MeetingFacets {
 public:
  struct Other {
    std::uint32_t facet = kNone;
    bool is_behind = false;
  };
  /// O(n) for n facets and segments.
  MeetingFacets(std::size_t facets, std::span<const FacetSegment> segments) : first_(facets + 1, 0) {
    for (const FacetSegment& s : segments) {
      ++first_[s.f + 1];
      ++first_[s.g + 1];
    }
    for (std::size_t f = 1; f < first_.size(); ++f) first_[f] += first_[f - 1];
    meeting_.resize(first_.back());
    std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
    for (const FacetSegment& s : segments) {
      meeting_[at[s.f]++] = {s.g, s.f_is_behind};
      meeting_[at[s.g]++] = {s.f, s.g_is_behind};
    }
  }
  /// Valid as long as the object.
  [[nodiscard]] std::span<const Other> operator()(std::uint32_t f) const {
    return std::span(meeting_).subspan(first_[f], first_[f + 1] - first_[f]);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<Other> meeting_;
};

}  // namespace nef::minkowski
