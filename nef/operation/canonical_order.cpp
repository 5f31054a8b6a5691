// SPDX-License-Identifier: Apache-2.0
#include "nef/operation/canonical_order.h"

#include <algorithm>
#include <atomic>

#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/threads/parallel.h"
#include "nef/geometry/spatial_order.h"
#include "nef/operation/canonical_map.h"
#include "nef/sphere_map/sphere_geometry.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {
namespace {

// A total order of the planes of one table.
bool coefficients_less(const PlaneTable& planes, std::uint32_t a, std::uint32_t b) {
  for (std::size_t i = 0; i < 5; ++i) {
    const int order = mpz_cmp(planes.coefficient(PlaneId{a << 1U}, i), planes.coefficient(PlaneId{b << 1U}, i));
    if (order != 0) return order < 0;
  }
  return false;
}

// Becomes the smaller one, whatever other threads do to it.
void take_smaller(std::uint32_t& smallest, std::uint32_t value) {
  const std::atomic_ref<std::uint32_t> shared(smallest);
  std::uint32_t now = shared.load(std::memory_order_relaxed);
  while (value < now && !shared.compare_exchange_weak(now, value, std::memory_order_relaxed)) {
  }
}

class Canonical {
 public:
  Canonical(PlaneTable&& planes, std::span<const CanonicalPart> parts, std::vector<CanonicalVertex>&& vertices,
            unsigned threads)
      : planes_(std::move(planes)), parts_(parts), vertices_(std::move(vertices)), threads_(threads) {}

  Complex run(LabelId outer) {
    drop_idle_box(outer);
    reduce_points();
    put_in_order();
    choose_lines();
    PlaneTable planes = ordered_planes();
    ComplexBuilder builder(planes);
    write(planes, builder);
    KnownLinks known = known_twins(builder.so_far());
    svertices_ = {};
    return builder.finish(outer, std::move(known), threads_);
  }

 private:
  struct Point {
    const PointTable& table;
    PointId id;
  };

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(vertices_.size()); }
  [[nodiscard]] const Complex& complex(std::uint32_t i) const { return *parts_[vertices_[i].part].complex; }
  [[nodiscard]] SphereMapView map(std::uint32_t i) const { return complex(i).sphere_map(vertices_[i].vertex); }
  [[nodiscard]] PlaneId common(std::uint32_t i, PlaneId plane) const {
    const std::span<const std::uint32_t> rows = parts_[vertices_[i].part].rows;
    return rows.empty() ? plane : PlaneId{rows[plane.row()] << 1U | (plane.value & 1U)};
  }
  [[nodiscard]] Point point(std::uint32_t i) const {
    if (!reduced_at_.empty() && reduced_at_[i] != kNone) return {reduced_, PointId{reduced_at_[i]}};
    return {complex(i).points, point_of(vertices_[i].vertex)};
  }

  // Calls body(first, last, chunk) for parts of all vertices, several at once; one thread has one part.
  [[nodiscard]] std::size_t chunk_count() const { return threads_ == 1 ? 1 : (count() + kChunk - 1) / kChunk; }
  template <typename Body>
  void for_each_chunk(Body&& body) const {
    const std::size_t chunks = chunk_count();
    check_interruption();
    parallel_for(chunks, threads_, [&](std::size_t k) {
      const auto first = static_cast<std::uint32_t>(k * kChunk);
      body(first, chunks == 1 ? count() : std::min(count(), first + kChunk), k);
    });
  }

  void drop_idle_box(LabelId& outer) {
    std::vector<CanonicalVertex> infinite;
    const auto is_infinite = [this](const CanonicalVertex& v) {
      return !parts_[v.part].complex->points.finite(point_of(v.vertex));
    };
    std::copy_if(vertices_.begin(), vertices_.end(), std::back_inserter(infinite), is_infinite);
    ComplexBuilder box(planes_);
    for (const CanonicalVertex& v : infinite) box.copy(*parts_[v.part].complex, v.vertex, 1);
    if (!box.has_idle_box()) return;
    outer = box.so_far().mark(VertexId{0});
    std::erase_if(vertices_, is_infinite);
  }

