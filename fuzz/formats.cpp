// SPDX-License-Identifier: Apache-2.0
#include "fuzz/formats.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/planner/linkage/linkage_path.h"
#include "apps/planner/linkage_urdf/urdf_robot.h"
#include "apps/planner/path/path_file.h"
#include "apps/planner/proofs/inseparable_proof.h"
#include "apps/planner/proofs/proof_file.h"
#include "apps/planner/rigid/pose_file.h"
#include "apps/planner/scene/scene.h"
#include "apps/program/expression/expression.h"
#include "apps/program/expression/openscad.h"
#include "apps/visual_hull/formats/colmap.h"
#include "apps/visual_hull/formats/matlab.h"
#include "apps/visual_hull/formats/opencv_storage.h"
#include "apps/visual_hull/formats/scene_blocks.h"
#include "apps/visual_hull/formats/scene_json.h"
#include "apps/visual_hull/formats/scene_text.h"
#include "apps/visual_hull/formats/vsh.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/io/cgal/cgal_nef3.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/native/native_binary.h"
#include "nef/io/native/native_format.h"
#include "nef/mesh/mesh_check.h"
#include "tests/support/temporary_folder.h"

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

// A format of the table of mesh formats, in one of its forms.
Format mesh_format(const MeshFormat& format, bool binary) {
  return {(binary && format.has_two_forms() ? "binary-" : "") + std::string(format.extension),
          [&format, binary](const Polyhedron& set, const std::string& /*text*/) {
            MeshWriteOptions options;
            options.binary = binary;
            return format.write(solid_mesh(set), options);
          },
          [&format](const std::string& bytes) {
            MeshParts parts;
            check_mesh_file(format.read(bytes, "file", &parts));
          }};
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

std::string opencv_yaml(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return "%YAML:1.0\n---\nimage_width: 200\ncamera_matrix: [[100., 0., 99.5], [0., 100., 49.5], [0., 0., 1.]]\n"
         "dist_coeffs: [0.1, 0., 0., 0.]\nR0: [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.]]\nt0: [0., 0., 5.]\n"
         "rvec1: [0., 1., 0.]\ntvec1: [0., 0., 5.]\n"
         "P2: !!opencv-matrix\n   rows: 3\n   cols: 4\n   dt: d\n   data: [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., "
         "5.]\n";
}

std::string opencv_xml(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return "<?xml version=\"1.0\"?>\n<opencv_storage>\n<P0 type_id=\"opencv-matrix\">\n  <rows>3</rows>\n  "
         "<cols>4</cols>\n  <dt>d</dt>\n  <data>1. 0. 0. 0. 0. 1. 0. 0. 0. 0. 1. 5.</data></P0>\n<views><_><name>a"
         "</name><K>1. 0. 0. 0. 1. 0. 0. 0. 1.</K></_></views>\n</opencv_storage>\n";
}

std::string parameter_blocks(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return "#Intrinsic parameter\n2 0 10\n0 3 20\n0 0 1\n\n#Extrinsic parameter for a.bmp\n1 0 0 0.5\n0 1 0 0\n0 0 1 4\n"
         "# extrinsic\n\n1 0 0 1\n0 1 0 2\n0 0 1 3\n";
}

std::string transforms_scene(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return R"({"camera_model": "OPENCV", "fl_x": 100, "cx": 100, "cy": 50, "w": 200, "h": 100, "k1": 0.1, "frames": [
  {"file_path": "images/a", "transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,5],[0,0,0,1]]},
  {"file_path": "b.png", "fl_x": 90, "transform_matrix": [[1,0,0,0],[0,0,1,0],[0,-1,0,5],[0,0,0,1]]}]})";
}

// The files of a model, one after the other.
constexpr std::string_view kNextFile = "-- images --\n";

