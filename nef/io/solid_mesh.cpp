// SPDX-License-Identifier: Apache-2.0
#include "nef/io/solid_mesh.h"

#include "nef/export/to_mesh.h"
#include "nef/io/mesh/mend_rounded.h"
#include "nef/mesh/recenter.h"
#include "nef/mesh/separate_sheets.h"
#include "nef/polyhedron.h"

namespace nef {

namespace {

void require_legal(const std::string& problem) {
  if (problem.empty()) return;
  throw UnsupportedError("rounded to double precision, the mesh is not valid (" + problem +
                         ") and could not be repaired; use exact coordinates, or recenter it");
}

MeshExport exported(const Polyhedron& set, const SolidMeshOptions& options, const Rounding& rounding) {
  MeshExportOptions how;
  // Polygons stay planar only if all of their corners are moved alike and none is rounded.
  how.keep_polygons = options.polygons && !(options.repair && options.recenter);
  how.only_quads = options.manifold || options.repair;
  if (options.repair) {
    how.polygon_corner = [&rounding](const Rational3& p) { return is_kept(p, rounding); };
  }
  return to_mesh(set, how, options.monitor);
}

}  // namespace

SolidMesh solid_mesh(const Polyhedron& set, const SolidMeshOptions& options) {
  const Rounding rounding = rounding_to(FileNumbers::kDoubles);
  MeshExport made = exported(set, options, rounding);
  SolidMesh result{.mesh = std::move(made.mesh), .notes = std::move(made.lost)};
  if (options.recenter) result.offset = recenter(result.mesh);
  if (options.repair) {
    MendedMesh rounded = round_mesh(result.mesh, rounding, options.monitor);
    if (!rounded.legal) require_legal(rounded.problem);
    if (const std::string done = repair_text(rounded); !done.empty()) result.notes.push_back(done);
    result.mesh = std::move(rounded.mesh);
  }
  if (!options.manifold) return result;
  SeparatedSheets separated = separate_sheets(result.mesh);
  result.mesh = std::move(separated.mesh);
  if (options.repair && separated.copies > 0) {  // it may have added middles of edges, which are rounded, too
    require_legal(rounded_problem(result.mesh, rounding, options.monitor));
  }
  return result;
}

}  // namespace nef
