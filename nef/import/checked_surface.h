// SPDX-License-Identifier: Apache-2.0
//
// The second step from a mesh to a solid: mesh -> checked surface -> solid.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/construct/crossings.h"
#include "nef/mesh/mesh.h"
#include "nef/mesh/mesh_check.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/surface/surface_contacts.h"

namespace nef {

/// A mesh that is refused: what() is the problem and, at the end, what the user can do about it.
class RefusedMesh : public InputError {
 public:
  RefusedMesh(const std::string& problem, const std::string& advice)
      : InputError(problem + advice), problem_(problem) {}

  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  std::string problem_;
};

/// What a message about a mesh that crosses itself ends with: the rule that takes it.
std::string advice_to_unite();

/// The surface of a mesh that was looked at: solids are made of nothing else, unless it is refused. Its faces name
/// vertices that exist and have areas (those without area are known, and left out later), its edges are run through
/// equally often in both directions (by Crossings::kOdd an even number of times, by kOutside and kGuess in any way),
/// and no two faces cross or overlap unless a rule says what becomes of them. What is left to find out is how its
/// components lie to each other.
class CheckedSurface {
 public:
  /// How much is looked at.
  enum class Extent {
    kAll,          ///< everything
    kNoCrossings,  ///< all but faces that meet otherwise than in common vertices and edges: the caller knows of none
  };

  /// `known` are the contacts of the faces, if somebody has looked for them. The mesh must outlive this object.
  /// O(n log n) for meshes whose faces meet few others.
  CheckedSurface(const Mesh& mesh, Extent extent, Crossings rule, const Monitor& monitor, KnownContacts known = {});

  /// It has a problem that the rule has no answer to.
  [[nodiscard]] bool is_refused() const { return refused_ != nullptr; }

  /// Throws RefusedMesh with the first such problem, if there is one; where another rule has an answer, the message
  /// says so.
  void require_legal(const Monitor& monitor);

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  [[nodiscard]] const MeshSurface& surface() const { return *surface_; }

  /// Faces meet otherwise than in common vertices and edges, or would without the faces that have no area, or solids
  /// that share an edge do not lie beside each other.
  [[nodiscard]] bool in_contact() const { return in_contact_; }

  /// How faces meet otherwise than in common vertices and edges; nothing if that was not looked at, as what is refused
  /// for another reason may be.
  [[nodiscard]] const KnownContacts& contacts() const { return contacts_; }

  /// The volume is negative: the faces are clockwise as seen from outside.
  [[nodiscard]] bool inside_out() const { return inside_out_; }

  /// Some edge has an odd number of faces, as at holes and inner walls: a rule decides which faces count.
  [[nodiscard]] bool is_unpaired() const { return unpaired_; }

  [[nodiscard]] std::size_t faces_without_area() const { return faces_without_area_; }

  /// Faces of components that enclose nothing, as each face has another one on its back (count_cancelled). O(n log n)
  /// if there are faces back to back.
  [[nodiscard]] std::size_t cancelled_faces() const;

  /// What was found of the mesh.
  struct Found {
    std::unique_ptr<const MeshSurface> surface;
    std::vector<FaceContact> contacts;
  };
  /// Hands it over.
  [[nodiscard]] Found take() && {
    return {std::move(surface_), contacts_ ? *std::move(contacts_) : std::vector<FaceContact>()};
  }

  /// Gives the memory of the surface back, which is as large as what is made of it.
  void release() { surface_.reset(); }

 private:
  const Mesh* mesh_;
  Extent extent_;
  Crossings rule_;
  std::unique_ptr<const MeshSurface> surface_;
  KnownContacts contacts_;
  std::vector<MeshProblem> problems_;     // one of each kind at most
  const MeshProblem* refused_ = nullptr;  // the first that the rule has no answer to
  bool in_contact_ = false;
  bool inside_out_ = false;
  bool unpaired_ = false;
  std::size_t faces_without_area_ = 0;
};

}  // namespace nef
