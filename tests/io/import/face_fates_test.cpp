// SPDX-License-Identifier: Apache-2.0
//
// What became of each face, against boxes whose faces are compared by arithmetic.
#include "nef/import/repair/face_fates.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "nef/import/repair.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

struct IntegerBox {
  std::array<int, 3> low{};
  std::array<int, 3> high{};
};

// Six quads, counterclockwise as seen from outside.
void add_box(Mesh& mesh, const IntegerBox& box) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int v = 0; v < 8; ++v) {
    Rational3 point;
    for (std::size_t i = 0; i < 3; ++i) point[i] = (v >> i & 1) != 0 ? box.high[i] : box.low[i];
    mesh.vertices.push_back(point);
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kQuads{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (std::array<std::uint32_t, 4> quad : kQuads) {
    for (std::uint32_t& v : quad) v += first;
    mesh.push_face(quad);
  }
}

// The rectangle that is side `f` of a box.
IntegerBox side(const IntegerBox& box, std::size_t f) {
  IntegerBox result = box;
  const std::size_t axis = f / 2;
  result.low[axis] = result.high[axis] = f % 2 == 0 ? box.low[axis] : box.high[axis];
  return result;
}

int area_of(const IntegerBox& rectangle) {
  int product = 1;
  for (std::size_t i = 0; i < 3; ++i) product *= std::max(1, rectangle.high[i] - rectangle.low[i]);
  return product;
}

// No two of their sides are in one plane.
std::vector<IntegerBox> boxes_in_general_position(std::size_t count, std::mt19937& random) {
  std::vector<IntegerBox> boxes(count);
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<int> coordinates(2 * count);
    std::iota(coordinates.begin(), coordinates.end(), 0);
    std::shuffle(coordinates.begin(), coordinates.end(), random);
    for (std::size_t b = 0; b < count; ++b) {
      std::tie(boxes[b].low[i], boxes[b].high[i]) = std::minmax(coordinates[2 * b], coordinates[2 * b + 1]);
    }
  }
  return boxes;
}

bool meet(const IntegerBox& a, const IntegerBox& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.high[i] < b.low[i] || b.high[i] < a.low[i]) return false;
  }
  return true;
}

bool is_within(const IntegerBox& a, const IntegerBox& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.low[i] < b.low[i] || a.high[i] > b.high[i]) return false;
  }
  return true;
}

FaceFate expected(const std::vector<IntegerBox>& boxes, std::size_t own, std::size_t f) {
  const IntegerBox rectangle = side(boxes[own], f);
  FaceFate fate = FaceFate::kKept;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i == own || !meet(rectangle, boxes[i])) continue;
    if (!is_within(rectangle, boxes[i])) return FaceFate::kCut;
    fate = FaceFate::kInside;
  }
  return fate;
}

std::size_t count(const FaceRecord& record, FaceFate fate) {
  return static_cast<std::size_t>(std::count(record.fates.begin(), record.fates.end(), fate));
}

}  // namespace

TEST_CASE("Faces are kept, cut or inside as arithmetic says", "[repair][fates]") {
  std::mt19937 random(8);
  std::array<std::size_t, 3> seen{};
  for (int round = 0; round < 40; ++round) {
    const std::vector<IntegerBox> boxes = boxes_in_general_position(5, random);
    Mesh mesh;
    for (const IntegerBox& box : boxes) add_box(mesh, box);
    const RepairedMesh repaired = repair_mesh(mesh, {.crossings = Crossings::kUnion, .record = true});
    REQUIRE(repaired.problem.empty());
    REQUIRE(repaired.record.fates.size() == mesh.face_count());
    CHECK(repaired.record.added.empty());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const FaceFate fate = repaired.resolved ? expected(boxes, f / 6, f % 6) : FaceFate::kKept;
      CHECK(repaired.record.fates[f] == fate);
      ++seen[fate == FaceFate::kKept ? 0 : fate == FaceFate::kCut ? 1 : 2];
    }
  }
  for (const std::size_t often : seen) CHECK(often > 10);
}

