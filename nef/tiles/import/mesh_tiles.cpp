// SPDX-License-Identifier: Apache-2.0
//
// The mesh is checked as a whole; a mesh with anything that needs repair is imported whole and cut afterwards.
// Otherwise space is divided until a part meets at most `piece` faces, and the faces of each part become a solid in its
// region, several at once (`solid_in_region`). A part without faces is inside or outside as a whole: an upward ray from
// a point of it counts how often it leaves the solid, exactly and with a symbolic perturbation.
#include "nef/tiles/import/mesh_tiles.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>
#include <utility>
#include <vector>

#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/import/mesh_faces.h"
#include "nef/mesh/mesh_check.h"
#include "nef/mesh/polygon/perturbed_turn.h"
#include "nef/tiles/cuts/region_division.h"
#include "nef/tiles/import/surface_in_region.h"

namespace nef {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

class MeshTiler {
 public:
  MeshTiler(const Mesh& mesh, std::vector<Triangle> triangles, const Tiling& tiling)
      : mesh_(mesh), triangles_(std::move(triangles)), tiling_(tiling) {
    places_.reserve(mesh.vertices.size());
    for (const Rational3& p : mesh.vertices) {
      places_.push_back(nearest_doubles(p));
    }
  }

  // Nothing if the triangles contradict each other.
  std::optional<TileRef> run(std::size_t most, const Monitor& monitor) {
    RegionDivision division(
        static_cast<std::uint32_t>(triangles_.size()),
        [this](std::uint32_t t, std::size_t axis) { return extent(t, axis); }, most);
    std::vector<TileRef> trees(division.parts().size());
    std::atomic<std::size_t> done = 0;
    parallel_for(trees.size(), monitor, [&](std::size_t i, const Monitor& own) {
      const Mesh faces = part(division.take_items(i));
      const Region& region = division.parts()[i].region;
      trees[i] =
          solid_in_region(faces, region, tiling_, own, [&] { return inside(inner_point(region)); }).value_or(TileRef{});
      own.tell_progress("pieces of the mesh", ++done, trees.size());
    });
    const bool whole = std::all_of(trees.begin(), trees.end(), [](const TileRef& t) { return t.node != nullptr; });
    return whole ? std::optional(division.tree(trees)) : std::nullopt;
  }

 private:
  // Rounding to the nearest keeps order, so that what is strictly apart is apart.
  [[nodiscard]] std::array<double, 2> extent(std::uint32_t t, std::size_t axis) const {
    const auto [a, b, c] = triangles_[t];
    const auto [low, high] = std::minmax({places_[a][axis], places_[b][axis], places_[c][axis]});
    return {low, high};
  }

  [[nodiscard]] Mesh part(const std::vector<std::uint32_t>& triangles) const {
    std::vector<std::uint32_t> used;
    used.reserve(3 * triangles.size());
    for (const std::uint32_t t : triangles) used.insert(used.end(), triangles_[t].begin(), triangles_[t].end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    Mesh result;
    result.vertices.reserve(used.size());
    for (const std::uint32_t v : used) result.vertices.push_back(mesh_.vertices[v]);
    for (const std::uint32_t t : triangles) {
      Triangle face = triangles_[t];
      for (std::uint32_t& v : face) {
        v = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
      }
      result.push_face(face);
    }
    return result;
  }

  static Rational3 inner_point(const Region& region) {
    Rational3 result;
    for (std::size_t i = 0; i < 3; ++i) {
      const AxisPlane* low = region.low[i];
      const AxisPlane* high = region.high[i];
      if (low != nullptr && high != nullptr) {
        result[i] = (low->at + high->at) / 2;
      } else if (low != nullptr) {
        result[i] = low->at + 1;
      } else if (high != nullptr) {
        result[i] = high->at - 1;
      }
    }
    return result;
  }

  // Of a point that is not on the surface: how often the surface above it turns its back. O(n).
  [[nodiscard]] bool inside(const Rational3& p) const {
    const std::array<double, 3> place = nearest_doubles(p);
    int winding = 0;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (extent(t, 2)[1] < place[2]) continue;
      const auto [x_low, x_high] = extent(t, 0);
      const auto [y_low, y_high] = extent(t, 1);
      if (place[0] < x_low || place[0] > x_high || place[1] < y_low || place[1] > y_high) continue;
      winding += crossing(t, p);
    }
    return winding > 0;
  }