  // Those whose coordinates have common factors.
  void reduce_points() {
    std::vector<std::uint8_t> reducible(count(), 0);
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t) {
      Integer divisor;
      for (std::uint32_t i = first; i < last; ++i) {
        reducible[i] = complex(i).points.is_reduced(point_of(vertices_[i].vertex), divisor) ? 0 : 1;
      }
    });
    for (std::uint32_t i = 0; i < count(); ++i) {
      if (reducible[i] == 0) continue;
      if (reduced_at_.empty()) reduced_at_.assign(count(), kNone);
      reduced_.push_reduced(complex(i).points, point_of(vertices_[i].vertex));
      reduced_at_[i] = static_cast<std::uint32_t>(reduced_.size() - 1);
    }
  }

  // Along a curve through space; lexicographic within its cells.
  void put_in_order() {
    std::vector<std::array<double, 3>> places(count());
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t) {
      for (std::uint32_t i = first; i < last; ++i) {
        const Point p = point(i);
        places[i] = p.table.approximate(p.id);
      }
    });
    PointTable two;
    const std::vector<std::uint32_t> order = spatial_order(places, [&](std::uint32_t a, std::uint32_t b) {
      const Point p = point(a);
      const Point q = point(b);
      two.push_from(p.table, p.id);
      two.push_from(q.table, q.id);
      const bool less = compare_lexicographic(two, PointId{0}, PointId{1}) < 0;
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
  }

  // The two planes that name the line of each svertex: of facets where two arrive, others parallel to an axis.
  void choose_lines() {
    std::vector<std::vector<BareLine>> of_chunk(chunk_count());
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t chunk) {
      std::vector<std::array<std::uint32_t, 2>> rows;  // that arrive at each svertex
      for (std::uint32_t i = first; i < last; ++i) {
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
        if (line.rows[0] != kNone) line.rows[0] = common(line.place, PlaneId{line.rows[0] << 1U}).row();
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

  std::uint32_t plane_through(const Point& point, Integer3& n) {
    Integer offset;
    Integer at_infinity;
    for (std::size_t i = 0; i < 3; ++i) {
      mpz_submul(offset.get_mpz_t(), n[i].get_mpz_t(), point.table.coordinate(point.id, i));
      mpz_submul(at_infinity.get_mpz_t(), n[i].get_mpz_t(), point.table.coordinate(point.id, 4 + i));
      mpz_mul(n[i].get_mpz_t(), n[i].get_mpz_t(), point.table.coordinate(point.id, 3));
    }
    return planes_.intern(n[0], n[1], n[2], offset, at_infinity).row();
  }

  // Those in use, by the first vertex that uses them; fills row_.
  PlaneTable ordered_planes() {
    row_.assign(planes_.size(), kNone);  // until the end: the first vertex
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t) {
      for (std::uint32_t i = first; i < last; ++i) {
        const Complex& c = complex(i);
        const VertexRecord& begin = c.vertices[vertices_[i].vertex];
        const VertexRecord& end = c.vertices[vertices_[i].vertex.next()];
        for (std::uint32_t pair = begin.shalfedges / 2; pair < end.shalfedges / 2; ++pair) {
          take_smaller(row_[common(i, c.shalfedge_plane.pairs()[pair]).row()], i);
        }
        for (std::uint32_t l = begin.sloops; l < end.sloops; ++l) {
          take_smaller(row_[common(i, c.sloops[l].plane).row()], i);
        }
      }
    });
    for (const BareLine& line : lines_) {
      for (const std::uint32_t row : line.rows) take_smaller(row_[row], line.place);
    }
    std::vector<std::uint32_t> begin(count() + 1U, 0);  // of the planes of each vertex
    for (const std::uint32_t first : row_) {
      if (first != kNone) ++begin[first + 1U];
    }
    for (std::uint32_t i = 0; i < count(); ++i) begin[i + 1U] += begin[i];
    std::vector<std::uint32_t> used(begin.back());
    std::vector<std::uint32_t> end(begin.begin(), begin.end() - 1);
    for (std::uint32_t row = 0; row < row_.size(); ++row) {
      if (row_[row] != kNone) used[end[row_[row]]++] = row;
    }
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t) {
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

  // All vertices into the builder; fills svertices_.
  void write(PlaneTable& planes, ComplexBuilder& builder) {
    std::vector<std::vector<std::uint32_t>> ordered(parts_.size());  // of the planes of parts
    svertices_.resize(parts_.size());
    parallel_for(parts_.size(), threads_, [&](std::size_t k) {
      ordered[k].reserve(parts_[k].rows.size());
      for (const std::uint32_t row : parts_[k].rows) ordered[k].push_back(row_[row]);
      if (!parts_[k].complex->twin.empty()) svertices_[k].assign(parts_[k].complex->svertex_count(), HalfedgeId());
    });
    const std::size_t chunks = chunk_count();
    std::vector<std::uint32_t> first_svertex(chunks + 1, 0);
    std::vector<Complex> written(chunks);
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t chunk) {
      const VertexRecord size = size_of(first, last);
      first_svertex[chunk + 1] = size.svertices.index();
      ComplexBuilder part(planes);
      part.reserve(last - first, size);
      CanonicalMapWriter writer(planes_, planes, row_);
      auto line = std::lower_bound(lines_.begin(), lines_.end(), first,
                                   [](const BareLine& l, std::uint32_t place) { return l.place < place; });
      for (std::uint32_t i = first; i < last; ++i) {
        const CanonicalVertex& v = vertices_[i];
        const auto line_end = std::find_if(line, lines_.end(), [i](const BareLine& l) { return l.place != i; });
        writer.set_rows(parts_[v.part].rows, ordered[v.part]);
        const HalfedgeId at = part.so_far().vertices.back().svertices;
        const Point p = point(i);
        part.append(p.table, p.id, writer.write(map(i), {line, line_end}));
        line = line_end;
        if (svertices_[v.part].empty()) continue;
        HalfedgeId old = complex(i).vertices[v.vertex].svertices;
        for (const std::uint32_t s : writer.svertex_numbers()) {
          svertices_[v.part][old] = at + s;
          ++old;
        }
      }
      written[chunk] = part.take_so_far();
    });
    if (chunks == 1) return builder.take_vertices(std::move(written[0]));
    join(written, builder);
    for (std::size_t k = 0; k < chunks; ++k) first_svertex[k + 1] += first_svertex[k];
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t chunk) {
      for (std::uint32_t i = first; i < last; ++i) {
        const CanonicalVertex& v = vertices_[i];
        if (svertices_[v.part].empty()) continue;
        for (const HalfedgeId h : complex(i).halfedges(v.vertex)) svertices_[v.part][h] += first_svertex[chunk];
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

  [[nodiscard]] KnownLinks known_twins(const Complex& written) const {
    KnownLinks known;
    known.twin.assign(written.svertex_count(), HalfedgeId());
    std::vector<std::vector<VertexId>> loose(chunk_count());
    for_each_chunk([&](std::uint32_t first, std::uint32_t last, std::size_t chunk) {
      for (std::uint32_t i = first; i < last; ++i) {
        const IndexedVector<HalfedgeId, HalfedgeId>& numbers = svertices_[vertices_[i].part];
        const Complex& c = complex(i);
        bool all = true;
        for (const HalfedgeId h : c.halfedges(vertices_[i].vertex)) {
          const HalfedgeId twin = numbers.empty() ? HalfedgeId() : numbers[c.twin[h]];
          if (twin.valid()) known.twin[numbers[h]] = twin;
          all = all && twin.valid();
        }
        if (!all) loose[chunk].push_back(VertexId{i});
      }
    });
    for (const auto& some : loose) known.loose_vertices.insert(known.loose_vertices.end(), some.begin(), some.end());
    return known;
  }

  static constexpr std::uint32_t kChunk = 8192;  // vertices

  PlaneTable planes_;
  std::span<const CanonicalPart> parts_;
  std::vector<CanonicalVertex> vertices_;
  unsigned threads_;
  PointTable reduced_;
  std::vector<std::uint32_t> reduced_at_;  // of each vertex, or kNone; empty if all are reduced as they are
  std::vector<BareLine> lines_;            // in the order of the vertices
  std::vector<std::uint32_t> row_;         // of each plane in the result
  std::vector<IndexedVector<HalfedgeId, HalfedgeId>> svertices_;  // numbers in the result; of each part that has twins
};

}  // namespace

Complex canonical_complex(PlaneTable&& planes, std::span<const CanonicalPart> parts,
                          std::vector<CanonicalVertex>&& vertices, LabelId outer, unsigned threads) {
  return Canonical(std::move(planes), parts, std::move(vertices), threads).run(outer);
}

Polyhedron in_canonical_order(const Polyhedron& set) {
  const Complex& c = set.complex();
  std::vector<CanonicalVertex> vertices(c.vertex_count());
  for (const VertexId v : c.vertex_ids()) vertices[v.index()].vertex = v;
  const CanonicalPart part{&c, {}};
  return Polyhedron(
      canonical_complex(PlaneTable(c.planes), {&part, 1}, std::move(vertices), c.volumes[kOuterVolume].mark));
}

}  // namespace nef
