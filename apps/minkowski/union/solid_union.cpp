// SPDX-License-Identifier: Apache-2.0
//
// A vertex of the union is a vertex of a cell, or where an edge of one meets a face of another, or where faces of three
// cells meet. All of the latter lie on segments: edges of cells and meetings of two faces. Along a segment each cell
// has an interval that it covers: where the segment is inside of it, or inside one of its faces that is in the plane of
// a face of the segment (see coplanar.h). What no such interval covers is left, and only there points are made.
//
// Here, all that is done in doubles: intervals that are surely covered are taken away, faces that may cut are cut with.
// Points that come from this are candidates; UnionVertices decides exactly.
//
// Why flush faces may cover: let x be a vertex of the union, and look only at cells whose local pyramid at x is not
// held by another cell's (of equal ones, the first). Their planes alone make x a vertex, and none of the segments of
// these cells through x is covered at x.
#include "apps/minkowski/union/solid_union.h"

#include <algorithm>
#include <limits>

#include "apps/minkowski/cells/segment.h"
#include "apps/minkowski/part_of_sum.h"
#include "apps/minkowski/union/coplanar.h"
#include "apps/minkowski/union/face_chord.h"
#include "apps/minkowski/union/repeated_cells.h"
#include "apps/minkowski/union/union_vertices.h"
#include "apps/minkowski/union/visible_faces.h"
#include "nef/base/error.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

class SolidUnion {
 public:
  SolidUnion(std::span<const ConvexCell> cells, const RoundedCells& rounded, std::uint64_t budget,
             const Monitor& monitor)
      : cells_(cells),
        rounded_(rounded),
        boxes_(rounded.boxes(), BoxSplit::kMedians),
        vertices_(cells, rounded, boxes_, monitor),
        exact_(vertices_.exact()),
        cutter_(rounded, exact_),
        visible_(visible_faces(cells, rounded, boxes_, exact_, monitor)),
        tree_(visible_.boxes, BoxSplit::kMedians),
        budget_(budget),
        monitor_(monitor) {
    for (std::uint32_t c = 0; c < rounded.size(); ++c) apart_.push_back(rounded.first_face(c));
    segment_apart_ = apart_;
  }

  [[nodiscard]] std::size_t hidden_cells() const { return visible_.hidden_cells; }

  // All candidates; false if the budget did not suffice.
  bool search() {
    for (std::uint32_t i = 0; i < visible_.faces.size(); ++i) {
      monitor_.tell_progress(kSumPhase, i, visible_.faces.size());
      search_face(i);
      if (exhausted()) return false;
    }
    return true;
  }

  Complex finish() { return vertices_.finish(); }

 private:
  [[nodiscard]] bool exhausted() const { return work_ + vertices_.work() > budget_; }

  [[nodiscard]] const Double3& corner(std::uint32_t face, std::uint32_t vertex) const {
    return rounded_.vertices(rounded_.cell_of_face(face))[vertex];
  }

  // The segments on a face: its edges, and its meetings with faces that come later.
  void search_face(std::uint32_t i) {
    const std::uint32_t f = visible_.faces[i];
    const Box& box = visible_.boxes[i];
    const std::uint32_t own = rounded_.cell_of_face(f);
    find_neighbours(f, box);
    const auto ring = exact_.corners(f);
    for (std::size_t k = 0; k < ring.size(); ++k) search_edge(f, box, ring[k], ring[(k + 1) % ring.size()]);
    tree_.for_each_overlap(box, [&](std::uint32_t j) {
      if (j > i && rounded_.cell_of_face(visible_.faces[j]) != own && !exhausted()) search_meeting(i, j);
    });
  }

  // The cells that may have a part of the face inside or touch it. A plane that keeps a cell from one face is likely to
  // keep it from the next one.
  void find_neighbours(std::uint32_t face, const Box& box) {
    neighbours_.clear();
    ring_.clear();
    for (const std::uint32_t v : exact_.corners(face)) ring_.push_back(corner(face, v));
    const std::uint32_t own = rounded_.cell_of_face(face);
    const auto is_beyond = [&](std::uint32_t h) {
      ++work_;
      const RoundedFace& plane = rounded_.face(h);
      return std::all_of(ring_.begin(), ring_.end(), [&](const Double3& x) { return plane.value(x) > plane.slack; });
    };
    boxes_.for_each_overlap(box, [&](std::uint32_t cell) {
      if (cell == own || is_beyond(apart_[cell])) return;
      for (std::uint32_t h = rounded_.first_face(cell); h < rounded_.end_face(cell); ++h) {
        if (!is_beyond(h)) continue;
        apart_[cell] = h;
        return;
      }
      neighbours_.push_back(cell);
    });
  }

