// SPDX-License-Identifier: Apache-2.0
//
// The regions around all candidate points are joined by union-find over the intervals that lead from one to another.
// Regions just behind a facet are inside, and so are regions around a point that surely is; one point of each region
// that is left is tested by the definition, in blocks, on several threads. Then the boundary gets its marks, if the sum
// need not be closed (`BoundaryMarker`), and the points become vertices of a complex.
#include "apps/minkowski/convolution/convolution_regions.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "apps/minkowski/convolution/marks/boundary_marker.h"
#include "apps/minkowski/convolution/marks/direction_into.h"
#include "apps/minkowski/convolution/region_vertices.h"
#include "apps/minkowski/part_of_sum.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/union_find.h"
#include "nef/complex/local_pyramid.h"
#include "nef/sphere_map/sphere_geometry.h"
#include "nef/synthesis/complex_builder.h"

namespace nef::minkowski {
namespace {

// The sfaces around all vertices, and which of them are one region.
struct Regions {
  std::vector<std::uint32_t> first;  // of each vertex
  UnionFind same{0};
};

// True if an arc on the great circle of a plane ends at an svertex.
bool ends_on(const SphereMapView& map, std::uint32_t svertex, PlaneId plane) {
  const std::uint32_t first = map.svertices[svertex].out;
  if (first == kNone) return false;
  std::uint32_t e = first;
  do {
    if (map.shalfedges[e].plane.row() == plane.row()) return true;
    e = map.next_around(e);
  } while (e != first);
  return false;
}

// The svertex in the direction of a segment, or against it. Both facets of the segment go on there, so it is one of the
// two points in which their great circles meet, and arcs on both of them end there.
std::uint32_t svertex_along(const ConvolutionFacets& facets, const RegionVertex& v, const FacetSegment& s, bool forward,
                            const Monitor& monitor) {
  const Direction d = Direction::cross(facets.planes, facets.plane[s.f], facets.plane[s.g]);
  double along = 0;
  for (std::size_t i = 0; i < 3; ++i) along += d.approximate[i] * (s.to[i] - s.from[i]);
  const int side = (along > 0) == forward ? 1 : -1;
  const SphereMapView map = v.map.view();
  for (std::uint32_t i = 0; i < map.svertices.size(); ++i) {
    if (!ends_on(map, i, facets.plane[s.f]) || !ends_on(map, i, facets.plane[s.g])) continue;
    if (sign_of_dot(direction_of(facets.planes, map.svertices[i]), d, monitor) == side) return i;
  }
  return kNone;
}

// Two sfaces of different vertices, counted over all of them.
using SamePair = std::array<std::uint32_t, 2>;

// The same half-planes leave both ends of the interval, and the same regions lie between them. Seen from the other end
// a half-plane is that of the opposite plane, and has the region on its other side.
void find_same(const ConvolutionFacets& facets, const SurvivingIntervals& intervals, const RegionVertices& found,
               const RegionJoint& joint, const std::vector<std::uint32_t>& first_sface, std::vector<SamePair>& same,
               const Monitor& monitor) {
  const FacetSegment& s = intervals.segments[joint.segment];
  const RegionVertex& from = found.vertices[joint.from];
  const RegionVertex& to = found.vertices[joint.to];
  const std::uint32_t here = svertex_along(facets, from, s, true, monitor);
  const std::uint32_t there = svertex_along(facets, to, s, false, monitor);
  if (here == kNone || there == kNone) return;
  const SphereMapView a = from.map.view();
  const SphereMapView b = to.map.view();
  const std::uint32_t first = a.svertices[here].out;
  const std::uint32_t first_there = b.svertices[there].out;
  std::uint32_t e = first;
  do {
    std::uint32_t h = first_there;
    do {
      if (b.shalfedges[h].plane == a.shalfedges[e].plane.opposite()) {
        same.push_back(
            {first_sface[joint.from] + a.shalfedges[e].sface, first_sface[joint.to] + b.shalfedges[h ^ 1U].sface});
      }
      h = b.next_around(h);
    } while (h != first_there);
    e = a.next_around(e);
  } while (e != first);
}

Regions joined_regions(const ConvolutionFacets& facets, const SurvivingIntervals& intervals,
                       const RegionVertices& found, const Monitor& monitor) {
  Regions regions;
  std::uint32_t count = 0;
  for (const RegionVertex& v : found.vertices) {
    regions.first.push_back(count);
    count += static_cast<std::uint32_t>(v.map.sfaces.size());
  }
  regions.same.reset(count);
  constexpr std::size_t kChunk = 1024;
  std::vector<std::vector<SamePair>> same((found.joints.size() + kChunk - 1) / kChunk);
  parallel_for_ranges(found.joints.size(), kChunk, monitor, [&](std::size_t from, std::size_t to, const Monitor& own) {
    for (std::size_t i = from; i < to; ++i) {
      find_same(facets, intervals, found, found.joints[i], regions.first, same[from / kChunk], own);
    }
  });
  for (const std::vector<SamePair>& pairs : same) {
    for (const auto& [a, b] : pairs) regions.same.unite(a, b);
  }
  return regions;
}

// An sface of a vertex.
struct RegionPlace {
  std::uint32_t vertex = 0, sface = 0;
};

// For each place whether its vertex surely lies in the inside of the sum: then so does all that is around it. In
// doubles, without a point of the region, and without an exact question. Neighbours often have a crossing in common.
std::vector<std::uint8_t> surely_inside(const ConvolutionFacets& facets, const SumMembership& membership,
                                        const std::vector<RegionVertex>& vertices,
                                        const std::vector<RegionPlace>& places, const Monitor& monitor) {
  constexpr std::size_t kChunk = 64;
  std::vector<std::uint8_t> result(places.size(), 0);
  parallel_for((places.size() + kChunk - 1) / kChunk, monitor, [&](std::size_t chunk, const Monitor& own) {
    IntersectionQuery::Crossings recent;
    const std::size_t first = chunk * kChunk;
    for (std::size_t k = first; k < std::min(places.size(), first + kChunk); ++k) {
      if (k > first && places[k].vertex == places[k - 1].vertex) {
        result[k] = result[k - 1];
        continue;
      }
      const Approximation3 x = near_point(facets.points, vertices[places[k].vertex].point);
      result[k] = membership.surely_in_inside(x, recent, true, own) ? 1 : 0;
    }
  });
  return result;
}

struct RegionsInside {
  std::vector<std::uint8_t> inside;  // of each sface
  std::size_t tested = 0;            // regions
};

// For each region around a vertex whether it is inside.
RegionsInside regions_inside(const ConvolutionFacets& facets, const FacetPyramids& pyramids,
                             const SumMembership& membership, const std::vector<RegionVertex>& vertices,
                             Regions& regions, const Monitor& monitor) {
  enum : std::uint8_t { kOut, kIn, kUnknown, kAsked };
  std::vector<std::uint8_t> state(regions.same.size(), kUnknown);
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const RegionVertex& v = vertices[i];
    for (std::uint32_t f = 0; f < v.map.sfaces.size(); ++f) {
      if (v.map.sfaces[f].mark != 0) state[regions.same.find(regions.first[i] + f)] = kIn;
    }
  }
  std::vector<RegionPlace> places;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i].is_plain) continue;  // regions of such points alone make no difference
    for (std::uint32_t f = 0; f < vertices[i].map.sfaces.size(); ++f) {
      std::uint8_t& of_region = state[regions.same.find(regions.first[i] + f)];
      if (of_region != kUnknown) continue;
      of_region = kAsked;
      places.push_back({i, f});
    }
  }
  const std::vector<std::uint8_t> inside = surely_inside(facets, membership, vertices, places, monitor);
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (inside[k] != 0) state[regions.same.find(regions.first[places[k].vertex] + places[k].sface)] = kIn;
  }
  struct Question {
    std::uint32_t region = 0;
    Rational3 point;
  };
  std::vector<Question> questions;
  for (const auto& [vertex, f] : places) {
    const RegionVertex& v = vertices[vertex];
    const std::uint32_t region = regions.same.find(regions.first[vertex] + f);
    if (state[region] != kAsked) continue;
    const Direction into =
        v.map.view().trivial() ? Direction::exact(1, 0, 0) : direction_into(facets.planes, v.map.view(), f, monitor);
    Rational3 point = pyramids.point_towards(facets.points, v.point, into, monitor);
    const Double3 near = nearest_doubles(point);
    if (facets.covered.cover({&near, 1})) {
      state[region] = kIn;
    } else {
      questions.push_back({region, std::move(point)});
    }
  }
  constexpr std::size_t kBlock = 64;
  for (std::size_t first = 0; first < questions.size(); first += kBlock) {
    monitor.tell_progress(kSumPhase, first, questions.size());
    parallel_for(std::min(kBlock, questions.size() - first), monitor, [&](std::size_t k, const Monitor& own) {
      const Question& q = questions[first + k];
      state[q.region] = membership.in_closure(q.point, own) ? kIn : kOut;
    });
  }
  for (std::uint32_t r = 0; r < state.size(); ++r) state[r] = state[regions.same.find(r)];
  return {std::move(state), questions.size()};
}

