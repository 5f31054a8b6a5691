// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <set>

#include "nef/io/mesh/mesh_reader.h"
#include "nef/mesh/mesh_check.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/polyhedron.h"
#include "tests/support/paths.h"
#include "tests/support/shapes/machine_parts.h"

namespace nef {
namespace {

using Kind = MeshProblemKind;

Mesh off(const std::string& body) { return read_off("OFF\n" + body, "test.off"); }

// Six quads, counterclockwise as seen from outside.
void add_box(Mesh& mesh, const Rational3& low, const Rational3& high) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < 8; ++i) {
    mesh.vertices.push_back(
        {(i & 1U) != 0 ? high[0] : low[0], (i & 2U) != 0 ? high[1] : low[1], (i & 4U) != 0 ? high[2] : low[2]});
  }
  const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& quad : quads) {
    const std::uint32_t face[4] = {first + quad[0], first + quad[1], first + quad[2], first + quad[3]};
    mesh.push_face(face);
  }
}

Mesh boxes(std::initializer_list<std::array<int, 6>> list) {
  Mesh mesh;
  for (const auto& b : list) add_box(mesh, {b[0], b[1], b[2]}, {b[3], b[4], b[5]});
  return mesh;
}

std::vector<MeshProblem> of_kind(const Mesh& mesh, Kind kind) {
  std::vector<MeshProblem> result;
  for (const MeshProblem& problem : check_mesh(mesh)) {
    if (problem.kind == kind) result.push_back(problem);
  }
  return result;
}

// The first pair of faces that cross or overlap, be it along an edge of both only.
std::optional<MeshProblem> first_self_intersection(const Mesh& mesh) {
  for (const MeshProblem& problem : check_mesh(mesh)) {
    const bool edge =
        problem.kind == Kind::kNonManifoldEdge && problem.text.find("do not separate") != std::string::npos;
    if (problem.kind == Kind::kSelfIntersection || edge) return problem;
  }
  return std::nullopt;
}

bool planar(const Mesh& mesh, std::size_t face) { return MeshSurface(mesh, {}).planar[face]; }

bool legal(const Mesh& mesh) {
  const auto problems = check_mesh(mesh);
  return std::all_of(problems.begin(), problems.end(), [](const MeshProblem& p) { return p.legal; });
}

TEST_CASE("A box is clean, also with a cavity and beside others") {
  CHECK(check_mesh(boxes({{0, 0, 0, 1, 1, 1}})).empty());
  CHECK(check_mesh(boxes({{0, 0, 0, 9, 9, 9}, {1, 1, 1, 2, 2, 2}, {11, 0, 0, 12, 1, 1}})).empty());
}

TEST_CASE("Of coordinates beyond those that filters take, faces far from each other are not compared either") {
  const auto signs = [](const char* scale) {
    const Integer by(scale);
    Mesh mesh;
    for (int i = 0; i < 100; ++i) add_box(mesh, {3 * i * by, 0, 0}, {(3 * i + 2) * by, 2 * by, by});
    PredicateCounts counts;
    CHECK(check_mesh(mesh, {}, Monitor().counting(counts)).empty());
    return counts.identity + counts.filter + counts.exact;
  };
  const std::string huge = "1" + std::string(150, '0');
  CHECK(signs(huge.c_str()) < 20 * signs("1"));
}

TEST_CASE("Solids that share a corner, an edge or a part of an edge are legal") {
  const Mesh corner = boxes({{0, 0, 0, 1, 1, 1}, {1, 1, 1, 2, 2, 2}});
  CHECK(check_mesh(corner).empty());
  const Mesh edge = boxes({{0, 0, 0, 1, 1, 1}, {1, 1, 0, 2, 2, 1}});
  const auto shared = of_kind(edge, Kind::kNonManifoldEdge);
  REQUIRE(shared.size() == 1);
  CHECK(shared[0].legal);
  CHECK(shared[0].faces.size() == 4);
  CHECK(shared[0].edges == std::vector<std::array<std::uint32_t, 2>>{{7, 3}});
  CHECK(legal(edge));
  CHECK_FALSE(first_self_intersection(edge));
  const Mesh part = boxes({{0, 0, 0, 1, 1, 4}, {1, 1, 1, 2, 2, 2}});
  CHECK(legal(part));
  CHECK_FALSE(of_kind(part, Kind::kTouching).empty());
  CHECK_FALSE(first_self_intersection(part));
}