TEST_CASE("Pieces of faces that were cut fill these faces, and those that are kept are the rest of the boundary",
          "[repair][fates]") {
  std::mt19937 random(9);
  std::size_t cut_rounds = 0;
  for (int round = 0; round < 20; ++round) {
    const std::vector<IntegerBox> boxes = boxes_in_general_position(4, random);
    Mesh mesh;
    for (const IntegerBox& box : boxes) add_box(mesh, box);
    const RepairedMesh repaired = repair_mesh(mesh, {.crossings = Crossings::kUnion, .record = true});
    REQUIRE(repaired.problem.empty());
    // Areas of sides are integers.
    double cut = 0;
    double whole = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const FaceFate fate = repaired.record.fates[f];
      if (fate == FaceFate::kCut) cut += area_of(side(boxes[f / 6], f % 6));
      if (fate == FaceFate::kKept) whole += area_of(side(boxes[f / 6], f % 6));
    }
    const double kept = surface_area(repaired.record.pieces.kept);
    CHECK(kept + surface_area(repaired.record.pieces.dropped) == Approx(cut));
    CHECK(kept + whole == Approx(surface_area(repaired.set)));
    CHECK(subtract(repaired.record.pieces.kept, boundary(repaired.set)).is_empty());
    cut_rounds += cut > 0 ? 1 : 0;
  }
  CHECK(cut_rounds > 10);
}

TEST_CASE("Copies, slivers, turned faces and lids are recorded under the numbers that they came in with",
          "[repair][fates]") {
  Mesh box;
  add_box(box, {{0, 0, 0}, {9, 9, 9}});
  Mesh mesh;
  mesh.vertices = box.vertices;
  mesh.push_face(std::array<std::uint32_t, 3>{0, 0, 1});  // 0: no area
  for (std::size_t f = 0; f < 5; ++f) {                   // 1 to 5; the last one is open
    std::vector<std::uint32_t> ring(box.face(f).begin(), box.face(f).end());
    if (f == 3) std::reverse(ring.begin(), ring.end());
    mesh.push_face(ring);
  }
  mesh.push_face(box.face(2));  // 6: like 3
  const RepairedMesh repaired =
      repair_mesh(mesh, {.close_percent = 20, .crossings = Crossings::kUnion, .record = true});
  INFO(repaired.problem);
  REQUIRE(repaired.problem.empty());
  using enum FaceFate;
  CHECK(repaired.record.fates == std::vector<FaceFate>{kNoArea, kKept, kKept, kKept, kTurned, kKept, kCopy, kAdded});
  REQUIRE(repaired.record.added.size() == 1);
  std::vector<std::uint32_t> lid = repaired.record.added[0];
  std::sort(lid.begin(), lid.end());
  CHECK(lid == std::vector<std::uint32_t>{4, 5, 6, 7});
  // A box that is inside out is turned as a whole; a sound one is kept.
  Mesh inside_out;
  inside_out.vertices = box.vertices;
  for (std::size_t f = 0; f < 6; ++f) {
    std::vector<std::uint32_t> ring(box.face(f).rbegin(), box.face(f).rend());
    inside_out.push_face(ring);
  }
  add_box(inside_out, {{20, 20, 20}, {30, 30, 30}});
  // One component, of which one face is turned outward already.
  Mesh mixed;
  mixed.vertices = box.vertices;
  for (std::size_t f = 0; f < 6; ++f) {
    std::vector<std::uint32_t> ring(box.face(f).begin(), box.face(f).end());
    if (f != 2) std::reverse(ring.begin(), ring.end());
    mixed.push_face(ring);
  }
  for (const Crossings rule : {Crossings::kRefuse, Crossings::kUnion}) {
    const RepairedMesh single = repair_mesh(mixed, {.crossings = rule, .record = true});
    REQUIRE(single.problem.empty());
    CHECK(single.done == std::vector<std::string>{"1 face flipped to match adjacent faces", "1 component flipped"});
    CHECK(volume(from_mesh(single.mesh)) == 729);
    CHECK(single.record.fates == std::vector<FaceFate>{kTurned, kTurned, kKept, kTurned, kTurned, kTurned});
    Messages notes;
    static_cast<void>(from_mesh(single.mesh, {}, &notes));
    CHECK(notes.empty());  // it was not inside out
  }
  const RepairedMesh turned = repair_mesh(inside_out, {.record = true});
  REQUIRE(turned.problem.empty());
  CHECK(count(turned.record, kTurned) == 6);
  CHECK(count(turned.record, kKept) == 6);
  CHECK(count(repair_mesh(box, {.record = true}).record, kKept) == 6);
}

}  // namespace nef