std::string colmap_model(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return "# cameras\n1 PINHOLE 200 100 100 100 100 50\n2 OPENCV 200 100 100 100 100 50 0.1 0 0 0\n" +
         std::string(kNextFile) + "1 1 0 0 0 0 0 5 1 a.png\n1 2 3\n2 0 1 0 0 0 0 5 2 b.png\n\n";
}

void read_colmap_model(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::size_t end = std::min(text.find(kNextFile), text.size());
  write_file(folder.file("cameras.txt"), text.substr(0, end));
  write_file(folder.file("images.txt"), text.substr(std::min(end + kNextFile.size(), text.size())));
  static_cast<void>(nef::visual_hull::read_colmap(folder.file("")));
}

void append(std::string& bytes, std::uint32_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 255U);
}

// An element of a MATLAB file: type, size, bytes, padded to eight.
std::string mat_element(std::uint32_t type, const std::string& data) {
  std::string bytes;
  append(bytes, type);
  append(bytes, static_cast<std::uint32_t>(data.size()));
  return bytes + data + std::string((8 - data.size() % 8) % 8, '\0');
}

std::string matlab_file(const Polyhedron& /*set*/, const std::string& /*text*/) {
  std::string bytes = "MATLAB 5.0 MAT-file, by hand";
  bytes.append(124 - bytes.size(), ' ');
  append(bytes, 0x4d490100);
  std::string flags;
  append(flags, 6);  // doubles
  append(flags, 0);
  std::string sizes;
  append(sizes, 3);
  append(sizes, 4);
  return bytes + mat_element(14, mat_element(6, flags) + mat_element(5, sizes) + mat_element(1, "P") +
                                     mat_element(9, std::string(96, '\x3f')));
}

std::string expression(const Polyhedron& /*set*/, const std::string& text) {
  return "union(" + text +
         ", rotate(box(0,0,0,1,1,1), z, 30), hull(0,0,0,1,0,0,0,1,0,0,0,1)) ^ !halfspace(1,2,-1/3,1e-1) * "
         "closure(transform(polygon((0,0,0),(3,0,0),(0,3,0);(1/2,1/2,0),(1,1/2,0),(1/2,1,0)), "
         "1,0,0,0,0,1,0,0,0,0,1,2))";
}

std::string openscad_model(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return R"(group() { // all objects
 multmatrix([[1, 0, 0, 0.5], [0, 1, 0, 0], [0, 0, 1, -1e0], [0, 0, 0, 1]]) {
  difference() { cube(size = [2, 3, 1], center = true); cylinder($fn = 5, $fa = 12, $fs = 2, h = 4, r1 = 1, r2 = 0.5); }
 }
 color([1, 0, 0, 1]) { intersection() { sphere($fn = 6, r = 2); cube(size = 1); } }
 hull() { polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
   faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]], convexity = 1); cube(size = [1, 1, 1]); }
 linear_extrude(height = 2, center = true, slices = 1, $fn = 0) { union() { square(size = [2, 1], center = false);
   circle($fn = 5, r = 1); polygon(points = [[0, 0], [3, 0], [0, 3]], paths = [[0, 1, 2]]); } }
 rotate_extrude(angle = 90, $fn = 8) { multmatrix([[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { square(size = 1); } }
 %render(convexity = 2) { /* left out */ cube(size = undef); }
})";
}

void read_openscad_model(const std::string& text) {
  ExpressionOptions options;
  options.load = [](const std::string&, const Monitor&) { return make_box({0, 0, 0}, {1, 1, 1}); };
  check_set(evaluate_openscad(text, options));
}

std::string ompl_problem(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return "[problem]\nname = a\nrobot = cube.nef\nworld = cube.nef\nrobot.origin = mesh # or vertex-mean\n"
         "start.x = 2\nstart.y = -1.5\nstart.z = 1e1\nstart.theta = 0.5\nstart.axis.x = 1\nstart.axis.y = 0\n"
         "start.axis.z = 0\ngoal.x = 7\ngoal.y = 1.5\ngoal.z = -1/2\ngoal.theta = 0.5\ngoal.axis.x = 1\n"
         "goal.axis.y = 0\ngoal.axis.z = 0\nvolume.min.x = 0\nvolume.min.y = -8\nvolume.min.z = -8\n"
         "volume.max.x = 9\nvolume.max.y = 8\nvolume.max.z = 12\n\n[planner]\nrrtconnect=\n";
}