TEST_CASE("A vertex or an edge that lies on a face touches it") {
  // A pyramid with its apex in the middle of the top of a box.
  Mesh apex = boxes({{0, 0, 0, 4, 4, 4}});
  for (const Rational3& p : std::vector<Rational3>{{2, 2, 4}, {1, 1, 6}, {3, 1, 6}, {2, 3, 6}})
    apex.vertices.push_back(p);
  const std::uint32_t faces[4][3] = {{9, 10, 11}, {8, 10, 9}, {8, 11, 10}, {8, 9, 11}};
  for (const auto& face : faces) apex.push_face(face);
  CHECK(legal(apex));
  CHECK(of_kind(apex, Kind::kTouching).size() == 3);
  CHECK_FALSE(first_self_intersection(apex));
  // A wedge standing on its edge, in the top of a box.
  Mesh ridge = boxes({{0, 0, 0, 4, 4, 4}});
  for (const Rational3& p : std::vector<Rational3>{{1, 2, 4}, {3, 2, 4}, {1, 1, 6}, {3, 1, 6}, {1, 3, 6}, {3, 3, 6}}) {
    ridge.vertices.push_back(p);
  }
  const std::vector<std::vector<std::uint32_t>> wedge{
      {8, 9, 11, 10}, {8, 12, 13, 9}, {10, 11, 13, 12}, {8, 10, 12}, {9, 13, 11}};
  for (const auto& face : wedge) ridge.push_face(face);
  CHECK(legal(ridge));
  CHECK_FALSE(of_kind(ridge, Kind::kTouching).empty());
  CHECK_FALSE(first_self_intersection(ridge));
}

TEST_CASE("Solids that cross are refused with the first pair of faces") {
  const Mesh crossing = boxes({{0, 0, 0, 2, 2, 2}, {1, 1, 1, 3, 3, 3}});
  const auto first = first_self_intersection(crossing);
  REQUIRE(first);
  CHECK(first->kind == Kind::kSelfIntersection);
  CHECK(first->faces == std::vector<std::uint32_t>{1, 8});  // top of the first, front of the second
  CHECK_FALSE(first->legal);
  // Each of three faces of one crosses two of the other's.
  CHECK(of_kind(crossing, Kind::kSelfIntersection).size() == 6);
}

TEST_CASE("Coplanar faces that overlap turned alike are refused, ones back to back or with a common edge are not") {
  CHECK(first_self_intersection(boxes({{0, 0, 0, 2, 2, 2}, {1, 1, 0, 3, 3, 4}})));
  CHECK(first_self_intersection(boxes({{0, 0, 0, 2, 2, 2}, {0, 0, 0, 2, 2, 2}})));
  for (const Mesh& glued :
       {boxes({{0, 0, 0, 2, 2, 2}, {1, 1, 2, 3, 3, 4}}), boxes({{0, 0, 0, 2, 2, 2}, {0, 0, 2, 2, 2, 4}})}) {
    CHECK_FALSE(first_self_intersection(glued));
    CHECK(legal(glued));
    CHECK(of_kind(glued, Kind::kTouching).size() >= 1);
    CHECK(of_kind(glued, Kind::kTouching)[0].faces == std::vector<std::uint32_t>{1, 6});
  }
  CHECK_FALSE(first_self_intersection(boxes({{0, 0, 0, 2, 2, 2}, {2, 2, 0, 4, 4, 2}})));
}

