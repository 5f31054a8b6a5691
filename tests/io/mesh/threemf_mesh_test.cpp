// SPDX-License-Identifier: Apache-2.0
//
// 3MF: what is written is read again, components are placed exactly, and no file harms.
#include <catch2/catch.hpp>
#include <optional>

#include "nef/construct/construct.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/polyhedron_file.h"
#include "nef/io/zip_archive.h"
#include "nef/polyhedron.h"
#include "tests/support/temporary_folder.h"

namespace nef::test {
namespace {

constexpr const char* kTetrahedronModel =
    "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='0.1' y='0' z='0'/><vertex x='0' y='1e0' z='0'/>"
    "<vertex x='0' y='0' z='1'/></vertices><triangles><triangle v1='0' v2='2' v3='1'/><triangle v1='0' v2='1' v3='3'/>"
    "<triangle v1='1' v2='2' v3='3'/><triangle v1='2' v2='0' v3='3'/></triangles></mesh>";

Polyhedron tetrahedron() {
  const std::vector<Rational3> points{{0, 0, 0}, {Rational(1, 10), 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return convex_hull(points);
}

std::string model(const std::string& objects, const std::string& items, const std::string& more = "") {
  return "<model xmlns='http://schemas.microsoft.com/3dmanufacturing/core/2015/02' "
         "xmlns:p='http://schemas.microsoft.com/3dmanufacturing/production/2015/06' " +
         more + "><resources>" + objects + "</resources><build>" + items + "</build></model>";
}

std::string object(const std::string& id, const std::string& content, const std::string& more = "") {
  return "<object id='" + id + "' " + more + ">" + content + "</object>";
}

std::string archive(const std::string& text) { return zip_bytes({{"3D/3dmodel.model", text}}); }

Polyhedron read(const std::string& bytes) {
  const TemporaryFolder folder;
  return read_polyhedron(folder.write("a.3mf", bytes));
}

void check_refused(const std::string& bytes, const std::string& words) {
  const TemporaryFolder folder;
  try {
    read_mesh(folder.write("a.3mf", bytes));
    FAIL("was read, but: " << words);
  } catch (const FileError& error) {
    CHECK_THAT(error.what(), Catch::Contains(words));
  }
}

}  // namespace

TEST_CASE("3MF: what is written is read, doubles and all", "[threemf]") {
  const TemporaryFolder folder;
  const double third = 1.0 / 3;
  const Polyhedron set = closure(subtract(make_box({0, 0, 0}, {3, 3, Rational(1, 8)}), make_box({1, 1, 0}, {2, 2, 1})));
  write_polyhedron(folder.file("a.3mf"), set);
  CHECK(equal(read_polyhedron(folder.file("a.3mf")), set));
  CHECK(read_mesh(folder.file("a.3mf")).face_count() >= 32);
  // By its first bytes, without the extension.
  std::filesystem::rename(folder.file("a.3mf"), folder.file("a"));
  CHECK(equal(read_polyhedron(folder.file("a")), set));
  write_polyhedron(folder.file("b.3mf"), make_box({0, 0, 0}, {exact_rational(third), 1, 1}));
  CHECK(nearest_double((*bounding_box(read_polyhedron(folder.file("b.3mf"))))[1][0]) == third);
  write_polyhedron(folder.file("c.3mf"), make_box({0, 0, 0}, {exact_rational(third), 1, 1}));
  CHECK(slurp(folder.file("b.3mf")) == slurp(folder.file("c.3mf")));
  write_polyhedron(folder.file("empty.3mf"), Polyhedron());
  CHECK(read_polyhedron(folder.file("empty.3mf")).is_empty());
  PolyhedronWriteOptions exact;
  exact.exact = true;
  CHECK_THROWS_AS(write_polyhedron(folder.file("d.3mf"), set, exact), FileError);
}

TEST_CASE("3MF: lengths in other units become millimetres, exactly", "[threemf]") {
  for (const auto& [unit, factor] : {std::pair("micron", Rational(1, 1000)), std::pair("millimeter", Rational(1)),
                                     std::pair("centimeter", Rational(10)), std::pair("inch", Rational(127, 5)),
                                     std::pair("foot", Rational(1524, 5)), std::pair("meter", Rational(1000))}) {
    INFO(unit);
    const std::string text =
        model(object("1", kTetrahedronModel), "<item objectid='1' transform='1 0 0 0 1 0 0 0 1 2 0 0'/>",
              "unit='" + std::string(unit) + "'");
    const Polyhedron moved = transform(tetrahedron(), AffineMap::translate({2, 0, 0}));
    CHECK(equal(read(archive(text)), transform(moved, AffineMap::scale({factor, factor, factor}))));
  }
  check_refused(archive(model(object("1", kTetrahedronModel), "<item objectid='1'/>", "unit='furlong'")),
                "there is no unit 'furlong'; it must be micron, millimeter,");
}

TEST_CASE("3MF: components are placed exactly, mirrored ones flipped", "[threemf]") {
  const std::string tetrahedron_object = object("1", kTetrahedronModel);
  CHECK(equal(read(archive(model(tetrahedron_object, "<item objectid='1'/>"))), tetrahedron()));
  // Twice: moved by a component in a component, and mirrored and stretched in x by the build.
  const std::string nested =
      object("2", "<components><component objectid='1' transform='1 0 0 0 1 0 0 0 1 0.1 5 0'/></components>") +
      object("3", "<components><component objectid='2' transform='0 1 0 -1 0 0 0 0 1 0 0 7'/></components>");
  AffineMap move = AffineMap::translate({Rational(1, 10), 5, 0});
  AffineMap turn = AffineMap::identity();
  turn.linear = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};  // rows of the file are columns here
  turn.translation = {0, 0, 7};
  const AffineMap mirror = AffineMap::scale({-3, 1, 1});
  CHECK(equal(read(archive(model(tetrahedron_object + nested,
                                 "<item objectid='3'/><item objectid='1' transform='-3 0 0 0 1 0 0 0 1 0 0 0'/>"))),
              unite(transform(tetrahedron(), turn.after(move)), transform(tetrahedron(), mirror))));
  // Objects in another part of the archive; supports and what is not built do not count.
  const std::string root = model(object("1", kTetrahedronModel, "type='support'") +
                                     object("2",
                                            "<components><component p:path='/3D/other.model' objectid='1'/>"
                                            "<component objectid='1'/></components>") +
                                     object("9", kTetrahedronModel),
                                 "<item objectid='2'/>", "requiredextensions='p'");
  CHECK(equal(read(zip_bytes({{"3D/3dmodel.model", root}, {"3D/other.model", model(tetrahedron_object, "")}})),
              tetrahedron()));
  // The model is where the relationships say.
  CHECK(equal(read(zip_bytes({{"_rels/.rels",
                               "<Relationships><Relationship Id='r' Target='/x/y.model' "
                               "Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'/></Relationships>"},
                              {"x/y.model", model(tetrahedron_object, "<item objectid='1'/>")}})),
              tetrahedron()));
}

TEST_CASE("3MF: damaged and malicious files are refused", "[threemf]") {
  const std::string good = archive(model(object("1", kTetrahedronModel), "<item objectid='1'/>"));
  for (std::size_t size = 1; size < good.size(); size += 7) {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(read_mesh(folder.write("a.3mf", good.substr(0, size))), FileError);
  }
  // A byte changed is found by a checksum, or lies where nothing is said.
  const Mesh mesh = [&] {
    const TemporaryFolder folder;
    return read_mesh(folder.write("a.3mf", good));
  }();
  for (std::size_t i = 0; i < good.size(); i += 3) {
    std::string changed = good;
    changed[i] = static_cast<char>(changed[i] ^ 0x41);
    const TemporaryFolder folder;
    std::optional<Mesh> read;
    try {
      read = read_mesh(folder.write("a.3mf", changed));
    } catch (const FileError&) {
    }
    if (read) CHECK(read->vertices == mesh.vertices);
  }
  check_refused("PK\x03\x04 but nothing else", "not a zip archive");
  check_refused(zip_bytes({{"readme.txt", "hello"}}), "3D/3dmodel.model");
  check_refused(archive("<model><resources>"), "not valid XML");
  check_refused(archive("<!DOCTYPE model [<!ENTITY a \"aaaa\">]><model>&a;</model>"), "document type");
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = model(object("1", kTetrahedronModel), "<item objectid='1'/>");
    text.replace(text.find(from), from.size(), to);
    return archive(text);
  };
  check_refused(with("v3='1'", "v3='4'"), "names vertex 4");
  check_refused(with("v3='1'", "v3='-1'"), "not an index");
  check_refused(with("x='0.1'", "x='nan'"), "not a number");
  check_refused(with("x='0.1'", ""), "lacks the attribute 'x'");
  check_refused(with("item objectid='1'", "item objectid='7'"), "no object '7'");
  check_refused(archive(model(object("1", kTetrahedronModel), "<item objectid='1' transform='1 0 0'/>")), "3 numbers");
  check_refused(archive(model("", "", "requiredextensions='b' xmlns:b='urn:beams'")), "urn:beams");
  check_refused(
      archive(model(object("1", "<components><component objectid='1'/></components>"), "<item objectid='1'/>")),
      "nested too deeply");
}

TEST_CASE("3MF: an archive that takes too long is refused", "[threemf]") {
  const std::string bytes = zip_bytes({{"a", std::string(1 << 20U, 'a')}});
  std::size_t pieces = 0;
  const std::string path = "x.3mf";
  ZipArchive patient(bytes, path);
  patient.read("a", [&](std::string_view) { ++pieces; });
  CHECK(pieces > 2);
  ZipArchive impatient(bytes, path, 0);
  pieces = 0;
  const auto read = [&] { impatient.read("a", [&](std::string_view) { ++pieces; }); };
  CHECK_THROWS_WITH(read(), Catch::Contains("x.3mf: ") && Catch::Contains("more than 0 s"));
  CHECK(pieces == 0);
}

TEST_CASE("3MF: archives and components that explode are refused", "[threemf]") {
  check_refused(archive("<model>" + std::string(std::size_t{70} << 20U, ' ') + "</model>"), "suspiciously large");
  // An attribute that takes quadratic time.
  const std::string many(std::size_t{8} << 20U, '1');
  check_refused(archive(model(object("1", kTetrahedronModel, "name='" + many + "'"), "<item objectid='1'/>")),
                "more than 1 MiB");
  check_refused(archive("<model><!--" + many + "--></model>"), "more than 1 MiB");
  // Ten to the power of twenty tetrahedra.
  std::string objects = object("0", kTetrahedronModel);
  for (int i = 1; i <= 20; ++i) {
    std::string components;
    for (int k = 0; k < 10; ++k) components += "<component objectid='" + std::to_string(i - 1) + "'/>";
    objects += object(std::to_string(i), "<components>" + components + "</components>");
  }
  check_refused(archive(model(objects, "<item objectid='20'/>")), "more than a thousand copies");
}

}  // namespace nef::test
