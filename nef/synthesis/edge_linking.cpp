// SPDX-License-Identifier: Apache-2.0
//
// Each svertex gets a name for its line: the rows of the two smallest planes of facets around it. If fewer than two
// planes arrive there, it is the number of the line among exact lines (Pluecker coordinates, made unique). Sorting
// groups svertices by this name: a counting sort by the smaller plane, and each of its groups by itself. Vertices and
// planes that are neighbours in space have numbers close to each other, so this runs along memory. A group of two is an
// edge; a larger group holds several edges of one line, so it is sorted along the line, where edges that begin and
// edges that end must alternate. With several threads, each share is the names of a range of planes.
#include "nef/synthesis/edge_linking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "nef/base/defect.h"
#include "nef/base/fast_path.h"
#include "nef/base/threads/group_by.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/threads/shared_out.h"
#include "nef/number/int128.h"

namespace nef {
namespace {

// The name of a line: two plane rows, or kLine and the number of an interned line.
struct LineKey {
  std::uint32_t first = kNone;
  std::uint32_t second = kNone;
  bool operator==(const LineKey&) const = default;
};
constexpr std::uint32_t kLine = 0xfffffffeU;

constexpr std::size_t kFewKeys = 1U << 15U;     // one share does
constexpr std::uint32_t kVertices = 1U << 12U;  // of a task

// Interns lines by their Pluecker coordinates: the direction n_p x n_q and the moment
// d_q n_p - d_p n_q (with its part in R), without common factor and with a positive leading component.
class LineTable {
 public:
  LineTable() : rows_(9) {}

  // Small integers take 19 % off the union of two fans of 100 triangles around one apex (bench `sphere_map-100`).
  std::uint32_t number(const PlaneTable& planes, PlaneId p, PlaneId q) {
    if (std::array<Int128, 9> small{}; small_line(planes, p, q, small)) return number(rows_.push(small));
    std::array<Integer, 9> v;
    const std::array<IntegerView, 5> a = planes.coefficients(p);
    const std::array<IntegerView, 5> b = planes.coefficients(q);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      subtract_products(v[i], a[j], b[k], a[k], b[j]);
      subtract_products(v[3 + i], b[3], a[i], a[3], b[i]);
      subtract_products(v[6 + i], b[4], a[i], a[4], b[i]);
    }
    Integer divisor = 0;
    for (const Integer& value : v) mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), value.get_mpz_t());
    const auto lead = std::find_if(v.begin(), v.end(), [](const Integer& value) { return value != 0; });
    if (*lead < 0) divisor = -divisor;
    std::array<mpz_srcptr, 9> row{};
    for (std::size_t i = 0; i < 9; ++i) {
      mpz_divexact(v[i].get_mpz_t(), v[i].get_mpz_t(), divisor.get_mpz_t());
      row[i] = v[i].get_mpz_t();
    }
    return number(rows_.push(row));
  }

 private:
  // The same of planes whose coefficients are below 2^31, so that all that comes up is below 2^63.
  static bool small_line(const PlaneTable& planes, PlaneId p, PlaneId q, std::array<Int128, 9>& v) {
    constexpr std::int64_t kLimit = std::int64_t{1} << 31U;
    std::array<std::int64_t, 5> a{};
    std::array<std::int64_t, 5> b{};
    if (!kFastPaths || !planes.small_coefficients(p, a) || !planes.small_coefficients(q, b)) return false;
    const auto is_large = [](std::int64_t value) { return value >= kLimit || value <= -kLimit; };
    if (std::any_of(a.begin(), a.end(), is_large) || std::any_of(b.begin(), b.end(), is_large)) return false;
    std::array<std::int64_t, 9> line{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      line[i] = a[j] * b[k] - a[k] * b[j];
      line[3 + i] = b[3] * a[i] - a[3] * b[i];
      line[6 + i] = b[4] * a[i] - a[4] * b[i];
    }
    std::int64_t divisor = 0;
    for (const std::int64_t value : line) divisor = std::gcd(divisor, value);
    if (*std::find_if(line.begin(), line.end(), [](std::int64_t value) { return value != 0; }) < 0) divisor = -divisor;
    for (std::size_t i = 0; i < 9; ++i) v[i] = line[i] / divisor;
    return true;
  }

  // The last row; it is taken off again if it was there before.
  std::uint32_t number(std::uint32_t candidate) {
    const auto [first, last] = by_hash_.equal_range(rows_.hash(candidate));
    for (auto at = first; at != last; ++at) {
      if (!rows_.equal(at->second, rows_, candidate)) continue;
      rows_.pop();
      return at->second;
    }
    by_hash_.emplace(rows_.hash(candidate), candidate);
    return candidate;
  }

  static void subtract_products(Integer& out, mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, mpz_srcptr d) {
    mpz_mul(out.get_mpz_t(), a, b);
    mpz_submul(out.get_mpz_t(), c, d);
  }

  IntegerRows rows_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> by_hash_;
};

