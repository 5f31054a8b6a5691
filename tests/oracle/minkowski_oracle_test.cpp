// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums against CGAL's minkowski_sum_3, set against set; and the one published sum in reach that is not the
// exact one, with the roundings that make it (docs/minkowski.md, "Exactness against published answers").
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "nef/io/polyhedron_file.h"
#include "tests/support/literals.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_folder.h"

namespace {

using nef::Polyhedron;
using nef::minkowski::MinkowskiOptions;
using nef::minkowski::UnionStrategy;

const std::string kData = source_folder() + "/data/";

// Files of one test, removed at the end.
class Place : public nef::test::TemporaryFolder {
 public:
  // A cube of side 0.2 about the origin, spelled as in the published inputs.
  [[nodiscard]] std::string cube() const {
    return write("cube.off",
                 "OFF\n8 6 0\n"
                 "-0.1 -0.1 0.1\n0.1 -0.1 0.1\n0.1 0.1 0.1\n-0.1 0.1 0.1\n"
                 "-0.1 0.1 -0.1\n0.1 0.1 -0.1\n0.1 -0.1 -0.1\n-0.1 -0.1 -0.1\n"
                 "4 0 1 2 3\n4 4 5 6 7\n4 7 6 1 0\n4 6 5 2 1\n4 5 4 3 2\n4 4 7 0 3\n");
  }

  [[nodiscard]] Polyhedron cgal_sum(const std::string& how, const std::string& a, const std::string& b) const {
    const std::string out = path() / "sum.nef3";
    const int status =
        std::system((program_folder() + "/sum_peer " + how + " '" + a + "' '" + b + "' '" + out + "'").c_str());
    REQUIRE((WIFEXITED(status) && WEXITSTATUS(status) == 0));
    return nef::read_polyhedron(out);
  }
};

TEST_CASE("sums are CGAL's, as sets, by every strategy") {
  const Place place;
  const std::vector<std::pair<std::string, std::string>> operands = {
      {kData + "minkowski/tripod.off", place.cube()},
      {kData + "minkowski/mushroom.off", kData + "minkowski/cube.off"},
      {kData + "minkowski/P.off", kData + "meshes/star.off"},
      {kData + "meshes/hole.off", place.cube()}};
  for (const auto& [a, b] : operands) {
    CAPTURE(a, b);
    const Polyhedron expected = place.cgal_sum("exact", a, b);
    for (const UnionStrategy strategy : {UnionStrategy::kAuto, UnionStrategy::kConvolution, UnionStrategy::kQueue}) {
      MinkowskiOptions options;
      options.strategy = strategy;
      CHECK(nef::equal(nef::minkowski::minkowski_sum(nef::read_polyhedron(a), nef::read_polyhedron(b), options),
                       expected));
    }
  }
}

TEST_CASE("the tripod plus a cube: 64 vertices exactly, 134 with OpenSCAD's roundings") {
  const Place place;
  const std::string tripod = kData + "minkowski/tripod.off";
  const Polyhedron sum =
      nef::minkowski::minkowski_sum(nef::read_polyhedron(tripod), nef::read_polyhedron(place.cube()));
  CHECK(nef::test::count_text(sum) == "64/134/72/2");
  CHECK(nef::nearest_double(*nef::volume(sum)) == Approx(0.411228507).epsilon(1e-8));

  const Polyhedron rounded = place.cgal_sum("rounded", tripod, place.cube());
  CHECK(nef::counts(rounded).vertices == 134);
  CHECK(nef::counts(rounded).facets == 167);
  CHECK(nef::nearest_double(*nef::volume(rounded)) == Approx(0.411224).margin(5e-7));
}

}  // namespace