  // The face of the same cell on the other side of an edge.
  [[nodiscard]] std::uint32_t face_beyond(std::uint32_t face, std::uint32_t from, std::uint32_t to) const {
    const std::uint32_t cell = rounded_.cell_of_face(face);
    const Mesh& mesh = cells_[cell].mesh;
    for (std::uint32_t g = 0; g < mesh.face_count(); ++g) {
      std::uint32_t last = mesh.face(g).back();
      for (const std::uint32_t corner : mesh.face(g)) {
        if (last == to && corner == from) return rounded_.first_face(cell) + g;
        last = corner;
      }
    }
    NEF_ASSERT(false);  // convex solids are closed
    return face;
  }

  void search_edge(std::uint32_t face, const Box& box, std::uint32_t from, std::uint32_t to) {
    const std::uint32_t beyond = face_beyond(face, from, to);
    // Each edge once; not at all if a face of it is hidden, since then the edge is, too.
    if (visible_.is_visible[beyond] == 0 || beyond < face) return;
    Segment& s = segment_;
    s.from = corner(face, from);
    s.to = corner(face, to);
    s.error = rounded_.vertex_error();
    s.f = face;
    s.g = beyond;
    Interval whole{0, 1};
    if (!clip_to_box(s, box, whole) || is_covered(s, whole)) return;
    const std::uint32_t cell = rounded_.cell_of_face(face);
    s.from_point = s.open.front().low <= 0 ? vertices_.add_vertex(cell, from) : kNone;
    s.to_point = s.open.back().high >= 1 ? vertices_.add_vertex(cell, to) : kNone;
    add_candidates(s);
  }

  // Where two faces of different cells cross in their insides, the meeting is a segment that no edge holds.
  void search_meeting(std::uint32_t i, std::uint32_t j) {
    Segment& s = segment_;
    s.f = visible_.faces[i];
    s.g = visible_.faces[j];
    work_ += 20;
    const std::optional<Chord> on_f = cutter_.chord(s.f, s.g);
    if (!on_f) return;
    const std::optional<Chord> on_g = cutter_.chord(s.g, s.f);
    if (!on_g) return;
    s.from_point = s.to_point = kNone;
    s.from = on_f->point[0];
    s.to = on_f->point[1];
    s.error = on_f->error;
    Interval common = overlap(*on_f, *on_g);
    if (!(common.low <= common.high) || !clip_to_box(s, visible_.boxes[i], common) ||
        !clip_to_box(s, visible_.boxes[j], common) || is_covered(s, common)) {
      return;
    }
    add_candidates(s);
  }

  // True if a face is flush with a cell that the segment is an edge or a meeting of.
  [[nodiscard]] bool is_flush(std::uint32_t h, std::uint32_t own, std::uint32_t other) const {
    const PlaneId plane = exact_.known_plane(h);
    return visible_.planes.has(own, plane) || (own != other && visible_.planes.has(other, plane));
  }

  // The part of a segment that is surely inside of cell d, an open interval; nothing if a face of d that matters is
  // flush with cell `own` or `other`, so that more may be covered.
  std::optional<Interval> inside_part(const Segment& s, std::uint32_t d, std::uint32_t own, std::uint32_t other) {
    constexpr Interval kNothing{1, 0};
    const auto is_beyond = [&](const FormOnSegment& form, std::uint32_t h) {
      return std::min(form.at, form.at + form.slope) >= -form.error && !is_flush(h, own, other);
    };
    // Segments next to each other are mostly beyond the same face.
    ++work_;
    if (is_beyond(FormOnSegment(rounded_.face(segment_apart_[d]), s), segment_apart_[d])) return kNothing;
    Interval inside{-1, 2};  // so that a cell which surely holds an end covers it
    limits_.clear();
    for (std::uint32_t h = rounded_.first_face(d); h < rounded_.end_face(d) && inside.low < inside.high; ++h) {
      ++work_;
      const FormOnSegment form(rounded_.face(h), s);
      if (std::max(form.at, form.at + form.slope) < -form.error) continue;
      if (is_beyond(form, h)) {
        segment_apart_[d] = h;
        return kNothing;
      }
      keep_below(inside, form.at, form.slope, -form.error, Rounding::kInwards);
      limits_.push_back(h);
    }
    for (const std::uint32_t h : limits_) {
      if (is_flush(h, own, other)) return std::nullopt;
    }
    return inside;
  }

