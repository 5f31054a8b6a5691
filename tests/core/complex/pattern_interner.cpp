// SPDX-License-Identifier: Apache-2.0
//
// Sphere maps taken apart into patterns and planes, and put together again.
#include <catch2/catch.hpp>
#include <random>

#include "nef/complex/rewrite_sphere_maps.h"
#include "nef/construct/construct.h"
#include "nef/construct/round_shapes.h"
#include "nef/io/native/native_binary.h"
#include "nef/polyhedron.h"
#include "tests/support/shapes/random_polyhedra.h"

namespace nef::test {
namespace {

std::uint32_t below(std::mt19937& random, std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); }

// Items without sense, but for twins, which have one plane. Svertices name planes of shalfedges and others.
SphereMapBuffer random_map(std::mt19937& random, std::uint32_t most) {
  SphereMapBuffer map;
  map.mark = static_cast<LabelId>(below(random, 3));
  const std::uint32_t pairs = below(random, most);
  const std::uint32_t svertices = below(random, most);
  const std::uint32_t planes = 1 + below(random, 3 * most);
  for (std::uint32_t e = 0; e < pairs; ++e) {
    const PlaneId plane{below(random, 2 * planes)};
    for (const PlaneId side : {plane, plane.opposite()}) {
      map.shalfedges.push_back({side, below(random, most), below(random, most), below(random, most), below(random, 2),
                                static_cast<LabelId>(e % 2)});
    }
  }
  for (std::uint32_t s = 0; s < svertices; ++s) {
    map.svertices.push_back({PlaneId{below(random, 2 * planes)}, PlaneId{below(random, 2 * planes)},
                             below(random, 2) == 0 ? kNone : below(random, most), 0,
                             static_cast<LabelId>(below(random, 2))});
  }
  for (std::uint32_t f = 0; f < 2; ++f) map.sfaces.push_back({f, 1, static_cast<LabelId>(below(random, 2))});
  for (std::uint32_t f = 0; f < 2; ++f) map.entries.push_back({SFaceEntry::Kind::kCycle, below(random, most)});
  return map;
}

template <typename A, typename B>
bool same(const A& a, const B& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

bool same_map(const SphereMapView& a, const SphereMapBuffer& b) {
  return same(a.svertices, b.svertices) && same(a.shalfedges, b.shalfedges) && same(a.sfaces, b.sfaces) &&
         same(a.entries, b.entries) && a.mark == b.mark;
}

// As a complex holds them.
struct Packed {
  PatternTable patterns;
  PatternInterner interner;
  std::vector<PlaneId> planes, others;
  std::vector<SphereMapBuffer> maps;
  std::vector<PatternId> pattern;
  std::vector<std::size_t> first_plane, first_other;

  void add(const SphereMapBuffer& map) {
    first_plane.push_back(planes.size());
    first_other.push_back(others.size());
    pattern.push_back(interner.intern(patterns, map.view(), planes, others));
    maps.push_back(map);
  }

  [[nodiscard]] SphereMapView view(std::size_t i) const {
    const LocalPlanes local(planes.data() + first_plane[i], static_cast<std::uint32_t>(maps[i].shalfedges.size() / 2),
                            others.data() + first_other[i]);
    const SphereMapView named = patterns.view(pattern[i]);
    return {{patterns.svertices(pattern[i]), local},
            {patterns.shalfedges(pattern[i]), local},
            {},
            named.sfaces,
            named.entries,
            named.mark};
  }
};

std::vector<bool> used_patterns(const Complex& c) {
  std::vector<bool> used(c.patterns.size(), false);
  for (const VertexId v : c.vertex_ids()) used[c.vertices[v].pattern.index()] = true;
  return used;
}

}  // namespace

TEST_CASE("Patterns and planes give back the sphere maps that they come from") {
  CHECK(rc::check("maps of any size, whatever planes they name", [](std::uint32_t seed) {
    std::mt19937 random(seed);
    Packed packed;
    const std::uint32_t most = random() % 4 == 0 ? 120 : 1 + below(random, 6);
    for (int i = 0; i < 12; ++i) packed.add(random_map(random, most));
    packed.add(packed.maps[below(random, 12)]);
    for (std::size_t i = 0; i < packed.maps.size(); ++i) RC_ASSERT(same_map(packed.view(i), packed.maps[i]));
    RC_ASSERT(packed.patterns.size() <= 12U);
  }));
}

TEST_CASE("The same ring through other planes has the same pattern") {
  Packed packed;
  for (const std::uint32_t shift : {0U, 10U, 70U}) {
    SphereMapBuffer ring;
    for (std::uint32_t i = 0; i < 5; ++i) {
      const PlaneId plane{2 * (i + shift)};
      const PlaneId before{2 * ((i + 4) % 5 + shift) + 1};
      ring.svertices.push_back({before, plane, 2 * i, kNone, 1});
      ring.shalfedges.push_back({plane, i, 2 * ((i + 1) % 5), 2 * ((i + 4) % 5), 0, 1});
      ring.shalfedges.push_back({plane.opposite(), (i + 1) % 5, 2 * ((i + 4) % 5) + 1, 2 * ((i + 1) % 5) + 1, 1, 1});
    }
    packed.add(ring);
  }
  CHECK(packed.patterns.size() == 1);
  CHECK(packed.planes.size() == 15);
  CHECK(packed.others.empty());
}

TEST_CASE("A convex mesh has a pattern for each degree, and results hold no pattern that nothing has") {
  const Polyhedron sphere = make_sphere(10, 60);
  CHECK(sphere.complex().vertex_count() > 1000);
  CHECK(sphere.complex().patterns.size() <= 32);
  const Polyhedron bitten = subtract(sphere, transform(sphere, AffineMap::translate({7, 3, 1})));
  for (const Polyhedron& set : {bitten, intersect(bitten, make_halfspace(1, 2, 3, 4)), complement(sphere)}) {
    const std::vector<bool> used = used_patterns(set.complex());
    CHECK(std::find(used.begin(), used.end(), false) == used.end());
  }
}

TEST_CASE("Rewriting sphere maps as they are changes nothing") {
  CHECK(rc::check("random sets", [] {
    const Polyhedron set = (*recipes(*rc::gen::arbitrary<bool>(), 4)).make();
    Complex c = set.complex();
    rewrite_sphere_maps(c, [](VertexId, SphereMapBuffer&) {});
    RC_ASSERT(native_binary(Polyhedron(std::move(c))) == native_binary(set));
  }));
}

}  // namespace nef::test
