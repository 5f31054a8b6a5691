// SPDX-License-Identifier: Apache-2.0
#include "nef/synthesis/complex_builder.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/base/parallel.h"
#include "nef/complex/local_pyramid.h"
#include "nef/synthesis/synthesis.h"

namespace nef {
namespace {

void rename(PlaneId& plane, std::span<const std::uint32_t> rows) {
  plane = PlaneId{rows[plane.row()] << 1U | (plane.value & 1U)};
}

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
  complex_.svertices.reserve(items.svertices);
  complex_.shalfedges.reserve(items.shalfedges);
  complex_.sloops.reserve(items.sloops);
  complex_.sfaces.reserve(items.sfaces);
  complex_.entries.reserve(items.entries);
}

// Into map_. True if that is the map of a vertex.
bool ComplexBuilder::simplify(Arrangement& drawing, bool sorted) {
  if (defect_) return false;
  defect_ = detail::defect_in([&] {
    if (!sorted) drawing.sort_around_nodes(planes_);
    drawing.simplify_and_assemble(planes_, map_);
  });
  if (defect_) defect_->items.push_back({"vertex", complex_.vertex_count()});
  return !defect_ && is_vertex(planes_, map_.view());
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
  if (defect_ || !is_vertex(planes_, map)) return false;
  append(points, point, map);
  return true;
}

void ComplexBuilder::append(const PointTable& points, PointId point, const SphereMapView& map) {
  complex_.points.push_from(points, point);
  push(map);
}

void ComplexBuilder::push(const SphereMapView& map) {
  Complex& c = complex_;
  c.vertices.back().mark = map.mark;
  c.svertices.insert(c.svertices.end(), map.svertices.begin(), map.svertices.end());
  c.shalfedges.insert(c.shalfedges.end(), map.shalfedges.begin(), map.shalfedges.end());
  c.sloops.insert(c.sloops.end(), map.sloops.begin(), map.sloops.end());
  c.sfaces.insert(c.sfaces.end(), map.sfaces.begin(), map.sfaces.end());
  c.entries.insert(c.entries.end(), map.entries.begin(), map.entries.end());
  VertexRecord end;
  end.svertices = static_cast<std::uint32_t>(c.svertices.size());
  end.shalfedges = static_cast<std::uint32_t>(c.shalfedges.size());
  end.sloops = static_cast<std::uint32_t>(c.sloops.size());
  end.sfaces = static_cast<std::uint32_t>(c.sfaces.size());
  end.entries = static_cast<std::uint32_t>(c.entries.size());
  c.vertices.push_back(end);
}

void ComplexBuilder::copy(const Complex& from, std::uint32_t first, std::uint32_t count,
                          std::span<const std::uint32_t> rows, std::span<const LabelId> marks) {
  const CopiedRun run{&from, first, count, rows, marks};
  copy(std::span(&run, 1), 1);
}

// Indices inside sphere maps are local, so only where they begin changes, and the names of planes and marks. Each array
// depends on nothing but the same array of the other complexes.
void ComplexBuilder::copy(std::span<const CopiedRun> runs, unsigned threads) {
  const auto all = [runs](const auto& copy_run) {
    for (const CopiedRun& run : runs) copy_run(run);
  };
  // The longest array first.
  parallel_calls(
      threads,
      {[&] { all([this](const CopiedRun& run) { copy_shalfedges(run); }); },
       [&] { all([this](const CopiedRun& run) { copy_svertices(run); }); },
       [&] { all([this](const CopiedRun& run) { complex_.points.append(run.from->points, run.first, run.count); }); },
       [&] {
         all([this](const CopiedRun& run) {
           copy_records(run);
           copy_other_items(run);
         });
       }});
}

namespace {

// Appends a range of items, changed by `rename` and with other marks, in blocks that stay in a fast cache meanwhile.
template <typename Item, typename Rename>
void copy_changed(const std::vector<Item>& from, std::uint32_t begin, std::uint32_t end, std::span<const LabelId> marks,
                  const Rename& rename, std::vector<Item>& to) {
  constexpr std::uint32_t kBlock = 2048;
  while (begin < end) {
    const std::uint32_t count = std::min(kBlock, end - begin);
    const std::size_t base = to.size();
    to.insert(to.end(), from.begin() + begin, from.begin() + begin + count);
    const std::span<Item> fresh = std::span(to).subspan(base);
    for (Item& item : fresh) rename(item);
    if (!marks.empty()) {
      for (Item& item : fresh) {
        if (item.mark != kOutside) item.mark = marks[item.mark];
      }
    }
    begin += count;
  }
}

}  // namespace

void ComplexBuilder::copy_svertices(const CopiedRun& run) {
  const auto with_rows = [rows = run.rows](SVertex& item) {
    if (rows.empty()) return;
    rename(item.p, rows);
    rename(item.q, rows);
  };
  const std::vector<VertexRecord>& records = run.from->vertices;
  copy_changed(run.from->svertices, records[run.first].svertices, records[run.first + run.count].svertices, run.marks,
               with_rows, complex_.svertices);
}

void ComplexBuilder::copy_shalfedges(const CopiedRun& run) {
  const auto with_rows = [rows = run.rows](SHalfedge& item) {
    if (!rows.empty()) rename(item.plane, rows);
  };
  const std::vector<VertexRecord>& records = run.from->vertices;
  copy_changed(run.from->shalfedges, records[run.first].shalfedges, records[run.first + run.count].shalfedges,
               run.marks, with_rows, complex_.shalfedges);
}

void ComplexBuilder::copy_other_items(const CopiedRun& run) {
  const auto with_rows = [rows = run.rows](SLoop& item) {
    if (!rows.empty()) rename(item.plane, rows);
  };
  const VertexRecord& begin = run.from->vertices[run.first];
  const VertexRecord& end = run.from->vertices[run.first + run.count];
  copy_changed(run.from->sloops, begin.sloops, end.sloops, run.marks, with_rows, complex_.sloops);
  copy_changed(
      run.from->sfaces, begin.sfaces, end.sfaces, run.marks, [](SFace&) {}, complex_.sfaces);
  complex_.entries.insert(complex_.entries.end(), run.from->entries.begin() + begin.entries,
                          run.from->entries.begin() + end.entries);
}

void ComplexBuilder::copy_records(const CopiedRun& run) {
  const VertexRecord begin = run.from->vertices[run.first];
  const VertexRecord base = complex_.vertices.back();
  const auto mark = [marks = run.marks](LabelId label) {
    return marks.empty() || label == kOutside ? label : marks[label];
  };
  complex_.vertices.back().mark = mark(begin.mark);
  const std::uint32_t last = run.first + run.count;
  for (std::uint32_t v = run.first + 1; v <= last; ++v) {
    VertexRecord record = run.from->vertices[v];
    record.svertices += base.svertices - begin.svertices;
    record.shalfedges += base.shalfedges - begin.shalfedges;
    record.sloops += base.sloops - begin.sloops;
    record.sfaces += base.sfaces - begin.sfaces;
    record.entries += base.entries - begin.entries;
    record.mark = v == last ? LabelId{0} : mark(record.mark);
    complex_.vertices.push_back(record);
  }
}

void ComplexBuilder::take_vertices(Complex&& from) {
  complex_ = Complex();
  complex_.points = std::move(from.points);
  complex_.vertices = std::move(from.vertices);
  complex_.svertices = std::move(from.svertices);
  complex_.shalfedges = std::move(from.shalfedges);
  complex_.sloops = std::move(from.sloops);
  complex_.sfaces = std::move(from.sfaces);
  complex_.entries = std::move(from.entries);
}

// A box whose walls hold nothing but its eight corners says only what the outer volume is: the
// set is finitely bounded, or its complement is.
bool ComplexBuilder::has_idle_box() const {
  const Complex& c = complex_;
  std::size_t infinite = 0;
  for (std::uint32_t v = 0; v < c.vertex_count(); ++v) {
    if (c.points.finite(PointId{v})) continue;
    // Eight octants are not enough: a plane may cut through all of the box.
    if (!far_corner(c.points, PointId{v}) || !idle_corner(c.sphere_map(v))) return false;
    ++infinite;
  }
  return infinite == 8;
}

void ComplexBuilder::drop_idle_box(LabelId& outer) {
  if (!has_idle_box()) return;
  const Complex& c = complex_;
  ComplexBuilder kept(planes_);
  kept.reserve(c.vertex_count(), c.vertices.back());
  const auto count = static_cast<std::uint32_t>(c.vertex_count());
  std::uint32_t first = 0;  // of the run of finite vertices
  for (std::uint32_t v = 0; v <= count; ++v) {
    if (v < count && c.points.finite(PointId{v})) continue;
    if (first < v) kept.copy(c, first, v - first);
    first = v + 1;
    if (v < count) outer = c.vertices[v].mark;
  }
  complex_ = std::move(kept.complex_);
}

// Cascades would otherwise carry the planes of everything that ever was.
void ComplexBuilder::drop_idle_planes() {
  Complex& c = complex_;
  std::vector<bool> used(planes_.size(), false);
  for (const SVertex& v : c.svertices) used[v.p.row()] = used[v.q.row()] = true;
  for (const SHalfedge& e : c.shalfedges) used[e.plane.row()] = true;
  for (const SLoop& l : c.sloops) used[l.plane.row()] = true;
  const auto count = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  if (count == used.size()) return;
  PlaneTable planes;
  planes.reserve(count);
  std::vector<std::uint32_t> row(used.size(), kNone);
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    if (used[i]) row[i] = planes.append_new(planes_, i);
  }
  for (SVertex& v : c.svertices) {
    rename(v.p, row);
    rename(v.q, row);
  }
  for (SHalfedge& e : c.shalfedges) rename(e.plane, row);
  for (SLoop& l : c.sloops) rename(l.plane, row);
  planes_ = std::move(planes);
}

