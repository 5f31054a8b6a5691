// SPDX-License-Identifier: Apache-2.0
//
// Triangulations of polygons with holes against what one is: triangles that turn counterclockwise and hold no corner
// inside, whose areas add up to the polygon's and whose sides cancel but for those of its rings.
#include <rapidcheck.h>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "nef/base/monitor.h"
#include "nef/mesh/polygon/triangulate.h"

namespace nef::test {
namespace {

using Ring = std::vector<std::uint32_t>;
using Side = std::pair<std::uint32_t, std::uint32_t>;

struct Polygon {
  std::vector<Rational3> points;
  std::vector<Ring> rings;
};

Rational twice_the_area(const Rational3& a, const Rational3& b, const Rational3& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

Rational twice_the_area(const std::vector<Rational3>& points, std::span<const std::uint32_t> ring) {
  Rational sum;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    sum += twice_the_area(points[ring[0]], points[ring[i]], points[ring[i + 1]]);
  }
  return sum;
}

void add_sides(std::map<Side, int>& sides, std::span<const std::uint32_t> ring, int times) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::uint32_t v = ring[i];
    const std::uint32_t w = ring[i + 1 == ring.size() ? 0 : i + 1];
    sides[{v, w}] += times;
    sides[{w, v}] -= times;
  }
}

// What is wrong with the triangles of a polygon, in words; empty if nothing is.
std::string fault(const Polygon& polygon, const std::vector<Triangulator::Triangle>& triangles) {
  const std::vector<Rational3>& points = polygon.points;
  std::map<Side, int> sides;
  std::set<std::uint32_t> used;
  Rational area;
  for (const Ring& ring : polygon.rings) {
    area -= twice_the_area(points, ring);
    add_sides(sides, ring, -1);
    used.insert(ring.begin(), ring.end());
  }
  for (const Triangulator::Triangle& t : triangles) {
    const Rational its = twice_the_area(points, t);
    if (its <= 0) return "a triangle does not turn counterclockwise";
    area += its;
    add_sides(sides, t, 1);
    for (const std::uint32_t p : used) {
      bool inside = true;
      for (std::size_t i = 0; inside && i < 3; ++i) {
        inside = twice_the_area(points[t[i]], points[t[(i + 1) % 3]], points[p]) > 0;
      }
      if (inside) return "a corner lies inside a triangle";
    }
  }
  if (area != 0) return "the areas do not add up";
  for (const auto& [side, count] : sides) {
    if (count != 0) return "sides do not cancel";
  }
  return "";
}

// The fault of the polygon's triangulation, from both sides and along different axes.
std::string fault(const Polygon& polygon) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int sign : {1, -1}) {
      std::vector<Rational3> placed;
      for (const Rational3& p : polygon.points) {
        Rational3& q = placed.emplace_back();
        q[axis] = p[0] - p[1] / 2;
        q[(axis + 1) % 3] = sign > 0 ? p[0] : p[1];
        q[(axis + 2) % 3] = sign > 0 ? p[1] : p[0];
      }
      const MeshPoints mesh_points{std::span<const Rational3>(placed)};
      std::vector<Triangulator::Triangle> triangles;
      if (!Triangulator(mesh_points, {}).triangulate(polygon.rings, axis, sign, triangles)) return "refused";
      if (std::string text = fault(polygon, triangles); !text.empty()) return text;
    }
  }
  return "";
}

