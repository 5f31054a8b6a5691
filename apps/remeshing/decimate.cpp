// SPDX-License-Identifier: Apache-2.0
//
// The target is approached in steps, each of which keeps at least a quarter of the triangles of the step before, so
// that mistakes are found on small meshes. A step collapses edges by quadric errors [Garland, Heckbert 1997], checks
// the result exactly, and, where faces touch or cross, lowers the error that vertices there may reach (in the end to
// nothing) and repeats from the step's own mesh. Sheets that touch are separated for OpenMesh, which has manifolds
// only, and get their common vertices back afterwards.
#include "apps/remeshing/decimate.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apps/remeshing/collapse_edges.h"
#include "apps/remeshing/sheets.h"
#include "apps/remeshing/triangle_mesh.h"
#include "nef/export/convert_openmesh.h"
#include "nef/export/to_mesh.h"
#include "nef/import/try_from_mesh.h"
#include "nef/mesh/mesh_check.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

constexpr std::uint32_t kNone = static_cast<std::uint32_t>(-1);

bool is_legal(const Mesh& mesh, const Monitor& monitor) {
  return mesh.face_count() > 0 && std::holds_alternative<Polyhedron>(try_from_mesh(mesh, {.monitor = monitor}));
}

// Adds the vertices of faces that mesh_to_openmesh could not fit in even so: a sheet that comes back to an edge.
void add_separate_vertices(const TriangleMesh& work, Sheets& sheets) {
  sheets.original.resize(work.n_vertices());
  for (const auto f : work.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::transform(work.cfv_ccwbegin(f), work.cfv_ccwend(f), corners.begin(),
                   [](const auto& v) { return static_cast<std::uint32_t>(v.idx()); });
    if (corners[0] < sheets.mesh.vertices.size()) continue;
    // All corners are new ones, numbered in the order of the face.
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    const std::span<const std::uint32_t> face = sheets.mesh.face(static_cast<std::size_t>(f.idx()));
    for (std::size_t i = 0; i < 3; ++i) sheets.original[corners[i]] = sheets.original[face[i]];
  }
}

/// One step of the way: a mesh that is legal, as OpenMesh has it, and which collapses have turned out to be bad.
class Step {
 public:
  Step(const Mesh& mesh, const Monitor& monitor)
      : mesh_(mesh), monitor_(monitor), sheets_(sheets_of(mesh)), work_(mesh_to_openmesh<TriangleMesh>(sheets_.mesh)) {
    add_separate_vertices(work_, sheets_);
    limits_.assign(work_.n_vertices(), std::numeric_limits<float>::infinity());
  }

