// SPDX-License-Identifier: Apache-2.0
//
// 1. Points are reduced to lowest terms, and an infimaximal box that nothing reaches is dropped. 2. Vertices are sorted
// along a space-filling curve (`spatial_order`), lexicographically within its cells. 3. The line of an svertex where
// facets of fewer than two planes arrive is named by planes parallel to the axes. 4. Planes are sorted by the first
// vertex that uses them, and by their coefficients at one vertex. 5. Sphere maps are written in canonical form:
// vertices whose map is one ring by `CanonicalRings`, which learns one map for each pattern, the others by
// `CanonicalMapWriter`. 6. Twins are renamed, and synthesis finds facets, shells and volumes. Steps 1, 3, 4 and 5 work
// on chunks of vertices, several at once.
#include "nef/operation/canonical_order.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"
#include "nef/base/fast_path.h"
#include "nef/base/threads/parallel.h"
#include "nef/geometry/search/spatial_order.h"
#include "nef/location/compare.h"
#include "nef/operation/canonical_map.h"
#include "nef/operation/canonical_ring.h"
#include "nef/polyhedron.h"
#include "nef/sphere_map/sphere_geometry.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {
namespace {

// A total order of the planes of one table.
bool coefficients_less(const PlaneTable& planes, std::uint32_t a, std::uint32_t b) {
  for (std::size_t i = 0; i < 5; ++i) {
    const int order = mpz_cmp(planes.coefficient(PlaneId::of_row(a), i), planes.coefficient(PlaneId::of_row(b), i));
    if (order != 0) return order < 0;
  }
  return false;
}

class Canonical {
 public:
  Canonical(PlaneTable&& planes, std::span<const CanonicalPart> parts, std::vector<CanonicalVertex>&& vertices,
            const Monitor& monitor)
      : planes_(std::move(planes)), parts_(parts), vertices_(std::move(vertices)), monitor_(monitor) {}

  Complex run(LabelId outer) {
    arrange(outer);
    PlaneTable planes = ordered_planes();
    ComplexBuilder builder(planes, monitor_);
    write(planes, builder);
    KnownLinks known = known_twins(builder.so_far());
    numbers_ = {};
    return builder.finish(outer, std::move(known));
  }

  CanonicalVertices run_unlinked(LabelId outer) {
    arrange(outer);
    PlaneTable planes = ordered_planes();
    ComplexBuilder builder(planes, monitor_);
    write(planes, builder);
    CanonicalVertices result{builder.take_so_far(), outer};
    result.unlinked.planes = std::move(planes);
    return result;
  }

 private:
  // Finds the order of the vertices, and the planes that they will name.
  void arrange(LabelId& outer) {
    read_points();
    drop_idle_box(outer);
    reduce_points();
    put_in_order();
    find_rings();
    choose_lines();
  }

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(vertices_.size()); }
  [[nodiscard]] const Complex& complex(std::uint32_t i) const { return *parts_[vertices_[i].part].complex; }
  [[nodiscard]] SphereMapView map(std::uint32_t i) const { return complex(i).sphere_map(vertices_[i].vertex); }
  // Null if the map of a vertex is no ring.
  [[nodiscard]] const RingOfPattern* ring(std::uint32_t i) const {
    return rings_[vertices_[i].part].of(complex(i).vertices.pattern(vertices_[i].vertex));
  }
  // Those of its even shalfedges.
  [[nodiscard]] std::span<const PlaneId> planes_of_pairs(std::uint32_t i) const {
    return complex(i).planes_of_pairs(vertices_[i].vertex);
  }
  [[nodiscard]] std::span<const SLoop> sloops(std::uint32_t i) const {
    const Complex& c = complex(i);
    const std::uint32_t first = c.vertices[vertices_[i].vertex].sloops;
    return std::span(c.sloops).subspan(first, c.vertices[vertices_[i].vertex.next()].sloops - first);
  }
  [[nodiscard]] PlaneId common(std::uint32_t i, PlaneId plane) const {
    const std::span<const std::uint32_t> rows = parts_[vertices_[i].part].rows;
    return rows.empty() ? plane : plane.in_row(rows[plane.row()]);
  }
  [[nodiscard]] PointRef point(std::uint32_t i) const {
    if (!reduced_at_.empty() && reduced_at_[i] != kNone) return {&reduced_, PointId{reduced_at_[i]}};
    return {&complex(i).points, point_of(vertices_[i].vertex)};
  }