// A room made of cells of a grid, with walls between some of them: holes, rings that touch themselves and each other at
// vertices, dangling edges, runs of straight corners. Rings go around it as facet cycles do.
class Room {
 public:
  Room(int width, int height, const std::function<bool()>& is_cell, const std::function<bool()>& is_wall)
      : width_(width), height_(height) {
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    std::vector<bool> cells(count);
    for (std::size_t i = 0; i < count; ++i) cells[i] = is_cell();
    for (auto& closed : walls_) {
      closed.resize(count);
      for (std::size_t i = 0; i < count; ++i) closed[i] = is_wall();
    }
    // What can be reached from the first cell.
    inside_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (!cells[i]) continue;
      std::vector<std::size_t> stack{i};
      inside_[i] = true;
      while (!stack.empty()) {
        const auto at = static_cast<int>(stack.back());
        stack.pop_back();
        for (int side = 0; side < 4; ++side) {
          const int other = beyond(at, side);
          if (other < 0 || inside_[index(other)] || !cells[index(other)] || walled(at, side)) continue;
          inside_[index(other)] = true;
          stack.push_back(index(other));
        }
      }
      break;
    }
  }

  // Side 0 is the lower one of a cell; they follow counterclockwise, as do the corners that they begin at.
  [[nodiscard]] std::vector<Ring> rings() const {
    std::vector<Ring> result;
    std::set<std::pair<int, int>> done;
    for (int cell = 0; cell < width_ * height_; ++cell) {
      for (int side = 0; side < 4; ++side) {
        if (!inside_[index(cell)] || !bounds(cell, side) || done.count({cell, side}) > 0) continue;
        Ring& ring = result.emplace_back();
        int c = cell;
        int s = side;
        while (done.insert({c, s}).second) {
          ring.push_back(corner(c, s));
          s = (s + 1) % 4;
          while (!bounds(c, s)) {
            c = beyond(c, s);
            s = (s + 3) % 4;
          }
        }
      }
    }
    return result;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] int beyond(int cell, int side) const {
    const int x = cell % width_ + (side == 1 ? 1 : side == 3 ? -1 : 0);
    const int y = cell / width_ + (side == 2 ? 1 : side == 0 ? -1 : 0);
    return x < 0 || y < 0 || x >= width_ || y >= height_ ? -1 : y * width_ + x;
  }
  // A wall belongs to the cell whose upper or right side it is.
  [[nodiscard]] bool walled(int cell, int side) const {
    if (side == 1 || side == 2) return walls_[index(side - 1)][index(cell)];
    const int other = beyond(cell, side);
    return other < 0 || walls_[index(side == 3 ? 0 : 1)][index(other)];
  }
  [[nodiscard]] bool bounds(int cell, int side) const {
    const int other = beyond(cell, side);
    return other < 0 || !inside_[index(other)] || walled(cell, side);
  }
  [[nodiscard]] std::uint32_t corner(int cell, int k) const {
    const int x = cell % width_ + (k == 1 || k == 2 ? 1 : 0);
    const int y = cell / width_ + (k == 2 || k == 3 ? 1 : 0);
    return static_cast<std::uint32_t>(y * (width_ + 1) + x);
  }

  int width_;
  int height_;
  std::vector<bool> inside_;
  std::array<std::vector<bool>, 2> walls_;
};

// The outer ring first.
void put_outer_first(Polygon& polygon) {
  for (Ring& ring : polygon.rings) {
    if (twice_the_area(polygon.points, ring) > 0) std::swap(ring, polygon.rings[0]);
  }
}

// Takes some straight corners out that only one ring has, once.
void drop_straight_corners(Polygon& polygon, const std::function<bool()>& drops) {
  std::map<std::uint32_t, int> uses;
  for (const Ring& ring : polygon.rings) {
    for (const std::uint32_t v : ring) ++uses[v];
  }
  for (Ring& ring : polygon.rings) {
    for (std::size_t i = 0; i < ring.size() && ring.size() > 3;) {
      const std::array<std::uint32_t, 3> three{ring[i == 0 ? ring.size() - 1 : i - 1], ring[i],
                                               ring[i + 1 == ring.size() ? 0 : i + 1]};
      if (uses[ring[i]] == 1 && three[0] != three[2] && twice_the_area(polygon.points, three) == 0 && drops()) {
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
      } else {
        ++i;
      }
    }
  }
}

