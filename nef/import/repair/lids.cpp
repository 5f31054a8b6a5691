// SPDX-License-Identifier: Apache-2.0
//
// Loops: sides with their balance (how often they are run through one way less the other) leave a graph in which as
// many arrows come to a vertex as leave it. From the end of an arrow, breadth first, the shortest way leads back to its
// beginning. So a crack between two parts, whose borders share some vertices, gets a sliver from each such vertex to
// the next, instead of a lid over each part.
//
// Triangles: by dynamic programming over chains of the loop, each split where its two parts and the triangle over them
// have the least area in sum. Of long loops, ears are cut off in the order of their areas first.
#include "nef/import/repair/lids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "nef/geometry/vectors.h"
#include "nef/mesh/mesh.h"
#include "nef/mesh/surface/mesh_surface.h"

namespace nef {
namespace {

using Ring = std::vector<std::uint32_t>;

constexpr std::size_t kLongLoop = 400;

// Sides by their vertices, the smaller one first: how often faces go from it to the larger one, less the way back.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance_of_sides(const std::vector<Ring>& rings) {
  std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, int>> uses;
  for (const Ring& ring : rings) {
    for_each_side(ring, [&](std::uint32_t u, std::uint32_t v) {
      if (u != v) uses.push_back({std::minmax(u, v), u < v ? 1 : -1});
    });
  }
  std::sort(uses.begin(), uses.end());
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> open;
  for (std::size_t i = 0; i < uses.size();) {
    int sum = 0;
    std::size_t k = i;
    for (; k < uses.size() && uses[k].first == uses[i].first; ++k) sum += uses[k].second;
    if (sum != 0) open.emplace_hint(open.end(), uses[i].first, sum);
    i = k;
  }
  return open;
}

// The sides that faces leave open, each as an arrow against its faces.
class BorderGraph {
 public:
  explicit BorderGraph(const std::map<std::pair<std::uint32_t, std::uint32_t>, int>& balances) {
    for (const auto& [side, balance] : balances) vertices_.insert(vertices_.end(), {side.first, side.second});
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    next_.resize(vertices_.size());
    for (const auto& [side, balance] : balances) {
      const auto [from, to] = balance > 0 ? std::pair(side.second, side.first) : side;
      Ring& ways = next_[place_of(from)];
      ways.insert(ways.end(), static_cast<std::size_t>(std::abs(balance)), place_of(to));
    }
    seen_.assign(vertices_.size(), 0);
    before_.assign(vertices_.size(), 0);
  }

  /// Takes the shortest loop through one arrow after the other, until none is left. Places with many ways come first:
  /// a search that comes to one looks at all of them, but not at those of its start.
  std::vector<Ring> take_loops() {
    Ring starts(next_.size());
    std::iota(starts.begin(), starts.end(), 0U);
    std::stable_sort(starts.begin(), starts.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return next_[a].size() > next_[b].size(); });
    std::vector<Ring> loops;
    for (const std::uint32_t start : starts) {
      while (!next_[start].empty()) loops.push_back(take_loop(start));
    }
    return loops;
  }

 private:
  [[nodiscard]] std::uint32_t place_of(std::uint32_t vertex) const {
    return static_cast<std::uint32_t>(std::lower_bound(vertices_.begin(), vertices_.end(), vertex) - vertices_.begin());
  }

  // As many arrows come to each place as leave it, so the search along them gets back.
  Ring take_loop(std::uint32_t start) {
    ++round_;
    Ring reached{next_[start].back()};
    seen_[reached[0]] = round_;
    for (std::size_t i = 0; seen_[start] != round_; ++i) {
      for (const std::uint32_t to : next_[reached[i]]) {
        if (seen_[to] == round_) continue;
        seen_[to] = round_;
        before_[to] = reached[i];
        reached.push_back(to);
      }
    }
    Ring loop{vertices_[start]};
    std::uint32_t to = start;
    while (to != reached[0]) {
      const std::uint32_t from = before_[to];
      take_arrow(from, to);
      loop.push_back(vertices_[from]);
      to = from;
    }
    take_arrow(start, to);
    std::reverse(loop.begin() + 1, loop.end());
    return loop;
  }

  void take_arrow(std::uint32_t from, std::uint32_t to) {
    Ring& ways = next_[from];
    // From the back: there is the arrow with which a search begins.
    ways.erase(std::next(std::find(ways.rbegin(), ways.rend(), to)).base());
  }

  Ring vertices_;
  std::vector<Ring> next_;             // where the arrows of a place lead
  std::vector<std::uint32_t> before_;  // the place from which the search came
  std::vector<std::uint64_t> seen_;    // the last search that came to a place
  std::uint64_t round_ = 0;
};

double area(const Double3& a, const Double3& b, const Double3& c) {
  const Double3 n = cross(minus(b, a), minus(c, a));
  return std::hypot(n[0], n[1], n[2]) / 2;
}

// Corners of the vertices in doubles, so scaled that areas do not overflow if the coordinates are doubles.
class Corners {
 public:
  explicit Corners(std::span<const Rational3> vertices) : vertices_(vertices) {
    double largest = 0;
    for (const Rational3& v : vertices) {
      for (const Rational& x : v) largest = std::max(largest, std::abs(nearest_double(x)));
    }
    if (largest > 0) std::frexp(largest, &exponent_);
  }

  [[nodiscard]] Double3 operator[](std::uint32_t v) const {
    Double3 result{};
    for (std::size_t i = 0; i < 3; ++i) result[i] = std::ldexp(nearest_double(vertices_[v][i]), -exponent_);
    return result;
  }

