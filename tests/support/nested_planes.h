// SPDX-License-Identifier: Apache-2.0
//
// Random sets of facets nested and side by side in one or two planes: dividing slits, loops of slits, holes, islands,
// diamonds, isolated points, cut by prisms and walls, with topological operations midway. Everything stands on a grid
// of x, y, x + y, x - y and z at whole numbers, so an oracle knows the set cell by cell without any geometry but that
// of the grid. An affine map carries the set to planes in other positions. A recipe prints as text for literals.h, and
// a failing one is made smaller by leaving out steps.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/support/literals.h"

namespace nef::test::nested {

inline constexpr int kWidth = 16;  ///< x and y run from 0 to kWidth
inline constexpr int kHeight = 6;  ///< z runs from 0 to kHeight
inline constexpr int kScale = 32;  ///< samples stand at multiples of a quarter; steps to cells near by are a sixteenth
using Point = std::array<int, 3>;  ///< in units of 1 / kScale, or whole

/// One cell of the grid: vertices, edges, triangles of the planes x, y, x + y, x - y = const times vertices and edges
/// of z. Cells are told apart, and sampled, by a point of theirs. Cells from 0 to kWidth suffice, since nothing that is
/// made touches the border.
class Grid {
 public:
  Grid() : in_(kCells, false) {}

  static constexpr int kPlanar = kWidth * kWidth * 12;
  static constexpr int kCells = kPlanar * 2 * kHeight;

  /// The cell of a point.
  static int cell(const Point& p) {
    const int u = p[0] % kScale;
    const int v = p[1] % kScale;
    const int square = (p[0] / kScale) * kWidth + p[1] / kScale;
    int kind = 0;
    if (u == 0 && v == 0) {
      kind = 0;
    } else if (v == 0) {
      kind = 1;
    } else if (u == 0) {
      kind = 2;
    } else {
      const int rising = (u > v) - (u < v);
      const int falling = (u + v > kScale) - (u + v < kScale);
      // Centre; four half diagonals; four triangles.
      constexpr std::array<int, 9> kKinds{8, 4, 9, 5, 3, 6, 10, 7, 11};
      kind = kKinds[static_cast<std::size_t>(3 * (rising + 1) + falling + 1)];
    }
    const int level = 2 * (p[2] / kScale) + (p[2] % kScale != 0 ? 1 : 0);
    return (square * 12 + kind) * 2 * kHeight + level;
  }

  /// A point of each cell.
  static const std::vector<Point>& samples() {
    static const std::vector<Point> result = [] {
      std::vector<Point> points(kCells, Point{-1, -1, -1});
      for (int x = 0; x < kWidth * kScale; x += kScale / 4) {
        for (int y = 0; y < kWidth * kScale; y += kScale / 4) {
          for (int z = 0; z < kHeight * kScale; z += kScale / 2) {
            points[static_cast<std::size_t>(cell({x, y, z}))] = {x, y, z};
          }
        }
      }
      return points;
    }();
    return result;
  }

  [[nodiscard]] bool in(int cell) const { return in_[static_cast<std::size_t>(cell)]; }
  [[nodiscard]] bool in(const Point& p) const { return in(cell(p)); }
  void set(int cell, bool value) { in_[static_cast<std::size_t>(cell)] = value; }

  /// The cells that every neighbourhood of a cell meets, itself among them: where its sample goes by a small step along
  /// one of the eight rays of the grid, or between two of them.
  template <typename Visit>
  static void for_each_near(int cell_index, Visit&& visit) {
    static constexpr std::array<std::array<int, 2>, 17> kSteps{{{0, 0},
                                                                {2, 0},
                                                                {2, 1},
                                                                {2, 2},
                                                                {1, 2},
                                                                {0, 2},
                                                                {-1, 2},
                                                                {-2, 2},
                                                                {-2, 1},
                                                                {-2, 0},
                                                                {-2, -1},
                                                                {-2, -2},
                                                                {-1, -2},
                                                                {0, -2},
                                                                {1, -2},
                                                                {2, -2},
                                                                {2, -1}}};
    const Point& p = samples()[static_cast<std::size_t>(cell_index)];
    for (const auto& step : kSteps) {
      for (int dz = -1; dz <= 1; ++dz) {
        const Point q{p[0] + step[0], p[1] + step[1], p[2] + dz};
        if (q[0] >= 0 && q[1] >= 0 && q[2] >= 0) visit(cell(q));
      }
    }
  }

