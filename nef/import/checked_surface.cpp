// SPDX-License-Identifier: Apache-2.0
#include "nef/import/checked_surface.h"

#include <algorithm>

#include "nef/import/repair/doubled_faces.h"
#include "nef/mesh/surface/equal_faces.h"

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
      return problem.balance == EdgeBalance::kBalanced || rule == Crossings::kOutside || rule == Crossings::kGuess ||
             (rule == Crossings::kOdd && problem.balance == EdgeBalance::kEven);
    default:
      return true;
  }
}

// What the user can do about a problem that no rule for crossings has an answer to.
const char* advice_to_repair(MeshProblemKind kind) {
  if (kind == MeshProblemKind::kOpenBorder) return "; --close (close=10 in Python) closes holes by a guess";
  if (kind == MeshProblemKind::kInconsistentOrientation) return "; nef repair flips faces to fit their neighbours";
  if (kind == MeshProblemKind::kNonManifoldEdge)
    return "; nef check lists all problems, nef repair repairs what it can";
  return "";
}

}  // namespace

std::string advice_to_unite() { return std::string("; crossings=\"union\" selects ") + taken_by(Crossings::kUnion); }

CheckedSurface::CheckedSurface(const Mesh& mesh, Extent extent, Crossings rule, const Monitor& monitor,
                               KnownContacts known)
    : mesh_(&mesh), extent_(extent), rule_(rule), contacts_(std::move(known)) {
  monitor.tell_progress("faces of the mesh", 0, 0);
  surface_ = std::make_unique<const MeshSurface>(mesh, monitor);
  monitor.tell_progress("self-intersections", 0, 0);
  const MeshCheckOptions first{
      .max_per_kind = 1, .self_intersections = extent == Extent::kAll, .only_verdict = rule == Crossings::kRefuse};
  problems_ = check_mesh(mesh, *surface_, first, monitor, &contacts_);
  for (const MeshProblem& problem : problems_) {
    if (!problem.legal && !is_resolved(problem, rule)) {
      refused_ = &problem;
      return;
    }
    in_contact_ = in_contact_ || !problem.legal || problem.kind == MeshProblemKind::kTouching ||
                  problem.kind == MeshProblemKind::kDuplicateFace;
    unpaired_ = unpaired_ || (!problem.legal && problem.balance == EdgeBalance::kOdd);
    inside_out_ = inside_out_ || problem.kind == MeshProblemKind::kInsideOut;
  }
  faces_without_area_ =
      static_cast<std::size_t>(std::count(surface_->defects.begin(), surface_->defects.end(), FaceDefect::kNoArea));
  // Without a face that has no area, its neighbours meet in parts of edges.
  in_contact_ = in_contact_ || faces_without_area_ > 0;
}

// A face whose corners no other one has encloses something, with all that is connected to it. So the others alone are
// looked at, but for those that share a side with such a face.
std::size_t CheckedSurface::cancelled_faces() const {
  const auto is_double = [](const MeshProblem& problem) { return problem.kind == MeshProblemKind::kDuplicateFace; };
  if (std::none_of(problems_.begin(), problems_.end(), is_double)) return 0;
  const std::vector<std::uint32_t> first = first_with_corners(*mesh_, *surface_, Monitor());
  std::vector<bool> alone(first.size(), true);
  for (std::uint32_t f = 0; f < first.size(); ++f) {
    if (first[f] != f) alone[f] = alone[first[f]] = false;
  }
  std::vector<bool> near_others(surface_->points.size(), false);  // places of faces that are not alone
  for (std::uint32_t f = 0; f < mesh_->face_count(); ++f) {
    if (alone[f]) continue;
    for (const std::uint32_t v : mesh_->face(f)) near_others[surface_->place[v]] = true;
  }
  std::vector<std::vector<std::uint32_t>> rings;
  for (std::uint32_t f = 0; f < mesh_->face_count(); ++f) {
    std::size_t near = 0;
    for (const std::uint32_t v : mesh_->face(f)) near += near_others[surface_->place[v]] ? 1 : 0;
    if (alone[f] && near < 2) continue;  // shares no side with any of them
    std::vector<std::uint32_t>& ring = rings.emplace_back();
    for (const std::uint32_t v : mesh_->face(f)) ring.push_back(surface_->place[v]);
  }
  return count_cancelled(std::move(rings));
}

void CheckedSurface::require_legal(const Monitor& monitor) {
  if (!is_refused()) return;
  if (rule_ != Crossings::kRefuse || extent_ != Extent::kAll) {
    throw RefusedMesh(refused_->text, advice_to_repair(refused_->kind));
  }
  for (const MeshProblem& problem : problems_) {
    if (problem.legal || is_resolved(problem, Crossings::kUnion)) continue;
    throw RefusedMesh(refused_->text, advice_to_repair(problem.kind));
  }
  if (!contacts_) contacts_ = face_contacts(*surface_, SurfaceContacts(*surface_, monitor));
  const std::size_t pairs = count_crossings(*contacts_);
  throw RefusedMesh(refused_->text, (pairs > 1 ? "; " + crossing_text(pairs) : "") + advice_to_unite());
}

}  // namespace nef