  // Of a polygon: half of the length of the sum of its triangles' normals. For faces that are not planar, less than
  // that of any triangulation.
  [[nodiscard]] double area_of(const Ring& ring) const {
    Double3 sum{};
    if (ring.empty()) return 0;
    const Double3 a = (*this)[ring[0]];
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
      sum = plus(sum, cross(minus((*this)[ring[i]], a), minus((*this)[ring[i + 1]], a)));
    }
    return std::hypot(sum[0], sum[1], sum[2]) / 2;
  }

 private:
  std::span<const Rational3> vertices_;
  int exponent_ = 0;
};

class LoopTriangulation {
 public:
  LoopTriangulation(const Corners& corners, Ring loop) : loop_(std::move(loop)) {
    for (const std::uint32_t v : loop_) points_.push_back(corners[v]);
  }

  std::vector<Ring> run() {
    if (loop_.size() > kLongLoop) cut_ears();
    best_chains();
    return std::move(triangles_);
  }

 private:
  struct Ear {
    double area = 0;
    std::uint32_t at = 0;
    std::uint32_t stamp = 0;  // of its corner when it was measured
    bool operator<(const Ear& other) const { return area != other.area ? area > other.area : at > other.at; }
  };

  void cut_ears() {
    const auto n = static_cast<std::uint32_t>(loop_.size());
    std::vector<std::uint32_t> before(n);
    std::vector<std::uint32_t> after(n);
    std::vector<std::uint32_t> stamp(n, 0);
    std::priority_queue<Ear> ears;
    const auto measure = [&](std::uint32_t i) {
      ears.push({area(points_[before[i]], points_[i], points_[after[i]]), i, ++stamp[i]});
    };
    for (std::uint32_t i = 0; i < n; ++i) {
      before[i] = (i + n - 1) % n;
      after[i] = (i + 1) % n;
    }
    for (std::uint32_t i = 0; i < n; ++i) measure(i);
    std::vector<bool> cut(n, false);
    for (std::size_t left = n; left > kLongLoop;) {
      const Ear ear = ears.top();
      ears.pop();
      if (cut[ear.at] || ear.stamp != stamp[ear.at]) continue;
      triangles_.push_back({loop_[before[ear.at]], loop_[ear.at], loop_[after[ear.at]]});
      cut[ear.at] = true;
      after[before[ear.at]] = after[ear.at];
      before[after[ear.at]] = before[ear.at];
      measure(before[ear.at]);
      measure(after[ear.at]);
      --left;
    }
    std::size_t kept = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (cut[i]) continue;
      loop_[kept] = loop_[i];
      points_[kept++] = points_[i];
    }
    loop_.resize(kept);
    points_.resize(kept);
  }

  void best_chains() {
    const std::size_t n = loop_.size();
    if (n < 3) return;
    std::vector<double> least(n * n, 0);
    std::vector<std::uint32_t> split(n * n, 0);
    for (std::size_t length = 2; length < n; ++length) {
      for (std::size_t i = 0; i + length < n; ++i) {
        const std::size_t k = i + length;
        double best = std::numeric_limits<double>::infinity();
        std::size_t at = i + 1;
        for (std::size_t m = i + 1; m < k; ++m) {
          const double parts = least[i * n + m] + least[m * n + k];
          if (parts >= best) continue;
          const double sum = parts + area(points_[i], points_[m], points_[k]);
          if (sum < best) {
            best = sum;
            at = m;
          }
        }
        least[i * n + k] = best;
        split[i * n + k] = static_cast<std::uint32_t>(at);
      }
    }
    std::vector<std::pair<std::size_t, std::size_t>> chains{{0, n - 1}};
    while (!chains.empty()) {
      const auto [i, k] = chains.back();
      chains.pop_back();
      if (k - i < 2) continue;
      const std::size_t m = split[i * n + k];
      triangles_.push_back({loop_[i], loop_[m], loop_[k]});
      chains.emplace_back(i, m);
      chains.emplace_back(m, k);
    }
  }

  Ring loop_;
  std::vector<Double3> points_;
  std::vector<Ring> triangles_;
};

bool is_flat(std::span<const Rational3> vertices, const Ring& loop, const Monitor& monitor) {
  Mesh lid;
  Ring ring;
  for (const std::uint32_t v : loop) {
    ring.push_back(static_cast<std::uint32_t>(lid.vertices.size()));
    lid.vertices.push_back(vertices[v]);
  }
  lid.push_face(ring);
  const MeshSurface surface(lid, monitor);
  return surface.defects[0] == FaceDefect::kNone && surface.planar[0];
}

}  // namespace

std::vector<Ring> border_loops(const std::vector<Ring>& rings) {
  BorderGraph border(balance_of_sides(rings));
  return border.take_loops();
}

std::vector<Ring> least_area_triangles(std::span<const Rational3> vertices, const Ring& loop) {
  return LoopTriangulation(Corners(vertices), loop).run();
}

Lids lids_for(std::span<const Rational3> vertices, const std::vector<Ring>& rings, LidShape shape,
              const Monitor& monitor) {
  Lids lids;
  const std::vector<Ring> loops = border_loops(rings);
  if (loops.empty()) return lids;
  const Corners corners(vertices);
  for (const Ring& loop : loops) {
    const bool flat = is_flat(vertices, loop, monitor);
    if (!flat && shape == LidShape::kFlat) continue;
    ++lids.holes;
    lids.flat += flat ? 1 : 0;
    if (flat) {
      lids.faces.push_back(loop);
    } else {
      for (Ring& triangle : LoopTriangulation(corners, loop).run()) lids.faces.push_back(std::move(triangle));
    }
  }
  double faces = 0;
  double closed = 0;
  for (const Ring& ring : rings) faces += corners.area_of(ring);
  for (const Ring& ring : lids.faces) closed += corners.area_of(ring);
  lids.share = closed == 0 ? 0 : closed / (faces + closed);
  return lids;
}

}  // namespace nef
