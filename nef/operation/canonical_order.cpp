// SPDX-License-Identifier: Apache-2.0
#include "nef/operation/canonical_order.h"

#include <algorithm>
#include <numeric>

#include "nef/base/error.h"
#include "nef/geometry/spatial_order.h"
#include "nef/sphere_map/sphere_geometry.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {
namespace {

// Without common factors.
PointTable reduced(const PointTable& points) {
  PointTable result;
  result.reserve(points.size());
  std::array<Integer, 7> h;
  Integer divisor;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    divisor = Integer(points.coordinate(PointId{v}, 3));
    for (std::size_t i = 0; i < 7 && divisor != 1; ++i) {
      mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), points.coordinate(PointId{v}, i));
    }
    if (divisor == 1) {
      result.push_from(points, PointId{v});
      continue;
    }
    for (std::size_t i = 0; i < 7; ++i) {
      mpz_divexact(h[i].get_mpz_t(), points.coordinate(PointId{v}, i), divisor.get_mpz_t());
    }
    result.push_homogeneous(h);
  }
  return result;
}

// Along a curve through space; lexicographic within its cells.
std::vector<std::uint32_t> order_of(const PointTable& points) {
  std::vector<std::array<double, 3>> places;
  places.reserve(points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) places.push_back(points.approximate(PointId{v}));
  return spatial_order(places, [&points](std::uint32_t a, std::uint32_t b) {
    return compare_lexicographic(points, PointId{a}, PointId{b}) < 0;
  });
}

// A total order of the planes of one table.
bool coefficients_less(const PlaneTable& planes, std::uint32_t a, std::uint32_t b) {
  for (std::size_t i = 0; i < 5; ++i) {
    const int order = mpz_cmp(planes.coefficient(PlaneId{a << 1U}, i), planes.coefficient(PlaneId{b << 1U}, i));
    if (order != 0) return order < 0;
  }
  return false;
}

class Canonical {
 public:
  Canonical(PlaneTable&& planes, const Complex& vertices) : c_(vertices), planes_(std::move(planes)) {}

  Complex run(LabelId outer) {
    const PointTable points = reduced(c_.points);
    order_ = order_of(points);
    choose_lines();
    PlaneTable planes = ordered_planes();
    ComplexBuilder builder(planes);
    VertexRecord size = c_.vertices.back();
    builder.reserve(c_.vertex_count(), size);
    for (const std::uint32_t v : order_) {
      write(planes, v);
      builder.append(points, PointId{v}, out_.view());
    }
    return builder.finish(outer);
  }

