// SPDX-License-Identifier: Apache-2.0
//
// Random Nef polyhedra that are rich in coincidences, for RapidCheck: primitives on a grid of a few
// integers, combined by Boolean operations. A recipe is text (see literals.h), so a failure prints
// as something that can be pasted into a test, and shrinks by dropping steps and small numbers.
// Membership of a point is known from the recipe alone, by arithmetic on the primitives.
#pragma once

#include <rapidcheck.h>

#include <array>
#include <ostream>
#include <string>
#include <vector>

#include "tests/support/literals.h"

namespace nef::test {

enum class Shape : std::uint8_t {
  kBox,
  kOpenBox,
  kTetrahedron,
  kTriangle,
  kSegment,
  kPoint,
  kHalfspace,
  kOpenHalfspace,
  kPlane
};

struct Primitive {
  Shape shape = Shape::kBox;
  std::array<int, 12> n{};

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool contains(const Rational3& p) const;
};

/// A left fold: each step combines what is there with a primitive.
struct Step {
  char op = '+';
  bool complemented = false;  ///< of the primitive
  Primitive primitive;
};

struct Recipe {
  std::vector<Step> steps;

  [[nodiscard]] std::string text() const {
    std::string result = "nothing";
    for (const Step& step : steps) {
      result = "(" + result + " " + step.op + " " + (step.complemented ? "!" : "") + step.primitive.text() + ")";
    }
    return result;
  }
  [[nodiscard]] Polyhedron make() const { return set(text()); }
  [[nodiscard]] bool contains(const Rational3& p) const {
    bool in = false;
    for (const Step& step : steps) {
      const bool other = step.primitive.contains(p) != step.complemented;
      in = step.op == '+' ? in || other : step.op == '*' ? in && other : step.op == '-' ? in && !other : in != other;
    }
    return in;
  }
};

inline void showValue(const Recipe& recipe, std::ostream& out) { out << recipe.text(); }

namespace detail {

inline Rational det3(const Rational3& a, const Rational3& b, const Rational3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}
inline Rational3 minus(const Rational3& a, const Rational3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Rational3 cross(const Rational3& a, const Rational3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Rational dot(const Rational3& a, const Rational3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline bool on_segment(const Rational3& p, const Rational3& a, const Rational3& b) {
  const Rational3 c = cross(minus(b, a), minus(p, a));
  return dot(c, c) == 0 && dot(minus(p, a), minus(p, b)) <= 0;
}
inline bool on_triangle(const Rational3& p, const Rational3& a, const Rational3& b, const Rational3& c) {
  const Rational3 n = cross(minus(b, a), minus(c, a));
  if (dot(n, n) == 0) return on_segment(p, a, b) || on_segment(p, b, c) || on_segment(p, c, a);
  if (dot(n, minus(p, a)) != 0) return false;
  return det3(n, minus(b, a), minus(p, a)) >= 0 && det3(n, minus(c, b), minus(p, b)) >= 0 &&
         det3(n, minus(a, c), minus(p, c)) >= 0;
}
inline bool in_tetrahedron(const Rational3& p, const std::array<Rational3, 4>& v) {
  const int whole = sgn(det3(minus(v[1], v[0]), minus(v[2], v[0]), minus(v[3], v[0])));
  if (whole == 0) {
    return on_triangle(p, v[0], v[1], v[2]) || on_triangle(p, v[0], v[1], v[3]) || on_triangle(p, v[0], v[2], v[3]) ||
           on_triangle(p, v[1], v[2], v[3]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<Rational3, 4> w = v;
    w[i] = p;
    if (sgn(det3(minus(w[1], w[0]), minus(w[2], w[0]), minus(w[3], w[0]))) * whole < 0) return false;
  }
  return true;
}
inline std::string list(const std::array<int, 12>& n, std::size_t first, std::size_t count) {
  std::string result;
  for (std::size_t i = first; i < first + count; ++i) result += (i > first ? "," : "") + std::to_string(n[i]);
  return result;
}

}  // namespace detail

inline std::string Primitive::text() const {
  using detail::list;
  switch (shape) {
    case Shape::kBox:
      return "box(" + list(n, 0, 6) + ")";
    case Shape::kOpenBox:
      return "interior(box(" + list(n, 0, 6) + "))";
    case Shape::kTetrahedron:
      return "hull(" + list(n, 0, 12) + ")";
    case Shape::kTriangle:
      return "hull(" + list(n, 0, 9) + ")";
    case Shape::kSegment:
      return "hull(" + list(n, 0, 6) + ")";
    case Shape::kPoint:
      return "point(" + list(n, 0, 3) + ")";
    case Shape::kHalfspace:
      return "halfspace(" + list(n, 0, 4) + ")";
    case Shape::kOpenHalfspace:
      return "interior(halfspace(" + list(n, 0, 4) + "))";
    case Shape::kPlane:
      break;
  }
  return "boundary(halfspace(" + list(n, 0, 4) + "))";
}

inline bool Primitive::contains(const Rational3& p) const {
  std::array<Rational3, 4> v;
  for (std::size_t i = 0; i < 4; ++i) v[i] = {Rational(n[3 * i]), Rational(n[3 * i + 1]), Rational(n[3 * i + 2])};
  bool closed = true;
  bool open = true;
  switch (shape) {
    case Shape::kBox:
    case Shape::kOpenBox:
      for (std::size_t i = 0; i < 3; ++i) {
        closed = closed && v[0][i] <= p[i] && p[i] <= v[1][i];
        open = open && v[0][i] < p[i] && p[i] < v[1][i];
      }
      return shape == Shape::kBox ? closed : open;
    case Shape::kTetrahedron:
      return detail::in_tetrahedron(p, v);
    case Shape::kTriangle:
      return detail::on_triangle(p, v[0], v[1], v[2]);
    case Shape::kSegment:
      return detail::on_segment(p, v[0], v[1]);
    case Shape::kPoint:
      return p == v[0];
    case Shape::kHalfspace:
    case Shape::kOpenHalfspace:
    case Shape::kPlane:
      break;
  }
  const int side = sgn(Rational(n[0] * p[0] + n[1] * p[1] + n[2] * p[2] + n[3]));
  return shape == Shape::kHalfspace ? side <= 0 : shape == Shape::kOpenHalfspace ? side < 0 : side == 0;
}

/// Coordinates are 0 .. grid; halfspaces have normals with components -1 .. 1.
inline rc::Gen<Primitive> primitives(bool bounded, int grid) {
  const auto shapes =
      bounded
          ? rc::gen::element(Shape::kBox, Shape::kBox, Shape::kBox, Shape::kOpenBox, Shape::kOpenBox,
                             Shape::kTetrahedron, Shape::kTetrahedron, Shape::kTriangle, Shape::kSegment, Shape::kPoint)
          : rc::gen::element(Shape::kBox, Shape::kBox, Shape::kHalfspace, Shape::kHalfspace, Shape::kOpenHalfspace,
                             Shape::kPlane, Shape::kTetrahedron, Shape::kTriangle, Shape::kSegment, Shape::kPoint);
  const auto raw = rc::gen::container<std::array<int, 12>>(rc::gen::inRange(0, grid + 1));
  return rc::gen::apply(
      [grid](Shape shape, std::array<int, 12> n) {
        if (shape == Shape::kBox || shape == Shape::kOpenBox) {
          for (std::size_t i = 0; i < 3; ++i) {
            if (n[i] > n[i + 3]) std::swap(n[i], n[i + 3]);
            if (n[i] == n[i + 3]) n[i + 3] += 1;  // flat boxes are what triangles and segments are for
          }
        } else if (shape >= Shape::kHalfspace) {
          for (std::size_t i = 0; i < 3; ++i) n[i] = n[i] % 3 - 1;
          if (n[0] == 0 && n[1] == 0 && n[2] == 0) n[static_cast<std::size_t>(n[4]) % 3] = 1;
          n[3] = -n[3];
          if (n[0] + n[1] + n[2] < 0) n[3] = -n[3];
        }
        static_cast<void>(grid);
        return Primitive{shape, n};
      },
      shapes, raw);
}

/// Recipes of 1 .. `most` steps. The first step is a union, so that something is there.
inline rc::Gen<Recipe> recipes(bool bounded, std::size_t most, int grid = 3) {
  const auto step = rc::gen::apply(
      [bounded](char op, bool complemented, const Primitive& primitive) {
        // A complement may only be what is taken away or intersected, where boundedness matters.
        return Step{op, complemented && (!bounded || op == '*'), primitive};
      },
      rc::gen::element('+', '+', '-', '*', '^'), rc::gen::element(false, false, false, true),
      primitives(bounded, grid));
  return rc::gen::map(
      rc::gen::mapcat(rc::gen::inRange<std::size_t>(1, most + 1),
                      [step](std::size_t count) { return rc::gen::container<std::vector<Step>>(count, step); }),
      [](std::vector<Step> steps) {
        if (!steps.empty()) steps[0].op = '+', steps[0].complemented = false;
        return Recipe{std::move(steps)};
      });
}

/// A point where something may change: on the grid, between its lines, or at thirds.
inline rc::Gen<Rational3> adversarial_points(int grid = 3) {
  const auto coordinate = rc::gen::apply(
      [](int numerator, int denominator) {
        Rational x(numerator, denominator);
        x.canonicalize();
        return x;
      },
      rc::gen::inRange(-1, 3 * grid + 2), rc::gen::element(1, 2, 2, 3));
  return rc::gen::apply(
      [](const Rational& x, const Rational& y, const Rational& z) {
        return Rational3{x, y, z};
      },
      coordinate, coordinate, coordinate);
}

}  // namespace nef::test
