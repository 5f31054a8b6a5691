// SPDX-License-Identifier: Apache-2.0
//
// Cones and double cones over star-shaped polygons of up to 150 corners, two of them with an apex or the middle of a
// base in common, so that vertices have very many edges, convex or not. Whether a point is in a cone follows from the
// polygon by rational arithmetic. Both in one mesh are their union if they only touch, and else no solid.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "fuzz/fuzzer.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"

namespace nef::fuzz {
namespace {

// Over a polygon in the plane w = 0, star-shaped about the origin, with an apex at w = up > 0 and one at w = -down;
// down = 0: that one is the middle of the base. u, v, w are x, y, z or turned cyclically, and shifted.
struct Cone {
  std::vector<std::array<int, 2>> ring;
  int up = 1;
  int down = 0;
  std::size_t turn = 0;
  std::array<int, 3> shift{};

  [[nodiscard]] std::array<int, 3> place(int u, int v, int w) const {
    std::array<int, 3> p = shift;
    p[turn] += u;
    p[(turn + 1) % 3] += v;
    p[(turn + 2) % 3] += w;
    return p;
  }
};

double angle(const std::array<int, 2>& p) { return std::atan2(p[1], p[0]); }

std::vector<std::array<int, 2>> random_ring(Choices& choices) {
  const int count = choices.one_in(2) ? choices.between(64, 150) : choices.between(3, 12);
  const int radius = count > 12 ? 1000 : choices.between(3, 12);
  const bool round = choices.one_in(3);
  std::vector<std::array<int, 2>> ring;
  for (int i = 0; i < count; ++i) {
    const double a = 2 * 3.14159265358979 * i / count;
    const double r = round ? radius : choices.between(radius / 3 + 1, radius);
    ring.push_back({static_cast<int>(std::lround(r * std::cos(a))), static_cast<int>(std::lround(r * std::sin(a)))});
  }
  std::erase(ring, std::array{0, 0});
  std::sort(ring.begin(), ring.end(), [](const auto& p, const auto& q) { return angle(p) < angle(q); });
  return ring;
}

long turn_of(const std::array<int, 2>& p, const std::array<int, 2>& q) {
  return static_cast<long>(p[0]) * q[1] - static_cast<long>(p[1]) * q[0];
}

std::optional<Cone> random_cone(Choices& choices) {
  Cone cone;
  cone.ring = random_ring(choices);
  if (cone.ring.size() < 3) return std::nullopt;
  for (std::size_t i = 0; i < cone.ring.size(); ++i) {
    if (turn_of(cone.ring[i], cone.ring[(i + 1) % cone.ring.size()]) <= 0) return std::nullopt;
  }
  cone.up = choices.between(1, 12) * choices.element(std::array{1, 1, 40});
  cone.down = choices.one_in(2) ? choices.between(1, 12) : 0;
  cone.turn = choices.below(3);
  return cone;
}

void add_to(Mesh& mesh, const Cone& cone) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto push = [&](int u, int v, int w) {
    const auto [x, y, z] = cone.place(u, v, w);
    mesh.vertices.push_back({x, y, z});
  };
  for (const auto& [u, v] : cone.ring) push(u, v, 0);
  push(0, 0, cone.up);
  push(0, 0, -cone.down);
  const auto n = static_cast<std::uint32_t>(cone.ring.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.push_face(std::array{first + i, first + j, first + n});
    mesh.push_face(std::array{first + j, first + i, first + n + 1});
  }
}

// By the wedge of the polygon that holds the point when it is seen from the apex.
bool holds(const Cone& cone, const Rational3& p) {
  std::array<Rational, 3> q;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t axis = (cone.turn + i) % 3;
    q[i] = p[axis] - cone.shift[axis];
  }
  const int height = q[2] >= 0 ? cone.up : cone.down;
  if (q[2] == 0 ? false : height == 0) return false;
  const Rational share = q[2] == 0 ? Rational(1) : 1 - abs(q[2]) / height;  // of the polygon
  if (share < 0) return false;
  for (std::size_t i = 0; i < cone.ring.size(); ++i) {
    const auto& a = cone.ring[i];
    const auto& b = cone.ring[(i + 1) % cone.ring.size()];
    const Rational from_a = a[0] * q[1] - a[1] * q[0];
    const Rational to_b = q[0] * b[1] - q[1] * b[0];
    const Rational beyond = share * turn_of(a, b) - from_a - to_b;
    if (from_a >= 0 && to_b >= 0 && beyond >= 0) return true;
  }
  return false;
}

