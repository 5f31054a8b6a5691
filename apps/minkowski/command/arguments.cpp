// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/command/arguments.h"

#include <map>
#include <sstream>

#include "nef/base/error.h"

namespace nef::minkowski {
namespace {

const std::map<std::string, UnionStrategy>& strategies() {
  static const std::map<std::string, UnionStrategy> kNames = {{"trivial", UnionStrategy::kTrivial},
                                                              {"queue", UnionStrategy::kQueue},
                                                              {"priority", UnionStrategy::kPriority},
                                                              {"nary", UnionStrategy::kNary}};
  return kNames;
}

}  // namespace

void declare(CLI::App& app, Arguments& a) {
  app.add_option("operands", a.operands, "A and B: .nef, .nef3, or a mesh (off, obj, stl, ply)");
  app.add_option("-o,--output", a.output, "where the result goes; the extension says the format")->required();
  app.add_flag("--open-a", a.open_a, "take the interior of A");
  app.add_flag("--open-b", a.open_b, "take the interior of B");
  app.add_flag("--negate-b", a.negate_b, "take -B instead of B");
  app.add_option("--ball", a.ball, "R,N: a ball of radius R stands in for B (octahedron, edges split N times)");
  app.add_option("--box-tool", a.box_tool, "x,y,z: a box of these extents about the origin stands in for B");
  app.add_option("--union", a.union_name, "how sums of cells are united: trivial, queue, priority, nary")
      ->check(CLI::IsMember({"trivial", "queue", "priority", "nary"}));
  app.add_flag("--decompose", a.decompose, "write the convex cells of A, to one mesh file or into a directory");
  app.add_option("--format", a.format, "of cells in a directory: off (default), ply, obj, or nef (exact, with marks)")
      ->check(CLI::IsMember({"off", "ply", "obj", "nef"}));
  app.add_flag("--configuration-space", a.configuration_space, "free positions of a robot among obstacles");
  app.add_option("--robot", a.robot, "the robot; its reference point is the origin");
  app.add_option("--obstacles", a.obstacles, "the obstacles")->expected(-1);
  app.add_option("--box", a.box, "two corners x,y,z X,Y,Z that bound the reference point")->expected(2);
  app.add_flag("--as-surface", a.as_surface, "take the faces of meshes as a two-dimensional set");
  app.add_flag("--strict", a.strict, "refuse meshes with faces that are not exactly planar");
  app.add_flag("--exact", a.exact, "exact coordinates in mesh files");
  app.add_flag("--binary", a.binary, "binary STL or PLY");
  app.add_flag("--text", a.text, ".nef as text");
  app.add_option("--report", a.report, "write a JSON report: cells, pairs, times, predicates, memory, result");
  app.add_option("--preview", a.preview, "write pictures (PNG) of the operands and the result into this directory")
      ->type_name("DIR");
  app.add_option("--threads", a.threads, "threads to use at most; 0 (default): as many as the machine has");
  app.add_flag("--json", a.json, "print the report to stdout");
  app.add_flag("-q,--quiet", a.quiet, "print nothing but errors");
}

void check(const Arguments& a) {
  if (a.decompose && a.configuration_space) {
    throw InputError("--decompose and --configuration-space are two tasks: give one of them");
  }
  if (!a.format.empty() && !a.decompose)
    throw InputError("--format goes with --decompose; -o names a file by its extension");
  const std::size_t tools = (a.ball.empty() ? 0U : 1U) + (a.box_tool.empty() ? 0U : 1U);
  if (tools > 1) throw InputError("--ball and --box-tool both stand in for B: give one of them");
  if (a.configuration_space) {
    if (a.robot.empty()) throw InputError("--configuration-space needs --robot");
    if (a.obstacles.empty()) throw InputError("--configuration-space needs --obstacles (one file or more)");
    if (!a.operands.empty()) throw InputError("--configuration-space takes --robot and --obstacles, not A and B");
    if (tools > 0 || a.open_a || a.open_b || a.negate_b) {
      throw InputError("--ball, --box-tool, --open-a, --open-b and --negate-b do not go with --configuration-space");
    }
    return;
  }
  if (!a.robot.empty() || !a.obstacles.empty() || !a.box.empty()) {
    throw InputError("--robot, --obstacles and --box go with --configuration-space");
  }
  if (a.decompose && (tools > 0 || a.open_b || a.negate_b)) {
    throw InputError("--ball, --box-tool, --open-b and --negate-b do not go with --decompose");
  }
  const std::size_t wanted = a.decompose || tools > 0 ? 1 : 2;
  if (a.operands.size() != wanted) {
    throw InputError("give " + std::string(wanted == 1 ? "one operand" : "two operands") + ", not " +
                     std::to_string(a.operands.size()) + " (see minkowski --help)");
  }
}

UnionStrategy strategy(const Arguments& arguments) { return strategies().at(arguments.union_name); }

}  // namespace nef::minkowski
