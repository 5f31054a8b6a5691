// SPDX-License-Identifier: Apache-2.0
//
// Directed edges are matched with their opposites in a hash table; that gives all adjacencies. Normals and directions
// of edges are integers without a common factor: from differences of vertices if these have a short common denominator,
// else from the planes, whose numbers are shorter then. The vertex that is extreme in a direction is found by climbing
// along edges, which ends in it because the solid is convex.
#include "apps/minkowski/convex/normal_diagram.h"

#include <unordered_map>
#include <utility>

#include "nef/base/error.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"

namespace nef::minkowski {
namespace {

// A positive multiple of b - a in integers.
Integer3 integer_difference(const Rational3& a, const Rational3& b) { return primitive(minus(b, a)); }

}  // namespace

NormalDiagram::NormalDiagram(const ConvexCell& cell) : cell_(&cell) {
  NEF_ASSERT(cell.dimension == 3);
  connect();
  set_directions();
}

void NormalDiagram::connect() {
  const Mesh& mesh = cell_->mesh;
  const std::size_t corners = mesh.corners.size();
  next_.resize(corners);
  twin_.assign(corners, 0);
  face_.resize(corners);
  line_.resize(corners);
  corner_at_.assign(mesh.vertices.size(), 0);
  std::unordered_map<std::uint64_t, std::uint32_t> open;
  open.reserve(corners);
  std::uint32_t lines = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t first = mesh.face_begin[f];
    const std::uint32_t last = mesh.face_begin[f + 1];
    for (std::uint32_t c = first; c < last; ++c) {
      face_[c] = f;
      next_[c] = c + 1 < last ? c + 1 : first;
      const std::uint64_t from = mesh.corners[c];
      const std::uint64_t to = mesh.corners[next_[c]];
      corner_at_[from] = c;
      if (const auto it = open.find(to << 32U | from); it != open.end()) {
        twin_[c] = it->second;
        twin_[it->second] = c;
        line_[c] = line_[it->second];
        open.erase(it);
      } else {
        open.emplace(from << 32U | to, c);
        line_[c] = lines++;
      }
    }
  }
  NEF_ASSERT(open.empty());
}

// If the vertices have a short common denominator (input meshes: powers of two or ten), edges come
// from differences of integers and normals from two edges. Otherwise (vertices that planes cut out)
// the planes have the short numbers: normals are reduced first, edges are where two faces meet.
void NormalDiagram::set_directions() {
  const Mesh& mesh = cell_->mesh;
  Integer common = 1;
  constexpr std::size_t kShort = 256;
  bool is_short = true;
  for (const Rational3& p : mesh.vertices) {
    for (const Rational& x : p) {
      if (mpz_divisible_p(common.get_mpz_t(), x.get_den_mpz_t()) == 0) common = lcm(common, x.get_den());
    }
    if (mpz_sizeinbase(common.get_mpz_t(), 2) > kShort) {
      is_short = false;
      break;
    }
  }
  std::vector<Integer3> scaled;
  if (is_short) {
    scaled.resize(mesh.vertices.size());
    Integer factor;
    for (std::size_t v = 0; v < scaled.size(); ++v) {
      for (std::size_t i = 0; i < 3; ++i) {
        mpz_divexact(factor.get_mpz_t(), common.get_mpz_t(), mesh.vertices[v][i].get_den_mpz_t());
        scaled[v][i] = factor * mesh.vertices[v][i].get_num();
      }
    }
  }
  const auto edge = [&](std::uint32_t a, std::uint32_t b) {
    if (!is_short) return integer_difference(mesh.vertices[a], mesh.vertices[b]);
    return Integer3{Integer(scaled[b][0] - scaled[a][0]), Integer(scaled[b][1] - scaled[a][1]),
                    Integer(scaled[b][2] - scaled[a][2])};
  };
  std::vector<Integer3> normals(mesh.face_count());
  normals_.reserve(normals.size());
  for (std::uint32_t f = 0; f < normals.size(); ++f) {
    const auto face = mesh.face(f);
    if (!cell_->normals.empty()) {
      normals[f] = cell_->normals[f];
    } else {
      normals[f] = cross(edge(face[0], face[1]), edge(face[1], face[2]));
      normals[f] = primitive(std::move(normals[f]));
    }
    normals_.push_back(Direction::exact(normals[f][0], normals[f][1], normals[f][2]));
  }
  lines_.reserve(corner_count() / 2);
  for (std::uint32_t c = 0; c < corner_count(); ++c) {
    if (twin_[c] < c) continue;
    // Counterclockwise about the outward normal of its left face, an edge runs along n_left x n_right.
    const Integer3 d = is_short ? edge(source(c), target(c)) : cross(normals[face_[c]], normals[face_[twin_[c]]]);
    lines_.push_back(Direction::exact(d[0], d[1], d[2]));
  }
}

std::uint32_t NormalDiagram::extreme_vertex(const Direction& n, std::uint32_t start, const Monitor& monitor) const {
  std::uint32_t v = start;
  for (bool moved = true; moved;) {
    moved = false;
    const std::uint32_t first = corner_at_[v];
    std::uint32_t c = first;
    do {
      if (sign_along(c, n, monitor) > 0) {
        v = target(c);
        moved = true;
        break;
      }
      c = next_around(c);
    } while (c != first);
  }
  return v;
}

NormalDiagram::Extreme NormalDiagram::extreme(const Direction& n, std::uint32_t start, const Monitor& monitor) const {
  Extreme result;
  result.vertex = extreme_vertex(n, start, monitor);
  const std::uint32_t first = corner_at_[result.vertex];
  std::uint32_t c = first;
  do {
    if (sign_along(c, n, monitor) == 0) {
      // Of two such edges of one vertex, the one that starts the face has it to its left, and the
      // other is that face's last edge, backwards.
      const bool starts_face = result.dimension == 1 && face_[c] == face_[twin_[result.corner]];
      if (result.dimension == 0 || starts_face) result.corner = c;
      ++result.dimension;
    }
    c = next_around(c);
  } while (c != first);
  NEF_ASSERT(result.dimension <= 2);
  return result;
}

}  // namespace nef::minkowski