  // Calls body(first, last, chunk, own) for parts of all vertices, several at once; one thread has one part.
  [[nodiscard]] std::size_t chunk_count() const {
    return monitor_.threads() == 1 ? 1 : (count() + kChunk - 1) / kChunk;
  }
  template <typename Body>
  void for_each_chunk(Body&& body) const {
    const std::size_t chunks = chunk_count();
    monitor_.check_interruption();
    parallel_for(chunks, monitor_, [&](std::size_t k, const Monitor& own) {
      const auto first = static_cast<std::uint32_t>(k * kChunk);
      body(first, chunks == 1 ? count() : std::min(count(), first + kChunk), k, own);
    });
  }

  // What there is to know of them, in one pass.
  void read_points() {
    places_.resize(count());
    reducible_.assign(count(), 0);
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t, const Monitor&) {
      Integer divisor;
      for (std::uint32_t i = first; i < last; ++i) {
        const PointTable& points = complex(i).points;
        const PointId point = point_of(vertices_[i].vertex);
        places_[i] = points.approximate(point);
        reducible_[i] = points.is_reduced(point, divisor) ? 0 : 1;
      }
    });
  }

  void drop_idle_box(LabelId& outer) {
    // Doubles of infinite points are infinite, those of other ones seldom.
    const auto is_infinite = [this](std::uint32_t i) {
      return !std::isfinite(places_[i][0] + places_[i][1] + places_[i][2]) &&
             !complex(i).points.finite(point_of(vertices_[i].vertex));
    };
    std::vector<std::uint32_t> infinite;
    for (std::uint32_t i = 0; i < count(); ++i) {
      if (is_infinite(i)) infinite.push_back(i);
    }
    ComplexBuilder box(planes_, monitor_);
    for (const std::uint32_t i : infinite) box.copy(complex(i), vertices_[i].vertex, 1);
    if (!box.has_idle_box()) return;
    outer = box.so_far().mark(VertexId{0});
    for (auto at = infinite.rbegin(); at != infinite.rend(); ++at) {
      vertices_.erase(vertices_.begin() + *at);
      places_.erase(places_.begin() + *at);
      reducible_.erase(reducible_.begin() + *at);
    }
  }

  // Those whose coordinates have common factors.
  void reduce_points() {
    for (std::uint32_t i = 0; i < count(); ++i) {
      if (reducible_[i] == 0) continue;
      if (reduced_at_.empty()) reduced_at_.assign(count(), kNone);
      const PointId point = reduced_.push_reduced(complex(i).points, point_of(vertices_[i].vertex));
      reduced_at_[i] = point.index();
      places_[i] = reduced_.approximate(point);
    }
    reducible_ = {};
  }

  // Along a curve through space; lexicographic within its cells.
  void put_in_order() {
    PointTable two;
    const std::vector<std::uint32_t> order = spatial_order(places_, [&](std::uint32_t a, std::uint32_t b) {
      const PointRef p = point(a);
      const PointRef q = point(b);
      two.push_from(*p.table, p.id);
      two.push_from(*q.table, q.id);
      const bool less = compare_lexicographic(two, PointId{0}, PointId{1}, monitor_) < 0;
      two.pop();
      two.pop();
      return less;
    });
    std::vector<CanonicalVertex> vertices(count());
    std::vector<std::uint32_t> reduced_at(reduced_at_.size());
    for (std::uint32_t i = 0; i < count(); ++i) {
      vertices[i] = vertices_[order[i]];
      if (!reduced_at.empty()) reduced_at[i] = reduced_at_[order[i]];
    }
    vertices_ = std::move(vertices);
    reduced_at_ = std::move(reduced_at);
    places_ = {};
  }

  void find_rings() {
    rings_.resize(parts_.size());
    parallel_for_ranges(parts_.size(), kParts, monitor_, [this](std::size_t first, std::size_t last, const Monitor&) {
      for (std::size_t k = first; k < last; ++k) {
        rings_[k] = RingsOfPatterns(parts_[k].complex->patterns);
      }
    });
  }

  // The two planes that name the line of each svertex: of facets where two arrive, others parallel to an axis.
  void choose_lines() {
    std::vector<std::vector<BareLine>> of_chunk(chunk_count());
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t chunk, const Monitor&) {
      std::vector<std::array<std::uint32_t, 2>> rows;  // that arrive at each svertex
      for (std::uint32_t i = first; i < last; ++i) {
        if (const RingOfPattern* ring = kFastPaths ? this->ring(i) : nullptr;
            ring != nullptr && ring->names_lines(planes_of_pairs(i)))
          continue;
        const SphereMapView map = this->map(i);
        rows.assign(map.svertices.size(), {kNone, kNone});
        for (const SHalfedge& half : map.shalfedges) {
          auto& [one, other] = rows[half.source];
          if (one == kNone) one = half.plane.row();
          if (one != half.plane.row()) other = half.plane.row();
        }
        for (std::uint32_t s = 0; s < rows.size(); ++s) {
          if (rows[s][1] == kNone) of_chunk[chunk].push_back({i, s, rows[s]});
        }
      }
    });
    for (const std::vector<BareLine>& lines : of_chunk) {
      for (BareLine line : lines) {
        if (line.rows[0] != kNone) line.rows[0] = common(line.place, PlaneId::of_row(line.rows[0])).row();
        complete(line);
        lines_.push_back(line);
      }
    }
  }

  // Adds planes through the line in the order of the axes that they are parallel to; the one of a facet stays.
  void complete(BareLine& line) {
    SVertex svertex = map(line.place).svertices[line.svertex];
    svertex.p = common(line.place, svertex.p);
    svertex.q = common(line.place, svertex.q);
    const Direction direction = direction_of(planes_, svertex);
    const Integer3& d = direction.integers();
    std::size_t found = line.rows[0] == kNone ? 0 : 1;
    for (std::size_t axis = 0; axis < 3 && found < 2; ++axis) {
      Integer3 n;
      n[(axis + 1) % 3] = d[(axis + 2) % 3];
      n[(axis + 2) % 3] = -d[(axis + 1) % 3];
      if (n[(axis + 1) % 3] == 0 && n[(axis + 2) % 3] == 0) continue;
      const std::uint32_t row = plane_through(point(line.place), n);
      if (row != line.rows[0]) line.rows[found++] = row;
    }
    NEF_ASSERT(found == 2);
  }

  std::uint32_t plane_through(const PointRef& point, Integer3& n) {
    Integer offset;
    Integer at_infinity;
    for (std::size_t i = 0; i < 3; ++i) {
      mpz_submul(offset.get_mpz_t(), n[i].get_mpz_t(), point.coordinate(i));
      mpz_submul(at_infinity.get_mpz_t(), n[i].get_mpz_t(), point.coordinate(4 + i));
      mpz_mul(n[i].get_mpz_t(), n[i].get_mpz_t(), point.coordinate(3));
    }
    return planes_.intern(n[0], n[1], n[2], offset, at_infinity).row();
  }

  // Those in use, by the first vertex that uses them; fills row_.
  PlaneTable ordered_planes() {
    constexpr std::uint32_t kUsed = 0;  // until the end
    row_.assign(planes_.size(), kNone);
    std::vector<std::uint32_t> used;
    used.reserve(planes_.size());
    const auto use = [&](std::uint32_t row) {
      if (row_[row] != kNone) return;
      row_[row] = kUsed;
      used.push_back(row);
    };
    std::vector<std::uint32_t> begin(count() + 1U, 0);  // of the planes of each vertex
    auto line = lines_.begin();
    for (std::uint32_t i = 0; i < count(); ++i) {
      for (const PlaneId plane : planes_of_pairs(i)) use(common(i, plane).row());
      for (const SLoop& loop : sloops(i)) use(common(i, loop.plane).row());
      for (; line != lines_.end() && line->place == i; ++line) {
        for (const std::uint32_t row : line->rows) use(row);
      }
      begin[i + 1U] = static_cast<std::uint32_t>(used.size());
    }
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t, const Monitor&) {
      for (std::uint32_t i = first; i < last; ++i) {
        std::sort(used.begin() + begin[i], used.begin() + begin[i + 1U],
                  [this](std::uint32_t a, std::uint32_t b) { return coefficients_less(planes_, a, b); });
      }
    });
    PlaneTable result;
    result.reserve(used.size());
    for (const std::uint32_t row : used) row_[row] = result.append_new(planes_, row);
    return result;
  }

  [[nodiscard]] VertexRecord size_of(std::uint32_t first, std::uint32_t last) const {
    VertexRecord size;
    for (std::uint32_t i = first; i < last; ++i) {
      const VertexId vertex = vertices_[i].vertex;
      size.advance(complex(i).vertices[vertex], complex(i).vertices[vertex.next()]);
    }
    return size;
  }

  // All vertices into the builder; fills numbers_.
  void write(PlaneTable& planes, ComplexBuilder& builder) {
    // Where what is said of each part begins: of its planes, which become rows of the result, and of its svertices.
    std::vector<std::size_t> begin(parts_.size() + 1, 0);
    first_number_.assign(parts_.size() + 1, 0);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      begin[k + 1] = begin[k] + parts_[k].rows.size();
      const Complex& c = *parts_[k].complex;
      first_number_[k + 1] = first_number_[k] + (c.twin.empty() ? 0 : c.svertex_count());
    }
    std::vector<std::uint32_t> ordered(begin.back());
    numbers_.assign(first_number_.back(), HalfedgeId());
    parallel_for_ranges(parts_.size(), kParts, monitor_, [&](std::size_t first, std::size_t last, const Monitor&) {
      for (std::size_t k = first; k < last; ++k) {
        std::transform(parts_[k].rows.begin(), parts_[k].rows.end(), ordered.begin() + begin[k],
                       [this](std::uint32_t row) { return row_[row]; });
      }
    });
    const auto rows_of = [&](std::uint32_t part) {
      if (parts_[part].rows.empty()) return std::span<const std::uint32_t>(row_);
      return std::span<const std::uint32_t>(ordered).subspan(begin[part], begin[part + 1] - begin[part]);
    };
    const std::size_t chunks = chunk_count();
    std::vector<std::uint32_t> first_svertex(chunks + 1, 0);
    std::vector<Complex> written(chunks);
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t chunk, const Monitor& own) {
      const VertexRecord size = size_of(first, last);
      first_svertex[chunk + 1] = size.svertices.index();
      ComplexBuilder part(planes, own);
      part.reserve(last - first, size);
      CanonicalMapWriter writer(planes_, planes, row_, own);
      CanonicalRings rings;
      auto line = std::lower_bound(lines_.begin(), lines_.end(), first,
                                   [](const BareLine& l, std::uint32_t place) { return l.place < place; });
      for (std::uint32_t i = first; i < last; ++i) {
        const CanonicalVertex& v = vertices_[i];
        const HalfedgeId at = part.so_far().vertices.back().svertices;
        const std::span<HalfedgeId> numbers = numbers_of(v.part);
        const std::uint32_t old = complex(i).vertices.svertices(v.vertex).index();
        const PointRef p = point(i);
        const RingOfPattern* ring = kFastPaths ? this->ring(i) : nullptr;
        if (ring != nullptr && !rings.read(*ring, planes_of_pairs(i), rows_of(v.part))) ring = nullptr;
        if (const CanonicalRings::Written* like = ring == nullptr ? nullptr : rings.known()) {
          part.append_like(*p.table, p.id, like->vertex, rings.planes());
          if (numbers.empty()) continue;
          const std::span<const std::uint8_t> svertices = rings.svertices();
          for (std::size_t k = 0; k < svertices.size(); ++k) numbers[old + svertices[k]] = at + like->svertex[k];
          continue;
        }
        const auto line_end = std::find_if(line, lines_.end(), [i](const BareLine& l) { return l.place != i; });
        writer.set_rows(parts_[v.part].rows, rows_of(v.part));
        part.append(*p.table, p.id, writer.write(map(i), {line, line_end}));
        if (ring != nullptr) rings.learn(VertexId{i - first}, writer.svertex_numbers());
        line = line_end;
        if (numbers.empty()) continue;
        for (std::uint32_t s = 0; s < writer.svertex_numbers().size(); ++s) {
          numbers[old + s] = at + writer.svertex_numbers()[s];
        }
      }
      written[chunk] = part.take_so_far();
    });
    if (chunks == 1) return builder.take_vertices(std::move(written[0]));
    join(written, builder);
    for (std::size_t k = 0; k < chunks; ++k) first_svertex[k + 1] += first_svertex[k];
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t chunk, const Monitor&) {
      for (std::uint32_t i = first; i < last; ++i) {
        const CanonicalVertex& v = vertices_[i];
        const std::span<HalfedgeId> numbers = numbers_of(v.part);
        if (numbers.empty()) continue;
        for (const HalfedgeId h : complex(i).halfedges(v.vertex)) numbers[h.index()] += first_svertex[chunk];
      }
    });
  }

  void join(std::vector<Complex>& written, ComplexBuilder& builder) const {
    builder.reserve(count(), size_of(0, count()));
    for (Complex& part : written) {
      builder.copy(part);
      part = Complex();
    }
  }

  // None if the part has no twins.
  [[nodiscard]] std::span<HalfedgeId> numbers_of(std::uint32_t part) {
    return std::span(numbers_).subspan(first_number_[part], first_number_[part + 1U] - first_number_[part]);
  }

  [[nodiscard]] KnownLinks known_twins(const Complex& written) {
    KnownLinks known;
    known.twin.assign(written.svertex_count(), HalfedgeId());
    std::vector<std::vector<VertexId>> loose(chunk_count());
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t chunk, const Monitor&) {
      for (std::uint32_t i = first; i < last; ++i) {
        const std::span<const HalfedgeId> numbers = numbers_of(vertices_[i].part);
        const Complex& c = complex(i);
        bool all = true;
        for (const HalfedgeId h : c.halfedges(vertices_[i].vertex)) {
          const HalfedgeId twin = numbers.empty() ? HalfedgeId() : numbers[c.twin[h].index()];
          if (twin.valid()) known.twin[numbers[h.index()]] = twin;
          all = all && twin.valid();
        }
        if (!all) loose[chunk].push_back(VertexId{i});
      }
    });
    for (const auto& some : loose) known.loose_vertices.insert(known.loose_vertices.end(), some.begin(), some.end());
    return known;
  }

  static constexpr std::uint32_t kChunk = 8192;  // vertices
  static constexpr std::size_t kParts = 32;      // of a task

  PlaneTable planes_;
  std::span<const CanonicalPart> parts_;
  std::vector<CanonicalVertex> vertices_;
  Monitor monitor_;
  std::vector<std::array<double, 3>> places_;  // of vertices, until they are in order
  std::vector<std::uint8_t> reducible_;        // coordinates of a vertex have common factors
  PointTable reduced_;
  std::vector<std::uint32_t> reduced_at_;  // of each vertex, or kNone; empty if all are reduced as they are
  std::vector<RingsOfPatterns> rings_;     // of the parts
  std::vector<BareLine> lines_;            // in the order of the vertices
  std::vector<std::uint32_t> row_;         // of each plane in the result
  std::vector<std::size_t> first_number_;  // of each part in the list below
  std::vector<HalfedgeId> numbers_;        // in the result, of the svertices of parts that have twins
};