  // The part of a segment of cell `c` where cell d surely covers c: an open interval. See coplanar.h.
  Interval covered_part(const Segment& s, std::uint32_t d, std::uint32_t c) {
    Interval inside{-1, 2};  // so that a cell which surely holds an end covers it
    bool is_flush = false;
    bool on_f = false;
    bool on_g = false;
    for (std::uint32_t h = rounded_.first_face(d); h < rounded_.end_face(d); ++h) {
      ++work_;
      const FormOnSegment form(rounded_.face(h), s);
      if (std::max(form.at, form.at + form.slope) < -form.error) continue;
      const PlaneId plane = exact_.known_plane(h);
      if (visible_.planes.has(c, plane)) {
        is_flush = true;
        on_f = on_f || plane == exact_.known_plane(s.f);
        on_g = on_g || plane == exact_.known_plane(s.g);
        continue;
      }
      keep_below(inside, form.at, form.slope, -form.error, Rounding::kInwards);
      if (!(inside.low < inside.high)) return inside;
    }
    if (!is_flush) return inside;
    // Cell c has both planes along its own edges, and one along a meeting with another cell.
    const bool has_f = rounded_.cell_of_face(s.f) == c;
    const bool has_g = rounded_.cell_of_face(s.g) == c;
    const bool equal = (on_f || !has_f) && (on_g || !has_g);
    return may_cover(cells_, d, c, equal ? Pyramid::kEqual : Pyramid::kLarger) ? inside : Interval{1, 0};
  }

  // Takes from s.open what one cell surely covers.
  void take_covered(Segment& s, std::uint32_t cell, std::uint32_t own, std::uint32_t other) {
    const auto take = [&](const Interval& part) {
      if (part.low < part.high) subtract(s.open, part, pieces_);
    };
    if (const std::optional<Interval> inside = inside_part(s, cell, own, other)) return take(*inside);
    take(covered_part(s, cell, own));
    if (own != other) take(covered_part(s, cell, other));
  }