// Items that were put to the definition, and those of them that are not in the sum.
struct MarkedItems {
  std::size_t tested = 0, missing = 0;
};

// Marks all items around all vertices.
MarkedItems mark_boundary(const ConvolutionFacets& facets, const FacetPyramids& pyramids,
                          const SumMembership& membership, const Regions& regions,
                          const std::vector<std::uint8_t>& inside, std::vector<RegionVertex>& vertices,
                          const Monitor& monitor) {
  BoundaryMarker marker(pyramids, facets, monitor);
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    RegionVertex& v = vertices[i];
    for (std::uint32_t f = 0; f < v.map.sfaces.size(); ++f) v.map.sfaces[f].mark = inside[regions.first[i] + f];
    if (facets.marks == BoundaryMarks::kAll) {
      for (SHalfedge& e : v.map.shalfedges) e.mark = 1;
      for (SLoop& l : v.map.sloops) l.mark = 1;
      for (SVertex& s : v.map.svertices) s.mark = 1;
      v.map.mark = 1;
    } else {
      marker.mark(v.point, v.is_saddle_point, v.map);
    }
  }
  const std::size_t missing = marker.answer(membership);
  return {marker.tested(), missing};
}

// Draws the regions around points anew, with their marks, in the unique form. Not to be shared between threads.
class VertexDrawer {
 public:
  // The planes must outlive the object.
  explicit VertexDrawer(const PlaneTable& planes) : planes_(planes) {}