std::vector<CanonicalVertex> all_vertices(const Complex& complex) {
  std::vector<CanonicalVertex> vertices(complex.vertex_count());
  for (const VertexId v : complex.vertex_ids()) vertices[v.index()].vertex = v;
  return vertices;
}

}  // namespace

Complex canonical_complex(PlaneTable&& planes, std::span<const CanonicalPart> parts,
                          std::vector<CanonicalVertex>&& vertices, LabelId outer, const Monitor& monitor) {
  return Canonical(std::move(planes), parts, std::move(vertices), monitor).run(outer);
}

Polyhedron in_canonical_order(const Polyhedron& set, const Monitor& monitor) {
  const Complex& c = set.complex();
  const CanonicalPart part{&c, {}};
  return Polyhedron(
      canonical_complex(PlaneTable(c.planes), {&part, 1}, all_vertices(c), c.volumes[kOuterVolume].mark, monitor));
}

CanonicalVertices canonical_vertices(const Polyhedron& set, const Monitor& monitor) {
  const Complex& c = set.complex();
  const CanonicalPart part{&c, {}};
  return Canonical(PlaneTable(c.planes), {&part, 1}, all_vertices(c), monitor)
      .run_unlinked(c.volumes[kOuterVolume].mark);
}

}  // namespace nef
