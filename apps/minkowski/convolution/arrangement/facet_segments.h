// SPDX-License-Identifier: Apache-2.0
//
// Where two facets meet.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "apps/minkowski/cells/segment.h"
#include "apps/minkowski/convolution/facets/rounded_facets.h"
#include "nef/base/monitor.h"

namespace nef::minkowski {

/// Why a segment ends.
struct SegmentEnd {
  enum class Kind : std::uint8_t {
    kCorner,  ///< at the corner `index` of one facet or both
    kSide,    ///< the other facet passes through side `index` of `facet`
    kUnsure   ///< doubles can not tell
  };
  Kind kind = Kind::kUnsure;
  std::uint32_t facet = kNone;
  std::uint32_t index = kNone;
};

/// What two facets in different planes have in common: a segment, or, at ends that are not sure, perhaps less.
struct FacetSegment : Segment {  // f and g are the facets
  std::array<SegmentEnd, 2> ends;
  /// False if no region of space has both facets in front of it, with this segment between them.
  bool faces_a_region = true;
  /// True if neither facet passes through the other here: both end at the segment.
  bool is_side_of_both = false;
  /// True if nothing of f is in front of the plane of g, and the other way round.
  bool f_is_behind = false, g_is_behind = false;
};

/// Finds the segments. Not to be shared between threads.
class SegmentFinder {
 public:
  /// Facets of both kinds must outlive the object.
  SegmentFinder(const ConvolutionFacets& facets, const RoundedFacets& rounded, const Monitor& monitor)
      : facets_(facets), rounded_(rounded), monitor_(monitor) {}

  /// Nothing if the facets are in one plane or surely have less than a segment in common.
  std::optional<FacetSegment> find(std::uint32_t f, std::uint32_t g);

  /// Corners of a facet that may lie on another one, which has nothing else in common with it, of all pairs so far.
  [[nodiscard]] const std::vector<std::uint32_t>& touching_corners() const { return touching_; }

 private:
  struct ChordEnd {
    Double3 point{};
    double error = 0;
    SegmentEnd why;
  };
  struct Chord {
    std::array<ChordEnd, 2> ends;
    bool above = false, below = false;  // on which sides of the plane the facet has corners
  };
  [[nodiscard]] bool surely_apart(std::uint32_t facet, std::uint32_t other) const;
  void note_touching(std::uint32_t other);
  [[nodiscard]] bool find_chord(std::uint32_t facet, std::uint32_t other, Chord& chord);
  [[nodiscard]] ChordEnd crossing(std::uint32_t facet, std::uint32_t other, std::uint32_t side) const;
  [[nodiscard]] std::optional<FacetSegment> overlap(Chord& f, Chord& g) const;

  const ConvolutionFacets& facets_;
  const RoundedFacets& rounded_;
  Monitor monitor_;
  std::vector<int> signs_;
  std::vector<double> values_;
  std::vector<ChordEnd> found_;
  std::vector<std::uint32_t> touching_;
};

}  // namespace nef::minkowski