  /// A legal mesh of about so many triangles, of more where it takes them to stay legal. Nothing if there is none.
  std::optional<Mesh> mesh_of(std::size_t triangles) {
    constexpr int kAttempts = 24;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      monitor_.check_interruption();
      TriangleMesh left = work_;
      collapses_ = collapse_edges(left, triangles, limits_);
      if (attempt == 0) spare_the_rest();
      Mesh result = mesh_left(left);
      if (result.face_count() >= mesh_.face_count()) return std::nullopt;
      if (restrain_bad_places(result, attempt)) continue;
      if (is_legal(result, monitor_)) return result;
      restrain_all();  // parts that do not touch contradict each other: one has been left outside of another
    }
    return std::nullopt;
  }

  /// Whether collapses were held back since the mesh would have touched or crossed itself.
  [[nodiscard]] bool restrained() const { return restrained_; }

 private:
  // What bad places keep is not taken away elsewhere at any price.
  void spare_the_rest() {
    constexpr float kSlack = 4;  // of squares of distances
    const float worst = *std::max_element(collapses_.error.begin(), collapses_.error.end());
    for (float& limit : limits_) limit = std::min(limit, kSlack * worst);
  }

  // `sources_` tells which vertices of the work mesh each vertex of the result is.
  Mesh mesh_left(const TriangleMesh& left) {
    Mesh result;
    sources_.clear();
    std::vector<std::uint32_t> number(mesh_.vertices.size(), kNone);
    for (const auto f : left.faces()) {
      if (left.status(f).deleted()) continue;
      for (auto v = left.cfv_ccwbegin(f); v != left.cfv_ccwend(f); ++v) {
        const auto own = static_cast<std::uint32_t>(v->idx());
        std::uint32_t& vertex = number[sheets_.original[own]];
        if (vertex == kNone) {
          vertex = static_cast<std::uint32_t>(result.vertices.size());
          result.vertices.push_back(mesh_.vertices[sheets_.original[own]]);
        }
        result.corners.push_back(vertex);
        sources_.push_back(own);
      }
      result.face_begin.push_back(static_cast<std::uint32_t>(result.corners.size()));
    }
    return result;
  }

  // Faces of the result that meet in more than what they share, or have no area. Those that are as they were before are
  // none of ours.
  std::vector<bool> bad_vertices(const Mesh& result) const {
    std::vector<std::uint32_t> merged(work_.n_vertices(), 0);
    for (const std::uint32_t root : collapses_.into) ++merged[root];
    std::vector<bool> bad(work_.n_vertices(), false);
    for (const MeshProblem& problem : check_mesh(result, {}, monitor_)) {
      const bool flaw = !problem.legal || problem.kind == MeshProblemKind::kTouching ||
                        problem.kind == MeshProblemKind::kDuplicateFace ||
                        problem.kind == MeshProblemKind::kDegenerateFace;
      if (!flaw) continue;
      for (const std::uint32_t face : problem.faces) {
        for (std::size_t c = 3 * std::size_t{face}; c < 3 * std::size_t{face} + 3; ++c) {
          if (merged[sources_[c]] > 1) bad[sources_[c]] = true;
        }
      }
    }
    return bad;
  }

  // Holds back what was collapsed into a bad vertex: at first the worst of it, then all. False if there is no bad one.
  bool restrain_bad_places(const Mesh& result, int attempt) {
    constexpr int kGentle = 3;
    constexpr float kLess = 16;  // of squares of distances
    const std::vector<bool> bad = bad_vertices(result);
    bool found = false;
    for (std::size_t v = 0; v < limits_.size(); ++v) {
      const std::uint32_t root = collapses_.into[v];
      if (!bad[root]) continue;
      found = true;
      const float error = collapses_.error[root];
      limits_[v] = attempt < kGentle && error > 0 ? std::min(limits_[v], error / kLess) : -1;
    }
    restrained_ = restrained_ || found;
    return found;
  }

  void restrain_all() {
    constexpr float kLess = 16;
    const float worst = *std::max_element(collapses_.error.begin(), collapses_.error.end());
    for (float& limit : limits_) limit = std::min(limit, worst / kLess);
    restrained_ = true;
  }

  const Mesh& mesh_;
  Monitor monitor_;
  Sheets sheets_;
  TriangleMesh work_;
  CollapseLimits limits_;
  Collapses collapses_;
  std::vector<std::uint32_t> sources_;  // by corner of the result
  bool restrained_ = false;
};

std::string stay_text(std::size_t triangles, bool restrained) {
  const std::string stay = std::to_string(triangles) + " triangles remain: ";
  if (!restrained) return stay + "no other edge can be collapsed without flipping a face or losing a border";
  return stay + "with fewer the mesh would touch or cross itself in places, or be much coarser in others";
}

}  // namespace

DecimatedMesh decimate(const Polyhedron& set, std::size_t triangles, const Monitor& monitor) {
  MeshExport whole = to_mesh(set, {}, monitor);
  const Mesh& exact = whole.mesh;
  if (exact.face_count() == 0) throw InputError("the set has no bounded solid part, so there is no mesh to decimate");
  DecimatedMesh result{exact, {}, std::move(whole.lost)};
  // In steps, each a quarter of the last: what has turned out to be bad is sought on a small mesh, not on the whole
  // one.
  constexpr std::size_t kQuarter = 4;
  constexpr std::size_t kLittle = 50;  // a step that takes less than a fiftieth away is the last one
  bool restrained = false;
  while (result.mesh.face_count() > triangles) {
    Step step(result.mesh, monitor);
    std::optional<Mesh> fewer = step.mesh_of(std::max(triangles, result.mesh.face_count() / kQuarter));
    restrained = step.restrained();
    if (!fewer) break;
    const bool little = result.mesh.face_count() - fewer->face_count() < result.mesh.face_count() / kLittle;
    result.mesh = *std::move(fewer);
    if (little) break;
  }
  if (result.mesh.face_count() > triangles) result.notes.push_back(stay_text(result.mesh.face_count(), restrained));
  constexpr std::size_t kSplitsPerFace = 20;
  if (result.mesh.face_count() == exact.face_count()) return result;
  result.distance = hausdorff_distance(exact, result.mesh, kSplitsPerFace * exact.face_count());
  return result;
}

}  // namespace nef