TEST_CASE("Crossings along edges only are found") {
  // The edge of one wedge lies in the face of a box, its two faces on either side.
  Mesh mesh = boxes({{0, 0, 0, 4, 4, 4}});
  for (const Rational3& p : std::vector<Rational3>{{1, 2, 4}, {3, 2, 4}, {1, 1, 6}, {3, 1, 6}, {1, 1, 3}, {3, 1, 3}}) {
    mesh.vertices.push_back(p);
  }
  const std::vector<std::vector<std::uint32_t>> wedge{
      {8, 9, 11, 10}, {8, 12, 13, 9}, {10, 11, 13, 12}, {8, 10, 12}, {9, 13, 11}};
  for (const auto& face : wedge) mesh.push_face(face);
  CHECK(first_self_intersection(mesh));
  // Two tetrahedra with a common edge, one inside the other there: between their faces is more than one inside, though
  // no face crosses another.
  Mesh nested =
      off("6 8 0\n0 0 0\n0 0 4\n4 0 2\n0 4 2\n2 1 2\n1 2 2\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"
          "3 0 4 1\n3 0 1 5\n3 0 5 4\n3 1 4 5\n");
  const auto found = first_self_intersection(nested);
  REQUIRE(found);
  CHECK(found->edges.size() == 1);
  const auto edges = of_kind(nested, Kind::kNonManifoldEdge);
  REQUIRE(edges.size() == 1);
  CHECK_FALSE(edges[0].legal);
}

TEST_CASE("Every other problem has its name and its guilty elements") {
  Mesh open = boxes({{0, 0, 0, 1, 1, 1}});
  open.corners.resize(20);
  open.face_begin.pop_back();
  const auto border = of_kind(open, Kind::kOpenBorder);
  CHECK(border.size() == 4);
  CHECK(check_mesh(open).size() == 4);
  CHECK(border[0].faces.size() == 1);

  Mesh flipped = boxes({{0, 0, 0, 1, 1, 1}});
  std::reverse(flipped.corners.begin(), flipped.corners.begin() + 4);
  const auto turned = of_kind(flipped, Kind::kInconsistentOrientation);
  CHECK(turned.size() == 4);
  for (const MeshProblem& p : turned) CHECK(p.faces[0] == 0);

  Mesh inside_out = boxes({{0, 0, 0, 1, 1, 1}});
  for (std::size_t f = 0; f < 6; ++f) {
    std::reverse(inside_out.corners.begin() + 4 * static_cast<long>(f),
                 inside_out.corners.begin() + 4 * static_cast<long>(f) + 4);
  }
  REQUIRE(check_mesh(inside_out).size() == 1);
  CHECK(check_mesh(inside_out)[0].kind == Kind::kInsideOut);

  Mesh bad_index = boxes({{0, 0, 0, 1, 1, 1}});
  bad_index.corners[5] = 77;
  const auto bad = of_kind(bad_index, Kind::kBadIndex);
  REQUIRE(bad.size() == 1);
  CHECK(bad[0].faces == std::vector<std::uint32_t>{1});
  CHECK(bad[0].vertices == std::vector<std::uint32_t>{77});
  CHECK_FALSE(first_self_intersection(bad_index));

  Mesh lonely = boxes({{0, 0, 0, 1, 1, 1}});
  lonely.vertices.push_back({5, 5, 5});
  const auto isolated = of_kind(lonely, Kind::kIsolatedVertex);
  REQUIRE(isolated.size() == 1);
  CHECK(isolated[0].vertices == std::vector<std::uint32_t>{8});
  CHECK(isolated[0].legal);

  const Mesh degenerate = off("5 3 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n0 0 0\n3 0 1 2\n3 0 1 4\n4 0 1 3 1\n");
  const auto flat = of_kind(degenerate, Kind::kDegenerateFace);
  REQUIRE(flat.size() == 3);
  CHECK(flat[0].faces == std::vector<std::uint32_t>{0});

  const Mesh twice = off("4 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 1 0 2\n");
  const auto duplicate = of_kind(twice, Kind::kDuplicateFace);
  REQUIRE(duplicate.size() == 1);
  CHECK(duplicate[0].faces == std::vector<std::uint32_t>{0, 4});
  CHECK(of_kind(twice, Kind::kNonManifoldEdge).size() == 3);

  const Mesh bowtie = off("4 1 0\n0 0 0\n1 1 0\n1 0 0\n0 1 0\n4 0 1 2 3\n");
  const auto crossed = of_kind(bowtie, Kind::kSelfIntersection);
  REQUIRE(crossed.size() == 1);
  CHECK(crossed[0].faces == std::vector<std::uint32_t>{0});
}

