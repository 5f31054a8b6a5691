// SPDX-License-Identifier: Apache-2.0
//
// Equal sets have equal files in canonical order, however they were made.
#include "nef/operation/canonical_order.h"

#include "nef/io/native/native_binary.h"
#include "tests/laws/laws.h"

namespace nef::test {
namespace {

void same_bytes(const Polyhedron& a, const Polyhedron& b, const std::string& law) {
  const Polyhedron x = in_canonical_order(a);
  const Polyhedron y = in_canonical_order(b);
  same(x, a, law);
  if (native_binary(x) != native_binary(y)) RC_FAIL(law + ": other bytes");
}

}  // namespace

TEST_CASE("the canonical order depends on the set alone") {
  for_all_pairs("histories", 3, [](const Recipe& first, const Recipe& second) {
    const Polyhedron a = first.make();
    const Polyhedron b = second.make();
    same_bytes(a, in_canonical_order(a), "twice");
    same_bytes(unite(a, b), unite(b, a), "A + B");
    same_bytes(subtract(a, b), complement(unite(complement(a), b)), "A - B");
    same_bytes(symmetric_difference(a, b), unite(subtract(b, a), subtract(a, b)), "A ^ B");
    // Points over other denominators, lines by other planes.
    const AffineMap away = AffineMap::scale({Rational(1, 3), Rational(1, 7), 5});
    const AffineMap back = AffineMap::scale({3, 7, Rational(1, 5)});
    same_bytes(a, transform(transform(a, away), back), "there and back");
  });
}

}  // namespace nef::test
