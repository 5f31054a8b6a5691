// SPDX-License-Identifier: Apache-2.0
//
// One pass makes both halves: vertices beside the plane are copied in runs, the local pyramid of a vertex in the plane
// is overlaid with the half-space of each half, and an edge that crosses the plane gets a new end in both. Ends of
// edges between copies are known, so that synthesis has only those at the plane to find; facets and volumes are linked
// when a piece becomes a leaf. Subdivision halves a piece at the median of its vertices, trying the next axis if that
// separates little, until it is within the limit. With several threads, the first pieces are made on one thread and the
// rest of the work is distributed.
#include "nef/tiles/cuts/cutter.h"

#include <algorithm>
#include <thread>

#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/complex/local_pyramid.h"
#include "nef/complex/owners.h"
#include "nef/synthesis/complex_builder.h"
#include "nef/synthesis/edge_linking.h"
#include "nef/tiles/cuts/cut_edge.h"
#include "nef/tiles/cuts/halving_plane.h"

namespace nef {
namespace {

// Of the two sides of a plane.
template <typename T>
using Sides = std::array<T, 2>;

// The planes that a loose complex uses, in the order of the table, and renames them in it. `row`: scratch, kept between
// calls for one table.
PlaneTable own_planes(const PlaneTable& all, Complex& piece, std::vector<std::uint32_t>& row) {
  std::vector<std::uint32_t> used;
  row.resize(all.size(), kNone);
  for_each_plane_of(piece, [&](PlaneId plane) {
    if (row[plane.row()] != kNone) return;
    row[plane.row()] = 0;
    used.push_back(plane.row());
  });
  std::sort(used.begin(), used.end());
  PlaneTable planes;
  planes.reserve(used.size());
  for (const std::uint32_t r : used) row[r] = planes.append_new(all, r);
  for_each_plane_of(piece, [&row](PlaneId& plane) { plane = plane.in_row(row[plane.row()]); });
  for (const std::uint32_t r : used) row[r] = kNone;
  return planes;
}

}  // namespace

// The vertices of both halves: those of the piece on that side in its order, then those on the plane, then where edges
// cross it.
class Cutter::Halves {
 public:
  Halves(const Complex& piece, PlaneTable& planes, PlaneId plane, SphereOverlay& overlay, const Monitor& monitor)
      : c_(piece),
        planes_(planes),
        plane_(plane),
        overlay_(overlay),
        monitor_(monitor),
        side_(piece.vertex_count()),
        shift_(piece.vertex_count(), 0) {
    beyond_[0].assign_circle(plane, 0, kOutside, 0);
    beyond_[1].assign_circle(plane, 0, 0, kOutside);
  }

  Sides<Complex> run() {
    for (const VertexId v : side_.ids())
      side_[v] = static_cast<std::int8_t>(side_of_plane(planes_, plane_, c_.points, point_of(v), monitor_));
    for (VertexId v{0}; v < side_.end_id();) {
      VertexId end = v.next();
      while (end < side_.end_id() && side_[end] == side_[v]) ++end;
      if (side_[v] != 0) note_copy(v, end);
      v = end;
    }
    for (std::size_t x = 0; x < 2; ++x) {
      builder_[x].copy(copies_[x], monitor_);
      copies_[x] = {};
    }
    for (const VertexId v : side_.ids()) {
      if (side_[v] == 0) add_both(c_.points, point_of(v), c_.sphere_map(v));
    }
    for (const HalfedgeId h : c_.halfedge_ids()) {
      if (side_[c_.source(h)] < 0 && side_[c_.target(h)] > 0) add_crossing(h);
    }
    return {finish(0), finish(1)};
  }

 private:
  struct Run {
    bool copied = false;
    VertexId first{0};  // in the piece
    std::uint32_t count = 0;
  };
  // Where an edge of the piece that crosses the plane ends in a half.
  struct End {
    HalfedgeId svertex{0};  // there, of the new vertex
    HalfedgeId halfedge;    // of the piece, on the way to the plane
  };

  void note_copy(VertexId first, VertexId end) {
    const std::size_t x = side_[first] < 0 ? 0 : 1;
    std::ranges::fill(shift_[IdRange(first, end)], svertices_[x] - c_.vertices[first].svertices);
    svertices_[x] += c_.vertices[end].svertices - c_.vertices[first].svertices;
    copies_[x].push_back({&c_, first, end - first, {}, {}});
    runs_[x].push_back({true, first, end - first});
  }

