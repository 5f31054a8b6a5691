// SPDX-License-Identifier: Apache-2.0
//
// Every kind of broken file gives one clear line that says what and where.
#include <catch2/catch.hpp>

#include <array>
#include <functional>
#include <sstream>

#include "nef/export/to_mesh.h"
#include "nef/io/cgal/cgal_nef3.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/native/native_format.h"
#include "nef/io/polyhedron_file.h"
#include "nef/validation/validate.h"
#include "tests/support/literals.h"
#include "tests/support/temporary_folder.h"

namespace nef {
namespace {

struct BadFile {
  const char* what;
  std::string name;
  std::string bytes;
  FileProblem problem;
  std::string where;  // must be in the message
};

std::string binary_stl(std::uint32_t promised, std::size_t bytes) {
  std::string result(80, 'x');
  for (int i = 0; i < 4; ++i) result += static_cast<char>((promised >> (8 * i)) & 0xffU);
  result.resize(84 + bytes, '\0');
  return result;
}

std::string ply(const std::string& faces) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n" +
         faces;
}

// A cube whose exterior is marked like what lies beyond an infimaximal box.
std::string cube_in_outside() {
  std::istringstream lines(native_text(test::set("box(0,0,0,1,1,1)")));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    // Lines of sfaces begin with their mark.
    if (line.rfind(" 0 ", 0) == 0) line[1] = '*';
    if (line.size() > 8 && line.substr(line.size() - 8) == " outer 0") line.back() = '*';
    text += line + "\n";
  }
  return text;
}

