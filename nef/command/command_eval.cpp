// SPDX-License-Identifier: Apache-2.0
//
// nef eval
#include "nef/command/commands.h"
#include "nef/program/expression.h"

namespace nef {

void add_eval_command(CLI::App& app, Session& session) {
  CLI::App* command = add_subcommand(app, session, "eval", "The set that an expression describes");
  const auto text = std::make_shared<std::string>();
  command->add_option("expression", *text, "e.g. 'box(0,0,0, 2,2,2) - file(\"part.off\") * halfspace(0,0,1,-1)'")
      ->required();
  add_input_flags(command, session);
  add_output_flags(command, session);
  command->add_option("--repeat", session.repeat, "compute N times and report the median")
      ->check(CLI::Range(1, 1000000));
  command->footer(
      "Operators: + union, * intersection, - difference, ^ symmetric difference, ! complement.\n"
      "Sets: file(\"a.off\") box(x0,y0,z0, x1,y1,z1) halfspace(a,b,c,d) for ax+by+cz+d <= 0, hull(points),\n"
      "  point(x,y,z) segment(points) polygon(points; hole; ...) everything nothing\n"
      "Functions: interior closure boundary exterior regularize complement (A), union intersection (A, B, ...),\n"
      "  difference symdiff (A, B), translate(A, x,y,z) scale(A, s) rotate(A, axis, degrees[, tolerance])\n"
      "  transform(A, 12 or 16 numbers)\n"
      "Numbers are exact: 0.1 is one tenth, 1/3 is allowed.");
  command->callback([&session, text] {
    ExpressionOptions options;
    options.load = [&session](const std::string& path) { return session.load(path); };
    session.show_phase("computing");
    const Measured measured = measure(session.repeat, [&] { return evaluate_expression(*text, options); });
    finish(session, "eval", measured);
  });
}

}  // namespace nef
