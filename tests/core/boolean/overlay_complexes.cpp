// SPDX-License-Identifier: Apache-2.0
//
// A Boolean operation makes the same complex, item for item, on any number of threads.
#include "nef/boolean/overlay_complexes.h"
#include "nef/io/native/native_binary.h"
#include "nef/location/query_structure.h"
#include "nef/sphere_map/label_function.h"
#include "tests/laws/laws.h"
#include "tests/support/shapes/ball.h"

namespace nef::test {
namespace {

Polyhedron combined(const Polyhedron& a, const Polyhedron& b, unsigned table, unsigned threads) {
  const LabelFunction f(2, 2,
                        [table](LabelId x, LabelId y) { return static_cast<LabelId>(table >> (2U * x + y) & 1U); });
  std::optional<Complex> made = overlay_complexes(
      a.complex(), b.complex(), f, [&]() -> const QueryStructure& { return a.queries(); },
      [&]() -> const QueryStructure& { return b.queries(); }, Monitor().on_threads(threads));
  return made ? Polyhedron(std::move(*made)) : a;
}

void same_on_any_number(const Polyhedron& a, const Polyhedron& b, unsigned table) {
  const Polyhedron on_one = combined(a, b, table, 1);
  for (const unsigned threads : {2U, 3U, 0U}) {
    const Polyhedron on_many = combined(a, b, table, threads);
    if (native_binary(on_many) != native_binary(on_one)) RC_FAIL("other bytes");
    RC_ASSERT(on_many.complex().twin == on_one.complex().twin);
    RC_ASSERT(on_many.complex().corners == on_one.complex().corners);
    RC_ASSERT(on_many.complex().sface_shell == on_one.complex().sface_shell);
  }
}

}  // namespace

TEST_CASE("small sets of any kind on several threads", "[threads]") {
  for (const bool bounded : {true, false}) {
    CHECK(rc::check(bounded ? "bounded" : "unbounded", [bounded] {
      const Recipe a = *recipes(bounded, 4).as("A");
      const Recipe b = *recipes(bounded, 4).as("B");
      const unsigned table = *rc::gen::inRange(0U, 16U);
      same_on_any_number(a.make(), b.make(), table);
    }));
  }
}

TEST_CASE("large sets on several threads", "[threads]") {
  const Polyhedron a = ball(3, 60, 50);
  const Polyhedron beside = transform(ball(2, 50, 50), AffineMap::translate({2, Rational(1, 3), Rational(1, 7)}));
  const Polyhedron b = unite(beside, make_box({-4, -4, 5}, {4, 4, 6}));
  REQUIRE(a.complex().vertex_count() + b.complex().vertex_count() > 4000);
  const Polyhedron either = unite(a, b);
  const Polyhedron both = intersect(a, b);
  CHECK(*volume(either) + *volume(both) == *volume(a) + *volume(b));
  for (const unsigned threads : {2U, 0U}) {
    CHECK(native_binary(unite(a, b, Monitor().on_threads(threads))) == native_binary(either));
    CHECK(native_binary(intersect(a, b, Monitor().on_threads(threads))) == native_binary(both));
    CHECK(native_binary(subtract(a, b, Monitor().on_threads(threads))) == native_binary(subtract(a, b)));
    CHECK(native_binary(symmetric_difference(a, b, Monitor().on_threads(threads))) ==
          native_binary(symmetric_difference(a, b)));
  }
}

}  // namespace nef::test