std::string text_of(const Cone& cone) {
  std::string text = "up " + std::to_string(cone.up) + ", down " + std::to_string(cone.down) + ", axis " +
                     std::to_string((cone.turn + 2) % 3) + ", shift";
  for (const int x : cone.shift) text += " " + std::to_string(x);
  text += ", ring";
  for (const auto& [u, v] : cone.ring) text += " " + std::to_string(u) + "," + std::to_string(v);
  return text;
}

Rational3 random_vertex(Choices& choices, const Cone& cone) {
  const std::uint32_t n = choices.below(static_cast<std::uint32_t>(cone.ring.size()) + 2);
  std::array<int, 3> p{};
  if (n < 2) {
    p = cone.place(0, 0, n == 0 ? cone.up : -cone.down);
  } else {
    p = cone.place(cone.ring[n - 2][0], cone.ring[n - 2][1], 0);
  }
  return {p[0], p[1], p[2]};
}

// Between vertices of both, often on an edge or a face of one.
Rational3 random_point(Choices& choices, const std::array<Cone, 2>& cones) {
  Rational3 p{};
  int total = 0;
  for (int i = choices.between(1, 4); i > 0; --i) {
    const Rational3 v = random_vertex(choices, cones[choices.one_in(3) ? 1 : 0]);
    const int weight = choices.between(1, 3);
    total += weight;
    for (std::size_t k = 0; k < 3; ++k) p[k] += weight * v[k];
  }
  for (Rational& x : p) x /= total;
  return p;
}

void check_together(const Case& the_case, const std::array<Cone, 2>& cones, const Polyhedron& all, bool overlap) {
  Mesh mesh;
  for (const Cone& cone : cones) add_to(mesh, cone);
  try {
    const Polyhedron made = from_mesh(mesh);
    Case::require(!overlap, "import: cones that overlap were taken for a solid");
    Case::require(equal(made, all), "import: cones that touch are not their union");
    the_case.count("touching cones imported");
  } catch (const InputError&) {
    Case::require(overlap, "import: cones that only touch were refused");
    the_case.count("overlapping cones refused");
  }
}

}  // namespace

void fuzz_stars(const Case& the_case) {
  Choices& choices = the_case.choices();
  std::array<Cone, 2> cones;
  for (Cone& cone : cones) {
    const std::optional<Cone> made = random_cone(choices);
    if (!made) return;
    cone = *made;
  }
  const auto middle = [&](const Cone& cone) { return cone.place(0, 0, choices.one_in(2) ? -cone.down : cone.up); };
  const std::array<int, 3> there = middle(cones[0]);
  const std::array<int, 3> here = middle(cones[1]);
  for (std::size_t i = 0; i < 3; ++i) cones[1].shift[i] = there[i] - here[i];
  if (choices.one_in(4)) ++cones[1].shift[choices.below(3)];
  std::array<Polyhedron, 2> sets;
  for (std::size_t i = 0; i < 2; ++i) {
    the_case.tell("cone: " + text_of(cones[i]));
    Mesh mesh;
    add_to(mesh, cones[i]);
    sets[i] = the_case.valid(from_mesh(mesh), "from_mesh");
  }
  const Polyhedron united = the_case.valid(unite(sets[0], sets[1]), "unite");
  const Polyhedron common = the_case.valid(intersect(sets[0], sets[1]), "intersect");
  const Polyhedron left = the_case.valid(subtract(sets[0], sets[1]), "subtract");
  for (int i = 0; i < 60; ++i) {
    const Rational3 p = random_point(choices, cones);
    const bool a = holds(cones[0], p);
    const bool b = holds(cones[1], p);
    const std::string at = " at " + to_string(p[0]) + " " + to_string(p[1]) + " " + to_string(p[2]);
    Case::require(contains(sets[0], p) == a && contains(sets[1], p) == b, "import: a point" + at);
    Case::require(contains(united, p) == (a || b), "unite: a point" + at);
    Case::require(contains(common, p) == (a && b), "intersect: a point" + at);
    Case::require(contains(left, p) == (a && !b), "subtract: a point" + at);
    the_case.count("points");
  }
  Case::require(*volume(united) + *volume(common) == *volume(sets[0]) + *volume(sets[1]),
                "volume: of the union and the intersection");
  check_together(the_case, cones, united, !regularize(common).is_empty());
}

}  // namespace nef::fuzz