  void add_both(const PointTable& points, PointId point, const SphereMapView& map) {
    for (std::size_t x = 0; x < 2; ++x) {
      overlay_.overlay(planes_, map, beyond_[x].view(), keep_, half_, monitor_);
      if (builder_[x].add(points, point, half_.view())) runs_[x].push_back({false, VertexId(), 1});
    }
  }

  void add_crossing(HalfedgeId h) {
    const VertexId v = c_.source(h);
    const SphereMapView map = c_.sphere_map(v);
    const std::uint32_t position = c_.halfedges(v).position(h);
    const SVertex svertex = map.svertices[position];
    const auto point = crossing_.push_intersection(planes_, svertex.p, svertex.q, plane_);
    NEF_ASSERT(point.has_value());
    if (half_of_cut_edge(map, position, plane_, 0, half_)) {
      add_end(0, *point, h);
      half_of_cut_edge(map, position, plane_, 1, half_);
      add_end(1, *point, c_.twin[h]);
    } else {
      edge_pyramid(map, position, pyramid_);
      add_both(crossing_, *point, pyramid_.view());
      unlinked_.resize(c_.vertex_count(), 0);
      unlinked_[v] = unlinked_[c_.target(h)] = 1;
    }
    crossing_.pop();
  }

  void add_end(std::size_t x, PointId point, HalfedgeId halfedge) {
    ends_[x].push_back({builder_[x].so_far().vertices.back().svertices, halfedge});
    builder_[x].append(crossing_, point, half_.view());
    runs_[x].push_back({false, VertexId(), 1});
  }

  // The ends of edges between copies are known.
  Complex finish(std::size_t x) {
    Complex half = builder_[x].take_so_far();
    name_svertex_owners(half);
    const int side = x == 0 ? -1 : 1;
    KnownLinks known;
    known.twin.reserve(half.svertex_count());
    VertexId vertex{0};
    for (const Run& run : runs_[x]) {
      for (std::uint32_t i = 0; i < run.count; ++i, ++vertex) {
        if (run.copied ? !copy_twins(run.first + i, side, known.twin) : add_loose(half, vertex, known.twin)) {
          known.loose_vertices.push_back(vertex);
        }
      }
    }
    for (const End& end : ends_[x]) {
      const HalfedgeId halfedge = end.halfedge + shift_[c_.source(end.halfedge)];
      known.twin[end.svertex] = halfedge;
      known.twin[halfedge] = end.svertex;
    }
    std::swap(half.planes, planes_);
    link_edges(half, known, monitor_);
    std::swap(half.planes, planes_);
    return half;
  }

  // True if all are known, or will be as ends of edges across the plane.
  bool copy_twins(VertexId v, int side, IndexedVector<HalfedgeId, HalfedgeId>& twin) const {
    bool all = true;
    for (const HalfedgeId h : c_.halfedges(v)) {
      const HalfedgeId other = c_.twin[h];
      const VertexId end = c_.source(other);
      const bool kept = side_[end] == side;
      twin.push_back(kept ? other + shift_[end] : HalfedgeId());
      all = all && (kept || side_[end] == -side);
    }
    return all && (unlinked_.empty() || unlinked_[v] == 0);
  }

  static bool add_loose(const Complex& half, VertexId vertex, IndexedVector<HalfedgeId, HalfedgeId>& twin) {
    twin.resize(half.vertices[vertex.next()].svertices.index(), HalfedgeId());
    return !half.halfedges(vertex).empty();
  }