// Maps of the plane that keep orientation.
std::vector<std::function<Rational3(const Rational&, const Rational&)>> placements() {
  const Rational tiny(Integer(1), Integer("1000000000000000000000000000000007"));
  const Rational huge(Integer("1000000000000000000000000000000007"));
  const Rational third(1, 3);
  return {
      [](const Rational& x, const Rational& y) {
        return Rational3{x, y, 0};
      },
      [](const Rational& x, const Rational& y) {
        return Rational3{2 * x + y, y - x, 0};
      },
      // By the angle of 3-4-5, with long denominators.
      [tiny, third](const Rational& x, const Rational& y) {
        return Rational3{(3 * x - 4 * y) * tiny + third, (4 * x + 3 * y) * tiny - third, 0};
      },
      // Nearly on one line.
      [tiny](const Rational& x, const Rational& y) {
        return Rational3{x, 7 * x + y * tiny, 0};
      },
      [tiny](const Rational& x, const Rational& y) {
        return Rational3{x * tiny - y, x + y, 0};
      },
      [huge](const Rational& x, const Rational& y) {
        return Rational3{x * huge, x + y * huge, 0};
      },
      // Homogeneous coordinates of more than 40 bits.
      [](const Rational& x, const Rational& y) {
        return Rational3{(x * 5 - y) / 1000003 + y / 998244353, (x + y * 3) / 1000003, 0};
      },
      // Beyond what doubles are filters for, and beyond their range.
      [huge](const Rational& x, const Rational& y) {
        const Rational far = huge * huge * huge * huge;
        return Rational3{x * far + y, y * far, 0};
      },
      [huge](const Rational& x, const Rational& y) {
        const Rational far = huge * huge * huge * huge * huge;
        return Rational3{x * far * far + far, y * far * far - x, 0};
      },
  };
}

Polygon random_room(int width, int height) {
  const auto out_of = [](int n, int all) { return *rc::gen::inRange(0, all) < n; };
  const int cells = *rc::gen::inRange(5, 11);
  const int walls = *rc::gen::inRange(0, 5);
  Polygon polygon;
  polygon.rings = Room(
                      width, height, [&] { return out_of(cells, 10); }, [&] { return out_of(walls, 10); })
                      .rings();
  const auto place = *rc::gen::elementOf(placements());
  const auto bend = *rc::gen::inRange(0, 2);
  for (int y = 0; y <= height; ++y) {
    for (int x = 0; x <= width; ++x) {
      // Columns and rows at uneven distances; of the grid, what is straight stays so.
      polygon.points.push_back(place(Rational(x + bend * x * x), Rational(y + bend * y * y * y) / 2));
    }
  }
  put_outer_first(polygon);
  const int drops = *rc::gen::inRange(0, 11);
  drop_straight_corners(polygon, [&] { return out_of(drops, 10); });
  return polygon;
}

// A square with holes of four corners around the middles of its cells; with `reach` 1 these are diamonds that touch
// their neighbours and the sides, which have corners there.
Polygon plate(int n, const Rational& reach) {
  Polygon polygon;
  std::map<std::pair<Rational, Rational>, std::uint32_t> known;
  const auto push = [&](const Rational& x, const Rational& y, Ring& ring) {
    const auto [at, is_new] = known.emplace(std::pair(x, y), static_cast<std::uint32_t>(polygon.points.size()));
    if (is_new) polygon.points.push_back({x, y, 0});
    ring.push_back(at->second);
  };
  Ring outer;
  for (int i = 0; i < 2 * n; ++i) push(i, 0, outer);
  for (int i = 0; i < 2 * n; ++i) push(2 * n, i, outer);
  for (int i = 2 * n; i > 0; --i) push(i, 2 * n, outer);
  for (int i = 2 * n; i > 0; --i) push(0, i, outer);
  polygon.rings.push_back(outer);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Rational x = 2 * i + 1;
      const Rational y = 2 * j + 1;
      Ring ring;
      push(x + reach, y, ring);
      push(x, y - reach, ring);
      push(x - reach, y, ring);
      push(x, y + reach, ring);
      polygon.rings.push_back(ring);
    }
  }
  return polygon;
}

std::uint64_t predicates_for(const Polygon& polygon) {
  const MeshPoints points{std::span<const Rational3>(polygon.points)};
  std::vector<Triangulator::Triangle> triangles;
  PredicateCounts counts;
  REQUIRE(Triangulator(points, Monitor().counting(counts)).triangulate(polygon.rings, 2, 1, triangles));
  return counts.filter + counts.exact;
}

}  // namespace

TEST_CASE("Rooms of a grid with walls and holes are triangulated") {
  CHECK(rc::check("small rooms", [] {
    const Polygon polygon = random_room(*rc::gen::inRange(1, 5), *rc::gen::inRange(1, 5));
    if (polygon.rings.empty()) return;
    RC_ASSERT(fault(polygon) == "");
  }));
  CHECK(rc::check("larger rooms", [] {
    const Polygon polygon = random_room(*rc::gen::inRange(4, 12), *rc::gen::inRange(4, 12));
    if (polygon.rings.empty()) return;
    RC_ASSERT(fault(polygon) == "");
  }));
}