  // False if the sum has no vertex at the point.
  bool draw(RegionVertex& v, bool is_closed, const Monitor& monitor) {
    if (v.is_plain) return false;
    const auto is_inside = [](const SFace& f) { return f.mark != 0; };
    if (is_closed && std::all_of(v.map.sfaces.begin(), v.map.sfaces.end(), is_inside)) return false;
    drawing_.load(planes_, v.map.view());
    drawing_.sort_around_nodes(planes_, monitor);
    drawing_.simplify_and_assemble(planes_, v.map, monitor);
    return is_vertex(planes_, v.map.view(), monitor);
  }

 private:
  const PlaneTable& planes_;
  Arrangement drawing_;
};

// Consecutive points that are vertices, as parts of a complex. The drawings are freed.
Complex part_of_complex(const ConvolutionFacets& facets, PlaneTable& planes, std::span<RegionVertex> vertices,
                        const Monitor& monitor) {
  const bool is_closed = facets.marks == BoundaryMarks::kAll;
  VertexDrawer drawer(planes);
  ComplexBuilder builder(planes, monitor);
  for (RegionVertex& v : vertices) {
    if (drawer.draw(v, is_closed, monitor)) builder.append(facets.points, v.point, v.map.view());
    v.map = SphereMapBuffer();
  }
  return builder.take_so_far();
}

Complex complex_of(const ConvolutionFacets& facets, PlaneTable& planes, std::vector<RegionVertex>& vertices,
                   const Monitor& monitor) {
  constexpr std::size_t kRange = 1024;
  std::vector<Complex> parts((vertices.size() + kRange - 1) / kRange);
  parallel_for_ranges(vertices.size(), kRange, monitor, [&](std::size_t from, std::size_t to, const Monitor& own) {
    parts[from / kRange] = part_of_complex(facets, planes, std::span(vertices).subspan(from, to - from), own);
  });
  std::vector<ComplexBuilder::CopiedRun> runs;
  for (const Complex& part : parts) runs.push_back({&part, VertexId{0}, part.vertex_ids().size(), {}, {}});
  ComplexBuilder builder(planes, monitor);
  builder.copy(runs, monitor);
  parts.clear();
  return builder.finish(0);
}

}  // namespace

SumOfRegions sum_of_regions(ConvolutionFacets& facets, const RoundedFacets& rounded, const BoxTree& tree,
                            const SharedSides& at_side, const SurvivingIntervals& intervals,
                            const SumMembership& membership, std::span<const SaddlePoint> saddles,
                            const Monitor& monitor) {
  // Shares of the time are measured, for the bar only.
  const PartOfSum points(monitor, 0, 0.4);
  const PartOfSum tests(monitor, 0.4, 0.8);
  const PartOfSum marks(monitor, 0.8, 0.95);
  const FacetPyramids pyramids(facets, rounded, at_side, tree, monitor);
  const FacetArrangement arrangement{facets, rounded, tree, pyramids, at_side, intervals, membership};
  RegionVertices found = region_vertices(arrangement, facets, saddles, points.monitor());
  Regions regions = joined_regions(facets, intervals, found, monitor);
  const RegionsInside known = regions_inside(facets, pyramids, membership, found.vertices, regions, tests.monitor());
  const MarkedItems items =
      mark_boundary(facets, pyramids, membership, regions, known.inside, found.vertices, marks.monitor());
  SumOfRegions result{complex_of(facets, facets.planes, found.vertices, monitor), found.points,
                      known.tested + items.tested, items.missing};
  monitor.tell_progress(kSumPhase, 1, 1);
  return result;
}

}  // namespace nef::minkowski
