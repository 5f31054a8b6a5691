// SPDX-License-Identifier: Apache-2.0
//
// The program on docs/coming_from_cgal.md, as it is printed there (tests/docs/check_snippets.py compares them).
#include <catch2/catch.hpp>
#include <iostream>
#include <sstream>

#include "nef/construct/construct.h"
#include "nef/operators.h"
#include "nef/query/explore.h"

namespace {

void program() {
  const nef::Polyhedron n = nef::make_box({0, 0, 0}, {3, 3, 3}) - nef::make_box({1, 1, 1}, {2, 2, 2});
  const nef::Complex& c = n.complex();

  // Vertex_const_iterator v; CGAL_forall_vertices(v, N) std::cout << v->point() << v->mark();
  for (const auto v : nef::vertices(n)) {
    const nef::Rational3 p = nef::point(n, v);
    std::cout << p[0] << ' ' << p[1] << ' ' << p[2] << ' ' << c.mark(v) << '\n';
  }
  // Halffacet_cycle_const_iterator and SHalfedge_around_facet_const_circulator
  for (const auto f : nef::facets(n)) {
    nef::visit_cycles(n, f, [](std::span<const nef::VertexId> ring) { std::cout << ring.size() << " corners\n"; });
  }
  // N.visit_shell_objects(SFace_const_handle(shell), visitor)
  for (const auto volume : nef::volumes(n)) {
    for (const auto shell : nef::shells(n, volume)) {
      int facets = 0;
      nef::visit_shell(
          n, shell, [](auto) {}, [](auto) {}, [&facets](auto) { ++facets; });
      std::cout << "volume " << volume.index() << ": a shell of " << facets << " facets\n";
    }
  }
}

}  // namespace

TEST_CASE("the page for users of CGAL: going through the items") {
  std::ostringstream printed;
  std::streambuf* const before = std::cout.rdbuf(printed.rdbuf());
  program();
  std::cout.rdbuf(before);
  const std::string text = printed.str();
  CHECK(text.find("0 0 0 1\n") != std::string::npos);
  CHECK(text.find("4 corners\n") != std::string::npos);
  CHECK(text.find(": a shell of 6 facets\n") != std::string::npos);
}