TEST_CASE("Stars with holes on their rays are triangulated") {
  CHECK(rc::check([] {
    // Corners on rays in the order of their angles, and on some rays a triangle, an edge or a point as a hole.
    Polygon polygon;
    Ring outer;
    std::vector<Ring> holes;
    const auto quarter = *rc::gen::inRange(2, 7);
    const auto place = *rc::gen::elementOf(placements());
    for (int i = 0; i < 4 * quarter; ++i) {
      const int step = i % quarter;
      Rational x = quarter - step;
      Rational y = step;
      for (int k = 0; k < i / quarter; ++k) {
        std::swap(x, y);
        x = -x;
      }
      const auto push = [&](const Rational& scale, Ring& ring) {
        ring.push_back(static_cast<std::uint32_t>(polygon.points.size()));
        polygon.points.push_back(place(x * scale, y * scale));
      };
      const Rational scale(*rc::gen::inRange(3, 40));
      push(scale, outer);
      const int corners = *rc::gen::inRange(0, 4);
      if (corners == 0) continue;
      // On one ray, so that holes of neighbouring rays stay apart: a spike walked out and back, or one point.
      Ring& hole = holes.emplace_back();
      push(scale / 3, hole);
      if (corners > 1) push(scale / 2, hole);
      if (corners > 2) {
        push(scale * 2 / 3, hole);
        hole.push_back(hole[1]);
      }
    }
    polygon.rings.push_back(outer);
    polygon.rings.insert(polygon.rings.end(), holes.begin(), holes.end());
    // A point alone has no side to cancel.
    RC_ASSERT(fault(polygon) == "");
  }));
}

// Sides with corners on them: every second one a little farther on, where its coordinates take more than a word. The
// points are neither small integers nor told apart by doubles.
TEST_CASE("Corners on one line are put in order whether their coordinates are short or long") {
  const Rational tiny(Integer(1), Integer("1000000000000000000000000000000007"));
  const std::array<std::array<Rational, 2>, 5> ends{{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}};
  for (int per_side = 1; per_side < 9; ++per_side) {
    Polygon polygon;
    polygon.rings.emplace_back();
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const std::array<Rational, 2>& to = ends[(i + 1) % ends.size()];
      for (int k = 0; k < per_side; ++k) {
        Rational t = Rational(k) / per_side;
        if (k % 2 == 1) t += tiny;
        const Rational x = ends[i][0] + t * (to[0] - ends[i][0]);
        const Rational y = ends[i][1] + t * (to[1] - ends[i][1]);
        polygon.rings[0].push_back(static_cast<std::uint32_t>(polygon.points.size()));
        polygon.points.push_back({x / 998244353 + Rational(1, 1000003), y / 998244353 - Rational(1, 7), 0});
      }
    }
    CAPTURE(per_side);
    CHECK(fault(polygon) == "");
  }
}

TEST_CASE("Holes given as rings of their own touch each other and the outer ring") {
  for (const Rational& reach : {Rational(1), Rational(1, 2), Rational(99, 100)}) {
    for (int n = 1; n < 6; ++n) {
      // Without a way from one part to the next, where all four corners of a hole touch, each part is one anyhow.
      CAPTURE(n, reach.get_d());
      CHECK(fault(plate(n, reach)) == "");
    }
  }
}

TEST_CASE("A triangulation takes O(n log n) predicates") {
  // Squares of n times n holes, four times as many corners from one to the next.
  std::uint64_t last = predicates_for(plate(8, Rational(1, 2)));
  for (const int n : {16, 32, 64}) {
    const std::uint64_t now = predicates_for(plate(n, Rational(1, 2)));
    CAPTURE(n, last, now);
    CHECK(now < 5 * last);
    last = now;
  }
  // Combs of n teeth that all begin at once, along and across the sweep.
  const auto comb = [](int n, bool across) {
    Polygon polygon;
    const auto push = [&](int x, int y) {
      polygon.points.push_back(across ? Rational3{-y, x, 0} : Rational3{x, y, 0});
    };
    push(0, -1);
    push(2 * n, -1);
    for (int i = n; i > 0; --i) {
      push(2 * i, 1000 + i % 3);
      push(2 * i - 1, i % 2);
    }
    push(0, 1000);
    Ring ring(polygon.points.size());
    for (std::uint32_t i = 0; i < ring.size(); ++i) ring[i] = i;
    polygon.rings.push_back(ring);
    return polygon;
  };
  for (const bool across : {false, true}) {
    last = predicates_for(comb(100, across));
    for (const int n : {400, 1600, 6400}) {
      const std::uint64_t now = predicates_for(comb(n, across));
      CAPTURE(n, across, last, now);
      CHECK(now < 6 * last);
      last = now;
    }
  }
  CHECK(fault(comb(150, true)) == "");
}