// The meshes that it names lie beside it.
void read_ompl_problem(const std::string& text) {
  const test::TemporaryFolder folder;
  write_file(folder.file("cube.nef"), native_binary(make_box({0, 0, 0}, {1, 1, 1})));
  write_file(folder.file("problem.cfg"), text);
  const planner::Scene scene = planner::read_scene(folder.file("problem.cfg"));
  check_set(scene.robot);
  for (const Polyhedron& obstacle : scene.obstacles) check_set(obstacle);
}

std::string waypoints(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return R"({"path": [[0, 0, 0], ["1/3", 0.5, 1e1], [-1, 2, 3]], "status": "path"})";
}

void read_waypoints_file(const std::string& text) {
  const test::TemporaryFolder folder;
  write_file(folder.file("path.json"), text);
  static_cast<void>(planner::read_path(folder.file("path.json")));
}

std::string rigid_path(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return R"({"path": [{"position": [0, "1/3", 0.5], "quaternion": [1, 1, 0, 0]},
  {"position": [1e1, 0, 0], "quaternion": [1, 0, 0.5, "-2"]}]})";
}

std::string path_lines(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return "0 0 0 0 0 0 1\n\n1/3 0.5, 1e1 0 -2 0.5 1\r\n-1,2,3 0 0 0 1\n";
}

void read_path_lines(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::string file = folder.file("path.txt");
  write_file(file, text);
  static_cast<void>(planner::read_path(file));
}

std::string joint_path(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return R"({"path": [[0, "1/3", 0.5], [1e1, -2, 3]], "status": "path"})";
}

std::string joint_lines(const Polyhedron& /*set*/, const std::string& /*text*/) { return "0 1/3 0.5\n\n1e1, -2 3\r\n"; }

void read_joints(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::string file = folder.file("joints.txt");
  write_file(file, text);
  static_cast<void>(planner::read_joint_path(file, {"slew", "luff", "reach"}));
}

std::string urdf_robot(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="base"><collision><origin xyz="0 0 -.5" rpy="0 0 .25"/><geometry><box size="4 4 1"/></geometry></collision></link>
  <link name="lower"/>
  <link name="upper"><collision><geometry><box size="1 .5 .25"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="lower"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="lower"/><child link="upper"/><origin xyz="1 0 1e-1"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/></joint>
</robot>)";
}

void read_urdf_robot(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::string file = folder.file("robot.urdf");
  write_file(file, text);
  if (planner::reads_urdf()) static_cast<void>(planner::read_urdf(file));
}

std::string proof_of_path(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return R"({"claim": {"box": [["-9", "-9", "-9"], ["9", "9", "9"]], "contact": "allow",
  "obstacles": [[["-3", "3/2", "-3"], ["3", "3", "-3"], ["3", "3", "3"]]],
  "path": [{"position": ["0", "0", "0"], "quaternion": ["1", "0", "0", "0"]},
           {"position": ["0", "1/2", "0"], "quaternion": ["3", "0", "0", "1"]}],
  "robot": [[["0", "0", "0"], ["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]], "status": "path"}, "nef_proof": 1,
  "witness": {"motions": [[{"planes": [], "until": "1/2"},
                           {"planes": [{"normal": ["-1", "4", "0"], "obstacle": 0, "robot": 0}], "until": "1"}]]}})";
}

std::string proof_of_collision(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return R"({"claim": {"box": null, "contact": "forbid", "obstacles": [[["0", "0", "0"], ["2", "0", "0"]]],
  "path": [{"position": ["0", "0", "0"], "quaternion": ["1", "0", "0", "1/2"]}],
  "robot": [[["1", "0", "0"]], [["0", "0", "0"]]], "status": "blocked"}, "nef_proof": 1,
  "witness": {"collision": {"common": [{"obstacle": ["1", "0"], "robot": ["1"]}, {"obstacle": ["1", "0"], "robot": ["1"]}],
  "motion": 0, "obstacle": 0, "parameter": "0", "robot": 1, "times": ["0", "1"]}}})";
}

