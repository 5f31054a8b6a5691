// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/minkowski/convolution/nearest_outside.h"
#include "apps/minkowski/decomposition/decomposition.h"
#include "apps/minkowski/morphology.h"
#include "apps/minkowski/part_of_sum.h"
#include "nef/base/error.h"
#include "nef/base/timing/phase_timer.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/distance/distance.h"
#include "nef/distance/intersects.h"
#include "nef/geometry/vectors.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

struct Candidate {
  Rational squared_length;
  Rational3 point;
};

Rational3 times(const Rational& s, const Rational3& a) {
  return {Rational(s * a[0]), Rational(s * a[1]), Rational(s * a[2])};
}

// The points of the planes of facets, of the lines of edges, and of vertices that are nearest to the origin. The point
// of the boundary that is nearest to it is one of them.
std::vector<Candidate> candidates(const Complex& c) {
  std::vector<Candidate> result;
  const auto add = [&](Rational3 p) {
    Rational square = dot(p, p);
    result.push_back({std::move(square), std::move(p)});
  };
  std::vector<PlaneId> planes;
  for (const Facet& f : c.facets) planes.push_back(f.plane);
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  for (const PlaneId plane : planes) {
    Rational3 n;
    for (std::size_t i = 0; i < 3; ++i) n[i] = Rational(c.planes.oriented_coefficient(plane, i));
    add(times(-Rational(c.planes.oriented_coefficient(plane, 3)) / dot(n, n), n));
  }
  for (const VertexId v : c.vertex_ids()) add(c.points.rational(point_of(v)));
  for (const HalfedgeId h : c.halfedge_ids()) {
    if (h > c.twin[h]) continue;
    const Rational3& p = result[planes.size() + c.source(h).index()].point;
    const Rational3& q = result[planes.size() + c.target(h).index()].point;
    const Rational3 d = {Rational(q[0] - p[0]), Rational(q[1] - p[1]), Rational(q[2] - p[2])};
    const Rational3 along = times(-dot(p, d) / dot(d, d), d);
    add({Rational(p[0] + along[0]), Rational(p[1] + along[1]), Rational(p[2] + along[2])});
  }
  return result;
}

// The shortest candidate that is not in an open bounded set.
Candidate shortest(const Polyhedron& set, const Monitor& monitor) {
  std::vector<Candidate> all = candidates(set.complex());
  std::sort(all.begin(), all.end(),
            [](const Candidate& a, const Candidate& b) { return a.squared_length < b.squared_length; });
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Candidate& c) { return !contains(set, c.point, monitor); });
  NEF_ASSERT(found != all.end());  // a vertex
  return *found;
}

// The nearest point to the origin that is not in A + B.
Candidate way_out(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options, MinkowskiReport& report) {
  std::string why;
  if (options.strategy == UnionStrategy::kAuto) {
    const Stopwatch watch;
    const PhaseTimer phase(report.seconds_union, report.predicates_union, options.monitor);
    const PartOfSum whole(phase.monitor());
    std::optional<NearestOutside> found = nearest_outside(a, b, why, whole.monitor());
    report.seconds_total += watch.seconds();
    if (found) {
      report.convolution_facets += found->facets;
      report.convolution_points += found->candidates;
      report.convolution_regions += found->tested;
      report.choices.push_back({"convolution", "depth found from facets near the origin"});
      return {std::move(found->squared), std::move(found->point)};
    }
  }
  const Polyhedron sum = minkowski_sum(a, b, options, &report);
  if (!why.empty()) report.choices.back().why += "; the whole sum was made since " + why;
  return shortest(sum, options.monitor);
}

}  // namespace

Penetration penetration(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                        MinkowskiReport* report) {
  if (a.is_empty() || b.is_empty()) throw InputError("one of the two sets is empty: there is nothing to separate");
  require_bounded(a, "the first set");
  require_bounded(b, "the second set");
  const Monitor& monitor = options.monitor;
  MinkowskiReport unused;
  MinkowskiReport& r = report != nullptr ? *report : unused;
  Penetration result;
  const Polyhedron inside_a = interior(regularize(a, monitor), monitor);
  const Polyhedron inside_b = interior(regularize(b, monitor), monitor);
  if (intersects(inside_a, inside_b, Rational3(), monitor)) {
    const Candidate out = way_out(inside_a, negate(inside_b, monitor), options, r);
    result.kind = Penetration::Kind::kOverlapping;
    result.translation = out.point;
    result.squared_length = out.squared_length;
    return result;
  }
  r.choices.push_back({"none", "the sets do not overlap: their distance is the answer"});
  const std::optional<Distance> apart = distance(a, b, monitor);
  NEF_ASSERT(apart.has_value());  // neither set is empty
  if (apart->contact != Contact::kDisjoint) {
    result.kind = Penetration::Kind::kTouching;
    return result;
  }
  result.translation = minus(apart->on_a, apart->on_b);
  result.squared_length = apart->squared;
  return result;
}

}  // namespace nef::minkowski
