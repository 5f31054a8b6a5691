// SPDX-License-Identifier: Apache-2.0
#include "apps/program/common_options.h"

#include <CLI/CLI.hpp>
#include <map>

#include "nef/construct/construct.h"

#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/io/mesh/mesh_formats.h"

namespace nef {

namespace {

CLI::Validator above(bool zero_too, const std::string& name) {
  const auto check = [zero_too](const std::string& text) -> std::string {
    double value = 0;
    const bool number = CLI::detail::lexical_cast(text, value);
    if (number && (value > 0 || (zero_too && value == 0))) return {};
    return std::string(zero_too ? "expected a number of at least 0, not '" : "expected a positive number, not '") +
           text + "'";
  };
  return {check, name};
}

}  // namespace

CLI::Validator positive() { return above(false, "POSITIVE"); }

CLI::Validator not_negative() { return above(true, "NONNEGATIVE"); }

void add_run_options(CLI::App& app, bool& json, bool& quiet, Monitor& monitor) {
  app.add_flag("--json", json, "Print a JSON report on standard output, and nothing else");
  app.add_flag("-q,--quiet", quiet, "Print nothing but errors");
  app.add_option_function<unsigned>(
         "--threads", [&monitor](const unsigned& threads) { monitor = monitor.on_threads(threads); },
         "Maximal number of threads; 0: all that the machine has")
      ->check(CLI::Range(0U, 4096U))
      ->default_str(std::to_string(monitor.threads()));
}

void add_crossings_option(CLI::App& app, Crossings& rule) {
  rule = Crossings::kUnion;
  std::map<std::string, Crossings> rules;
  for (const Crossings each : kAllCrossings) rules.emplace(name(each), each);
  app.add_option("--crossings", rule,
                 "Which points are inside a mesh that crosses itself: refuse (an error), union (enclosed at least "
                 "once; default), nonzero (parts that are inside out, too), odd (overlaps are cavities), outside (not "
                 "reachable from outside), guess (winding number of an open mesh at least one half)")
      ->type_name("RULE")
      ->transform(CLI::CheckedTransformer(rules).description(""))
      ->default_str("union");
}

void add_close_option(CLI::App& app, double& percent) {
  // One program has another --close: the morphological one.
  const bool is_free = app.get_option_no_throw("--close") == nullptr;
  app.add_flag(
         is_free ? "--close{10},--close-holes{10}" : "--close-holes{10}", percent,
         "Repair meshes that do not bound a solid, and close all holes with lids: flat ones on planar holes, triangles "
         "of least area on others; open pieces in one plane are left out. Lids are a guess. PERCENT is their largest "
         "accepted share of the area (default 10)")
      ->type_name("[=PERCENT]")
      ->check(CLI::Range(0.0, 100.0).description(""));
}

void add_mesh_input_options(CLI::App& app, MeshOptions& options) {
  app.add_flag("--strict", options.strict, "Refuse meshes with faces that are not exactly planar");
  app.add_flag("--as-surface", options.as_surface, "Read meshes as two-dimensional sets; they may be open");
  add_crossings_option(app, options.crossings);
  add_close_option(app, options.close_percent);
}

void add_manifold_option(CLI::App& app, bool& manifold) {
  app.add_flag("--manifold", manifold,
               "Write a mesh in which each edge has two faces, even if the solid touches itself: vertices there are "
               "duplicated (not in STL)");
}

void add_mesh_file_options(CLI::App& app, MeshFileFlags& flags) {
  app.add_flag("--recenter", flags.recenter,
               "Subtract a point of few digits near the centre of the mesh from its coordinates, which keeps more "
               "digits far from the origin; the report and the file contain the offset");
  app.add_flag(
      "--lenient", flags.lenient,
      "Write a mesh even if rounding made it invalid and it could not be repaired (an error without this flag)");
}

void require_no_mesh_flags(const std::string& path, const MeshFileFlags& flags) {
  if (!flags.manifold && !flags.recenter) return;
  throw UnsupportedError(path + ": " + (flags.manifold ? "--manifold" : "--recenter") +
                         " applies to mesh files; write " + mesh_format_names(kNamedVertices));
}

void add_file_output_options(CLI::App& app, bool& exact, bool& binary, bool& text) {
  const auto has_two = [](const MeshFormat& format) { return format.has_two_forms(); };
  app.add_flag("--exact", exact, "Exact coordinates (p/q) in " + mesh_format_names(kFractions, "and"));
  app.add_flag("--binary", binary, "Binary " + mesh_format_names(has_two));
  app.add_flag("--text", text, ".nef as text");
}

}  // namespace nef
