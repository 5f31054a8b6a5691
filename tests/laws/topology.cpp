// SPDX-License-Identifier: Apache-2.0
//
// Laws of interior, closure, boundary, exterior and regularization.
#include "tests/laws/laws.h"

namespace nef::test {

TEST_CASE("interior, closure, boundary") {
  for_all("topology", 4, [](const Recipe& recipe) {
    const Polyhedron a = recipe.make();
    const Polyhedron inside = interior(a);
    const Polyhedron closed = closure(a);
    const Polyhedron edge = boundary(a);
    same(subtract(inside, a), Polyhedron(), "int A is part of A");
    same(subtract(a, closed), Polyhedron(), "A is part of cl A");
    same(interior(inside), inside, "int int A = int A");
    same(closure(closed), closed, "cl cl A = cl A");
    same(complement(interior(complement(a))), closed, "cl A = !int !A");
    same(subtract(closed, inside), edge, "bd A = cl A - int A");
    same(boundary(complement(a)), edge, "bd !A = bd A");
    same(exterior(a), interior(complement(a)), "ext A = int !A");
    same(regularize(a), closure(inside), "reg A = cl int A");
    same(regularize(regularize(a)), regularize(a), "reg reg A = reg A");
    same(interior(closure(interior(closed))), interior(closed), "int cl int cl A = int cl A");
    RC_ASSERT(inside.is_open());
    RC_ASSERT(closed.is_closed());
    RC_ASSERT(edge.is_closed());
    RC_ASSERT(exterior(a).is_open());
    RC_ASSERT(regularize(a).is_regular());
    RC_ASSERT(a.is_open() == equal(a, inside));
    RC_ASSERT(a.is_closed() == equal(a, closed));
    RC_ASSERT(a.is_regular() == equal(a, regularize(a)));
  });
}

TEST_CASE("topology of unions and intersections") {
  for_all_pairs("int and cl distribute", 2, [](const Recipe& first, const Recipe& second) {
    const Polyhedron a = first.make();
    const Polyhedron b = second.make();
    same(interior(intersect(a, b)), intersect(interior(a), interior(b)), "int(A * B) = int A * int B");
    same(closure(unite(a, b)), unite(closure(a), closure(b)), "cl(A + B) = cl A + cl B");
    same(subtract(unite(interior(a), interior(b)), interior(unite(a, b))), Polyhedron(),
         "int A + int B is part of int(A + B)");
  });
}

}  // namespace nef::test