  [[nodiscard]] Grid interior() const {
    Grid result;
    for (int c = 0; c < kCells; ++c) {
      bool all = in(c);
      if (all) for_each_near(c, [&](int d) { all = all && in(d); });
      result.set(c, all);
    }
    return result;
  }
  [[nodiscard]] Grid closure() const {
    Grid result;
    for (int c = 0; c < kCells; ++c) {
      bool any = in(c);
      if (!any) for_each_near(c, [&](int d) { any = any || in(d); });
      result.set(c, any);
    }
    return result;
  }

 private:
  std::vector<bool> in_;
};

/// A closed convex piece: x, y, x + y, x - y and z between bounds in whole numbers.
struct Piece {
  std::array<int, 5> low{};
  std::array<int, 5> high{};
  std::vector<Point> corners;  ///< in whole numbers; the piece is their hull

  [[nodiscard]] bool contains(const Point& p) const {
    const std::array<int, 5> forms{p[0], p[1], p[0] + p[1], p[0] - p[1], p[2]};
    for (std::size_t i = 0; i < 5; ++i) {
      if (forms[i] < low[i] * kScale || forms[i] > high[i] * kScale) return false;
    }
    return true;
  }
};

inline Piece hull_of(std::vector<Point> corners) {
  Piece piece;
  piece.low.fill(1000);
  piece.high.fill(-1000);
  for (const Point& p : corners) {
    const std::array<int, 5> forms{p[0], p[1], p[0] + p[1], p[0] - p[1], p[2]};
    for (std::size_t i = 0; i < 5; ++i) {
      piece.low[i] = std::min(piece.low[i], forms[i]);
      piece.high[i] = std::max(piece.high[i], forms[i]);
    }
  }
  piece.corners = std::move(corners);
  return piece;
}

/// What a step does with the set so far: an operation with a piece, or a topological operation.
struct Step {
  enum class Kind : std::uint8_t {
    kUnite,
    kSubtract,
    kIntersect,
    kDiffer,
    kInterior,
    kClosure,
    kBoundary,
    kRegularize
  };
  Kind kind = Kind::kUnite;
  Piece piece;

  [[nodiscard]] bool topological() const { return kind >= Kind::kInterior; }
};

/// Carries whole numbers to whole numbers; regular.
struct Map {
  std::array<std::array<int, 3>, 3> matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  template <typename Number>
  [[nodiscard]] std::array<Number, 3> operator()(const std::array<Number, 3>& p) const {
    std::array<Number, 3> image;
    for (std::size_t i = 0; i < 3; ++i) {
      image[i] = Number(matrix[i][0] * p[0]) + Number(matrix[i][1] * p[1]) + Number(matrix[i][2] * p[2]);
    }
    return image;
  }
};

struct Recipe {
  Map map;
  std::vector<Step> steps;

  [[nodiscard]] std::string piece_text(const Piece& piece) const {
    std::string text;
    for (const Point& p : piece.corners) {
      for (const int x : map(p)) text += (text.empty() ? "hull(" : ",") + std::to_string(x);
    }
    return text + ")";
  }

