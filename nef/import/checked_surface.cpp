// SPDX-License-Identifier: Apache-2.0
#include "nef/import/checked_surface.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/mesh/mesh_check.h"

namespace nef {
namespace {

// True if the rule tells what becomes of it.
bool is_resolved(const MeshProblem& problem, Crossings rule) {
  if (rule == Crossings::kRefuse) return false;
  switch (problem.kind) {
    case MeshProblemKind::kBadIndex:
    case MeshProblemKind::kDegenerateFace:
      return false;
    case MeshProblemKind::kOpenBorder:
    case MeshProblemKind::kNonManifoldEdge:
    case MeshProblemKind::kInconsistentOrientation:
      return problem.balance == EdgeBalance::kBalanced || rule == Crossings::kOutside ||
             (rule == Crossings::kOdd && problem.balance == EdgeBalance::kEven);
    default:
      return true;
  }
}

// Of a mesh that is refused: what the user can do about it.
std::string with_advice(const MeshProblem& refused, const Mesh& mesh, const MeshSurface& surface,
                        const Monitor& monitor) {
  std::vector<FaceContact> contacts;
  const MeshCheckOptions all{.max_per_kind = 1, .self_intersections = true};
  for (const MeshProblem& problem : check_mesh(mesh, surface, all, monitor, &contacts)) {
    if (!problem.legal && !is_resolved(problem, Crossings::kUnion)) return refused.text;
  }
  const std::size_t pairs = count_crossings(contacts);
  std::string text = refused.text;
  if (pairs > 1) text += "; " + crossing_text(pairs);
  return text + advice_to_unite();
}

}  // namespace

std::string advice_to_unite() { return std::string("; crossings=\"union\" takes ") + taken_by(Crossings::kUnion); }

CheckedSurface::CheckedSurface(const Mesh& mesh, Extent extent, Crossings rule, const Monitor& monitor) : mesh_(&mesh) {
  monitor.tell_progress("faces of the mesh", 0, 0);
  surface_ = std::make_unique<const MeshSurface>(mesh, monitor);
  monitor.tell_progress("self-intersections", 0, 0);
  const MeshCheckOptions first{
      .max_per_kind = 1, .self_intersections = extent == Extent::kAll, .only_verdict = rule == Crossings::kRefuse};
  for (const MeshProblem& problem : check_mesh(mesh, *surface_, first, monitor, &contacts_)) {
    if (!problem.legal && !is_resolved(problem, rule)) {
      throw InputError(rule == Crossings::kRefuse && extent == Extent::kAll
                           ? with_advice(problem, mesh, *surface_, monitor)
                           : problem.text);
    }
    in_contact_ = in_contact_ || !problem.legal || problem.kind == MeshProblemKind::kTouching ||
                  problem.kind == MeshProblemKind::kDuplicateFace;
    inside_out_ = inside_out_ || problem.kind == MeshProblemKind::kInsideOut;
  }
  faces_without_area_ =
      static_cast<std::size_t>(std::count(surface_->defects.begin(), surface_->defects.end(), FaceDefect::kNoArea));
  // Without a face that has no area, its neighbours meet in parts of edges.
  in_contact_ = in_contact_ || faces_without_area_ > 0;
}

}  // namespace nef
