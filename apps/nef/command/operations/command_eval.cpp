// SPDX-License-Identifier: Apache-2.0
//
// nef eval
#include <algorithm>
#include <filesystem>

#include "apps/nef/command/commands.h"
#include "apps/program/expression/expression.h"
#include "apps/program/expression/openscad.h"
#include "nef/io/file_bytes.h"

namespace nef {
namespace {

struct EvalFlags {
  std::string text;
  std::string script;
};

// Once, however often the computation is repeated.
void note_once(Session& session, const std::string& line) {
  if (std::find(session.notes().begin(), session.notes().end(), line) == session.notes().end()) session.note(line);
}

// The set of a text from a file: names of files in it are relative to the file, and errors begin with its name.
Polyhedron evaluate_file(const std::string& path, const std::string& text, bool openscad, Session& session,
                         ExpressionOptions options) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  options.load = [&session, folder](const std::string& file, const Monitor& monitor) {
    return session.load((folder / file).string(), monitor);
  };
  options.warn = [&session, &path](const std::string& warning) { note_once(session, path + ": " + warning); };
  try {
    return openscad ? evaluate_openscad(text, options) : evaluate_expression(text, options);
  } catch (const FileError&) {
    throw;
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

void add_eval_options(CLI::App& command, Session&, EvalFlags& flags) {
  command.add_option("expression", flags.text,
                     "e.g. 'box(0,0,0, 2,2,2) - file(\"part.off\") * halfspace(0,0,1,-1)', or the name of a .csg file");
  command.add_option("-f,--file", flags.script, "A file with the expression; .csg: a model flattened by OpenSCAD")
      ->type_name("FILE");
  command.footer(
      "Operators: + union, * intersection, - difference, ^ symmetric difference, ! complement.\n"
      "Sets: file(\"a.off\") box(x0,y0,z0, x1,y1,z1) halfspace(a,b,c,d) for ax+by+cz+d <= 0, hull(points),\n"
      "  point(x,y,z) segment(points) polyline(points) polygon(points; hole; ...) sphere(r[, corners])\n"
      "  cylinder(h, r) cylinder(h, r0, r1[, corners]) ball(r, n) as minkowski --ball, everything nothing\n"
      "Functions: interior closure boundary exterior regularize complement (A), union intersection hull (A, B, ...),\n"
      "  difference symdiff minkowski erode (A, B), translate(A, x,y,z) scale(A, s)\n"
      "  rotate(A, axis, degrees[, tolerance])\n"
      "  transform(A, 12 or 16 numbers)\n"
      "Variables: h = 7/2; a = cylinder(2*h, 1); a + translate(a, [0,0,h])\n"
      "Numbers are exact: 0.1 is one tenth, 1/3 is allowed. A list of numbers may be put in brackets.\n"
      "OpenSCAD (openscad -o model.csg model.scad; nef eval model.csg -o model.nef): cube sphere cylinder\n"
      "  polyhedron square circle polygon union difference intersection hull minkowski render color multmatrix\n"
      "  linear_extrude (no twist) rotate_extrude, import of meshes.");
}

void refuse_openscad_source(const std::string& path) {
  if (lower_extension(path) != "scad") return;
  const std::string flat = path.substr(0, path.size() - 4) + "csg";
  throw InputError(path + ": OpenSCAD must flatten this file first: openscad -o " + flat + " " + path + "; then give " +
                   flat);
}

// What is no expression but the name of a file.
void refuse_file_name(const std::string& text) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(text, error)) return;
  throw InputError(text + " is a file: write 'file(\"" + text + "\")' for a set or mesh, or -f " + text +
                   " for a file with an expression");
}

void run_eval(Session& session, const EvalFlags& flags, const CommandExtensions& extensions) {
  ExpressionOptions options = expression_options(session, extensions);
  std::string path = flags.script;
  if (path.empty() && lower_extension(flags.text) == "csg") path = flags.text;
  if (flags.text.empty() == flags.script.empty()) {
    throw InputError("eval: give an expression, or -f and a file that contains one (see nef eval --help)");
  }
  refuse_openscad_source(path.empty() ? flags.text : path);
  options.warn = [&session](const std::string& warning) { note_once(session, warning); };
  const std::string text = path.empty() ? flags.text : read_file(path);
  session.show_phase("computing");
  const Measured measured = measure(session.repeat, session.monitor, [&](const Monitor& monitor) {
    options.monitor = monitor;
    if (path.empty()) {
      try {
        return evaluate_expression(text, options);
      } catch (const InputError&) {
        refuse_file_name(text);
        throw;
      }
    }
    return evaluate_file(path, text, lower_extension(path) == "csg", session, options);
  });
  finish(session, "eval", measured);
}

}  // namespace

Commands eval_commands(const CommandExtensions& extensions) {
  return {with_flags<EvalFlags>({.name = "eval",
                                 .description = "Compute the set that an expression, a script or a .csg file describes",
                                 .operands = "",
                                 .output = Output::kOptional,
                                 .repeats = true},
                                add_eval_options, [extensions](Session& session, const EvalFlags& flags) {
                                  run_eval(session, flags, extensions);
                                })};
}

}  // namespace nef
