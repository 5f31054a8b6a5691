// SPDX-License-Identifier: Apache-2.0
#include "fuzz/formats.h"

#include <array>

#include "apps/planner/scene/scene.h"
#include "apps/visual_hull/formats/scene_json.h"
#include "apps/visual_hull/formats/scene_text.h"
#include "apps/visual_hull/formats/vsh.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/io/cgal/cgal_nef3.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/native/native_binary.h"
#include "nef/io/native/native_format.h"
#include "nef/mesh/mesh_check.h"
#include "nef/program/expression/expression.h"

namespace nef::fuzz {
namespace {

void require(bool condition, const std::string& complaint) { Case::require(condition, complaint); }

Polyhedron valid(Polyhedron set, const std::string& what) {
  const std::string broken = validate(set.complex());
  require(broken.empty(), "validate: " + broken + " after " + what);
  return set;
}

void check_set(const Polyhedron& read) {
  const Polyhedron set = valid(read, "reading");
  require(equal(set, set), "equality: a set that was read is not equal to itself");
  // A file may hold any labels; complements know two.
  const Polyhedron plain = overlay(set, Polyhedron(), [](LabelId a, LabelId) { return static_cast<LabelId>(a != 0); });
  require(equal(valid(complement(valid(complement(set), "complement")), "complement"), valid(plain, "overlay")),
          "complement: twice gives another set");
  require(equal(read_native(native_text(set), "text"), set), "native: another set comes back from text");
  require(equal(read_native(native_binary(set), "bytes"), set), "native: another set comes back from bytes");
  const Polyhedron box = make_box({0, 0, 0}, {1, 2, 3});
  const Polyhedron both = valid(unite(set, box), "union with a box");
  require(equal(intersect(both, box), box), "union: with a box does not hold the box");
  static_cast<void>(volume(set));
}

void check_mesh_file(const Mesh& mesh) {
  for (const MeshProblem& problem : check_mesh(mesh)) {
    require(problem.text.find('\n') == std::string::npos, "message: of several lines");
  }
  MeshOptions surface;
  surface.as_surface = true;
  check_set(from_mesh(mesh, surface));
  check_set(from_mesh(mesh));
}

// Mesh formats hold bounded solids.
Mesh solid_mesh(const Polyhedron& set) { return to_mesh(unite(regularize(set), make_box({0, 0, 0}, {1, 1, 1}))).mesh; }

template <std::string (*kBytes)(const Mesh&, const MeshWriteOptions&), bool kBinary>
std::string mesh_bytes(const Polyhedron& set, const std::string& /*text*/) {
  MeshWriteOptions options;
  options.binary = kBinary;
  return kBytes(solid_mesh(set), options);
}

template <Mesh (*kRead)(std::string_view, const std::string&)>
void read_mesh_bytes(const std::string& text) {
  check_mesh_file(kRead(text, "file"));
}

std::string planner_scene(const Polyhedron& /*set*/, const std::string& text) {
  return R"J({ "robot": "box(0,0,0,1,1,1)", "obstacles": [")J" + text +
         R"J(", "segment(0,0,0, 1,2,3)"], "reference": [0.5, "1/3", 0], "box": [[-9,-9,-9], [9,9,9]],
  "start": [-3, 0, 1e-1], "goal": [5, 5, 5], "contact": "allow" })J";
}

void read_planner_scene(const std::string& text) {
  const planner::Scene scene = planner::parse_scene(text, "/nonexistent", "scene.json");
  check_set(scene.robot);
  for (const Polyhedron& obstacle : scene.obstacles) check_set(obstacle);
}

std::string hull_scene(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return R"({"cameras": [
  {"name": "front", "P": [[1,0,0,0],[0,1,0,0],[0,0,1,5]], "polygons": [[[-0.5,-0.5],[0.5,-0.5],[0.5,0.5]]]},
  {"name": "side", "K": [[2,0,0],[0,2,0],[0,0,1]], "R": [[0,1,0],[0,0,1],[1,0,0]], "t": [0,0,7],
   "polygons": [[[-1,-1],[1,-1],[1,1],[-1,1]],[[0,0],[0.25,0],[0,0.25]]]}],
 "box": [-4,-4,-4,4,4,4], "threshold": 127, "channel": "red", "invert": true})";
}

