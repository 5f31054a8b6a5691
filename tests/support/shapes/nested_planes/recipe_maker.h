// SPDX-License-Identifier: Apache-2.0
//
// Random recipes: dividing slits, loops of slits, holes, islands, diamonds, isolated points, cut by prisms and walls,
// with topological operations midway.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/shapes/nested_planes/recipe.h"

namespace nef::test::nested {

/// Makes recipes. The same seed gives the same recipes everywhere.
class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(seed) {}

  Recipe make() {
    recipe_ = {};
    recipe_.map = random_map();
    const int planes = below(3) == 0 ? 2 : 1;
    for (int k = 0; k < planes; ++k) {
      z_ = 2 + k;
      const Rectangle frame{1 + below(3), 1 + below(3), 12 + below(3), 12 + below(3)};
      add(Step::Kind::kUnite, polygon(frame));
      divide(frame, 3 + below(3), true);
    }
    const int cuts = below(3);
    for (int i = 0; i < cuts; ++i) cut();
    return recipe_;
  }

  /// A number 0 .. n - 1.
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }

 private:
  struct Rectangle {
    int x0, y0, x1, y1;
    [[nodiscard]] int width() const { return x1 - x0; }
    [[nodiscard]] int height() const { return y1 - y0; }
  };

  Map random_map() {
    static const std::array<Map, 10> kMaps{{{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
                                            {{{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}}},
                                            {{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}},
                                            {{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
                                            {{{{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}}}},
                                            {{{{0, 1, 0}, {0, 0, -1}, {1, 0, 0}}}},
                                            {{{{1, 0, 0}, {0, 1, 0}, {1, 2, 1}}}},
                                            {{{{1, 1, 0}, {-1, 2, 0}, {2, 1, 1}}}},
                                            {{{{2, 1, 1}, {1, -1, 3}, {0, 1, -1}}}},
                                            {{{{-3, 1, 0}, {2, 2, 1}, {1, 0, 2}}}}}};
    return kMaps[static_cast<std::size_t>(below(static_cast<int>(kMaps.size())))];
  }

  void add(Step::Kind kind, Piece piece) { recipe_.steps.push_back({kind, std::move(piece)}); }
  // Takes away where something is, adds where nothing is.
  void flip(bool inside, Piece piece) { add(inside ? Step::Kind::kSubtract : Step::Kind::kUnite, std::move(piece)); }

  Piece polygon(const Rectangle& r) const {
    return hull_of({{r.x0, r.y0, z_}, {r.x1, r.y0, z_}, {r.x1, r.y1, z_}, {r.x0, r.y1, z_}});
  }
  Piece segment(int x0, int y0, int x1, int y1) const { return hull_of({{x0, y0, z_}, {x1, y1, z_}}); }
  static Piece box(const Rectangle& r, int z0, int z1) {
    std::vector<Point> corners;
    for (const int z : {z0, z1}) {
      for (const int x : {r.x0, r.x1}) {
        for (const int y : {r.y0, r.y1}) corners.push_back({x, y, z});
      }
    }
    return hull_of(std::move(corners));
  }
  // |x - cx| + |y - cy| <= radius.
  std::array<Point, 4> diamond(int cx, int cy, int radius) const {
    return {{{cx + radius, cy, z_}, {cx, cy + radius, z_}, {cx - radius, cy, z_}, {cx, cy - radius, z_}}};
  }

  // A rectangle inside, which may touch the border.
  Rectangle within(const Rectangle& r) {
    const int margin = below(4) == 0 ? 0 : 1;
    const auto range = [&](int low, int high) -> std::array<int, 2> {
      low += margin;
      high -= margin;
      if (high - low < 1) return {low - margin, high + margin};
      const int a = low + below(std::min(3, high - low));
      const int b = high - below(std::min(3, high - a));
      return {a, b};
    };
    const auto x = range(r.x0, r.x1);
    const auto y = range(r.y0, r.y1);
    return {x[0], y[0], x[1], y[1]};
  }

  // Draws inside a rectangle that is all in the set (or all out of it).
  void fill(const Rectangle& r, int depth, bool inside) {
    if (depth == 0 || recipe_.steps.size() > 40) return;
    if (below(12) == 0) topological();
    switch (below(10)) {
      case 0:
      case 1:
        return divide(r, depth, inside);
      case 2:
      case 3:
        return loop(within(r), depth, inside);
      case 4:
      case 5: {
        const Rectangle hole = within(r);
        flip(inside, polygon(hole));
        return fill(hole, depth - 1, !inside);
      }
      case 6:
        return diamonds(r, depth, inside);
      case 7:
        flip(inside, hull_of({{r.x0 + below(r.width() + 1), r.y0 + below(r.height() + 1), z_}}));
        return fill(r, depth - 1, inside);
      case 8: {
        const Rectangle base = within(r);
        flip(inside, box(base, z_ - below(2), z_ + 1));
        return fill(base, depth - 1, !inside);
      }
      default:
        // Touching pieces side by side.
        if (r.width() < 2) return;
        const int x = r.x0 + 1 + below(r.width() - 1);
        flip(inside, polygon(within({r.x0, r.y0, x, r.y1})));
        flip(inside, polygon(within({x, r.y0, r.x1, r.y1})));
    }
  }

  void divide(const Rectangle& r, int depth, bool inside) {
    if (below(4) == 0 && r.width() >= 2 && r.height() >= 2) {
      const int n = std::min(r.width(), r.height());
      flip(inside, below(2) == 0 ? segment(r.x0, r.y0, r.x0 + n, r.y0 + n) : segment(r.x0, r.y0 + n, r.x0 + n, r.y0));
      return;
    }
    if (r.width() >= r.height() && r.width() >= 2) {
      const int x = r.x0 + 1 + below(r.width() - 1);
      flip(inside, segment(x, r.y0, x, r.y1));
      fill({r.x0, r.y0, x, r.y1}, depth - 1, inside);
      fill({x, r.y0, r.x1, r.y1}, depth - 1, inside);
    } else if (r.height() >= 2) {
      const int y = r.y0 + 1 + below(r.height() - 1);
      flip(inside, segment(r.x0, y, r.x1, y));
      fill({r.x0, r.y0, r.x1, y}, depth - 1, inside);
      fill({r.x0, y, r.x1, r.y1}, depth - 1, inside);
    }
  }

  void loop(const Rectangle& r, int depth, bool inside) {
    const std::array<std::array<int, 4>, 4> sides{
        {{r.x0, r.y0, r.x1, r.y0}, {r.x1, r.y0, r.x1, r.y1}, {r.x1, r.y1, r.x0, r.y1}, {r.x0, r.y1, r.x0, r.y0}}};
    const int left_out = below(12);  // none of the four, mostly
    for (int i = 0; i < 4; ++i) {
      const auto& s = sides[static_cast<std::size_t>(i)];
      if (i != left_out) flip(inside, segment(s[0], s[1], s[2], s[3]));
    }
    fill(r, depth - 1, inside);
  }

  void diamonds(const Rectangle& r, int depth, bool inside) {
    const int radius = std::min(r.width(), r.height()) / 2;
    if (radius < 1) return;
    const int cx = r.x0 + radius + below(r.width() - 2 * radius + 1);
    const int cy = r.y0 + radius + below(r.height() - 2 * radius + 1);
    const std::array<Point, 4> corners = diamond(cx, cy, radius);
    const Rectangle inner{cx - radius / 2, cy - radius / 2, cx + radius / 2, cy + radius / 2};
    if (below(2) == 0) {
      flip(inside, hull_of({corners.begin(), corners.end()}));
      if (radius >= 2) fill(inner, depth - 1, !inside);
      return;
    }
    for (std::size_t i = 0; i < 4; ++i) flip(inside, hull_of({corners[i], corners[(i + 1) % 4]}));
    if (radius >= 2) fill(inner, depth - 1, inside);
  }

  void topological() {
    static constexpr std::array<Step::Kind, 3> kKinds{Step::Kind::kClosure, Step::Kind::kBoundary,
                                                      Step::Kind::kClosure};
    if (below(6) == 0)
      add(below(2) == 0 ? Step::Kind::kInterior : Step::Kind::kRegularize, {});
    else
      add(kKinds[static_cast<std::size_t>(below(3))], {});
  }

  void cut() {
    const Rectangle all{1, 1, 14, 14};
    switch (below(5)) {
      case 0:
        return add(Step::Kind::kIntersect, box(within(within(all)), 1 + below(2), 3 + below(2)));
      case 1: {
        const int x = 2 + below(11);
        return add(Step::Kind::kUnite, box({x, 1 + below(4), x + 1 + below(2), 9 + below(5)}, 2, 4));
      }
      case 2: {
        const int y = 2 + below(11);
        return add(Step::Kind::kSubtract, box({1 + below(4), y, 9 + below(5), y + 1}, 1 + below(2), 3));
      }
      case 3:
        return add(Step::Kind::kDiffer, box(within(within(all)), 1 + below(2), 3 + below(2)));
      default:
        return topological();
    }
  }

  std::mt19937_64 random_;
  Recipe recipe_;
  int z_ = 2;
};

}  // namespace nef::test::nested