  const Complex& c_;
  PlaneTable& planes_;
  PlaneId plane_;
  SphereOverlay& overlay_;
  Monitor monitor_;
  LabelFunction keep_{kMarks, 1, [](LabelId mark, LabelId) { return mark; }};
  Sides<SphereMapBuffer> beyond_;                 // kOutside there
  IndexedVector<VertexId, std::int8_t> side_;     // of each vertex
  IndexedVector<VertexId, std::uint32_t> shift_;  // from its svertices to those of its copy, modulo 2^32
  Sides<std::vector<Run>> runs_;
  Sides<std::vector<ComplexBuilder::CopiedRun>> copies_;
  Sides<HalfedgeId> svertices_{HalfedgeId{0}, HalfedgeId{0}};  // of these copies
  Sides<std::vector<End>> ends_;
  IndexedVector<VertexId, std::uint8_t> unlinked_;  // ends of edges that cross the plane and are in no list of ends
  PointTable crossing_;                             // one
  Sides<ComplexBuilder> builder_{ComplexBuilder{planes_, monitor_}, ComplexBuilder{planes_, monitor_}};
  SphereMapBuffer half_;
  SphereMapBuffer pyramid_;
};

Complex Cutter::loose(const Complex& complex) {
  ComplexBuilder builder(planes_, monitor_);
  builder.copy(complex);
  IndexedVector<HalfedgeId, HalfedgeId> twin = complex.twin;
  if (!complex.has_box()) {
    const Complex corners = infimaximal_corners(complex.volumes[kOuterVolume].mark, monitor_);
    std::vector<std::uint32_t> rows;
    for (std::uint32_t row = 0; row < corners.planes.size(); ++row) {
      rows.push_back(planes_.intern_from(corners.planes, PlaneId::of_row(row)).row());
    }
    builder.copy(corners, rows);
    const auto shift = static_cast<std::uint32_t>(twin.size());
    for (const HalfedgeId h : corners.twin) twin.push_back(h + shift);
  }
  Complex result = builder.take_so_far();
  name_svertex_owners(result);
  result.twin = std::move(twin);
  return result;
}

std::array<Complex, 2> Cutter::cut(const Complex& piece, const AxisPlane& plane) {
  monitor_.check_interruption();
  return Halves(piece, planes_, plane.intern(planes_), overlay_, monitor_).run();
}

Complex Cutter::restricted(Complex&& piece, const Region& region) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (region.low[axis] != nullptr) piece = std::move(cut(piece, *region.low[axis])[1]);
    if (region.high[axis] != nullptr) piece = std::move(cut(piece, *region.high[axis])[0]);
  }
  return std::move(piece);
}

Complex Cutter::linked(Complex&& piece) {
  PlaneTable planes = own_planes(planes_, piece, row_);
  KnownLinks known;
  known.twin = std::move(piece.twin);
  ComplexBuilder builder(planes, monitor_);
  builder.take_vertices(std::move(piece));
  return builder.finish(kOutside, std::move(known));
}

TileRef Cutter::leaf(Complex&& piece, bool uncut) {
  const TileMeasure measure = measure_tile(piece);
  if (measure.uniform) return uniform_leaf(measure.mark);
  return tile_leaf(Polyhedron(linked(std::move(piece))), tiling_.store, uncut);
}

std::optional<Cutter::Halved> Cutter::halve(const Complex& piece) {
  for (std::size_t attempt = 0; attempt < 3 && piece.vertex_count() > tiling_.limit; ++attempt) {
    std::optional<AxisPlane> plane = halving_plane(piece, attempt);
    if (!plane) continue;
    Halved result{std::move(*plane), {}};
    result.halves = cut(piece, result.plane);
    // Where all surfaces run across the plane, nothing is gained.
    const std::size_t most = std::max(result.halves[0].vertex_count(), result.halves[1].vertex_count());
    if (most <= piece.vertex_count() - piece.vertex_count() / 8) return result;
  }
  return std::nullopt;
}

TileRef Cutter::subdivide(Complex&& piece) {
  std::optional<Halved> halved = halve(piece);
  if (!halved) return leaf(std::move(piece));
  piece = Complex();
  TileRef low = subdivide(std::move(halved->halves[0]));
  return cut_node(halved->plane, std::move(low), subdivide(std::move(halved->halves[1])));
}

