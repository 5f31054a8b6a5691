// SPDX-License-Identifier: Apache-2.0
//
// The binary form of .nef: it gives every complex back, refuses every damage, and what somebody makes up stays
// harmless.
#define XXH_INLINE_ALL
#include <rapidcheck.h>
#include <xxhash.h>
#include <catch2/catch.hpp>

#include <cstring>
#include <random>

#include "nef/construct/construct.h"
#include "nef/io/file_bytes.h"
#include "nef/io/native/native_binary.h"
#include "nef/io/native/native_format.h"
#include "nef/io/polyhedron_file.h"
#include "tests/support/shapes/random_polyhedra.h"
#include "tests/support/temporary_folder.h"

namespace nef {
namespace {

using test::set;

// Items of every kind, more than one shell and volume, an infimaximal box, sloops, single points and edges.
Polyhedron specimen() {
  return set(
      "(box(0,0,0,4,4,4) - interior(box(1,1,1,2,2,2)) + box(4,4,0,8,8,4)) + polygon(4,0,2,6,0,2,6,2,2,4,2,2) + "
      "point(7,1,1) - point(6,6,4) - point(1/2,1/2,2) + segment(9,0,0,10,1,1) + halfspace(1,1,1,10)");
}

// With the checksum that its bytes ask for.
std::string sealed(std::string bytes) {
  const std::uint64_t checksum = XXH3_64bits(bytes.data(), bytes.size() - 8);
  std::memcpy(bytes.data() + bytes.size() - 8, &checksum, 8);
  return bytes;
}

// A pyramid over a polygon with many sides: its apex has many items.
Polyhedron pyramid(int sides) {
  Mesh mesh;
  const auto add = [&mesh](int x, int y, int z) { mesh.vertices.push_back({Rational(x), Rational(y), Rational(z)}); };
  // On a parabola and its chord, so that all is convex and exact.
  for (int i = 0; i < sides; ++i) add(i, i * i, 0);
  add(1, sides, 5);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(sides); ++i) {
    const std::uint32_t next = (i + 1) % static_cast<std::uint32_t>(sides);
    mesh.push_face(std::vector<std::uint32_t>{i, next, static_cast<std::uint32_t>(sides)});
  }
  std::vector<std::uint32_t> floor;
  for (int i = sides; i-- > 0;) floor.push_back(static_cast<std::uint32_t>(i));
  mesh.push_face(floor);
  return from_mesh(mesh);
}

void check_comes_back(const Polyhedron& a) {
  const std::string bytes = native_binary(a);
  const Polyhedron b = read_native(bytes, "bytes");
  CHECK(validate(b.complex()).empty());
  CHECK(equal(a, b));
  CHECK(native_text(a) == native_text(b));
  CHECK(native_binary(b) == bytes);
  CHECK(counts(a).shells == counts(b).shells);
}

}  // namespace

TEST_CASE("Binary files give every random set back, bounded or not") {
  CHECK(rc::check("binary round trip", [] {
    const Polyhedron a = (*test::recipes(false, 5)).make();
    const std::string bytes = native_binary(a);
    const Polyhedron b = read_native(bytes, "bytes");
    RC_ASSERT(validate(b.complex()).empty());
    RC_ASSERT(native_text(a) == native_text(b));
    RC_ASSERT(native_binary(b) == bytes);
    RC_ASSERT(equal(a, b));
  }));
}

TEST_CASE("Binary files hold everything") {
  check_comes_back(Polyhedron());
  check_comes_back(Polyhedron::everything());
  check_comes_back(specimen());
  check_comes_back(overlay(specimen(), set("box(1,1,1,3,3,3)"),
                           [](LabelId x, LabelId y) { return static_cast<LabelId>(300 * x + 20000 * y); }));
  check_comes_back(
      set("point(-170141183460469231731687303715884105728, 0, 1)"));  // -2^127: one bit too long for two words
  check_comes_back(pyramid(100));
  check_comes_back(pyramid(400));  // indices of two bytes
}

TEST_CASE("Any damage to a binary file is told") {
  const std::string bytes = native_binary(specimen());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string bent = bytes;
    bent[i] = static_cast<char>(bent[i] ^ (1 << (i % 8)));
    CHECK_THROWS_AS(read_native(bent, "bent"), FileError);
    CHECK_THROWS_AS(read_native(bytes.substr(0, i), "cut"), FileError);
  }
  CHECK_THROWS_AS(read_native(bytes + "x", "long"), FileError);
  CHECK_THROWS_WITH(read_native(bytes.substr(0, bytes.size() - 9), "a.nef"),
                    Catch::Contains("a.nef: ") && Catch::Contains("checksum"));
}

TEST_CASE("A binary file with a right checksum and wrong contents is refused or harmless") {
  const std::string bytes = native_binary(specimen());
  std::mt19937 random(4);
  int refused = 0;
  int taken = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string bent = bytes;
    for (int k = static_cast<int>(random() % 3); k >= 0; --k) {
      bent[16 + random() % (bent.size() - 24)] = static_cast<char>(random() % 2 == 0 ? random() % 5 : random() % 256);
    }
    try {
      const Polyhedron made = read_native(sealed(bent), "bent");
      ++taken;
      validate(made.complex());
      contains(made, {Rational(1, 2), Rational(1, 3), Rational(1, 4)});
      counts(made);
      unite(made, make_box({0, 0, 0}, {1, 1, 1}));
    } catch (const Error&) {
      ++refused;
    } catch (const std::logic_error&) {
      // An assertion of an operation: planes and points that do not fit together.
    }
  }
  CHECK(refused > 1000);
  CHECK(taken > 100);
}

TEST_CASE("A binary file that promises what it has not is refused before anything is made of it") {
  const std::string bytes = native_binary(set("box(0,0,0,1,1,1)"));
  for (std::size_t at = 16; at < 64; at += 4) {
    for (const std::uint32_t value : {0xffffffffU, 0x7fffffffU, 1U << 30U}) {
      std::string bent = bytes;
      std::memcpy(bent.data() + at, &value, 4);
      CHECK_THROWS_AS(read_native(sealed(bent), "large"), FileError);
    }
  }
  std::string later = bytes;
  later[8] = 2;
  CHECK_THROWS_WITH(read_native(sealed(later), "later"), Catch::Contains("version 2"));
}

TEST_CASE("Files of either form are written and told apart") {
  const test::TemporaryFolder folder;
  const Polyhedron a = specimen();
  const std::string binary = folder.file("a.nef");
  const std::string text = folder.file("b.nef");
  write_polyhedron(binary, a);
  PolyhedronWriteOptions options;
  options.text = true;
  write_polyhedron(text, a, options);
  CHECK(is_native_binary(test::slurp(binary)));
  CHECK(test::slurp(text).rfind("nef 1\n", 0) == 0);
  CHECK(equal(read_polyhedron(binary), a));
  CHECK(equal(read_polyhedron(text), a));
}

}  // namespace nef
