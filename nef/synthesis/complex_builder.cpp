// SPDX-License-Identifier: Apache-2.0
//
// Vertices are appended to the arrays of a complex: the pattern of the sphere map is interned, its planes follow those
// of the vertex before. Copies of runs append whole ranges of each array, renamed if need be; each pattern of the
// source is interned once. Finishing drops an infimaximal box whose walls hold nothing but its corners (thesis 3.3) and
// planes that nothing uses, and calls `synthesize`.
#include "nef/synthesis/complex_builder.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/complex/local_pyramid.h"
#include "nef/synthesis/synthesis.h"

namespace nef {
namespace {

constexpr std::size_t kFewVertices = 16;

// A point at infinity along all three axes.
bool far_corner(const PointTable& points, PointId point) {
  for (std::size_t i = 4; i < 7; ++i) {
    if (points.coordinate(point, i).sign() == 0) return false;
  }
  return true;
}

// A corner of a box where no plane of the set arrives: an octant of one mark.
bool idle_corner(const SphereMapView& map) {
  return map.svertices.size() == 3 && map.sfaces.size() == 2 &&
         std::any_of(map.sfaces.begin(), map.sfaces.end(), [](const SFace& f) { return f.mark == kOutside; });
}

}  // namespace

void ComplexBuilder::reserve(std::size_t vertices, const VertexRecord& items, std::size_t limbs) {
  complex_.points.reserve(vertices, limbs);
  complex_.vertices.reserve(vertices + 1);
  complex_.shalfedge_plane.pairs().reserve(pair_of(items.shalfedges));
  complex_.other_planes.reserve(items.other_planes);
  complex_.sloops.reserve(items.sloops);
  // Of a few vertices each may have a pattern of its own; many share theirs.
  if (vertices <= kFewVertices) {
    complex_.patterns.reserve(vertices, items.svertices.index(), items.shalfedges.index(), items.sfaces.index());
  }
}

// Into map_. True if that is the map of a vertex.
bool ComplexBuilder::simplify(Arrangement& drawing, bool sorted) {
  if (defect_) return false;
  defect_ = detail::defect_in([&] {
    if (!sorted) drawing.sort_around_nodes(planes_, monitor_);
    drawing.simplify_and_assemble(planes_, map_, monitor_);
  });
  if (defect_) defect_->items.push_back({"vertex", complex_.vertex_count()});
  return !defect_ && is_vertex(planes_, map_.view(), monitor_);
}

bool ComplexBuilder::add(const Rational3& point, Arrangement& drawing) {
  if (!simplify(drawing, false)) return false;
  complex_.points.push(point);
  push(map_.view());
  return true;
}

bool ComplexBuilder::add(const PointTable& points, PointId point, Arrangement& drawing) {
  if (!simplify(drawing, false)) return false;
  append(points, point, map_.view());
  return true;
}

bool ComplexBuilder::add_sorted(const PointTable& points, PointId point, Arrangement& drawing) {
  if (!simplify(drawing, true)) return false;
  append(points, point, map_.view());
  return true;
}

bool ComplexBuilder::add(const std::array<PlaneId, 3>& meeting, Arrangement& drawing) {
  if (!simplify(drawing, false)) return false;
  const auto point = complex_.points.push_intersection(planes_, meeting[0], meeting[1], meeting[2]);
  NEF_ASSERT(point.has_value());
  push(map_.view());
  return true;
}

bool ComplexBuilder::add(const PointTable& points, PointId point, const SphereMapView& map) {
  if (defect_ || !is_vertex(planes_, map, monitor_)) return false;
  append(points, point, map);
  return true;
}

void ComplexBuilder::append(const PointTable& points, PointId point, const SphereMapView& map) {
  complex_.points.push_from(points, point);
  push(map);
}

bool ComplexBuilder::append_like(const PointTable& points, PointId point, VertexId like,
                                 std::span<const PlaneId> planes) {
  monitor_.check_interruption();
  if (defect_) return false;
  Complex& c = complex_;
  const VertexRecord& begin = c.vertices[like];
  const VertexRecord& end = c.vertices[like.next()];
  NEF_ASSERT(2 * planes.size() == end.shalfedges - begin.shalfedges && end.sloops == begin.sloops &&
             end.other_planes == begin.other_planes);
  VertexRecord next = c.vertices.back();
  next.advance(begin, end);
  c.points.push_from(points, point);
  c.shalfedge_plane.pairs().insert(c.shalfedge_plane.pairs().end(), planes.begin(), planes.end());
  c.vertices.add(begin.pattern, next);
  return true;
}

void ComplexBuilder::push(const SphereMapView& map) {
  Complex& c = complex_;
  VertexRecord end = c.vertices.back();
  const PatternId pattern = interner_.intern(c.patterns, map, c.shalfedge_plane.pairs(), c.other_planes);
  c.sloops.insert(c.sloops.end(), map.sloops.begin(), map.sloops.end());
  end.svertices += static_cast<std::uint32_t>(map.svertices.size());
  end.shalfedges += static_cast<std::uint32_t>(map.shalfedges.size());
  end.sloops += static_cast<std::uint32_t>(map.sloops.size());
  end.sfaces += static_cast<std::uint32_t>(map.sfaces.size());
  end.other_planes = static_cast<std::uint32_t>(c.other_planes.size());
  c.vertices.add(pattern, end);
}

void ComplexBuilder::copy(const Complex& from, VertexId first, std::uint32_t count, std::span<const std::uint32_t> rows,
                          std::span<const LabelId> marks) {
  const CopiedRun run{&from, first, count, rows, marks};
  copy(std::span(&run, 1), monitor_);
}

// Patterns keep their places for planes, so only where items begin changes, and the names of planes and marks. Each
// array depends on nothing but the same array of the other complexes.
void ComplexBuilder::copy(std::span<const CopiedRun> runs, const Monitor& monitor) {
  const auto all = [runs](const auto& copy_run) {
    for (const CopiedRun& run : runs) copy_run(run);
  };
  std::size_t vertices = 0;
  for (const CopiedRun& run : runs) vertices += run.count;
  // The longest array first.
  parallel_calls(for_vertices(vertices, monitor),
                 {[&](const Monitor&) { copy_records(runs); },
                  [&](const Monitor&) {
                    all([this](const CopiedRun& run) {
                      complex_.points.append(run.from->points, point_of(run.first).index(), run.count);
                    });
                  },
                  [&](const Monitor&) { all([this](const CopiedRun& run) { copy_planes(run); }); },
                  [&](const Monitor&) { all([this](const CopiedRun& run) { copy_sloops(run); }); }});
}

namespace {

// Appends a range of items, changed by `change`, in blocks that stay in a fast cache meanwhile.
template <typename Item, typename Change>
void copy_changed(const std::vector<Item>& from, std::uint32_t begin, std::uint32_t end, std::vector<Item>& to,
                  const Change& change) {
  constexpr std::uint32_t kBlock = 4096;
  while (begin < end) {
    const std::uint32_t count = std::min(kBlock, end - begin);
    const std::size_t base = to.size();
    to.insert(to.end(), from.begin() + begin, from.begin() + begin + count);
    for (Item& item : std::span(to).subspan(base)) change(item);
    begin += count;
  }
}

// What the patterns of some complexes become, found when they are first met. Few vertices do not deserve a list.
class PatternsOfRuns {
 public:
  PatternsOfRuns(PatternInterner& interner, PatternTable& table) : interner_(interner), table_(table) {}

