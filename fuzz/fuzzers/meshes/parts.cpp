// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums of machine parts in every strategy: turned, extruded and drilled shapes with coordinates rounded to
// doubles, so that families of faces are coplanar, parallel or coaxial, or nearly so; or of their sections. Two
// strategies share neither cells nor facets; x is in A + B iff A meets x - B, which is asked of a Boolean and of an
// IntersectionQuery.
#include "apps/minkowski/minkowski.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/distance/intersects.h"
#include "tests/support/shapes/machine_parts.h"

namespace nef::fuzz {
namespace {

struct Part {
  Polyhedron set;
  std::string text;
};

// A ring about the z axis or the x axis.
Part random_turned(Choices& choices) {
  std::vector<test::ProfilePoint> profile = {{2, 0}, {3, 0}};
  const int steps = choices.between(0, 2);
  double height = 0;
  for (int i = 0; i < steps; ++i) {  // a collar, a cone or a groove
    height += choices.between(1, 2);
    const double radius = 2.5 + 0.5 * choices.between(0, 3);
    profile.push_back({profile.back()[0], height});
    if (radius != profile.back()[0]) profile.push_back({radius, height + 0.5 * choices.between(0, 1)});
    height = profile.back()[1];
  }
  height += choices.between(1, 2);
  profile.push_back({profile.back()[0], height});
  profile.push_back({2, height});
  const auto sides = static_cast<std::uint32_t>(choices.between(3, 12));
  const double turn = 0.1 * choices.between(0, 5);
  const bool lying = choices.one_in(2);
  std::string text = "turned";
  for (const auto& [radius, z] : profile) text += " " + std::to_string(radius) + "," + std::to_string(z);
  text += " sides " + std::to_string(sides) + " turn " + std::to_string(turn) + (lying ? " lying" : "");
  return {from_mesh(test::turned_part(profile, sides, turn, lying)), text};
}

// A gear, or a beam with a section like an L, a U or a T.
Part random_extruded(Choices& choices) {
  using Outline = std::vector<std::array<double, 2>>;
  const double height = 0.5 * choices.between(1, 5);
  const int what = choices.between(0, 3);
  const double w = 0.3 * choices.between(1, 3);
  Outline outline;
  std::string text;
  if (what == 0) {
    const auto teeth = static_cast<std::size_t>(choices.between(2, 4));
    outline = test::gear_outline(teeth, 2, 0.5);
    text = "gear of " + std::to_string(teeth) + " teeth";
  } else {
    const Outline sections[] = {{{0, 0}, {3, 0}, {3, w}, {w, w}, {w, 3}, {0, 3}},
                                {{0, 0}, {3, 0}, {3, 2}, {3 - w, 2}, {3 - w, w}, {w, w}, {w, 2}, {0, 2}},
                                {{-w, 0}, {w, 0}, {w, 2}, {2, 2}, {2, 2 + w}, {-2, 2 + w}, {-2, 2}, {-w, 2}}};
    outline = sections[what - 1];
    const double turn = 0.3 * choices.between(0, 3);
    for (auto& [x, y] : outline) {
      const double along = x * std::cos(turn) - y * std::sin(turn);
      y = x * std::sin(turn) + y * std::cos(turn);
      x = along;
    }
    text = std::string(1, "LUT"[what - 1]) + " of width " + std::to_string(w) + " turned by " + std::to_string(turn);
  }
  return {from_mesh(test::extruded_part(outline, height)), text + ", height " + std::to_string(height)};
}

// Maybe with a bore along z, or a corner milled away.
Part random_part(Choices& choices) {
  Part part = choices.one_in(2) ? random_turned(choices) : random_extruded(choices);
  if (choices.one_in(3)) {
    const test::ProfilePoint bore[] = {{0.2, -1}, {0.6, -1}, {0.6, 9}, {0.2, 9}};
    const auto sides = static_cast<std::uint32_t>(choices.between(3, 5));
    const Rational3 at = {Rational(choices.between(0, 4)) / 2, Rational(choices.between(0, 4)) / 2, 0};
    const Polyhedron drill = from_mesh(test::turned_part(bore, sides, 0.2));
    part.set = regularize(subtract(part.set, transform(drill, AffineMap::translate(at))));
    part.text += ", drilled with " + std::to_string(sides) + " sides at " + to_string(at[0]) + "," + to_string(at[1]);
  }
  return part;
}

// What a plane across the z axis cuts out of a part.
Polyhedron section(const Polyhedron& part, const Rational& height) {
  const std::vector<Rational3> square = {{-50, -50, height}, {50, -50, height}, {50, 50, height}, {-50, 50, height}};
  return intersect(part, make_polygon(std::vector<std::vector<Rational3>>{square}));
}

}  // namespace

void fuzz_parts(const Case& the_case) {
  Choices& choices = the_case.choices();
  Part a = random_part(choices);
  Part b = random_part(choices);
  const bool negated = choices.one_in(2);
  if (choices.one_in(3)) {  // rarely in the plane of a face
    for (Part* part : {&a, &b}) {
      const Rational height(choices.between(1, 8), 4);
      part->set = section(part->set, height);
      part->text += ", section at z = " + to_string(height);
    }
  }
  the_case.tell("a = " + a.text);
  the_case.tell("b = " + b.text + (negated ? ", negated" : ""));
  if (a.set.is_empty() || b.set.is_empty()) return;
  const Polyhedron second = negated ? minkowski::negate(b.set) : b.set;
  minkowski::MinkowskiOptions options;
  const auto sum_by = [&](minkowski::UnionStrategy strategy) {
    options.strategy = strategy;
    const std::string name(minkowski::kUnionStrategies[static_cast<std::size_t>(strategy)].first);
    the_case.count("by " + name);
    return the_case.valid(minkowski::minkowski_sum(a.set, second, options), name);
  };
  const auto count = static_cast<int>(minkowski::kUnionStrategies.size());
  const int one = choices.between(0, count - 1);
  const int other = (one + choices.between(1, count - 1)) % count;
  const Polyhedron sum = sum_by(static_cast<minkowski::UnionStrategy>(one));
  Case::require(equal(sum, sum_by(static_cast<minkowski::UnionStrategy>(other))), "strategies: different sets");
  const Polyhedron turned = minkowski::negate(second);
  const IntersectionQuery query(a.set, turned);
  const std::size_t vertices = sum.complex().vertex_count();
  for (int k = 0; k < 4; ++k) {
    const auto v = static_cast<std::uint32_t>(choices.below(static_cast<std::uint32_t>(vertices)));
    Rational3 x = sum.complex().points.rational(PointId{v});
    x[static_cast<std::size_t>(k) % 3] += Rational(k % 2) / 64;  // on the boundary and beside it
    const bool meets = !intersect(a.set, transform(turned, AffineMap::translate(x))).is_empty();
    the_case.count("points");
    Case::require(query.meet(x) == meets, "intersects: " + a.text + " and the other one turned, moved by " +
                                              to_string(x[0]) + "," + to_string(x[1]) + "," + to_string(x[2]));
    Case::require(contains(sum, x) == meets, "membership: of point(" + to_string(x[0]) + "," + to_string(x[1]) + "," +
                                                 to_string(x[2]) + "), want " + (meets ? "inside" : "outside"));
  }
}

}  // namespace nef::fuzz