TEST_CASE("A pentagram crosses itself though all its corners turn left") {
  const Mesh star = off("5 1 0\n0 10 0\n-6 -8 0\n10 3 0\n-10 3 0\n6 -8 0\n5 0 1 2 3 4\n");
  const auto crossed = of_kind(star, Kind::kSelfIntersection);
  REQUIRE_FALSE(crossed.empty());
  CHECK(crossed[0].faces == std::vector<std::uint32_t>{0});
}

TEST_CASE("A face that is not planar is reported with its deviation") {
  const Mesh bent = off("4 1 0\n0 0 0\n1 0 0\n1 1 0.4\n0 1 0\n4 0 1 2 3\n");
  CHECK_FALSE(planar(bent, 0));
  // Area vector (-0.2, -0.2, 1) up to a factor, centroid (1/2, 1/2, 1/10): each corner is 0.1 / |n| off.
  CHECK(face_deviation(bent, 0) == Approx(0.1 / std::sqrt(1.08)));
  const auto found = of_kind(bent, Kind::kNonPlanarFace);
  REQUIRE(found.size() == 1);
  CHECK(found[0].legal);
  // One part in 10^40 is not planar either.
  const Mesh nearly = off("4 1 0\n0 0 0\n1 0 0\n1 1 1e-40\n0 1 0\n4 0 1 2 3\n");
  CHECK_FALSE(planar(nearly, 0));
  CHECK(face_deviation(nearly, 0) == Approx(2.5e-41));
  CHECK(face_deviation_text(nearly, 0) == "2.5e-41");
  CHECK(planar(off("5 1 0\n0 0 0\n1 0 1/3\n2 0 2/3\n2 1 1\n0 1 1/3\n5 0 1 2 3 4\n"), 0));
}

TEST_CASE("Tiny and huge crossings are decided exactly") {
  for (const char* size : {"1e-40", "1e-200", "1e120", "1/3", "1e-7"}) {
    INFO(size);
    const Rational s = parse_rational(size);
    // The second box reaches into the first by s, or stays away by s, or its corner touches.
    for (const int sign : {-1, 0, 1}) {
      Mesh mesh;
      add_box(mesh, {0, 0, 0}, {1, 1, 1});
      const Rational low = 1 - sign * s;
      const Rational high = low + 2 + s;
      add_box(mesh, {low, low, low}, {high, high, high});
      if (s < 1) CHECK(first_self_intersection(mesh).has_value() == (sign > 0));
    }
  }
}

TEST_CASE("Random boxes: a pair of faces is reported iff the boxes' surfaces cross or overlap") {
  std::mt19937 random(20240611);
  const auto coordinate = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  int crossing = 0;
  for (int round = 0; round < 400; ++round) {
    INFO("round " << round);
    std::array<std::array<int, 6>, 2> b{};
    for (auto& box : b) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box[axis] = coordinate(5);
        box[axis + 3] = box[axis] + 1 + coordinate(4);
      }
    }
    // Closed-form: interiors meet in an area of both surfaces, or one surface enters the other's inside.
    bool inside_out_of_reach = false;
    bool first_in_second = true;
    bool second_in_first = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (b[0][axis + 3] < b[1][axis] || b[1][axis + 3] < b[0][axis]) inside_out_of_reach = true;
      if (!(b[1][axis] < b[0][axis] && b[0][axis + 3] < b[1][axis + 3])) first_in_second = false;
      if (!(b[0][axis] < b[1][axis] && b[1][axis + 3] < b[0][axis + 3])) second_in_first = false;
    }
    int touching_axes = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (b[0][axis + 3] == b[1][axis] || b[1][axis + 3] == b[0][axis]) ++touching_axes;
    }
    // Boxes that are apart, nested strictly, or meet from outside are fine; all others share an area of faces that are
    // turned alike, or cross.
    const bool fine = inside_out_of_reach || first_in_second || second_in_first || touching_axes >= 1;
    const Mesh mesh = boxes({b[0], b[1]});
    CHECK(first_self_intersection(mesh).has_value() == !fine);
    crossing += fine ? 0 : 1;
  }
  CHECK(crossing > 50);
  CHECK(crossing < 390);
}