  void set(const ComplexBuilder::CopiedRun& run) {
    run_ = &run;
    const auto same = [&run](const List& list) { return list.from == run.from && list.marks == run.marks.data(); };
    auto at = std::find_if(lists_.begin(), lists_.end(), same);
    if (at == lists_.end()) at = lists_.insert(lists_.end(), {run.from, run.marks.data(), 0, {}});
    at->vertices += run.count;
    if (at->to.empty() && at->vertices >= run.from->patterns.size()) at->to.resize(run.from->patterns.size());
    list_ = &*at;
  }

  PatternId operator()(PatternId pattern) {
    if (list_->to.empty()) return interner_.intern(table_, run_->from->patterns, pattern, run_->marks);
    PatternId& to = list_->to[pattern.index()];
    if (!to.valid()) to = interner_.intern(table_, run_->from->patterns, pattern, run_->marks);
    return to;
  }

 private:
  struct List {
    const Complex* from;
    const LabelId* marks;
    std::size_t vertices;  // that have asked so far
    std::vector<PatternId> to;
  };

  PatternInterner& interner_;
  PatternTable& table_;
  std::vector<List> lists_;
  const ComplexBuilder::CopiedRun* run_ = nullptr;
  List* list_ = nullptr;
};

}  // namespace

void ComplexBuilder::copy_planes(const CopiedRun& run) {
  const auto with_rows = [rows = run.rows](PlaneId& plane) {
    if (!rows.empty()) plane = plane.in_row(rows[plane.row()]);
  };
  const VertexRecord& begin = run.from->vertices[run.first];
  const VertexRecord& end = run.from->vertices[run.first + run.count];
  copy_changed(run.from->shalfedge_plane.pairs(), pair_of(begin.shalfedges), pair_of(end.shalfedges),
               complex_.shalfedge_plane.pairs(), with_rows);
  copy_changed(run.from->other_planes, begin.other_planes, end.other_planes, complex_.other_planes, with_rows);
}

void ComplexBuilder::copy_sloops(const CopiedRun& run) {
  const auto change = [&run](SLoop& loop) {
    if (!run.rows.empty()) loop.plane = loop.plane.in_row(run.rows[loop.plane.row()]);
    if (!run.marks.empty() && loop.mark != kOutside) loop.mark = run.marks[loop.mark];
  };
  copy_changed(run.from->sloops, run.from->vertices[run.first].sloops, run.from->vertices[run.first + run.count].sloops,
               complex_.sloops, change);
}

void ComplexBuilder::copy_records(std::span<const CopiedRun> runs) {
  PatternsOfRuns patterns(interner_, complex_.patterns);
  for (const CopiedRun& run : runs) {
    patterns.set(run);
    const VertexTable& records = run.from->vertices;
    const VertexRecord first = records[run.first];
    const VertexRecord base = complex_.vertices.back();
    for (VertexId v = run.first; v < run.first + run.count; ++v) {
      VertexRecord next = base;
      next.advance(first, records[v.next()]);
      complex_.vertices.add(patterns(records[v].pattern), next);
    }
  }
}

void ComplexBuilder::take_vertices(Complex&& from) {
  complex_ = Complex();
  complex_.points = std::move(from.points);
  complex_.vertices = std::move(from.vertices);
  complex_.patterns = std::move(from.patterns);
  complex_.shalfedge_plane = std::move(from.shalfedge_plane);
  complex_.other_planes = std::move(from.other_planes);
  complex_.sloops = std::move(from.sloops);
  interner_.reset();
}

Complex ComplexBuilder::take_so_far() {
  interner_.reset();
  return std::exchange(complex_, Complex());
}

// A box whose walls hold nothing but its eight corners says only what the outer volume is: the
// set is finitely bounded, or its complement is.
bool ComplexBuilder::has_idle_box() const {
  const Complex& c = complex_;
  std::size_t infinite = 0;
  for (const VertexId v : c.vertex_ids()) {
    if (c.points.finite(point_of(v))) continue;
    // Eight octants are not enough: a plane may cut through all of the box.
    if (!far_corner(c.points, point_of(v)) || !idle_corner(c.sphere_map(v))) return false;
    ++infinite;
  }
  return infinite == 8;
}

void ComplexBuilder::drop_idle_box(LabelId& outer) {
  if (!has_idle_box()) return;
  const Complex& c = complex_;
  ComplexBuilder kept(planes_, monitor_);
  kept.reserve(c.vertex_count(), c.vertices.back(), c.points.limbs());
  const VertexId end{c.vertex_count()};
  VertexId first{0};  // of the run of finite vertices
  for (VertexId v{0}; v <= end; ++v) {
    if (v < end && c.points.finite(point_of(v))) continue;
    if (first < v) kept.copy(c, first, v - first);
    first = v.next();
    if (v < end) outer = c.mark(v);
  }
  complex_ = kept.take_so_far();
  interner_.reset();
}

// Cascades would otherwise carry the planes of everything that ever was.
void ComplexBuilder::drop_idle_planes() {
  Complex& c = complex_;
  std::vector<std::uint8_t> used(planes_.size(), 0);
  for_each_plane_of(c, [&used](PlaneId plane) { used[plane.row()] = 1; });
  if (std::find(used.begin(), used.end(), 0) == used.end()) return;
  std::vector<std::uint32_t> row(used.size(), kNone);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    if (used[i] != 0) row[i] = count++;
  }
  for_each_plane_of(c, [&row](PlaneId& plane) { plane = plane.in_row(row[plane.row()]); });
  planes_.keep(used);
}

