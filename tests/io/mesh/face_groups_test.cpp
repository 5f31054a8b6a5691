// SPDX-License-Identifier: Apache-2.0
//
// Which input each face comes from, through labels, meshes and files.
#include "nef/io/mesh/face_groups.h"

#include <catch2/catch.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>

#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/formats/glb_mesh.h"
#include "nef/io/mesh/mend_rounded.h"
#include "nef/io/polyhedron_file.h"
#include "nef/operation/label_inputs.h"
#include "tests/support/shapes/ball.h"
#include "tests/support/temporary_folder.h"

namespace nef::test {
namespace {

Rational3 middle(const Mesh& mesh, std::size_t f) {
  Rational3 sum;
  for (const std::uint32_t v : mesh.face(f)) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] += mesh.vertices[v][i];
  }
  for (Rational& x : sum) x /= static_cast<unsigned>(mesh.face(f).size());
  return sum;
}

std::string letters(const InputSet& inputs) {
  std::string text;
  for (const std::uint32_t i : inputs) text += static_cast<char>('a' + i);
  return text;
}

// The union of some sets, in groups that name them a, b, c, ...
struct LabeledUnion {
  explicit LabeledUnion(const std::vector<Polyhedron>& sets) : labeled(label_inputs(sets)) {
    groups.selected = [this](LabelId mark) { return mark < labeled.labels().size() && !labeled.label(mark).empty(); };
    groups.name = [this](LabelId inside, LabelId outside, LabelId) {
      return letters(origins(labeled.label(inside), labeled.label(outside)));
    };
  }
  LabeledPolyhedron<InputSet> labeled;
  BoundaryGroups groups;
};

// The chunk of JSON in a GLB file.
nlohmann::json glb_json(const std::string& bytes) {
  const auto length = static_cast<unsigned char>(bytes[12]) + 256U * static_cast<unsigned char>(bytes[13]) +
                      65536U * static_cast<unsigned char>(bytes[14]);
  return nlohmann::json::parse(bytes.substr(20, length));
}

}  // namespace

TEST_CASE("a face lies on the boundary of the inputs that it is said to come from, and of no others") {
  std::mt19937 random(11);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::set<std::size_t> sizes;
  for (int round = 0; round < 12; ++round) {
    std::vector<Polyhedron> sets;
    for (int i = 0; i < 5; ++i) {
      const Rational3 low{below(5), below(5), below(5)};
      sets.push_back(make_box(low, {low[0] + 1 + below(3), low[1] + 1 + below(3), low[2] + 1 + below(3)}));
    }
    const LabeledPolyhedron<InputSet> labeled = label_inputs(sets, Monitor().on_threads(2));
    CHECK(validate(labeled.polyhedron().complex()).empty());
    CHECK(equal(labeled.where([](const InputSet& s) { return !s.empty(); }), unite_all(sets)));
    CHECK(equal(labeled.where([](const InputSet& s) { return s == InputSet{0}; }),
                subtract(sets[0], unite_all(std::vector<Polyhedron>(sets.begin() + 1, sets.end())))));
    MeshExportOptions options;
    options.face_marks = true;
    options.keep_polygons = options.only_quads = round % 2 == 0;
    // The union, and the points in exactly one set.
    for (const std::size_t most : {std::size_t{5}, std::size_t{1}}) {
      options.selected = [&](LabelId mark) {
        const std::size_t count = labeled.label(mark).size();
        return count >= 1 && count <= most;
      };
      const MeshExport result = to_mesh(labeled.polyhedron(), options);
      REQUIRE(result.face_marks.size() == result.mesh.face_count());
      for (std::size_t f = 0; f < result.mesh.face_count(); ++f) {
        const auto [inside, outside, facet] = result.face_marks[f];
        CHECK(options.selected(inside));
        CHECK_FALSE(options.selected(outside));
        InputSet expected;
        const Rational3 point = middle(result.mesh, f);
        for (std::uint32_t i = 0; i < sets.size(); ++i) {
          if (locate(sets[i], point).kind != Location::Kind::kVolume) expected.push_back(i);
        }
        CHECK(origins(labeled.label(inside), labeled.label(outside)) == expected);
        sizes.insert(expected.size());
      }
    }
  }
  CHECK(sizes.size() >= 3);  // faces of one, two and three inputs have been met
}

TEST_CASE("no inputs, one, and the same one twice") {
  CHECK(label_inputs({}).at({0, 0, 0}).empty());
  const std::vector<Polyhedron> one{make_box({0, 0, 0}, {1, 1, 1})};
  CHECK(label_inputs(one).at({1, 1, 1}) == InputSet{0});
  CHECK(label_inputs(one).at({2, 1, 1}).empty());
  const std::vector<Polyhedron> twice{one[0], one[0]};
  CHECK(label_inputs(twice).at({1, 0, 1}) == InputSet{0, 1});
  CHECK(label_inputs(twice).polyhedron().complex().volume_count() == 2);
}