// A prism over a polygon of the xy-plane, z from low to high, its axes permuted and all turned by an oblique rotation
// with rational entries.
void add_prism(Mesh& mesh, const std::vector<std::array<int, 2>>& base, std::array<int, 3> at, int height,
               std::size_t axis, bool oblique) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto n = static_cast<std::uint32_t>(base.size());
  for (const int z : {0, height}) {
    for (const auto& [x, y] : base) {
      Rational3 p;
      p[axis] = at[axis] + z;
      p[(axis + 1) % 3] = at[(axis + 1) % 3] + x;
      p[(axis + 2) % 3] = at[(axis + 2) % 3] + y;
      if (oblique) {
        p = {Rational(2, 7) * p[0] + Rational(3, 7) * p[1] + Rational(6, 7) * p[2],
             Rational(6, 7) * p[0] + Rational(2, 7) * p[1] - Rational(3, 7) * p[2],
             Rational(-3, 7) * p[0] + Rational(6, 7) * p[1] + Rational(2, 7) * p[2]};
        p[0] += Rational("1/1000000000000000000000");  // no small integers
      }
      mesh.vertices.push_back(p);
    }
  }
  std::vector<std::uint32_t> bottom;
  std::vector<std::uint32_t> top;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    const std::uint32_t side[4] = {first + i, first + j, first + n + j, first + n + i};
    mesh.push_face(side);
    bottom.push_back(first + n - 1 - i);
    top.push_back(first + n + i);
  }
  mesh.push_face(bottom);
  mesh.push_face(top);
}

// Pairs of faces that meet improperly, with the kind of the worst contact.
using Contacts = std::set<std::array<std::uint32_t, 3>>;

Contacts contacts_of(const Mesh& mesh, const std::vector<std::uint32_t>& face_of) {
  std::map<std::array<std::uint32_t, 2>, Kind> worst;
  for (const MeshProblem& p : check_mesh(mesh)) {
    if ((p.kind != Kind::kSelfIntersection && p.kind != Kind::kTouching) || p.faces.size() != 2) continue;
    const auto [f, g] = std::minmax(face_of[p.faces[0]], face_of[p.faces[1]]);
    const auto [at, added] = worst.emplace(std::array{f, g}, p.kind);
    if (p.kind == Kind::kSelfIntersection) at->second = p.kind;
  }
  Contacts result;
  for (const auto& [faces, kind] : worst) result.insert({faces[0], faces[1], static_cast<std::uint32_t>(kind)});
  return result;
}

std::size_t shared_corners(const MeshSurface& surface, std::uint32_t f, std::uint32_t g) {
  std::set<std::uint32_t> corners;
  std::set<std::uint32_t> shared;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.face_of[t] == f) corners.insert(surface.triangles[t].begin(), surface.triangles[t].end());
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.face_of[t] != g) continue;
    for (const std::uint32_t v : surface.triangles[t]) {
      if (corners.count(v) > 0) shared.insert(v);
    }
  }
  return shared.size();
}