Complex ComplexBuilder::take() {
  if (defect_) throw detail::BrokenInvariant(std::move(*defect_));
  planes_.trim();  // before the links need room
  complex_.planes = std::move(planes_);
  return std::move(complex_);
}

Complex ComplexBuilder::finish(LabelId outer, unsigned threads) {
  drop_idle_box(outer);
  drop_idle_planes();
  return finish_unreduced(outer, threads);
}

Complex ComplexBuilder::finish_unreduced(LabelId outer, unsigned threads) {
  Complex complex = take();
  synthesize(complex, outer, threads);
  complex.trim();
  return complex;
}

Complex ComplexBuilder::finish(LabelId outer, KnownLinks&& known, unsigned threads) {
  Complex complex = take();
  synthesize(complex, outer, std::move(known), threads);
  complex.trim();
  return complex;
}

namespace {

template <typename Finish>
std::variant<Complex, Defect> complex_or_defect(Finish&& finish) {
  std::optional<Complex> complex;
  std::optional<Defect> defect = detail::defect_in([&] { complex.emplace(finish()); });
  if (defect) return std::move(*defect);
  return std::move(*complex);
}

}  // namespace

std::variant<Complex, Defect> ComplexBuilder::try_finish(LabelId outer) {
  return complex_or_defect([&] { return finish(outer); });
}

std::variant<Complex, Defect> ComplexBuilder::try_finish(LabelId outer, KnownLinks&& known) {
  return complex_or_defect([&] { return finish(outer, std::move(known)); });
}

std::variant<Complex, Defect> ComplexBuilder::try_finish_unreduced(LabelId outer) {
  return complex_or_defect([&] { return finish_unreduced(outer, 1); });
}

}  // namespace nef