std::string proof_of_barrier(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return R"({"claim": {"box": [["-1", "-1", "-1"], ["1", "1", "1"]], "contact": "forbid",
  "obstacles": [[["0", "-9", "-9"], ["0", "9", "-9"], ["0", "0", "9"]]], "robot": [[["0", "0", "0"]]],
  "path": [{"position": ["-1", "0", "0"], "quaternion": ["1", "0", "0", "0"]},
           {"position": ["1", "0", "0"], "quaternion": ["1", "0", "0", "0"]}], "status": "infeasible"}, "nef_proof": 1,
  "witness": {"barrier": {"points": [["0", "-9", "-9"], ["0", "9", "-9"], ["0", "0", "9"], ["9", "0", "9"]],
  "triangles": [{"corners": [0, 1, 2], "robot": 0, "obstacle": 0, "common": [{"robot": ["1"], "obstacle": ["1", "0", "0"]},
  {"robot": ["1"], "obstacle": ["0", "1", "0"]}, {"robot": ["1"], "obstacle": ["0", "0", "1"]}]}, {"corners": [3, 1, 0]}]}}})";
}

std::string proof_of_turning(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return R"({"claim": {"box": null, "contact": "allow", "obstacles": [[["0", "0", "0"], ["1", "0", "0"], ["0", "1", "0"],
  ["0", "0", "1"]]], "path": [{"position": ["0", "0", "0"], "quaternion": ["1", "0", "0", "0"]},
  {"position": ["1", "0", "0"], "quaternion": ["1", "1", "0", "0"]}], "robot": [[["0", "0", "0"], ["1", "0", "0"],
  ["0", "1", "0"], ["0", "0", "1"]]], "rotations": [["1", "0", "0", "0"], ["1", "1", "0", "0"]], "status": "infeasible"},
  "nef_proof": 1, "witness": {"cells": {"bounds": [["-1", "-1", "-1"], ["1", "1", "1"]], "charts": [{"at": "1/2", "axis": 3,
  "halves": [{"side": "start"}, {"at": "0", "axis": 0, "halves": [{"beyond": 2}, {"common": [["0", "0", "0"],
  ["0", "0", "0"], ["0", "0", "0"], ["0", "0", "0"], ["0", "0", "0"], ["0", "0", "0"], ["0", "0", "0"], ["0", "0", "0"]],
  "obstacle": 0, "robot": 0}]}]}], "outside": "goal", "reference": ["0", "0", "0"]}}})";
}

