// SPDX-License-Identifier: Apache-2.0
//
// A point is in f(A, B) iff f says so of its membership in A and B; membership in the primitives
// is known by arithmetic of the test's own.
#include "tests/laws/laws.h"

namespace nef::test {
namespace {

std::string show(const Rational3& p) { return to_string(p[0]) + "," + to_string(p[1]) + "," + to_string(p[2]); }

void check_points(const Recipe& recipe) {
  const Polyhedron a = recipe.make();
  for (const Rational3& p : *rc::gen::container<std::vector<Rational3>>(60, adversarial_points())) {
    if (contains(a, p) != recipe.contains(p)) RC_FAIL("membership of " + show(p) + " is wrong");
  }
}

}  // namespace

TEST_CASE("membership follows from the primitives") { for_all("membership", 5, check_points); }

TEST_CASE("membership at every point of the half grid") {
  CHECK(rc::check("all points", [] {
    const bool bounded = *rc::gen::arbitrary<bool>();
    const Recipe recipe = *recipes(bounded, 4, 2);
    const Polyhedron a = recipe.make();
    for (int i = 0; i < 11 * 11 * 11; ++i) {
      Rational3 p{Rational(i % 11 - 2, 2), Rational(i / 11 % 11 - 2, 2), Rational(i / 121 - 2, 2)};
      for (Rational& x : p) x.canonicalize();
      if (contains(a, p) != recipe.contains(p)) RC_FAIL("membership of " + show(p) + " is wrong");
    }
  }));
}

TEST_CASE("the local pyramid at a point has the mark of the point") {
  for_all("local pyramid", 4, [](const Recipe& recipe) {
    const Polyhedron a = recipe.make();
    for (const Rational3& p : *rc::gen::container<std::vector<Rational3>>(20, adversarial_points())) {
      const SphereMapBuffer pyramid = local_pyramid(a, p);
      RC_ASSERT((pyramid.mark != 0) == recipe.contains(p));
      const Location place = locate(a, p);
      RC_ASSERT(place.mark == pyramid.mark);
      RC_ASSERT((place.kind == Location::Kind::kVolume) ==
                (pyramid.view().trivial() && pyramid.mark == pyramid.sfaces[0].mark));
    }
  });
}

TEST_CASE("a ray meets the boundary where membership can change") {
  for_all("rays", 4, [](const Recipe& recipe) {
    const Polyhedron a = recipe.make();
    const Rational3 origin = *adversarial_points();
    const Rational3 target = *adversarial_points();
    const Rational3 direction = detail::minus(target, origin);
    if (direction[0] == 0 && direction[1] == 0 && direction[2] == 0) return;
    const std::optional<RayHit> hit = shoot_ray(a, origin, direction);
    // Between origin and hit nothing may change.
    const auto at = [&](const Rational& t) {
      return Rational3{origin[0] + t * direction[0], origin[1] + t * direction[1], origin[2] + t * direction[2]};
    };
    Rational end = 100;
    if (hit) {
      const std::size_t axis = direction[0] != 0 ? 0 : direction[1] != 0 ? 1 : 2;
      end = (hit->point[axis] - origin[axis]) / direction[axis];
      RC_ASSERT(end > 0);
      RC_ASSERT(at(end) == hit->point);
      RC_ASSERT(hit->location.kind != Location::Kind::kVolume);
      RC_ASSERT((hit->location.mark != 0) == recipe.contains(hit->point));
    }
    const bool first = recipe.contains(at(end / 64));
    for (int i = 2; i < 64; ++i) RC_ASSERT(recipe.contains(at(end * i / 64)) == first);
  });
}

}  // namespace nef::test