TEST_CASE("Rings that are no polygon are refused or covered as often as they go around") {
  CHECK(rc::check([] {
    Polygon polygon;
    const auto count = *rc::gen::inRange<std::uint32_t>(3, 14);
    for (std::uint32_t i = 0; i < count; ++i) {
      polygon.points.push_back({*rc::gen::inRange(0, 6), *rc::gen::inRange(0, 6), 0});
    }
    std::uint32_t first = 0;
    while (first < count) {
      const auto last = *rc::gen::inRange(first, count) + 1;
      Ring& ring = polygon.rings.emplace_back();
      for (; first < last; ++first) ring.push_back(first);
    }
    const MeshPoints points{std::span<const Rational3>(polygon.points)};
    std::vector<Triangulator::Triangle> triangles;
    if (!Triangulator(points, {}).triangulate(polygon.rings, 2, 1, triangles)) {
      RC_ASSERT(triangles.empty());
      return;
    }
    Rational area;
    for (const Ring& ring : polygon.rings) area -= twice_the_area(polygon.points, ring);
    for (const Triangulator::Triangle& t : triangles) {
      const Rational its = twice_the_area(polygon.points, t);
      RC_ASSERT(its > 0);
      area += its;
    }
    RC_ASSERT(area == 0);
  }));
}

TEST_CASE("A list in blocks is in the order in which places were found") {
  CHECK(rc::check([] {
    // Items stand for numbers, which only the predicate knows.
    const auto numbers =
        *rc::gen::unique<std::vector<int>>(*rc::gen::inRange<std::size_t>(0, 700), rc::gen::arbitrary<int>());
    OrderedBlocks list;
    std::set<int> in;
    std::map<int, std::uint32_t> item_of;
    for (std::uint32_t i = 0; i < numbers.size(); ++i) {
      const auto find = [&](int number) {
        return list.find([&](std::uint32_t item) { return numbers[item] < number; });
      };
      const OrderedBlocks::Place place = find(numbers[i]);
      const auto after = in.lower_bound(numbers[i]);
      RC_ASSERT(list.before(place) == (after == in.begin() ? OrderedBlocks::kNone : item_of[*std::prev(after)]));
      list.insert(place, i);
      in.insert(numbers[i]);
      item_of[numbers[i]] = i;
      if (i % 3 == 2) {
        const int out = *std::next(in.begin(), static_cast<std::ptrdiff_t>(i % in.size()));
        list.erase(item_of[out]);
        in.erase(out);
      }
      RC_ASSERT(list.size() == in.size());
    }
  }));
}

TEST_CASE("Products of two words each are compared") {
  CHECK(rc::check([] {
    const auto number = [] {
      const Int128 high = *rc::gen::arbitrary<std::int64_t>();
      return ((high << 64U) + static_cast<Int128>(*rc::gen::arbitrary<std::uint64_t>())) >> *rc::gen::inRange(1, 127);
    };
    const auto exact = [](Int128 x) {
      const Integer high(static_cast<long>(x >> 64U));
      return Integer((high << 64U) + Integer(static_cast<unsigned long>(static_cast<std::uint64_t>(x))));
    };
    const Int128 a = number();
    const Int128 b = number();
    const bool same = *rc::gen::arbitrary<bool>();
    const Int128 c = same ? b : number();
    const Int128 d = same ? a + *rc::gen::inRange(-1, 2) : number();
    const Integer difference = exact(a) * exact(b) - exact(c) * exact(d);
    RC_ASSERT(compare_products(a, b, c, d) == sgn(difference));
  }));
}

}  // namespace nef::test