std::string vsh_scene(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return "-4 -4 -4 4 4 4\n2\n0 0 -9 1\n4 -1 -1 -5 1 -1 -5 1 1 -5 -1 1 -5\n-9 0 0 2\n3 -5 -1 -1 -5 1 -1 -5 0 1\n"
         "3 -5 2 2 -5 3 2 -5 2 3\n";
}

std::string matrix_scene(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return "# cameras\nfront.png 1 0 0 0 0 1 0 0 0 0 1 5\nside.png 0 2 0 0 0 0 2 0 1 0 0 7\n";
}

std::string middlebury_scene(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return "2\na.png 1 0 0 0 1 0 0 0 1 1 0 0 0 1 0 0 0 1 0 0 5\nb.png 2 0 0 0 2 0 0 0 1 0 1 0 0 0 1 1 0 0 0 0 7\n";
}

std::string expression(const Polyhedron& /*set*/, const std::string& text) {
  return "union(" + text +
         ", rotate(box(0,0,0,1,1,1), z, 30), hull(0,0,0,1,0,0,0,1,0,0,0,1)) ^ !halfspace(1,2,-1/3,1e-1) * "
         "closure(transform(polygon((0,0,0),(3,0,0),(0,3,0);(1/2,1/2,0),(1,1/2,0),(1/2,1,0)), "
         "1,0,0,0,0,1,0,0,0,0,1,2))";
}

constexpr std::array kFormats{
    Format{"off", mesh_bytes<off_bytes, false>, read_mesh_bytes<read_off>},
    Format{"obj", mesh_bytes<obj_bytes, false>, read_mesh_bytes<read_obj>},
    Format{"stl", mesh_bytes<stl_bytes, false>, read_mesh_bytes<read_stl>},
    Format{"binary-stl", mesh_bytes<stl_bytes, true>, read_mesh_bytes<read_stl>},
    Format{"ply", mesh_bytes<ply_bytes, false>, read_mesh_bytes<read_ply>},
    Format{"binary-ply", mesh_bytes<ply_bytes, true>, read_mesh_bytes<read_ply>},
    Format{"nef", [](const Polyhedron& set, const std::string& /*text*/) { return native_text(set); },
           [](const std::string& text) { check_set(read_native(text, "file")); }},
    Format{"binary-nef",
           [](const Polyhedron& set, const std::string& /*text*/) {
             return native_binary(symmetric_difference(set, make_halfspace(1, 1, 0, -2, false)));
           },
           [](const std::string& text) { check_set(read_native(text, "file")); }},
    Format{"unbounded-nef",
           [](const Polyhedron& set, const std::string& /*text*/) {
             return native_text(symmetric_difference(set, make_halfspace(1, 1, 0, -2, false)));
           },
           [](const std::string& text) { check_set(read_native(text, "file")); }},
    Format{"nef3", [](const Polyhedron& set, const std::string& /*text*/) { return nef3_text(set); },
           [](const std::string& text) { check_set(read_nef3(text, "file")); }},
    Format{"expression", expression, [](const std::string& text) { check_set(evaluate_expression(text)); }},
    Format{"planner-scene", planner_scene, read_planner_scene},
    Format{"hull-scene", hull_scene,
           [](const std::string& text) {
             static_cast<void>(visual_hull::read_json_scene(text, "/nonexistent/scene.json"));
           }},
    Format{"vsh", vsh_scene,
           [](const std::string& text) { static_cast<void>(visual_hull::read_vsh(text, "/nonexistent/scene.vsh")); }},
    Format{"matrices", matrix_scene,
           [](const std::string& text) {
             static_cast<void>(visual_hull::read_text_scene(text, "/nonexistent/scene.txt"));
           }},
    Format{"middlebury", middlebury_scene,
           [](const std::string& text) {
             static_cast<void>(visual_hull::read_text_scene(text, "/nonexistent/scene.txt"));
           }},
};

}  // namespace

std::span<const Format> formats() { return kFormats; }

}  // namespace nef::fuzz