class Linker {
 public:
  Linker(Complex& complex, const Monitor& monitor) : c_(complex), monitor_(monitor) {}

  void link_all() {
    keys_.resize(c_.svertex_count());
    c_.twin.assign(c_.svertex_count(), HalfedgeId());
    const VertexId end{c_.vertex_count()};
    parallel_for((c_.vertex_count() + kVertices - 1) / kVertices, monitor_, [&](std::size_t task, const Monitor&) {
      const VertexId first{task * kVertices};
      for (VertexId v = first; v < std::min(first + kVertices, end); ++v) {
        name_lines(v, keys_.data() + c_.vertices[v].svertices.index());
      }
    });
    name_bare_lines();
    pair_all();
  }

  void link_loose(std::span<const VertexId> vertices) {
    std::vector<LineKey> keys;
    for (const VertexId v : vertices) {
      const IdRange<HalfedgeId> halfedges = c_.halfedges(v);
      keys.assign(halfedges.size(), LineKey{});
      name_lines(v, keys.data());
      for (const HalfedgeId h : halfedges) {
        if (c_.twin[h].valid()) continue;
        loose_.push_back(h);
        keys_.push_back(keys[halfedges.position(h)]);
      }
    }
    name_bare_lines();
    pair_all();
  }

 private:
  // The svertex that key i belongs to.
  [[nodiscard]] HalfedgeId svertex(std::size_t i) const { return loose_.empty() ? HalfedgeId{i} : loose_[i]; }

  void name_lines(VertexId vertex, LineKey* keys) const {
    const SphereMapView map = c_.sphere_map(vertex);
    for (const SHalfedge& half : map.shalfedges) {
      const std::uint32_t row = half.plane.row();
      LineKey& key = keys[half.source];
      if (row < key.first) {
        key.second = key.first;
        key.first = row;
      } else if (row != key.first && row < key.second) {
        key.second = row;
      }
    }
  }