 private:
  // The two planes that name the line of each svertex: of facets where two arrive, others parallel to an axis.
  void choose_lines() {
    line_.assign(c_.svertices.size(), {kNone, kNone});
    std::vector<std::uint32_t> one;  // of each svertex of a vertex: the row of an arc that arrives
    std::vector<bool> several;
    for (const std::uint32_t v : order_) {
      const SphereMapView map = c_.sphere_map(v);
      one.assign(map.svertices.size(), kNone);
      several.assign(map.svertices.size(), false);
      for (const SHalfedge& half : map.shalfedges) {
        std::uint32_t& row = one[half.source];
        if (row == kNone) row = half.plane.row();
        if (row != half.plane.row()) several[half.source] = true;
      }
      for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
        if (several[s]) continue;
        line_[c_.vertices[v].svertices + s] = bare_line(v, map.svertices[s], one[s]);
      }
    }
  }

  // The two planes in the order of the axes that they are parallel to; `facet` is the row of a plane that must be one
  // of them, or kNone.
  std::array<std::uint32_t, 2> bare_line(std::uint32_t v, const SVertex& svertex, std::uint32_t facet) {
    const std::array<Integer, 3> d = direction_of(planes_, svertex).integers();
    std::array<std::uint32_t, 2> rows{facet, kNone};
    std::size_t found = facet == kNone ? 0 : 1;
    for (std::size_t axis = 0; axis < 3 && found < 2; ++axis) {
      std::array<Integer, 3> n;
      n[(axis + 1) % 3] = d[(axis + 2) % 3];
      n[(axis + 2) % 3] = -d[(axis + 1) % 3];
      if (n[(axis + 1) % 3] == 0 && n[(axis + 2) % 3] == 0) continue;
      const std::uint32_t row = plane_through(v, n);
      if (row != rows[0]) rows[found++] = row;
    }
    NEF_ASSERT(found == 2);
    return rows;
  }

  std::uint32_t plane_through(std::uint32_t v, std::array<Integer, 3>& n) {
    Integer offset;
    Integer at_infinity;
    for (std::size_t i = 0; i < 3; ++i) {
      mpz_submul(offset.get_mpz_t(), n[i].get_mpz_t(), c_.points.coordinate(PointId{v}, i));
      mpz_submul(at_infinity.get_mpz_t(), n[i].get_mpz_t(), c_.points.coordinate(PointId{v}, 4 + i));
      mpz_mul(n[i].get_mpz_t(), n[i].get_mpz_t(), c_.points.coordinate(PointId{v}, 3));
    }
    return planes_.intern(n[0], n[1], n[2], offset, at_infinity).row();
  }

  // Those in use, by the first vertex that uses them; fills row_.
  PlaneTable ordered_planes() {
    std::vector<std::uint32_t> first(planes_.size(), kNone);
    std::vector<std::uint32_t> used;
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
      const auto note = [&](std::uint32_t row) {
        if (row == kNone || first[row] != kNone) return;
        first[row] = i;
        used.push_back(row);
      };
      const SphereMapView map = c_.sphere_map(order_[i]);
      const auto begin = static_cast<std::ptrdiff_t>(used.size());
      for (const SHalfedge& half : map.shalfedges) note(half.plane.row());
      for (const SLoop& loop : map.sloops) note(loop.plane.row());
      for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
        for (const std::uint32_t row : line_[c_.vertices[order_[i]].svertices + s]) note(row);
      }
      std::sort(used.begin() + begin, used.end(),
                [this](std::uint32_t a, std::uint32_t b) { return coefficients_less(planes_, a, b); });
    }
    PlaneTable result;
    result.reserve(used.size());
    row_.assign(planes_.size(), kNone);
    for (const std::uint32_t row : used) row_[row] = result.append_new(planes_, row);
    return result;
  }

  [[nodiscard]] PlaneId renamed(PlaneId plane) const { return PlaneId{row_[plane.row()] << 1U | (plane.value & 1U)}; }

  // The canonical sphere map of a vertex, into out_.
  void write(const PlaneTable& planes, std::uint32_t v) {
    const SphereMapView map = c_.sphere_map(v);
    out_.clear();
    out_.mark = map.mark;
    write_svertices(planes, v, map);
    write_shalfedges(map);
    for (std::size_t l = 0; l < map.sloops.size(); ++l) {
      SLoop loop = map.sloops[l ^ (map.sloops[0].plane.flipped() ? 1U : 0U)];
      loop.plane = renamed(loop.plane);
      out_.sloops.push_back(loop);
    }
    write_sfaces(map);
  }

  void write_svertices(const PlaneTable& planes, std::uint32_t v, const SphereMapView& map) {
    const auto count = static_cast<std::uint32_t>(map.svertices.size());
    named_.assign(map.svertices.begin(), map.svertices.end());
    for (std::uint32_t s = 0; s < count; ++s) named_[s].p = named_[s].q = PlaneId();
    for (const SHalfedge& half : map.shalfedges) take_row(named_[half.source], row_[half.plane.row()]);
    for (std::uint32_t s = 0; s < count; ++s) {
      for (const std::uint32_t row : line_[c_.vertices[v].svertices + s]) {
        if (row != kNone) take_row(named_[s], row_[row]);
      }
      turn_along(planes, map.svertices[s], named_[s]);
    }
    sorted_.resize(count);
    std::iota(sorted_.begin(), sorted_.end(), 0U);
    std::sort(sorted_.begin(), sorted_.end(), [this](std::uint32_t a, std::uint32_t b) {
      return std::pair(named_[a].p, named_[a].q) < std::pair(named_[b].p, named_[b].q);
    });
    svertex_.resize(count);
    for (std::uint32_t s = 0; s < count; ++s) {
      svertex_[sorted_[s]] = s;
      out_.svertices.push_back(named_[sorted_[s]]);
    }
  }

  // Keeps the two smallest rows, as unflipped planes.
  static void take_row(SVertex& svertex, std::uint32_t row) {
    const PlaneId plane{row << 1U};
    if (plane == svertex.p || plane == svertex.q) return;
    if (plane < svertex.p) {
      svertex.q = svertex.p;
      svertex.p = plane;
    } else if (plane < svertex.q) {
      svertex.q = plane;
    }
  }

  // Flips the second plane where the planes would name the opposite direction.
  void turn_along(const PlaneTable& planes, const SVertex& old, SVertex& svertex) const {
    const PlaneId p = renamed(old.p);
    const PlaneId q = renamed(old.q);
    bool positive = false;
    const bool kept = row_[old.p.row()] != kNone && row_[old.q.row()] != kNone;
    if (kept && std::min(p.row(), q.row()) == svertex.p.row() && std::max(p.row(), q.row()) == svertex.q.row()) {
      positive = (p.flipped() != q.flipped()) == (p.row() != svertex.p.row());
    } else {
      positive = sign_of_dot(direction_of(planes_, old), Direction::cross(planes, svertex.p, svertex.q)) > 0;
    }
    if (!positive) svertex.q = svertex.q.opposite();
  }

  void write_shalfedges(const SphereMapView& map) {
    const auto count = static_cast<std::uint32_t>(map.shalfedges.size());
    evens_.clear();
    for (std::uint32_t e = 0; e < count; e += 2) evens_.push_back(e + (map.shalfedges[e].plane.flipped() ? 1 : 0));
    const auto key = [&](std::uint32_t e) {
      return std::array<std::uint32_t, 3>{row_[map.shalfedges[e].plane.row()], svertex_[map.shalfedges[e].source],
                                          svertex_[map.target(e)]};
    };
    std::sort(evens_.begin(), evens_.end(), [&key](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    shalfedge_.resize(count);
    for (std::uint32_t k = 0; k < evens_.size(); ++k) {
      shalfedge_[evens_[k]] = 2 * k;
      shalfedge_[evens_[k] ^ 1U] = 2 * k + 1;
    }
    for (SVertex& s : out_.svertices) s.out = kNone;
    for (std::uint32_t k = 0; k < evens_.size(); ++k) {
      for (const std::uint32_t old : {evens_[k], evens_[k] ^ 1U}) {
        SHalfedge half = map.shalfedges[old];
        half.plane = renamed(half.plane);
        half.source = svertex_[half.source];
        half.next = shalfedge_[half.next];
        half.prev = shalfedge_[half.prev];
        SVertex& source = out_.svertices[half.source];
        if (source.out == kNone) source.out = shalfedge_[old];
        out_.shalfedges.push_back(half);
      }
    }
  }

  void write_sfaces(const SphereMapView& map) {
    faces_.resize(map.sfaces.size());
    const std::uint32_t swap_loops = !map.sloops.empty() && map.sloops[0].plane.flipped() ? 1 : 0;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      faces_[f].old = f;
      faces_[f].entries.clear();
      for (const SFaceEntry& entry : map.entries.subspan(map.sfaces[f].entries, map.sfaces[f].entry_count)) {
        std::uint32_t index = entry.index ^ swap_loops;
        if (entry.kind == SFaceEntry::Kind::kCycle) index = smallest_of_cycle(shalfedge_[entry.index]);
        if (entry.kind == SFaceEntry::Kind::kIsolatedVertex) index = svertex_[entry.index];
        faces_[f].entries.emplace_back(entry.kind, index);
      }
      std::sort(faces_[f].entries.begin(), faces_[f].entries.end());
    }
    std::sort(faces_.begin(), faces_.end(), [](const Face& a, const Face& b) { return a.entries < b.entries; });
    sface_.resize(faces_.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      sface_[faces_[f].old] = f;
      out_.sfaces.push_back({static_cast<std::uint32_t>(out_.entries.size()),
                             static_cast<std::uint32_t>(faces_[f].entries.size()), map.sfaces[faces_[f].old].mark});
      for (const auto& [kind, index] : faces_[f].entries) out_.entries.push_back({kind, index});
    }
    const auto rename = [this](std::uint32_t& sface) {
      if (sface != kNone) sface = sface_[sface];
    };
    for (SVertex& s : out_.svertices) rename(s.sface);
    for (SHalfedge& e : out_.shalfedges) rename(e.sface);
    for (SLoop& l : out_.sloops) rename(l.sface);
  }

  [[nodiscard]] std::uint32_t smallest_of_cycle(std::uint32_t first) const {
    std::uint32_t smallest = first;
    for (std::uint32_t e = out_.shalfedges[first].next; e != first; e = out_.shalfedges[e].next) {
      smallest = std::min(smallest, e);
    }
    return smallest;
  }

  const Complex& c_;
  PlaneTable planes_;
  std::vector<std::uint32_t> order_;
  std::vector<std::array<std::uint32_t, 2>> line_;  // of svertices with less than two facets' planes; rows
  std::vector<std::uint32_t> row_;                  // of each plane in the result
  struct Face {
    std::vector<std::pair<SFaceEntry::Kind, std::uint32_t>> entries;
    std::uint32_t old = 0;
  };
  // Of one vertex, from old items to new ones.
  std::vector<Face> faces_;
  SphereMapBuffer out_;
  std::vector<SVertex> named_;
  std::vector<std::uint32_t> sorted_, svertex_, evens_, shalfedge_, sface_;
};

}  // namespace

Complex canonical_complex(PlaneTable&& planes, const Complex& vertices, LabelId outer) {
  return Canonical(std::move(planes), vertices).run(outer);
}

Polyhedron in_canonical_order(const Polyhedron& set) {
  const Complex& c = set.complex();
  return Polyhedron(canonical_complex(PlaneTable(c.planes), c, c.volumes[kOuterVolume].mark));
}

}  // namespace nef