  // +1 where the upward ray from p leaves the solid, -1 where it enters, 0 where it does not meet the triangle.
  [[nodiscard]] int crossing(std::uint32_t t, const Rational3& p) const {
    const Rational3& a = mesh_.vertices[triangles_[t][0]];
    const Rational3& b = mesh_.vertices[triangles_[t][1]];
    const Rational3& c = mesh_.vertices[triangles_[t][2]];
    const int turned = perturbed_turn(a, b, p, 2);
    if (perturbed_turn(b, c, p, 2) != turned || perturbed_turn(c, a, p, 2) != turned) return 0;
    Rational3 u;
    Rational3 v;
    Rational3 w;
    for (std::size_t i = 0; i < 3; ++i) {
      u[i] = b[i] - a[i];
      v[i] = c[i] - a[i];
      w[i] = p[i] - a[i];
    }
    const Rational height =
        (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] + (u[0] * v[1] - u[1] * v[0]) * w[2];
    // Above the plane on the side of its normal, which looks up if the triangle turns to the left.
    return sgn(height) * turned < 0 ? turned : 0;
  }

  const Mesh& mesh_;
  std::vector<Triangle> triangles_;
  const Tiling& tiling_;
  std::vector<std::array<double, 3>> places_;  // of the vertices, each coordinate the nearest double
};

// What is wrong with the mesh, but for what tiles can be made in spite of; each kind once.
bool is_plain(const Mesh& mesh, const MeshSurface& surface, bool& inside_out, const Monitor& monitor) {
  monitor.tell_progress("self-intersections", 0, 0);
  for (const MeshProblem& problem :
       check_mesh(mesh, surface, {.max_per_kind = 1, .self_intersections = true}, monitor)) {
    inside_out = inside_out || problem.kind == MeshProblemKind::kInsideOut;
    switch (problem.kind) {
      case MeshProblemKind::kNonPlanarFace:
      case MeshProblemKind::kIsolatedVertex:
      case MeshProblemKind::kInsideOut:
        continue;
      default:
        return false;
    }
  }
  return true;
}

// As from_mesh notes them.
void note_triangulated(const Mesh& mesh, const MeshSurface& surface, Messages& notes) {
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (surface.planar[f]) continue;
    notes.push_back(not_planar_text(mesh, f) + " and was triangulated");
  }
}

}  // namespace

TiledPolyhedron tiles_from_mesh(const Mesh& mesh, const MeshOptions& options, const Tiling& tiling, Messages* messages,
                                std::size_t piece) {
  const auto whole = [&] { return TiledPolyhedron(from_mesh(mesh, options, messages), tiling, options.monitor); };
  if (mesh.face_count() < piece || options.as_surface || options.strict) return whole();
  Messages notes;
  std::vector<Triangle> triangles;
  bool inside_out = false;
  {
    const MeshSurface surface(mesh, options.monitor);
    if (!is_plain(mesh, surface, inside_out, options.monitor)) return whole();
    note_triangulated(mesh, surface, notes);
    triangles = surface.triangles;
  }
  if (inside_out) {
    for (Triangle& t : triangles) std::swap(t[1], t[2]);
    notes.emplace_back(kTurnedOver);
  }
  const std::optional<TileRef> tree = MeshTiler(mesh, std::move(triangles), tiling).run(piece, options.monitor);
  if (!tree) return whole();  // which tells what is wrong
  if (messages != nullptr) messages->insert(messages->end(), notes.begin(), notes.end());
  return {*tree, tiling};
}

}  // namespace nef