  // Takes from the part `whole` what is surely covered and leaves the rest in s.open; true if that is nothing.
  bool is_covered(Segment& s, const Interval& whole) {
    s.open.assign(1, whole);
    const std::uint32_t own = rounded_.cell_of_face(s.f);
    const std::uint32_t other = rounded_.cell_of_face(s.g);
    const Box box = s.box();
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
      const std::uint32_t cell = neighbours_[k];
      if (cell == own || cell == other || !box.overlaps(rounded_.box(cell))) continue;
      take_covered(s, cell, own, other);
      if (s.open.empty()) {
        // Neighbouring segments are likely to be covered by the same cell.
        const auto begin = neighbours_.begin();
        std::rotate(begin, begin + static_cast<std::ptrdiff_t>(k), begin + static_cast<std::ptrdiff_t>(k) + 1);
        return true;
      }
    }
    return false;
  }

  // Faces of neighbours that may cut what is left of a segment.
  void add_candidates(const Segment& s) {
    const std::uint32_t own = rounded_.cell_of_face(s.f);
    const std::uint32_t other = rounded_.cell_of_face(s.g);
    const Interval left{s.open.front().low, s.open.back().high};
    const Box box = s.box_of(left);
    for (const std::uint32_t cell : neighbours_) {
      if (cell != own && cell != other && box.overlaps(rounded_.box(cell))) add_cuts(s, left, cell);
    }
  }

  // The faces of one cell among them. The segment is near the cell only where it is below all of its faces.
  void add_cuts(const Segment& s, const Interval& left, std::uint32_t cell) {
    Interval near = left;
    forms_.clear();
    const std::uint32_t first = rounded_.first_face(cell);
    const std::uint32_t end = rounded_.end_face(cell);
    for (std::uint32_t h = first; h < end; ++h) {
      ++work_;
      const FormOnSegment& form = forms_.emplace_back(rounded_.face(h), s);
      keep_below(near, form.at, form.slope, form.error, Rounding::kOutwards);
      if (!(near.low <= near.high)) return;
    }
    for (std::uint32_t h = first; h < end; ++h) {
      const PlaneId plane = exact_.known_plane(h);
      const bool parallel = plane.valid() && (plane == exact_.known_plane(s.f) || plane == exact_.known_plane(s.g));
      if (visible_.is_visible[h] != 0 && !parallel) add_cut(s, near, h, forms_[h - first]);
    }
  }

  void add_cut(const Segment& s, const Interval& near, std::uint32_t h, const FormOnSegment& form) {
    // Where the absolute value of the form may be zero.
    Interval at = near;
    keep_below(at, form.at, form.slope, form.error, Rounding::kOutwards);
    keep_below(at, -form.at, -form.slope, form.error, Rounding::kOutwards);
    if (!(at.low <= at.high)) return;
    const bool is_left = std::any_of(s.open.begin(), s.open.end(),
                                     [&](const Interval& t) { return at.low <= t.high && t.low <= at.high; });
    const bool is_end =
        (at.low <= 0 && vertices_.is_on(s.from_point, h)) || (at.high >= 1 && vertices_.is_on(s.to_point, h));
    if (!is_left || is_end) return;
    vertices_.add_meeting(s.f, s.g, h, s.at((at.low + at.high) / 2));
  }

  std::span<const ConvexCell> cells_;
  const RoundedCells& rounded_;
  BoxTree boxes_;
  UnionVertices vertices_;
  ExactCells& exact_;
  FaceCutter cutter_;
  VisibleFaces visible_;
  BoxTree tree_;  // over the boxes of visible faces
  std::uint64_t budget_;
  Monitor monitor_;
  std::uint64_t work_ = 0;

  // Scratch.
  std::vector<std::uint32_t> neighbours_;     // of the face at hand
  std::vector<Double3> ring_;                 // its corners
  std::vector<std::uint32_t> apart_;          // per cell, a face of it beyond which the last face was
  std::vector<std::uint32_t> segment_apart_;  // and one beyond which the last segment was
  std::vector<std::uint32_t> limits_;         // faces of the cell at hand that the segment is not surely below
  Segment segment_;
  std::vector<Interval> pieces_;
  std::vector<FormOnSegment> forms_;
};

std::optional<Polyhedron> unite_different(std::span<const ConvexCell> cells, const RoundedCells& rounded,
                                          std::uint64_t budget, std::size_t& dropped, const Monitor& monitor) {
  if (cells.size() == 1) return to_polyhedron(cells[0], monitor);
  SolidUnion search(cells, rounded, budget, monitor);
  if (!search.search()) return std::nullopt;
  dropped += search.hidden_cells();
  return Polyhedron(search.finish());
}

}  // namespace

std::optional<Polyhedron> try_unite_solids(std::span<const ConvexCell> cells, std::uint64_t budget,
                                           std::size_t* dropped, const Monitor& monitor) {
  std::size_t unused = 0;
  std::size_t& count = dropped != nullptr ? *dropped : unused;
  if (cells.empty()) return Polyhedron();
  const RoundedCells rounded(cells);
  if (!has_moderate_size(rounded.extent())) return std::nullopt;
  const std::vector<bool> repeated = repeated_cells(cells, rounded);
  const auto repeats = static_cast<std::size_t>(std::count(repeated.begin(), repeated.end(), true));
  if (repeats == 0) return unite_different(cells, rounded, budget, count, monitor);
  std::vector<ConvexCell> different;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!repeated[i]) different.push_back(cells[i]);
  }
  std::size_t hidden = 0;
  std::optional<Polyhedron> result = unite_different(different, RoundedCells(different), budget, hidden, monitor);
  if (result) count += repeats + hidden;
  return result;
}

Polyhedron unite_solids(std::span<const ConvexCell> cells, std::size_t* dropped, const Monitor& monitor) {
  constexpr std::uint64_t kAny = std::numeric_limits<std::uint64_t>::max();
  if (std::optional<Polyhedron> result = try_unite_solids(cells, kAny, dropped, monitor)) return *std::move(result);
  std::vector<Polyhedron> sets;
  sets.reserve(cells.size());
  for (const ConvexCell& cell : cells) sets.push_back(to_polyhedron(cell, monitor));
  return unite_all(sets, monitor);
}

}  // namespace nef::minkowski
