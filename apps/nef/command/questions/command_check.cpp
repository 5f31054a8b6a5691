// SPDX-License-Identifier: Apache-2.0
//
// nef check: what is wrong with a mesh, by name; or whether a native file holds a valid complex.
#include <map>

#include "apps/nef/command/commands.h"
#include "nef/import/repair/fill.h"
#include "nef/import/try_from_mesh.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/polyhedron_file.h"
#include "nef/mesh/mesh_check.h"

namespace nef {
namespace {

// A mesh with two shells that overlap has hundreds of crossings.
constexpr std::size_t kPrintedPerKind = 5;

Json problem_json(const MeshProblem& problem) {
  return {{"name", name(problem.kind)}, {"legal", problem.legal}, {"vertices", problem.vertices},
          {"edges", problem.edges},     {"faces", problem.faces}, {"text", problem.text}};
}

// A finding outside of the mesh: the file itself is at fault (perhaps in one element), or the complex in it.
Json plain_problem(const std::string& kind, const std::string& text, FileElement element = {}, bool legal = false) {
  Json vertices = Json::array();
  Json faces = Json::array();
  if (element.kind == FileElement::Kind::kVertex) vertices.push_back(element.index);
  if (element.kind == FileElement::Kind::kFace) faces.push_back(element.index);
  return {{"name", kind},           {"legal", legal}, {"vertices", vertices},
          {"edges", Json::array()}, {"faces", faces}, {"text", text}};
}

// `strict`: whether the mesh is strictly legal.
Json check_mesh_file(const std::string& path, bool& strict, const Monitor& monitor) {
  Json problems = Json::array();
  strict = false;
  Mesh mesh;
  try {
    mesh = read_mesh(path);
  } catch (const FileError& error) {
    // Numbers and indices are part of what a mesh can have wrong; a file that cannot be read as one
    // at all is an error.
    if (error.problem() != FileProblem::kBadIndex && error.problem() != FileProblem::kNotANumber) throw;
    problems.push_back(plain_problem(name(error.problem()), error.what(), error.element()));
    return problems;
  }
  if (mesh.face_count() == 0) {
    Messages notes;
    const std::variant<Polyhedron, MeshRefusal> made = try_from_mesh(mesh, {.monitor = monitor}, &notes);
    const auto* refused = std::get_if<MeshRefusal>(&made);
    problems.push_back(
        plain_problem("no faces", refused != nullptr ? refused->text : notes.at(0), {}, refused == nullptr));
    strict = refused == nullptr;
    return problems;
  }
  MeshCheckOptions options;
  options.max_per_kind = 1000;
  bool good = true;
  strict = true;
  for (const MeshProblem& problem : check_mesh(mesh, options, monitor)) {
    problems.push_back(problem_json(problem));
    good = good && problem.legal;
    strict = strict && is_strictly_legal(problem);
  }
  if (!good) return problems;
  // How components lie in each other is known only when the solid is made.
  const std::variant<Polyhedron, MeshRefusal> made = try_from_mesh(mesh, {.monitor = monitor});
  if (const auto* refused = std::get_if<MeshRefusal>(&made)) {
    strict = false;
    const bool cancel = refused->text.starts_with(kEnclosesNothing);
    problems.push_back(plain_problem(cancel ? "no volume" : "inconsistent orientation", refused->text));
  }
  return problems;
}

Json check_complex_file(Session& session, const std::string& path) {
  Json problems = Json::array();
  const std::string broken = validate(session.load(path).complex(), session.monitor);
  if (!broken.empty()) problems.push_back(plain_problem("broken invariant", broken));
  return problems;
}

void run_check(Session& session, bool need_strict) {
  const std::string& path = session.input;
  const bool complex = is_set_extension(lower_extension(path));
  bool strict = false;
  const Json problems = complex ? check_complex_file(session, path) : check_mesh_file(path, strict, session.monitor);
  bool good = complex || strict || !need_strict;
  std::map<std::string, std::size_t> found_by_name;
  for (const Json& problem : problems) {
    good = good && problem["legal"].get<bool>();
    if (++found_by_name[problem["name"]] > kPrintedPerKind) continue;
    session.say((problem["legal"].get<bool>() ? "note: " : "") + problem["name"].get<std::string>() + ": " +
                problem["text"].get<std::string>());
  }
  for (const auto& [name, count] : found_by_name) {
    if (count > kPrintedPerKind) {
      session.say(name + ": " + std::to_string(count - kPrintedPerKind) + " more (--json lists all)");
    }
  }
  session.exit_code = good ? kYes : kNo;
  if (session.json) {
    Json found{{"ok", good}, {"problems", problems}};
    if (!complex) found["strictly_legal"] = strict;
    session.print("check", found);
  } else if (problems.empty()) {
    session.say("no problems");
  }
}

}  // namespace

Commands check_commands() {
  return {with_flags<bool>(
      {.name = "check",
       .description = "Report what is wrong with a mesh. Exit code 0 if it bounds a solid, 1 if not",
       .operands = "File of the mesh",
       .reads_meshes = false},
      [](CLI::App& command, Session&, bool& need_strict) {
        command.add_flag("--strict", need_strict,
                         "Exit code 1 also for a mesh that bounds a solid but is not strictly legal: triangles meet "
                         "outside their shared vertices and edges");
      },
      run_check)};
}

}  // namespace nef