std::vector<BadFile> bad_files() {
  using P = FileProblem;
  const std::string v = "0 0 0\n1 0 0\n0 1 0\n";
  std::string nan_stl = binary_stl(1, 50);
  nan_stl.replace(84 + 12, 4, "\xff\xff\xff\x7f");
  return {
      {"no bytes", "a.off", "", P::kEmpty, "empty"},
      {"only white space", "a.obj", " \n\n", P::kEmpty, "empty"},
      {"no header", "a.off", "hello\n1 2 3\n", P::kSyntax, "a.off:1:"},
      {"four dimensions", "a.off", "4OFF\n1 0 0\n0 0 0 0\n", P::kUnsupported, "a.off:1:"},
      {"binary OFF", "a.off", "OFF BINARY\n", P::kUnsupported, "a.off:1:"},
      {"negative count", "a.off", "OFF\n-3 1 0\n" + v + "3 0 1 2\n", P::kWrongCount, "a.off:2:"},
      {"count is a word", "a.off", "OFF\nthree 1 0\n" + v, P::kSyntax, "a.off:2:"},
      {"too many vertices promised", "a.off", "OFF\n4 1 0\n" + v + "3 0 1 2\n", P::kSyntax, "a.off:6:"},
      {"far too many vertices promised", "a.off", "OFF\n9 1 0\n" + v + "3 0 1 2\n", P::kTruncated, "vertex 4"},
      {"too few vertices promised", "a.off", "OFF\n2 1 0\n" + v + "3 0 1 2\n", P::kSyntax, "a.off:5:"},
      {"too many faces promised", "a.off", "OFF\n3 2 0\n" + v + "3 0 1 2\n", P::kWrongCount, "announces 2"},
      {"too few faces promised", "a.off", "OFF\n3 1 0\n" + v + "3 0 1 2\n3 0 2 1\n", P::kWrongCount, "a.off:7:"},
      {"huge counts", "a.off", "OFF\n2000000000 2000000000 0\n" + v, P::kTruncated, "a.off:"},
      {"cut in a face", "a.off", "OFF\n3 1 0\n" + v + "3 0 1", P::kTruncated, "a.off:6:"},
      {"NaN", "a.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", P::kNotANumber, "a.off:4:"},
      {"infinity", "a.off", "OFF\n3 1 0\n0 0 0\n1 -inf 0\n0 1 0\n3 0 1 2\n", P::kNotANumber, "a.off:4:"},
      {"zero denominator", "a.off", "OFF\n3 1 0\n0 0 0\n1/0 0 0\n0 1 0\n3 0 1 2\n", P::kNotANumber, "1/0"},
      {"trailing characters", "a.off", "OFF\n3 1 0\n0 0 0\n1x 0 0\n0 1 0\n3 0 1 2\n", P::kNotANumber, "1x"},
      {"hostile exponent", "a.off", "OFF\n3 1 0\n0 0 0\n1e999999999 0 0\n0 1 0\n3 0 1 2\n", P::kNotANumber, "a.off:4:"},
      {"index too large", "a.off", "OFF\n3 1 0\n" + v + "3 0 1 3\n", P::kBadIndex, "a.off:6: face 0 names vertex 3"},
      {"negative index", "a.off", "OFF\n3 1 0\n" + v + "3 0 1 -1\n", P::kBadIndex, "a.off:6:"},
      {"face of two corners", "a.off", "OFF\n3 1 0\n" + v + "2 0 1\n", P::kSyntax, "a.off:6:"},
      {"OBJ index too large", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", P::kBadIndex, "a.obj:4:"},
      {"OBJ index zero", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", P::kBadIndex, "counts from 1"},
      {"OBJ negative too far", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", P::kBadIndex, "a.obj:4:"},
      {"OBJ two coordinates", "a.obj", "v 0 0\n", P::kTruncated, "a.obj:1:"},
      {"OBJ not a number", "a.obj", "v 0 0 NaN\n", P::kNotANumber, "a.obj:1:"},
      {"OBJ two corners", "a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", P::kSyntax, "a.obj:3:"},
      {"OBJ of something else", "a.obj", "\n<html>\n", P::kSyntax, "a.obj:2:"},
      {"STL cut in a facet", "a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", P::kTruncated, "a.stl:"},
      {"STL without end", "a.stl", "solid\n", P::kTruncated, "endsolid"},
      {"STL not a number", "a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n", P::kNotANumber,
       "a.stl:4:"},
      {"STL wrong word", "a.stl", "solid\nfacet normal 0 0 1\nouter ring\n", P::kSyntax, "a.stl:3:"},
      {"STL two corners", "a.stl",
       "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n", P::kSyntax,
       "a.stl:6:"},
      {"binary STL too short for a count", "a.stl", "binary", P::kTruncated, "byte 6"},
      {"binary STL truncated", "a.stl", binary_stl(3, 100), P::kTruncated, "announces 3 triangles"},
      {"binary STL cut in a triangle", "a.stl", binary_stl(2, 70), P::kTruncated, "byte 154"},
      {"binary STL too long", "a.stl", binary_stl(1, 100), P::kWrongCount, "announces 1"},
      {"binary STL with NaN", "a.stl", nan_stl, P::kNotANumber, "byte 100"},
      {"PLY without format", "a.ply", "ply\nelement vertex 0\nend_header\n", P::kSyntax, "format"},
      {"PLY header cut", "a.ply", "ply\nformat ascii 1.0\n", P::kTruncated, "end_header"},
      {"PLY bad type", "a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n", P::kSyntax,
       "a.ply:4:"},
      {"PLY without z", "a.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n", P::kSyntax,
       "x, y, z"},
      {"PLY index too large", "a.ply", ply("3 0 1 3\n"), P::kBadIndex, "names vertex 3"},
      {"PLY negative index", "a.ply", ply("3 0 1 -1\n"), P::kBadIndex, "a.ply:13:"},
      {"PLY cut", "a.ply", ply("3 0 1"), P::kTruncated, "a.ply:"},
      {"PLY too much", "a.ply", ply("3 0 1 2\n3 0 2 1\n"), P::kWrongCount, "more"},
      {"PLY two corners", "a.ply", ply("2 0 1\n"), P::kSyntax, "a.ply:13:"},
      {"binary PLY truncated", "a.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
       "property float z\nend_header\n" +
           std::string(20, '\0'),
       P::kTruncated, "byte"},
      {"nef of something else", "a.nef", "what 1\n", P::kSyntax, "a.nef:1:"},
      {"nef of the future", "a.nef", "nef 2\n", P::kUnsupported, "version 2"},
      {"nef truncated", "a.nef", "nef 1\nplanes 0 vertices 0 outer 0\n", P::kTruncated, "a.nef:"},
      {"nef with a zero normal", "a.nef", "nef 1\nplanes 1 vertices 0 outer 0\n0 0 0 1 0\nend\n", P::kSyntax, "normal"},
      {"nef with a word for a number", "a.nef", "nef 1\nplanes 1 vertices 0 outer 0\n1 0 nan 1 0\nend\n",
       P::kNotANumber, "a.nef:3:"},
      {"nef with nothing but an outside", "a.nef", "nef 1\nplanes 0 vertices 0 outer *\nend\n", P::kSyntax,
       "infimaximal box"},
      {"nef of a finite cube with an outside", "a.nef", cube_in_outside(), P::kSyntax, "infimaximal box"},
      {"nef of a point in an outside", "a.nef",
       "nef 1\nplanes 0 vertices 1 outer *\nvertex 0 0 0 1 0 0 0 1 0 0 0 1\n * 0\nend\n", P::kSyntax,
       "infimaximal box"},
      {"nef3 of an extended kernel", "a.nef3", "Selective Nef Complex\nextended\n", P::kUnsupported, "extended"},
      {"nef3 of something else", "a.nef3", "Selective Hearing\n", P::kSyntax, "a.nef3:1:"},
      {"nef3 truncated", "a.nef3", "Selective Nef Complex\nstandard\nvertices 8\nhalfedges 24\n", P::kTruncated,
       "a.nef3:"},
      {"unknown extension", "a.xyz", "1 2 3\n", P::kUnreadable, "format is unknown"},
  };
}

TEST_CASE("Malformed files are refused with their kind and place") {
  const test::TemporaryFolder folder;
  for (const BadFile& bad : bad_files()) {
    INFO(bad.what);
    const std::string path = folder.write(bad.name, bad.bytes);
    try {
      read_polyhedron(path);
      FAIL("was read");
    } catch (const FileError& error) {
      const std::string message = error.what();
      INFO(message);
      CHECK(std::string(name(error.problem())) == name(bad.problem));
      CHECK(message.find(bad.where) != std::string::npos);
      CHECK(message.find(bad.name) != std::string::npos);
      CHECK(message.find('\n') == std::string::npos);
    }
  }
}

TEST_CASE("A missing file and a folder are told apart") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_WITH(read_polyhedron(folder.file("nothing.off")), Catch::Contains("no such file"));
  CHECK_THROWS_WITH(read_polyhedron(folder.file("")), Catch::Contains("is a directory"));
}

TEST_CASE("Files cut anywhere are refused or mean the same") {
  const Polyhedron box = make_box({0, 0, 0}, {1, 2, Rational(1, 3)});
  const std::vector<std::pair<std::string, std::function<Polyhedron(std::string_view)>>> formats{
      {native_text(box), [](std::string_view text) { return read_native(text, "cut"); }},
      {nef3_text(box), [](std::string_view text) { return read_nef3(text, "cut"); }}};
  for (const auto& [text, read] : formats) {
    CHECK(equal(read(text), box));
    for (std::size_t length = 0; length + 1 < text.size(); length += 7) {
      try {
        const Polyhedron result = read(std::string_view(text).substr(0, length));
        CHECK(equal(result, box));
      } catch (const InputError& error) {
        CHECK(std::string(error.what()).find("cut:") == 0);
      }
    }
  }
}

TEST_CASE("Native and nef3 files with one digit changed are refused, or valid and equal to what is written of them") {
  const Polyhedron set = subtract(make_box({0, 0, 0}, {3, 3, 3}), make_box({1, 1, -1}, {2, 2, 2}));
  const std::string texts[] = {native_text(set), nef3_text(set)};
  std::size_t refused = 0;
  std::size_t accepted = 0;
  for (std::size_t which = 0; which < 2; ++which) {
    for (std::size_t i = 0; i < texts[which].size(); ++i) {
      std::string text = texts[which];
      const bool is_nothing = text[i] == '-' && text[i + 1] == ' ';  // in place of an index
      if (!is_nothing && (text[i] < '0' || text[i] > '9' || i % 3 != 0)) continue;
      text[i] = is_nothing || text[i] == '9' ? '0' : static_cast<char>(text[i] + 1);
      try {
        const Polyhedron result = which == 0 ? read_native(text, "bent") : read_nef3(text, "bent");
        CHECK(validate(result.complex()).empty());
        CHECK(equal(result, read_native(native_text(result), "text")));
        ++accepted;
      } catch (const InputError& error) {
        CHECK(std::string(error.what()).find("bent:") == 0);
        ++refused;
      }
    }
  }
  // Most digits are indices or coordinates that must fit to others; links that we synthesize anew are not read.
  CHECK(refused > 200);
  CHECK(accepted > 0);
}

// A small xorshift: the same files everywhere.
struct Dice {
  std::uint64_t state = 88172645463325252U;
  std::size_t below(std::size_t n) {
    state ^= state << 13U;
    state ^= state >> 7U;
    state ^= state << 17U;
    return state % n;
  }
};

std::string damaged(std::string bytes, Dice& dice) {
  const std::array<const char*, 12> words{"nan", "1e400", "-1",    "4294967296",  "1/0", "1/3",
                                          "",    "\n",    "99999", "-2147483648", "e",   "#"};
  for (std::size_t changes = 1 + dice.below(3); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = dice.below(bytes.size());
    switch (dice.below(5)) {
      case 0:
        bytes[at] = static_cast<char>(dice.below(256));
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.erase(at, dice.below(20));
        break;
      case 3:
        bytes.insert(at, bytes.substr(dice.below(bytes.size()), dice.below(40)));
        break;
      default:
        bytes.replace(at, 1, words[dice.below(words.size())]);
    }
  }
  return bytes;
}

TEST_CASE("Mesh files with anything changed are refused in one line or give valid sets") {
  const Polyhedron set = subtract(make_box({0, 0, 0}, {3, 3, 3}), make_box({1, 1, -1}, {2, 2, 2}));
  MeshExportOptions polygons;
  polygons.keep_polygons = true;
  const Mesh mesh = to_mesh(set, polygons).mesh;
  MeshWriteOptions binary;
  binary.binary = true;
  using Read = Mesh (*)(std::string_view, const std::string&);
  const Read read_whole_obj = [](std::string_view bytes, const std::string& path) { return read_obj(bytes, path); };
  const std::vector<std::pair<std::string, Read>> formats{
      {off_bytes(mesh), read_off},         {obj_bytes(mesh), read_whole_obj}, {stl_bytes(mesh), read_stl},
      {stl_bytes(mesh, binary), read_stl}, {ply_bytes(mesh), read_ply},       {ply_bytes(mesh, binary), read_ply}};
  Dice dice;
  std::size_t read = 0;
  for (const auto& [bytes, reader] : formats) {
    for (int i = 0; i < 600; ++i) {
      const std::string text = damaged(bytes, dice);
      MeshOptions options;
      options.as_surface = dice.below(3) == 0;
      INFO(text);
      try {
        const Mesh back = reader(text, "bent");
        ++read;
        const std::string broken = validate(from_mesh(back, options).complex());
        CHECK(broken.empty());
      } catch (const InputError& error) {
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
      }
    }
  }
  CHECK(read > 100);
}

TEST_CASE("A text that is nothing but white space is no STL") {
  CHECK_THROWS_AS(read_stl("", "a.stl"), FileError);
  CHECK_THROWS_AS(read_stl(" \n", "a.stl"), FileError);
}

TEST_CASE("Closed meshes only become solids, errors name the file") {
  const test::TemporaryFolder folder;
  const std::string open = folder.write("open.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  CHECK_THROWS_WITH(read_polyhedron(open), Catch::Contains("open.off"));
  MeshOptions surface;
  surface.as_surface = true;
  CHECK(equal(read_polyhedron(open, surface),
              make_polygon(std::vector<std::vector<Rational3>>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}})));
}

}  // namespace
}  // namespace nef