  /// The whole as text for literals.h.
  [[nodiscard]] std::string text() const {
    std::string result = "nothing";
    for (const Step& step : steps) {
      static constexpr std::array<const char*, 8> kNames{" + ",      " - ",     " * ",      " ^ ",
                                                         "interior", "closure", "boundary", "regularize"};
      const std::string name = kNames[static_cast<std::size_t>(step.kind)];
      result = step.topological() ? name + "(" + result + ")" : "(" + result + name + piece_text(step.piece) + ")";
    }
    return result;
  }

  [[nodiscard]] Grid oracle() const {
    Grid grid;
    for (const Step& step : steps) {
      if (step.topological()) {
        const Grid inside = grid.interior();
        if (step.kind == Step::Kind::kInterior) {
          grid = inside;
        } else if (step.kind == Step::Kind::kRegularize) {
          grid = inside.closure();
        } else {
          grid = grid.closure();
          for (int c = 0; step.kind == Step::Kind::kBoundary && c < Grid::kCells; ++c) {
            grid.set(c, grid.in(c) && !inside.in(c));
          }
        }
        continue;
      }
      for (int c = 0; c < Grid::kCells; ++c) {
        const bool a = grid.in(c);
        const bool b = step.piece.contains(Grid::samples()[static_cast<std::size_t>(c)]);
        grid.set(c, step.kind == Step::Kind::kUnite       ? a || b
                    : step.kind == Step::Kind::kSubtract  ? a && !b
                    : step.kind == Step::Kind::kIntersect ? a && b
                                                          : a != b);
      }
    }
    return grid;
  }

  /// The set, checked by validate after every step.
  [[nodiscard]] Polyhedron make() const {
    Polyhedron result;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const Step& step = steps[i];
      const auto piece = [&] { return nef::test::set(piece_text(step.piece)); };
      switch (step.kind) {
        case Step::Kind::kUnite:
          result = unite(result, piece());
          break;
        case Step::Kind::kSubtract:
          result = subtract(result, piece());
          break;
        case Step::Kind::kIntersect:
          result = intersect(result, piece());
          break;
        case Step::Kind::kDiffer:
          result = symmetric_difference(result, piece());
          break;
        case Step::Kind::kInterior:
          result = interior(result);
          break;
        case Step::Kind::kClosure:
          result = closure(result);
          break;
        case Step::Kind::kBoundary:
          result = boundary(result);
          break;
        case Step::Kind::kRegularize:
          result = regularize(result);
          break;
      }
      result = valid(std::move(result), "step " + std::to_string(i));
    }
    return result;
  }
};

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

/// What is wrong with the set of a recipe, or an empty string: an invariant broken, an exception, or a place of which
/// `samples` random cells disagree with the oracle.
inline std::string fault(const Recipe& recipe, std::uint64_t seed, int samples) {
  try {
    const Polyhedron made = recipe.make();
    const Grid grid = recipe.oracle();
    std::mt19937_64 random(seed);
    for (int i = 0; i < samples; ++i) {
      const auto cell = static_cast<int>(random() % Grid::kCells);
      const Point& p = Grid::samples()[static_cast<std::size_t>(cell)];
      Rational3 place;
      for (std::size_t k = 0; k < 3; ++k) {
        place[k] = Rational(p[k], kScale);
        place[k].canonicalize();
      }
      if (contains(made, recipe.map(place)) != grid.in(cell)) {
        return "wrong at (" + place[0].get_str() + ", " + place[1].get_str() + ", " + place[2].get_str() +
               ") before the map";
      }
    }
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

/// A recipe that is still wrong, and is not if any one more step is left out.
inline Recipe smallest(Recipe recipe, const std::function<bool(const Recipe&)>& wrong) {
  for (bool shrunk = true; shrunk;) {
    shrunk = false;
    for (std::size_t i = recipe.steps.size(); i-- > 0;) {
      Recipe less = recipe;
      less.steps.erase(less.steps.begin() + static_cast<std::ptrdiff_t>(i));
      if (!wrong(less)) continue;
      recipe = std::move(less);
      shrunk = true;
    }
  }
  return recipe;
}

}  // namespace nef::test::nested