// A wedge on a square, with its edge on a diagonal: the square's triangles may have that edge, too.
TEST_CASE("An edge on the diagonal of a face touches it, whichever way the face is cut") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2},
                   {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 4}, {1, 1, 4}};
  using Quad = std::array<std::uint32_t, 4>;
  using Triangle = std::array<std::uint32_t, 3>;
  for (const Quad& top : {Quad{4, 5, 6, 7}, Quad{5, 6, 7, 4}}) {
    Mesh both = mesh;
    for (const Quad& q :
         {Quad{0, 3, 2, 1}, Quad{0, 1, 5, 4}, Quad{1, 2, 6, 5}, Quad{2, 3, 7, 6}, Quad{3, 0, 4, 7}, top}) {
      both.push_face(q);
    }
    Mesh crossing = both;
    for (const Triangle& t : {Triangle{4, 9, 6}, Triangle{6, 8, 4}, Triangle{4, 8, 9}, Triangle{6, 9, 8}}) {
      both.push_face(t);
      crossing.push_face(Triangle{t[0], t[2], t[1]});
    }
    std::size_t touching = 0;
    for (const MeshProblem& p : check_mesh(both)) {
      CHECK(p.kind == Kind::kTouching);
      CHECK(p.faces[0] == 5);
      ++touching;
    }
    CHECK(touching == 2);
    const Polyhedron wedge = convex_hull(std::vector<Rational3>{{0, 0, 2}, {2, 2, 2}, {1, 0, 4}, {1, 1, 4}});
    const Polyhedron solid = from_mesh(both);
    CHECK(validate(solid.complex()) == "");
    CHECK(equal(solid, unite(make_box({0, 0, 0}, {2, 2, 2}), wedge)));
    MeshOptions surface;
    surface.as_surface = true;
    CHECK(equal(from_mesh(both, surface), boundary(solid)));
    // Turned inside out, the wedge is no part of a solid that the box could touch.
    CHECK_THROWS_AS(from_mesh(crossing), InputError);
  }
}

TEST_CASE("Polygons meet where the triangles that they are cut into meet") {
  const std::vector<std::vector<std::array<int, 2>>> bases{
      {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}},          // an L
      {{0, 0}, {2, 0}, {3, 1}, {2, 3}, {0, 2}},                  // convex
      {{0, 0}, {4, 0}, {4, 3}, {3, 3}, {2, 1}, {1, 3}, {0, 3}},  // a notch
      {{0, 0}, {2, 0}, {2, 2}, {0, 2}},
  };
  std::mt19937 random(20261121);
  const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
  std::size_t touching = 0;
  std::size_t crossing = 0;
  for (int round = 0; round < 300; ++round) {
    INFO("round " << round);
    Mesh mesh;
    const bool oblique = round % 3 == 0;
    for (int k = 0; k < 2; ++k) {
      add_prism(mesh, bases[static_cast<std::size_t>(below(4))], {below(4), below(4), below(4)}, 1 + below(3),
                static_cast<std::size_t>(below(3)), oblique);
    }
    const MeshSurface surface(mesh, {});
    Mesh cut;
    cut.vertices = mesh.vertices;
    for (const auto& t : surface.triangles) cut.push_face(t);
    std::vector<std::uint32_t> faces(mesh.face_count());
    std::iota(faces.begin(), faces.end(), 0U);
    const Contacts of_faces = contacts_of(mesh, faces);
    const Contacts of_triangles = contacts_of(cut, surface.face_of);
    CHECK(std::includes(of_faces.begin(), of_faces.end(), of_triangles.begin(), of_triangles.end()));
    // What lies on a cut through a face shares an edge with its triangles, but touches or crosses the face.
    for (const auto& contact : of_faces) {
      if (of_triangles.count(contact) > 0) continue;
      CHECK(shared_corners(surface, contact[0], contact[1]) >= 2);
    }
    for (const auto& contact : of_faces) {
      ++(static_cast<Kind>(contact[2]) == Kind::kTouching ? touching : crossing);
    }
  }
  CHECK(touching > 100);
  CHECK(crossing > 100);
}