  void name_bare_lines() {
    LineTable lines;  // few: only dangling and isolated edges
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      if (keys_[i].second != kNone) continue;
      const SVertex& v = c_.svertex(svertex(i));
      keys_[i] = {kLine, lines.number(c_.planes, v.p, v.q)};
    }
  }

  // A key and its number.
  struct Named {
    LineKey key;
    std::uint32_t i = 0;
    bool operator<(const Named& other) const {
      return std::tie(key.first, key.second, i) < std::tie(other.key.first, other.key.second, other.i);
    }
  };

  // Of the first plane of a key; that of numbered lines comes after all planes.
  [[nodiscard]] std::size_t row_of(const LineKey& key) const {
    return std::min<std::size_t>(key.first, c_.planes.size());
  }

  // Planes by their rows, and numbered lines.
  void pair_all() {
    const std::size_t rows = c_.planes.size() + 1;
    if (monitor_.threads() == 1 || keys_.size() < kFewKeys) {
      pair_up(
          keys_.size(), [](std::size_t k) { return static_cast<std::uint32_t>(k); }, {0, rows}, monitor_);
      return;
    }
    const std::size_t range = (rows + kShares - 1) / kShares;
    const auto shares = shared_out<std::uint32_t>(keys_.size(), monitor_, [&](std::size_t i, const auto& put) {
      put(row_of(keys_[i]) / range, static_cast<std::uint32_t>(i));
    });
    parallel_for(kShares, monitor_, [&](std::size_t s, const Monitor& own) {
      const std::vector<std::uint32_t>& mine = shares[s];
      pair_up(
          mine.size(), [&mine](std::size_t k) { return mine[k]; }, {s * range, std::min((s + 1) * range, rows)}, own);
    });
  }

  // Sorts keys, given by their numbers 0 <= k < count, whose rows are in a range.
  template <typename NumberOf>
  std::vector<Named> sorted(std::size_t count, const NumberOf& number_of, std::array<std::size_t, 2> rows) const {
    int shift = 0;  // few keys have groups of several planes
    while ((rows[1] - rows[0]) >> shift > 2 * count + 16) ++shift;
    std::vector<Named> result(count);
    const std::vector<std::uint32_t> begin =
        group_by(((rows[1] - rows[0]) >> shift) + 1,
                 [&](const auto& visit) {
                   for (std::size_t k = 0; k < count; ++k) {
                     const Named named{keys_[number_of(k)], number_of(k)};
                     visit(static_cast<std::uint32_t>((row_of(named.key) - rows[0]) >> shift), named);
                   }
                 },
                 [&result](std::uint32_t place, const Named& named) { result[place] = named; }, monitor_.on_threads(1));
    for (std::size_t g = 0; g + 1 < begin.size(); ++g) {
      sort_short(std::span(result).subspan(begin[g], begin[g + 1] - begin[g]), std::less<>());
    }
    return result;
  }

  // Pairs up the svertices of some keys: all those of each line among them.
  template <typename NumberOf>
  void pair_up(std::size_t count, const NumberOf& number_of, std::array<std::size_t, 2> rows, const Monitor& own) {
    const std::vector<Named> names = sorted(count, number_of, rows);
    std::vector<HalfedgeId> group;
    for (std::size_t first = 0, last = 0; first < count; first = last) {
      while (last < count && names[last].key == names[first].key) ++last;
      detail::require(last - first > 1, "an edge has two ends", {{"halfedge", svertex(names[first].i)}});
      if (last - first == 2) {
        pair(svertex(names[first].i), svertex(names[first + 1].i));
        continue;
      }
      group.clear();
      for (std::size_t k = first; k < last; ++k) group.push_back(svertex(names[k].i));
      pair_along_line(group, own);
    }
  }

  void pair(HalfedgeId a, HalfedgeId b) {
    detail::require(c_.source(a) != c_.source(b), "an edge joins two vertices", {{"halfedge", a}, {"halfedge", b}});
    detail::require(c_.is_bare(a) == c_.is_bare(b), "an edge has facets at both ends or at none",
                    {{"halfedge", a}, {"halfedge", b}});
    c_.twin[a] = b;
    c_.twin[b] = a;
  }

  // +1 if the svertex points along the line's reference direction.
  int sense(HalfedgeId s, HalfedgeId reference, const Direction& direction, const Monitor& own) const {
    const SVertex& v = c_.svertex(s);
    const SVertex& r = c_.svertex(reference);
    if (v.p.row() == r.p.row() && v.q.row() == r.q.row())
      return ((v.p.value ^ v.q.value ^ r.p.value ^ r.q.value) & 1U) != 0 ? -1 : 1;
    return sign_of_dot(direction, Direction::cross(c_.planes, v.p, v.q), own);
  }

  void pair_along_line(std::vector<HalfedgeId>& group, const Monitor& own) {
    const HalfedgeId reference = group.front();
    const Direction direction = Direction::cross(c_.planes, c_.svertex(reference).p, c_.svertex(reference).q);
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
      if (std::fabs(direction.approximate[static_cast<std::size_t>(i)]) >
          std::fabs(direction.approximate[static_cast<std::size_t>(axis)])) {
        axis = i;
      }
    }
    const int rising = direction.approximate[static_cast<std::size_t>(axis)] > 0 ? 1 : -1;
    struct Entry {
      HalfedgeId svertex;
      VertexId vertex;
      int sense;
    };
    std::vector<Entry> entries;
    for (const HalfedgeId s : group) entries.push_back({s, c_.source(s), sense(s, reference, direction, own)});
    std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
      if (a.vertex == b.vertex) return a.sense < b.sense;  // an edge ends before the next begins
      return rising * compare_coordinate(c_.points, point_of(a.vertex), point_of(b.vertex), axis, own) < 0;
    });
    detail::require(entries.size() % 2 == 0, "an edge has two ends", {{"halfedge", reference}});
    for (std::size_t i = 0; i < entries.size(); i += 2) {
      detail::require(entries[i].sense > 0 && entries[i + 1].sense < 0, "edges of one line lie apart",
                      {{"halfedge", entries[i].svertex}, {"halfedge", entries[i + 1].svertex}});
      pair(entries[i].svertex, entries[i + 1].svertex);
    }
  }

  Complex& c_;
  Monitor monitor_;
  std::vector<LineKey> keys_;
  std::vector<HalfedgeId> loose_;  // svertices of the keys; empty: all
};

}  // namespace

void link_edges(Complex& complex, const Monitor& monitor) { Linker(complex, monitor).link_all(); }

void link_edges(Complex& complex, KnownLinks& known, const Monitor& monitor) {
  complex.twin = std::move(known.twin);
  if (!known.loose_vertices.empty()) Linker(complex, monitor).link_loose(known.loose_vertices);
}

}  // namespace nef
