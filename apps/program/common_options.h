// SPDX-License-Identifier: Apache-2.0
//
// Options that all programs have, in the same words.
#pragma once

#include <cstdint>
#include <string>

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace nef {

class Monitor;
struct MeshOptions;
enum class Crossings : std::uint8_t;

/// Checks of numbers, which say what is needed rather than where doubles end.
CLI::Validator positive();
CLI::Validator not_negative();

/// --json, -q and --threads.
void add_run_options(CLI::App& app, bool& json, bool& quiet, Monitor& monitor);

/// --crossings: the rule for faces that cross. Sets the one that programs have unless told otherwise: union.
void add_crossings_option(CLI::App& app, Crossings& rule);

/// --close[=PERCENT], also called --close-holes: lids for holes. Where the program has an option --close already, only
/// the second name is new.
void add_close_option(CLI::App& app, double& percent);

/// --strict, --as-surface, --crossings and --close: how meshes are read.
void add_mesh_input_options(CLI::App& app, MeshOptions& options);

/// How meshes are written, whatever the format (see PolyhedronWriteOptions).
struct MeshFileFlags {
  bool manifold = false;
  bool lenient = false;
  bool recenter = false;
};

/// Throws UnsupportedError if the flags ask for what only files of meshes can have, of `path`, which is none.
void require_no_mesh_flags(const std::string& path, const MeshFileFlags& flags);

/// --manifold: solids that touch themselves get vertices of their own on each sheet.
void add_manifold_option(CLI::App& app, bool& manifold);

/// --lenient and --recenter.
void add_mesh_file_options(CLI::App& app, MeshFileFlags& flags);

/// --exact, --binary and --text: how sets are written.
void add_file_output_options(CLI::App& app, bool& exact, bool& binary, bool& text);

}  // namespace nef