TEST_CASE("A needle through one of two faces with two hundred corners is found") {
  std::vector<std::array<int, 2>> circle;
  // A convex polygon with integer corners: slopes in order.
  std::vector<std::array<int, 2>> steps;
  for (int x = 1; x <= 12; ++x) {
    for (int y = 0; y <= 12; ++y) {
      if (std::gcd(x, y) == 1) steps.push_back({x, y});
    }
  }
  std::sort(steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a[1] * b[0] < b[1] * a[0]; });
  std::array<int, 2> at{0, 0};
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (auto& step : steps) {
      circle.push_back(at);
      at = {at[0] + step[0], at[1] + step[1]};
      step = {-step[1], step[0]};
    }
  }
  REQUIRE(at == std::array{0, 0});
  REQUIRE(circle.size() > 200);
  Mesh mesh;
  add_prism(mesh, circle, {0, 0, 0}, 5, 2, false);
  CHECK(check_mesh(mesh).empty());
  add_box(mesh, {10, 300, 3}, {11, 301, 4});  // inside
  CHECK(check_mesh(mesh).empty());
  const auto last = static_cast<std::uint32_t>(circle.size() + 1);
  add_box(mesh, {10, 310, 4}, {11, 311, 6});  // through the top
  const auto crossings = of_kind(mesh, Kind::kSelfIntersection);
  CHECK(crossings.size() == 4);
  for (const MeshProblem& p : crossings) CHECK(p.faces[0] == last);
}

// The planes of wide rings run through the walls of the bore, so that each wall is asked against each ring.
TEST_CASE("A wall of a turned part that is bent through its flange is found") {
  constexpr std::uint32_t kSides = 800;
  constexpr std::array<test::ProfilePoint, 8> kFlange{
      {{5, -10}, {10, -10}, {10, 0}, {1000, 0}, {1000, 5}, {10, 5}, {10, 20}, {5, 20}}};
  Mesh mesh = test::turned_part(kFlange, kSides, 0);
  CHECK(check_mesh(mesh).empty());
  constexpr std::uint32_t kBent = 7 * kSides + 300;  // at the upper end of the bore
  for (std::size_t i = 0; i < 2; ++i) mesh.vertices[kBent][i] *= 10;
  const std::vector<MeshProblem> problems = check_mesh(mesh, {.max_per_kind = 1000});
  std::set<std::uint32_t> crossed;
  for (const MeshProblem& p : problems) {
    if (p.kind != Kind::kSelfIntersection) continue;
    // One of both has the vertex.
    for (const std::uint32_t f : p.faces) {
      const auto face = mesh.face(f);
      if (std::find(face.begin(), face.end(), kBent) == face.end()) crossed.insert(f);
    }
  }
  // It goes through both rings and the hub's walls, near its own side.
  for (const std::uint32_t ring : {1U, 2U, 4U, 5U}) {
    CHECK(std::any_of(crossed.begin(), crossed.end(), [&](std::uint32_t f) { return f / (2 * kSides) == ring; }));
  }
}

TEST_CASE("Real meshes: shuffled faces are the only trouble of cube-shuffled, sphere is clean") {
  const std::string folder = source_folder() + "/data/meshes/";
  CHECK(check_mesh(read_mesh(folder + "sphere.stl")).empty());
  CHECK(check_mesh(read_mesh(folder + "hole.off")).empty());
  const auto problems = check_mesh(read_mesh(folder + "cube-shuffled.off"));
  REQUIRE_FALSE(problems.empty());
  for (const MeshProblem& p : problems) CHECK(p.kind == Kind::kInconsistentOrientation);
}

TEST_CASE("The number of problems can be bounded") {
  Mesh mesh;
  for (int i = 0; i < 20; ++i) mesh.vertices.push_back({i, 0, 0});
  MeshCheckOptions options;
  options.max_per_kind = 3;
  CHECK(check_mesh(mesh, options).size() == 3);
}

}  // namespace
}  // namespace nef