std::string proof_of_parts(const Polyhedron& /*set*/, const std::string& /*text*/) {
  return R"({"claim": {"status": "inseparable", "parts": [
    {"name": "a", "pieces": [[["0", "0", "0"], ["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]]},
    {"name": "b", "pieces": [[["0", "0", "0"], ["-1/2", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]]}]}, "nef_proof": 1,
  "witness": {"contacts": [{"first": [0, 0], "second": [1, 0], "common": {"first": ["1", "0", "0", "0"], "second": ["1", "0", "0", "0"]}}],
  "octants": [{"edge": 2, "halves": [{"first_blocked": [0], "second_blocked": []}, {"first_blocked": [], "second_blocked": [0]}]},
  {"first_blocked": [0], "second_blocked": [0]}, {"first_blocked": [], "second_blocked": []},
  {"first_blocked": [], "second_blocked": []}, {"first_blocked": [], "second_blocked": []},
  {"first_blocked": [], "second_blocked": []}, {"first_blocked": [], "second_blocked": []},
  {"first_blocked": [], "second_blocked": []}]}})";
}

// Whatever the file says, the check of the proof must end.
void read_proof_file(const std::string& text) {
  static_cast<void>(planner::complaint_about(planner::parse_proof(text, "file")));
}

void read_proof_of_parts(const std::string& text) {
  static_cast<void>(planner::complaint_about(planner::parse_inseparable_proof(text, "file")));
}

std::vector<Format> other_formats() {
  return {
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
      Format{"csg", openscad_model, read_openscad_model},
      Format{"planner-scene", planner_scene, read_planner_scene},
      Format{"cfg", ompl_problem, read_ompl_problem},
      Format{"waypoints", waypoints, read_waypoints_file},
      Format{"rigid-path", rigid_path, read_waypoints_file},
      Format{"path-lines", path_lines, read_path_lines},
      Format{"urdf", urdf_robot, read_urdf_robot},
      Format{"joint-path", joint_path, read_joints},
      Format{"joint-lines", joint_lines, read_joints},
      Format{"path-proof", proof_of_path, read_proof_file},
      Format{"collision-proof", proof_of_collision, read_proof_file},
      Format{"barrier-proof", proof_of_barrier, read_proof_file},
      Format{"turning-proof", proof_of_turning, read_proof_file},
      Format{"inseparable-proof", proof_of_parts, read_proof_of_parts},
      Format{"hull-scene", hull_scene,
             [](const std::string& text) {
               static_cast<void>(nef::visual_hull::read_json_scene(text, "/nonexistent/scene.json"));
             }},
      Format{"vsh", vsh_scene,
             [](const std::string& text) {
               static_cast<void>(nef::visual_hull::read_vsh(text, "/nonexistent/scene.vsh"));
             }},
      Format{"matrices", matrix_scene,
             [](const std::string& text) {
               static_cast<void>(nef::visual_hull::read_text_scene(text, "/nonexistent/scene.txt"));
             }},
      Format{"opencv-yaml", opencv_yaml,
             [](const std::string& text) {
               static_cast<void>(nef::visual_hull::read_opencv_storage(text, "/nonexistent/scene.yml", ""));
             }},
      Format{"opencv-xml", opencv_xml,
             [](const std::string& text) {
               static_cast<void>(nef::visual_hull::read_opencv_storage(text, "/nonexistent/scene.xml", ""));
             }},
      Format{"matlab", matlab_file,
             [](const std::string& bytes) {
               const test::TemporaryFolder folder;
               write_file(folder.file("scene.mat"), bytes);
               static_cast<void>(nef::visual_hull::read_matlab(folder.file("scene.mat"), ""));
             }},
      Format{"parameter-blocks", parameter_blocks,
             [](const std::string& text) {
               static_cast<void>(nef::visual_hull::read_parameter_blocks(text, "/nonexistent/scene.txt"));
             }},
      Format{"transforms", transforms_scene,
             [](const std::string& text) {
               static_cast<void>(nef::visual_hull::read_json_scene(text, "/nonexistent/transforms.json"));
             }},
      Format{"colmap", colmap_model, read_colmap_model},
      Format{"middlebury", middlebury_scene,
             [](const std::string& text) {
               static_cast<void>(nef::visual_hull::read_text_scene(text, "/nonexistent/scene.txt"));
             }},
  };
}

std::vector<Format> all_formats() {
  std::vector<Format> all;
  for (const MeshFormat& format : mesh_formats()) {
    all.push_back(mesh_format(format, false));
    if (format.has_two_forms()) all.push_back(mesh_format(format, true));
  }
  const std::vector<Format> others = other_formats();
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace

std::span<const Format> formats() {
  static const std::vector<Format> all = all_formats();
  return all;
}

}  // namespace nef::fuzz
