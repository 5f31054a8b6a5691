// SPDX-License-Identifier: Apache-2.0
//
// Recipes for sets of facets nested and side by side in one or two planes. A grid of cells tells what the set is, an
// affine map carries it to planes in other positions. A recipe prints as text for literals.h, and a failing one is made
// smaller by leaving out steps.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/support/literals.h"
#include "tests/support/shapes/nested_planes/grid.h"

namespace nef::test::nested {

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
