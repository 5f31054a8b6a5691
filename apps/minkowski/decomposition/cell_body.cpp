// SPDX-License-Identifier: Apache-2.0
//
// A map from the sorted vertices of a face to the bodies that have it finds neighbours with a whole face in common.
// Each body in turn absorbs neighbours as long as the union is convex, which is a test at each edge of the common face:
// the two faces that meet there lie in one plane, or the angle between them is less than a half-turn. Faces in one
// plane are joined along their edge, and vertices that are left in fewer than three planes disappear. Greedy: the
// number of bodies depends on their order.
#include "apps/minkowski/decomposition/cell_body.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "nef/base/error.h"
#include "nef/geometry/predicates.h"

namespace nef::minkowski {
namespace {

using Ring = std::vector<std::uint32_t>;

Ring starting_at(const Ring& ring, std::uint32_t vertex) {
  Ring result(ring);
  std::rotate(result.begin(), std::find(result.begin(), result.end(), vertex), result.end());
  return result;
}

class Merger {
 public:
  Merger(const Complex& complex, std::vector<CellBody>& bodies, const Monitor& monitor)
      : c_(complex), bodies_(bodies), monitor_(monitor) {}

  void run() {
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) enter(b);
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
      while (grow(b)) {
      }
    }
  }

 private:
  static Ring key(const Ring& ring) {
    Ring sorted(ring);
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }

  void enter(std::uint32_t b) {
    for (const CellBody::Face& face : bodies_[b].faces) holders_[key(face.ring)].push_back(b);
  }
  void leave(std::uint32_t b) {
    for (const CellBody::Face& face : bodies_[b].faces) {
      const auto at = holders_.find(key(face.ring));
      std::erase(at->second, b);
      if (at->second.empty()) holders_.erase(at);
    }
  }

  // Unites a body with one neighbour, if it can.
  bool grow(std::uint32_t b) {
    for (std::size_t f = 0; f < bodies_[b].faces.size(); ++f) {
      const Ring shared = key(bodies_[b].faces[f].ring);
      const std::vector<std::uint32_t>& holders = holders_.at(shared);
      if (holders.size() != 2) continue;
      const std::uint32_t other = holders[0] == b ? holders[1] : holders[0];
      std::size_t g = 0;
      while (key(bodies_[other].faces[g].ring) != shared) ++g;
      std::optional<CellBody> whole = united(bodies_[b], f, bodies_[other], g);
      if (!whole) continue;
      leave(b);
      leave(other);
      bodies_[b] = *std::move(whole);
      bodies_[other].faces.clear();
      enter(b);
      return true;
    }
    return false;
  }

  static std::size_t face_with_edge(const CellBody& body, std::uint32_t from, std::uint32_t to) {
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
      const Ring& ring = body.faces[f].ring;
      for (std::size_t k = 0; k < ring.size(); ++k) {
        if (ring[k] == from && ring[(k + 1) % ring.size()] == to) return f;
      }
    }
    throw Error("an edge of a convex cell has one face only");
  }

  // The union of two convex solids with a common face f = g is convex iff it is at each edge of that face.
  [[nodiscard]] std::optional<CellBody> united(const CellBody& a, std::size_t f, const CellBody& b,
                                               std::size_t g) const {
    const Ring& shared = a.faces[f].ring;
    std::map<std::size_t, std::vector<std::size_t>> partners;  // faces of a that go on in coplanar faces of b
    for (std::size_t k = 0; k < shared.size(); ++k) {
      const std::uint32_t u = shared[k];
      const std::uint32_t v = shared[(k + 1) % shared.size()];
      const std::size_t of_a = face_with_edge(a, v, u);
      const std::size_t of_b = face_with_edge(b, u, v);
      if (a.faces[of_a].plane == b.faces[of_b].plane) {
        partners[of_a].push_back(of_b);
        continue;
      }
      const Ring& ring = b.faces[of_b].ring;
      const auto w = std::find_if(ring.begin(), ring.end(), [u, v](std::uint32_t x) { return x != u && x != v; });
      if (side_of_plane(c_.planes, a.faces[of_a].plane, c_.points, PointId(*w), monitor_) > 0) return std::nullopt;
    }
    CellBody result;
    std::set<std::size_t> used = {g};
    for (std::size_t i = 0; i < a.faces.size(); ++i) {
      if (i == f) continue;
      CellBody::Face& face = result.faces.emplace_back(a.faces[i]);
      if (const auto at = partners.find(i); at != partners.end()) {
        // Two convex polygons of one plane meet in one edge at most.
        NEF_ASSERT(at->second.size() == 1);
        face.ring = spliced(face.ring, b.faces[at->second[0]].ring, shared);
        used.insert(at->second[0]);
      }
    }
    for (std::size_t i = 0; i < b.faces.size(); ++i) {
      if (used.count(i) == 0) result.faces.push_back(b.faces[i]);
    }
    drop_flat_vertices(result, shared);
    return result;
  }

  // Two rings along the edge that they have in common, which is one of `shared`.
  static Ring spliced(const Ring& a, const Ring& b, const Ring& shared) {
    for (std::size_t k = 0; k < shared.size(); ++k) {
      const std::uint32_t u = shared[k];
      const std::uint32_t v = shared[(k + 1) % shared.size()];
      Ring from_u = starting_at(a, u);
      const Ring from_v = starting_at(b, v);
      // In a the edge runs from v to u, in b from u to v.
      if (from_u.front() != u || from_u.back() != v || from_v.front() != v || from_v.back() != u) continue;
      from_u.insert(from_u.end(), from_v.begin() + 1, from_v.end() - 1);
      return from_u;
    }
    throw Error("two faces of one plane have no edge in common");
  }

  // Vertices of the common face that are inside an edge of the union.
  static void drop_flat_vertices(CellBody& body, const Ring& shared) {
    for (const std::uint32_t v : shared) {
      std::size_t planes = 0;
      for (const CellBody::Face& face : body.faces) {
        planes += std::find(face.ring.begin(), face.ring.end(), v) != face.ring.end() ? 1 : 0;
      }
      if (planes >= 3) continue;
      for (CellBody::Face& face : body.faces) std::erase(face.ring, v);
    }
  }

  const Complex& c_;
  std::vector<CellBody>& bodies_;
  Monitor monitor_;
  std::map<Ring, std::vector<std::uint32_t>> holders_;  // sorted corners of a face -> bodies with that face
};

}  // namespace

ConvexCell to_cell(const Complex& complex, const CellBody& body) {
  ConvexCell cell;
  cell.dimension = 3;
  std::unordered_map<std::uint32_t, std::uint32_t> number;
  Ring face;
  for (const CellBody::Face& f : body.faces) {
    face.clear();
    for (const std::uint32_t v : f.ring) {
      const auto [at, is_new] = number.try_emplace(v, static_cast<std::uint32_t>(cell.mesh.vertices.size()));
      if (is_new) cell.mesh.vertices.push_back(complex.points.rational(PointId(v)));
      face.push_back(at->second);
    }
    cell.mesh.push_face(face);
    Integer3& n = cell.normals.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) n[i] = complex.planes.oriented_coefficient(f.plane, i);
  }
  return cell;
}

std::vector<CellBody> merged(const Complex& complex, std::vector<CellBody> bodies, const Monitor& monitor) {
  if (bodies.size() < 2) return bodies;
  Merger(complex, bodies, monitor).run();
  std::erase_if(bodies, [](const CellBody& body) { return body.faces.empty(); });
  return bodies;
}

}  // namespace nef::minkowski