TEST_CASE("groups in every format: names, colours, and meshes that can be read") {
  const TemporaryFolder folder;
  const LabeledUnion united({make_box({0, 0, 0}, {2, 2, 2}), make_box({1, 1, 1}, {3, 3, 2})});
  const Polyhedron expected = unite(make_box({0, 0, 0}, {2, 2, 2}), make_box({1, 1, 1}, {3, 3, 2}));
  const auto write = [&](const std::string& name, bool binary = false) {
    PolyhedronWriteOptions options;
    options.binary = binary;
    Messages notes;
    auto counts = write_groups(folder.file(name), united.labeled.polyhedron(), united.groups, options, &notes);
    CHECK(notes.empty());
    CHECK(equal(read_polyhedron(folder.file(name)), expected));
    CHECK(counts.size() == 3);
    return counts;
  };
  SECTION("OBJ") {
    const auto counts = write("a.obj");
    std::istringstream text(slurp(folder.file("a.obj")));
    std::map<std::string, std::size_t> found;
    std::string line;
    std::string group = "none";
    while (std::getline(text, line)) {
      if (line.starts_with("g ")) group = line.substr(2);
      if (line.starts_with("f ")) ++found[group];
    }
    CHECK(found == counts);
    CHECK(found.at("ab") >= 1);
  }
  SECTION("PLY, as text and in binary") {
    for (const bool binary : {false, true}) {
      write("a.ply", binary);
      const std::string text = slurp(folder.file("a.ply"));
      CHECK(text.find("comment group 0 a\ncomment group 1 ab\ncomment group 2 b\n") != std::string::npos);
      CHECK(text.find("property uchar red") != std::string::npos);
    }
  }
  SECTION("OFF: three colours") {
    write("a.off");
    std::istringstream text(slurp(folder.file("a.off")));
    std::string line;
    std::getline(text, line);
    std::size_t vertices = 0;
    std::size_t faces = 0;
    text >> vertices >> faces >> line;
    for (std::size_t v = 0; v <= vertices; ++v) std::getline(text, line);
    std::set<std::string> colors;
    for (std::size_t f = 0; f < faces; ++f) {
      std::size_t corners = 0;
      text >> corners;
      for (std::size_t i = 0; i < corners; ++i) text >> line;
      std::getline(text, line);
      colors.insert(line);
    }
    CHECK(colors.size() == 3);
  }
  SECTION("GLB: a primitive and a material for each") {
    const auto counts = write("a.glb");
    const nlohmann::json json = glb_json(slurp(folder.file("a.glb")));
    std::map<std::string, std::size_t> found;
    for (const auto& primitive : json["meshes"][0]["primitives"]) {
      found[json["materials"].at(primitive["material"].get<std::size_t>())["name"]] =
          json["accessors"].at(primitive["indices"].get<std::size_t>())["count"].get<std::size_t>() / 3;
    }
    CHECK(found == counts);
  }
  SECTION("STL has none") {
    Messages notes;
    write_groups(folder.file("a.stl"), united.labeled.polyhedron(), united.groups, {}, &notes);
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("OBJ") != std::string::npos);
    CHECK_THROWS_AS(write_groups(folder.file("a.nef"), united.labeled.polyhedron(), united.groups), FileError);
  }
}

TEST_CASE("faces of a mended mesh lie where the faces do that they come from") {
  std::size_t mended = 0;
  for (const int angle : {13, 39, 52, 78}) {
    const Polyhedron a = ball(6, 12, 8);
    const Polyhedron b = transform(a, AffineMap::rotate({1, 2, 5}, angle));
    const Mesh exact = to_mesh(symmetric_difference(a, b)).mesh;
    const MendedMesh rounded = round_mesh(exact, rounding_to(FileNumbers::kFloats));
    if (rounded.face_of.empty()) continue;
    REQUIRE(rounded.face_of.size() == rounded.mesh.face_count());
    ++mended;
    for (std::size_t f = 0; f < rounded.mesh.face_count(); ++f) {
      const auto from = exact.face(rounded.face_of[f]);
      Rational3 low = exact.vertices[from[0]];
      Rational3 high = low;
      for (const std::uint32_t v : from) {
        for (std::size_t i = 0; i < 3; ++i) {
          low[i] = std::min(low[i], exact.vertices[v][i]);
          high[i] = std::max(high[i], exact.vertices[v][i]);
        }
      }
      const Rational3 point = middle(rounded.mesh, f);
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(point[i] >= low[i] - Rational(1, 1000));
        CHECK(point[i] <= high[i] + Rational(1, 1000));
      }
    }
  }
  CHECK(mended > 0);
}

TEST_CASE("names of groups are single words, and colours differ") {
  CHECK(group_word("left wheel\n") == "left_wheel_");
  CHECK(group_word("") == "_");
  CHECK(group_word("a#b") == "a_b");
  std::set<std::array<std::uint8_t, 3>> colors;
  for (std::size_t g = 0; g < 100; ++g) colors.insert(group_color(g));
  CHECK(colors.size() >= 98);
}

}  // namespace nef::test
