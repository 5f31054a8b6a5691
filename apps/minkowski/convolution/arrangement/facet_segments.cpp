// SPDX-License-Identifier: Apache-2.0
//
// The chord of a facet is what it has in common with the plane of the other one; the segment is what the two chords
// have in common. The signs of corners come from doubles with a bound, and exactly if that does not tell; where a side
// crosses a plane is computed in doubles with its error, and an end is called unsure if several candidates are within
// their errors of each other.
#include "apps/minkowski/convolution/arrangement/facet_segments.h"

#include <algorithm>
#include <cmath>

namespace nef::minkowski {

bool SegmentFinder::surely_apart(std::uint32_t facet, std::uint32_t other) const {
  const RoundedFace& plane = rounded_.plane(other);
  bool above = true;
  bool below = true;
  for (const std::uint32_t c : facets_.ring(facet)) {
    const double value = plane.value(facets_.rounded[c]);
    above = above && value > plane.slack;
    below = below && value < -plane.slack;
  }
  return above || below;
}

// A point of a side where the plane's form is zero; it has opposite signs at the ends, each within `slack`.
SegmentFinder::ChordEnd SegmentFinder::crossing(std::uint32_t facet, std::uint32_t other, std::uint32_t side) const {
  const auto ring = facets_.ring(facet);
  const std::uint32_t next = side + 1 < ring.size() ? side + 1 : 0;
  const Double3& p = facets_.rounded[ring[side]];
  const Double3& q = facets_.rounded[ring[next]];
  const double slack = rounded_.plane(other).slack;
  const double span = std::fabs(values_[side] - values_[next]);
  // The quotient a / (a - b), at most 1, has an error of up to (slack + 2 slack) / (span - 2 slack), which is below
  // 3.5 slack / span for spans above 16 slack, and 3u of rounding. Of a shorter span nothing is known.
  double share = 0.5;
  double doubt = 0.5;
  if (span > 16 * slack) {
    share = std::clamp(values_[side] / (values_[side] - values_[next]), 0.0, 1.0);
    doubt = 4 * slack / span + 4 * kUnit;
  }
  ChordEnd end;
  double length = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    end.point[i] = p[i] + share * (q[i] - p[i]);
    length = std::max(length, std::fabs(q[i] - p[i]));
  }
  // 1.01 for the rounding of the length and of the product.
  end.error = 1.01 * length * doubt + 2 * rounded_.corner_error();
  end.why = {SegmentEnd::Kind::kSide, facet, side};
  return end;
}

// If all that a facet has in common with the plane of another one is a corner, which is not also one of that.
void SegmentFinder::note_touching(std::uint32_t other) {
  if (found_.empty()) return;
  const std::uint32_t corner = found_[0].why.index;
  const auto others = facets_.ring(other);
  if (std::find(others.begin(), others.end(), corner) != others.end()) return;
  Box box;
  box.add_rounded(facets_.rounded[corner]);
  if (box.overlaps(rounded_.box(other))) touching_.push_back(corner);
}

// What a facet has in common with the plane of another one; false if that is less than a segment.
bool SegmentFinder::find_chord(std::uint32_t facet, std::uint32_t other, Chord& chord) {
  const auto ring = facets_.ring(facet);
  const auto others = facets_.ring(other);
  const RoundedFace& plane = rounded_.plane(other);
  signs_.clear();
  values_.clear();
  for (const std::uint32_t c : ring) {
    const double value = plane.value(facets_.rounded[c]);
    int sign = value > plane.slack ? 1 : value < -plane.slack ? -1 : 0;
    if (sign == 0 && std::find(others.begin(), others.end(), c) == others.end()) {
      sign = side_of_plane(facets_.planes, facets_.plane[other], facets_.points, PointId{c}, monitor_);
    }
    values_.push_back(value);
    signs_.push_back(sign);
    chord.above = chord.above || sign > 0;
    chord.below = chord.below || sign < 0;
  }
  found_.clear();
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    if (signs_[i] == 0) {
      found_.push_back(
          {facets_.rounded[ring[i]], rounded_.corner_error(), {SegmentEnd::Kind::kCorner, facet, ring[i]}});
    } else if (signs_[i] * signs_[i + 1 < ring.size() ? i + 1 : 0] < 0) {
      found_.push_back(crossing(facet, other, i));
    }
  }
  if (found_.size() < 2) {
    note_touching(other);
    return false;
  }
  // More than two if a side in the plane has straight corners: then the ends are those that are farthest apart.
  double largest = -1;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    for (std::size_t j = i + 1; j < found_.size(); ++j) {
      double distance = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        distance = std::max(distance, std::fabs(found_[i].point[k] - found_[j].point[k]));
      }
      if (distance <= largest) continue;
      largest = distance;
      chord.ends = {found_[i], found_[j]};
    }
  }
  for (ChordEnd& end : chord.ends) {
    for (const ChordEnd& other : found_) {
      if (other.why.index == end.why.index) continue;
      double distance = 0;
      for (std::size_t k = 0; k < 3; ++k) distance = std::max(distance, std::fabs(end.point[k] - other.point[k]));
      if (distance > end.error + other.error) continue;
      end.error += distance + other.error;
      end.why = {};
    }
  }
  return true;
}

