// SPDX-License-Identifier: Apache-2.0
#include "nef/import/checked_surface.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/mesh/mesh_check.h"

namespace nef {

CheckedSurface::CheckedSurface(const Mesh& mesh, Extent extent, const Monitor& monitor) : mesh_(&mesh) {
  monitor.tell_progress("faces of the mesh", 0, 0);
  surface_ = std::make_unique<const MeshSurface>(mesh, monitor);
  monitor.tell_progress("self-intersections", 0, 0);
  const MeshCheckOptions first{.max_per_kind = 1, .self_intersections = extent == Extent::kAll, .only_verdict = true};
  for (const MeshProblem& problem : check_mesh(mesh, *surface_, first, monitor)) {
    if (!problem.legal) throw InputError(problem.text);
    in_contact_ =
        in_contact_ || problem.kind == MeshProblemKind::kTouching || problem.kind == MeshProblemKind::kDuplicateFace;
    inside_out_ = inside_out_ || problem.kind == MeshProblemKind::kInsideOut;
  }
  faces_without_area_ =
      static_cast<std::size_t>(std::count(surface_->defects.begin(), surface_->defects.end(), FaceDefect::kNoArea));
  // Without a face that has no area, its neighbours meet in parts of edges.
  in_contact_ = in_contact_ || faces_without_area_ > 0;
}

}  // namespace nef
