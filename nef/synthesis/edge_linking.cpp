// SPDX-License-Identifier: Apache-2.0
//
// Each svertex gets a name for its line: the rows of the two smallest planes of facets around it. If fewer than two
// planes arrive there, it is the number of the line among exact lines (Pluecker coordinates, made unique). A hash table
// groups svertices by this name. A group of two is an edge; a larger group holds several edges of one line, so it is
// sorted along the line, where edges that begin and edges that end must alternate. With several threads, names are
// first distributed by hash, and each share is grouped by itself.
#include "nef/synthesis/edge_linking.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_map>

#include "nef/base/defect.h"
#include "nef/base/fast_path.h"
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
    bucket();
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
    bucket();
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

  static std::uint64_t hash(const LineKey& key) {
    std::uint64_t h = (static_cast<std::uint64_t>(key.first) << 32U | key.second) * 0x9e3779b97f4a7c15ULL;
    return h ^ (h >> 29U);
  }

  void bucket() {
    if (monitor_.threads() == 1 || keys_.size() < kFewKeys) {
      std::vector<std::uint32_t> all(keys_.size());
      std::iota(all.begin(), all.end(), 0U);
      bucket(all, monitor_);
      return;
    }
    const auto shares = shared_out<std::uint32_t>(keys_.size(), monitor_, [&](std::size_t i, const auto& put) {
      put((hash(keys_[i]) >> 40U) % kShares, static_cast<std::uint32_t>(i));
    });
    parallel_for(kShares, monitor_, [&](std::size_t share, const Monitor& own) { bucket(shares[share], own); });
  }

  // Pairs up the svertices of some keys: all those of each line among them.
  void bucket(std::span<const std::uint32_t> mine, const Monitor& own) {
    std::size_t capacity = 16;
    while (capacity < mine.size() + mine.size() / 2) capacity *= 2;
    std::vector<std::uint32_t> slots(capacity, kNone);    // first key of the group in this slot
    std::vector<std::uint32_t> next(mine.size(), kNone);  // the others, last come first
    std::vector<std::uint32_t> crowded;                   // heads of groups with more than two
    std::vector<std::uint32_t> size(mine.size(), 0);
    for (std::uint32_t i = 0; i < mine.size(); ++i) {
      const LineKey& key = keys_[mine[i]];
      std::size_t slot = hash(key) & (capacity - 1);
      while (slots[slot] != kNone && !(keys_[mine[slots[slot]]] == key)) slot = (slot + 1) & (capacity - 1);
      if (slots[slot] == kNone) slots[slot] = i;
      const std::uint32_t head = slots[slot];
      if (++size[head] == 3) crowded.push_back(head);
      if (head != i) {
        next[i] = next[head];
        next[head] = i;
      }
    }
    std::vector<HalfedgeId> group;
    for (std::uint32_t i = 0; i < mine.size(); ++i) {
      detail::require(size[i] != 1, "an edge has two ends", {{"halfedge", svertex(mine[i])}});
      if (size[i] == 2) pair(svertex(mine[i]), svertex(mine[next[i]]));
    }
    for (const std::uint32_t head : crowded) {
      group.clear();
      for (std::uint32_t i = head; i != kNone; i = next[i]) group.push_back(svertex(mine[i]));
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