namespace {

// A part of a tree that is being made: a piece, or two parts.
struct Part {
  Complex piece;
  AxisPlane plane;
  std::array<std::size_t, 2> parts{};
  bool halved = false;
  TileRef tree;
};

// Halves the first piece, then its parts, until there are so many.
std::vector<Part> first_parts(Cutter& cutter, Complex&& piece, std::size_t enough) {
  std::vector<Part> parts(1);
  parts[0].piece = std::move(piece);
  std::size_t pieces = 1;
  for (std::size_t i = 0; i < parts.size() && pieces < enough; ++i) {
    std::optional<Cutter::Halved> halved = cutter.halve(parts[i].piece);
    if (!halved) continue;
    ++pieces;
    parts[i].piece = Complex();
    parts[i].plane = std::move(halved->plane);
    parts[i].halved = true;
    for (std::size_t x = 0; x < 2; ++x) {
      parts[i].parts[x] = parts.size();
      parts.emplace_back();
      parts.back().piece = std::move(halved->halves[x]);
    }
  }
  return parts;
}

TileRef subdivided_in_parallel(Cutter& cutter, Complex&& piece, const Tiling& tiling, const Monitor& monitor) {
  constexpr std::size_t kPartsPerThread = 4;
  const unsigned threads = monitor.threads();
  const std::size_t workers = threads == 0 ? std::max(1U, std::thread::hardware_concurrency()) : threads;
  std::vector<Part> parts = first_parts(cutter, std::move(piece), kPartsPerThread * workers);
  parallel_for(parts.size(), monitor, [&](std::size_t i, const Monitor& own) {
    if (parts[i].halved) return;
    std::vector<std::uint32_t> row;
    Cutter of_part(own_planes(cutter.planes(), parts[i].piece, row), tiling, own);
    parts[i].tree = of_part.subdivide(std::move(parts[i].piece));
  });
  for (std::size_t i = parts.size(); i-- > 0;) {
    Part& part = parts[i];
    if (part.halved) part.tree = cut_node(part.plane, parts[part.parts[0]].tree, parts[part.parts[1]].tree);
  }
  return parts[0].tree;
}

}  // namespace

TileRef subdivided(const Polyhedron& set, const Tiling& tiling, const Monitor& monitor) {
  const Complex& complex = set.complex();
  if (complex.vertex_count() <= tiling.limit) return tile_leaf(set, tiling.store);
  Cutter cutter(complex.planes, tiling, monitor);
  Complex piece = cutter.loose(complex);
  TileRef tree = monitor.threads() == 1 ? cutter.subdivide(std::move(piece))
                                        : subdivided_in_parallel(cutter, std::move(piece), tiling, monitor);
  return tree.node->kind == TileNode::Kind::kTile ? tile_leaf(set, tiling.store) : tree;
}

TileRef tiles_in_region(const Polyhedron& set, const Region& region, const Tiling& tiling, const Monitor& monitor) {
  const Polyhedron all = without_labels(set, monitor);
  if (region.unbounded()) return subdivided(all, tiling, monitor);
  if (all.is_empty() || all.is_everything()) return uniform_leaf(all.is_empty() ? 0 : 1);
  Cutter cutter(all.complex().planes, tiling, monitor);
  return cutter.subdivide(cutter.restricted(cutter.loose(all.complex()), region));
}

TileRef fully_cut(const TileRef& tree, const Tiling& tiling, const Monitor& monitor) {
  TileRef result = tree;
  if (tree.node->kind == TileNode::Kind::kTile && tree.node->uncut) {
    result = subdivided(tree.node->set(), tiling, monitor);
    if (tree.complemented) result = result.complement();
  } else if (tree.node->kind == TileNode::Kind::kCut) {
    const std::array<TileRef, 2> old = children(tree);
    const std::array<TileRef, 2> cut{fully_cut(old[0], tiling, monitor), fully_cut(old[1], tiling, monitor)};
    if (cut != old) result = cut_node(tree.node->plane, cut[0], cut[1]);
  }
  return result;
}

std::array<TileRef, 2> cut_leaf(const TileRef& leaf, const AxisPlane& plane, const Tiling& tiling,
                                const Monitor& monitor) {
  const Polyhedron set = leaf.node->set();
  const Complex& complex = set.complex();
  Cutter cutter(complex.planes, tiling, monitor);
  std::array<Complex, 2> halves = cutter.cut(cutter.loose(complex), plane);
  std::array<TileRef, 2> result;
  for (std::size_t x = 0; x < 2; ++x) {
    result[x] = cutter.leaf(std::move(halves[x]));
    if (leaf.complemented) result[x] = result[x].complement();
  }
  return result;
}

}  // namespace nef