Complex ComplexBuilder::take() {
  if (defect_) throw detail::BrokenInvariant(std::move(*defect_));
  planes_.trim();  // before the links need room
  complex_.planes = std::move(planes_);
  return std::move(complex_);
}

Complex ComplexBuilder::finish(LabelId outer) {
  drop_idle_box(outer);
  drop_idle_planes();
  return finish_unreduced(outer);
}

Complex ComplexBuilder::finish_unreduced(LabelId outer) {
  Complex complex = take();
  synthesize(complex, outer, monitor_);
  complex.trim();
  return complex;
}

Complex ComplexBuilder::finish(LabelId outer, KnownLinks&& known) {
  Complex complex = take();
  synthesize(complex, outer, std::move(known), monitor_);
  complex.trim();
  return complex;
}

namespace {

template <typename Finish>
std::variant<Complex, Defect> complex_or_defect(Finish&& finish) {
  std::variant<Complex, Defect> made(std::in_place_type<Defect>);
  std::optional<Defect> defect = detail::defect_in([&] { made.emplace<Complex>(finish()); });
  if (defect) made = std::move(*defect);
  return made;
}

}  // namespace

std::variant<Complex, Defect> ComplexBuilder::try_finish(LabelId outer) {
  return complex_or_defect([&] { return finish(outer); });
}

std::variant<Complex, Defect> ComplexBuilder::try_finish(LabelId outer, KnownLinks&& known) {
  return complex_or_defect([&] { return finish(outer, std::move(known)); });
}

std::variant<Complex, Defect> ComplexBuilder::try_finish_unreduced(LabelId outer) {
  return complex_or_defect([&] { return finish_unreduced(outer); });
}

}  // namespace nef