std::optional<FacetSegment> SegmentFinder::overlap(Chord& f, Chord& g) const {
  std::array<double, 2> length{};
  std::size_t axis = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double along = std::max(std::fabs(f.ends[1].point[i] - f.ends[0].point[i]),
                                  std::fabs(g.ends[1].point[i] - g.ends[0].point[i]));
    if (along > length[0]) {
      length[0] = along;
      axis = i;
    }
  }
  for (Chord* chord : {&f, &g}) {
    if (chord->ends[1].point[axis] < chord->ends[0].point[axis]) std::swap(chord->ends[0], chord->ends[1]);
  }
  FacetSegment s;
  std::array<ChordEnd, 2> ends;
  for (const std::size_t k : {0U, 1U}) {
    const ChordEnd& a = f.ends[k];
    const ChordEnd& b = g.ends[k];
    const bool same = a.why.kind == SegmentEnd::Kind::kCorner && b.why.kind == SegmentEnd::Kind::kCorner &&
                      a.why.index == b.why.index;
    const double difference = a.point[axis] - b.point[axis];
    const bool sure = same || std::fabs(difference) > a.error + b.error;
    ends[k] = (difference > 0) == (k == 0) ? a : b;
    if (!sure) {
      ends[k].why = {};
      ends[k].error = a.error + b.error + std::fabs(difference);
    }
    s.ends[k] = ends[k].why;
  }
  if (ends[0].point[axis] > ends[1].point[axis] + ends[0].error + ends[1].error) return std::nullopt;
  if (s.ends[0].kind == SegmentEnd::Kind::kCorner && s.ends[1].kind == SegmentEnd::Kind::kCorner &&
      s.ends[0].index == s.ends[1].index) {
    return std::nullopt;
  }
  if (ends[1].point[axis] - ends[0].point[axis] <= 100 * (ends[0].error + ends[1].error)) s.ends = {};
  s.from = ends[0].point;
  s.to = ends[1].point;
  s.error = std::max(ends[0].error, ends[1].error);
  return s;
}

std::optional<FacetSegment> SegmentFinder::find(std::uint32_t f, std::uint32_t g) {
  if (surely_apart(f, g) || surely_apart(g, f)) return std::nullopt;
  if (facets_.plane[f].row() == facets_.plane[g].row()) return std::nullopt;
  Chord on_f;
  Chord on_g;
  if (!find_chord(f, g, on_f) || !find_chord(g, f, on_g)) return std::nullopt;
  std::optional<FacetSegment> s = overlap(on_f, on_g);
  if (!s) return std::nullopt;
  s->f = f;
  s->g = g;
  s->f_is_behind = !on_f.above;
  s->g_is_behind = !on_g.above;
  // In the plane across the segment, facets are lines through a point or rays that end there. A region in front of both
  // has one of each as its sides: a ray in front of the other line, or two rays each of which is in front of the
  // other (a valley), or behind (a ridge).
  const bool through_f = on_f.above && on_f.below;
  const bool through_g = on_g.above && on_g.below;
  s->is_side_of_both = !through_f && !through_g;
  if (s->is_side_of_both) {
    s->faces_a_region = on_f.above == on_g.above;
  } else {
    s->faces_a_region = (through_f || on_f.above) && (through_g || on_g.above);
  }
  return s;
}

}  // namespace nef::minkowski
