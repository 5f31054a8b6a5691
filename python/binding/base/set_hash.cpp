// SPDX-License-Identifier: Apache-2.0
#include "binding/base/set_hash.h"

#include "nef/complex/predicates_of_sets.h"
#include "nef/polyhedron.h"

namespace nef::python {
namespace {

std::uint64_t mixed(std::uint64_t x) {
  // The finalizer of splitmix64.
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

std::uint64_t of_integer(const Integer& value) {
  constexpr unsigned long kPrime = (1UL << 61U) - 1;
  return mpz_fdiv_ui(value.get_mpz_t(), kPrime);
}

}  // namespace

std::int64_t set_hash(const Polyhedron& set) {
  const Complex& c = set.complex();
  std::uint64_t sum = 0;
  std::uint64_t finite = 0;
  for (const VertexId v : c.vertex_ids()) {
    if (is_box_vertex(c, v)) continue;
    ++finite;
    Rational3 point = c.points.rational(point_of(v));
    std::uint64_t h = c.mark(v);
    for (Rational& x : point) {
      x.canonicalize();
      h = mixed(h * 31 + of_integer(x.get_num()) + 17 * of_integer(x.get_den()));
    }
    sum += mixed(h);
  }
  const Counts n = counts(set);
  for (const std::uint64_t count : {finite, std::uint64_t{n.edges}, std::uint64_t{n.facets}, std::uint64_t{n.volumes},
                                    std::uint64_t{c.volumes[kOuterVolume].mark}}) {
    sum = mixed(sum * 31 + count);
  }
  return static_cast<std::int64_t>(sum >> 1U);
}

}  // namespace nef::python
