// SPDX-License-Identifier: Apache-2.0
//
// Meshes to solids: check, merge equal vertices, find the plane of every face, then draw each
// vertex's sphere map from the corners of the faces around it.
#include <algorithm>
#include <cmath>

#include "nef/base/error.h"
#include "nef/base/union_find.h"
#include "nef/construct/construct.h"
#include "nef/construct/mesh_check.h"
#include "nef/construct/mesh_points.h"
#include "nef/construct/solid.h"
#include "nef/construct/triangulate.h"
#include "nef/construct/vertex_merger.h"

namespace nef {
namespace {

class MeshSolid {
 public:
  MeshSolid(const Mesh& mesh, const MeshOptions& options, Messages* messages)
      : mesh_(mesh), options_(options), messages_(messages), representative_(merge_equal(mesh.vertices)) {}

  // `faces` selects some faces of the mesh; all if it is empty. `reverse` turns them over.
  Complex build(std::span<const std::uint32_t> faces, bool reverse) {
    f_ = {};
    reverse_ = reverse;
    number_points();
    const std::size_t count = faces.empty() ? mesh_.face_count() : faces.size();
    f_.plane.reserve(count);
    f_.planes.reserve(count);
    for (std::size_t i = 0; i < count; ++i) add_face(faces.empty() ? static_cast<std::uint32_t>(i) : faces[i]);
    return make_solid(std::move(f_), {1, 1, 0});
  }

  // Faces that share a vertex belong together.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> components() const {
    UnionFind vertices(mesh_.vertices.size());
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      for (const std::uint32_t v : mesh_.face(f)) vertices.unite(representative_[v], representative_[mesh_.face(f)[0]]);
    }
    std::vector<std::uint32_t> number(mesh_.vertices.size(), 0xffffffffU);
    std::vector<std::vector<std::uint32_t>> result;
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      if (mesh_.face(f).empty()) continue;
      std::uint32_t& n = number[vertices.find(representative_[mesh_.face(f)[0]])];
      if (n == 0xffffffffU) {
        n = static_cast<std::uint32_t>(result.size());
        result.emplace_back();
      }
      result[n].push_back(f);
    }
    return result;
  }

 private:
  using Integers = std::array<Integer, 3>;

  void number_points() {
    if (point_of_.empty()) {
      point_of_.resize(mesh_.vertices.size());
      points_.reserve(mesh_.vertices.size());
      for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
        point_of_[v] = representative_[v] == v ? points_.push(mesh_.vertices[v]).value : point_of_[representative_[v]];
      }
    }
    f_.points = points_;
  }

  void add_face(std::uint32_t face) {
    ring_.clear();
    for (const std::uint32_t v : mesh_.face(face)) {
      const std::uint32_t p = point_of_[v];
      if (ring_.empty() || (ring_.back() != p && ring_.front() != p)) ring_.push_back(p);
    }
    if (ring_.size() < 3) return;
    if (reverse_) std::reverse(ring_.begin(), ring_.end());
    if (ring_.size() == 3) {
      push(ring_, plane_of_triangle(ring_));
      return;
    }
    const Integers area = vector_area();
    if (area[0] == 0 && area[1] == 0 && area[2] == 0) return;
    const PlaneId plane = plane_through(area, ring_[0]);
    const bool planar = std::all_of(ring_.begin(), ring_.end(), [&](std::uint32_t p) {
      return side_of_plane(f_.planes, plane, f_.points, PointId{p}) == 0;
    });
    if (planar) {
      push(ring_, plane);
    } else {
      triangulate(face, area);
    }
  }

  void push(std::span<const std::uint32_t> ring, PlaneId plane) {
    f_.plane.push_back(plane);
    f_.corners.insert(f_.corners.end(), ring.begin(), ring.end());
    f_.begin.push_back(static_cast<std::uint32_t>(f_.corners.size()));
  }

  // (b - a) x (c - a) up to a positive factor, and the offset that puts a on it.
  PlaneId plane_of_triangle(std::span<const std::uint32_t> t) {
    const auto difference = [&](std::uint32_t p, std::size_t i, Integer& out) {
      mpz_mul(out.get_mpz_t(), f_.points.coordinate(PointId{p}, i), f_.points.coordinate(PointId{t[0]}, 3));
      mpz_submul(out.get_mpz_t(), f_.points.coordinate(PointId{t[0]}, i), f_.points.coordinate(PointId{p}, 3));
    };
    for (std::size_t i = 0; i < 3; ++i) {
      difference(t[1], i, u_[i]);
      difference(t[2], i, v_[i]);
    }
    mpz_ptr offset = offset_.get_mpz_t();
    mpz_set_ui(offset, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      mpz_ptr n = n_[i].get_mpz_t();
      mpz_mul(n, u_[j].get_mpz_t(), v_[k].get_mpz_t());
      mpz_submul(n, u_[k].get_mpz_t(), v_[j].get_mpz_t());
    }
    // Short normals first: a common factor of the differences would go through all that follows.
    Integer& divisor = u_[0];
    mpz_gcd(divisor.get_mpz_t(), n_[0].get_mpz_t(), n_[1].get_mpz_t());
    mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), n_[2].get_mpz_t());
    for (std::size_t i = 0; i < 3; ++i) {
      mpz_ptr n = n_[i].get_mpz_t();
      if (divisor > 1) mpz_divexact(n, n, divisor.get_mpz_t());
      mpz_submul(offset, n, f_.points.coordinate(PointId{t[0]}, i));
      mpz_mul(n, n, f_.points.coordinate(PointId{t[0]}, 3));
    }
    return f_.planes.intern(n_[0], n_[1], n_[2], offset_);
  }

  // The plane of a normal through a point.
  PlaneId plane_through(const Integers& normal, std::uint32_t p) {
    Integer offset;
    Integers n = normal;
    for (std::size_t i = 0; i < 3; ++i) {
      mpz_submul(offset.get_mpz_t(), normal[i].get_mpz_t(), f_.points.coordinate(PointId{p}, i));
      mpz_mul(n[i].get_mpz_t(), n[i].get_mpz_t(), f_.points.coordinate(PointId{p}, 3));
    }
    return f_.planes.intern(n[0], n[1], n[2], offset);
  }

  // The vector area of the ring up to a positive factor: the same denominator for all corners.
  [[nodiscard]] Integers vector_area() const {
    Integer common = 1;
    for (const std::uint32_t p : ring_) {
      mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), f_.points.coordinate(PointId{p}, 3));
    }
    Integer factor;
    const auto scaled = [&](std::uint32_t p, Integers& out) {
      mpz_divexact(factor.get_mpz_t(), common.get_mpz_t(), f_.points.coordinate(PointId{p}, 3));
      for (std::size_t k = 0; k < 3; ++k) {
        mpz_mul(out[k].get_mpz_t(), f_.points.coordinate(PointId{p}, k), factor.get_mpz_t());
      }
    };
    Integers origin;
    Integers u;
    Integers v;
    Integers area;
    scaled(ring_[0], origin);
    for (std::size_t i = 1; i < ring_.size(); ++i) {
      scaled(ring_[i], v);
      for (std::size_t k = 0; k < 3; ++k) v[k] -= origin[k];
      for (std::size_t k = 0; k < 3 && i > 1; ++k) {
        mpz_addmul(area[k].get_mpz_t(), u[(k + 1) % 3].get_mpz_t(), v[(k + 2) % 3].get_mpz_t());
        mpz_submul(area[k].get_mpz_t(), u[(k + 2) % 3].get_mpz_t(), v[(k + 1) % 3].get_mpz_t());
      }
      std::swap(u, v);
    }
    return area;
  }

  void triangulate(std::uint32_t face, const Integers& area) {
    const std::string name =
        "face " + std::to_string(face) + " is not planar (off by " + std::to_string(face_deviation(mesh_, face)) + ")";
    if (options_.strict) throw InputError(name + "; triangulate it, or read the mesh without --strict");
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (abs(area[i]) > abs(area[axis])) axis = i;
    }
    if (!mesh_points_) mesh_points_ = std::make_unique<MeshPoints>(points_);
    Triangulator triangulator(*mesh_points_);
    std::vector<Triangulator::Triangle> triangles;
    if (!triangulator.triangulate(std::span<const std::uint32_t>(ring_), axis, sgn(area[axis]), triangles)) {
      throw InputError(name + " and crosses itself when projected, so it cannot be triangulated; split it");
    }
    if (messages_ != nullptr && !reverse_) messages_->push_back(name + " and was triangulated");
    for (const Triangulator::Triangle& t : triangles) {
      if (mesh_points_->collinear(t[0], t[1], t[2])) continue;
      push(t, plane_of_triangle(t));
    }
  }

  const Mesh& mesh_;
  MeshOptions options_;
  Messages* messages_;
  std::vector<std::uint32_t> representative_;
  std::vector<std::uint32_t> point_of_;  // vertex of the mesh -> point
  PointTable points_;
  std::unique_ptr<MeshPoints> mesh_points_;
  SolidFaces f_;
  bool reverse_ = false;
  std::vector<std::uint32_t> ring_;
  std::array<Integer, 3> u_, v_, n_;
  Integer offset_;
};

Polyhedron surface(const Mesh& mesh) {
  std::vector<Polyhedron> faces;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<Rational3> ring;
    for (const std::uint32_t v : mesh.face(f)) {
      if (v >= mesh.vertices.size()) {
        throw InputError("face " + std::to_string(f) + " names vertex " + std::to_string(v) + ", which does not exist");
      }
      if (ring.empty() || ring.back() != mesh.vertices[v]) ring.push_back(mesh.vertices[v]);
    }
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    if (ring.size() < 3) continue;
    bool planar = true;
    try {
      faces.push_back(make_polygon(std::span(&ring, 1)));
    } catch (const InputError&) {
      planar = false;
    }
    // Any triangulation will do for a set that is no boundary; a fan keeps the corners.
    for (std::size_t i = 1; !planar && i + 1 < ring.size(); ++i) {
      const Rational3 triangle[3] = {ring[0], ring[i], ring[i + 1]};
      faces.push_back(convex_hull(triangle));
    }
  }
  return unite_all(faces);
}

}  // namespace

Polyhedron from_mesh(const Mesh& mesh, const MeshOptions& options, Messages* messages) {
  if (options.as_surface) return surface(mesh);
  if (mesh.face_count() == 0) throw InputError("the mesh has no faces, so it bounds no solid");
  bool touching = false;
  if (options.check) {
    for (const MeshProblem& problem : check_mesh(mesh, {.max_per_kind = 1, .self_intersections = true})) {
      if (!problem.legal) throw InputError(problem.text);
      if (problem.kind == MeshProblemKind::kTouching) touching = true;
    }
  }
  MeshSolid solid(mesh, options, messages);
  std::vector<std::vector<std::uint32_t>> parts(1);
  if (touching) {
    // Parts that touch without sharing vertices meet in points that are no vertices of each other's
    // faces; a Boolean operation finds these. By parity, cavities stay cavities.
    parts = solid.components();
    if (parts.size() == 1) {
      throw InputError("the mesh touches itself where it has no common vertices; split the faces there, or the mesh");
    }
  }
  Polyhedron result;
  for (const std::vector<std::uint32_t>& part : parts) {
    Complex complex = solid.build(part, false);
    if (complex.vertex_count() > 0 && complex.volumes[0].mark == 1) {
      if (parts.size() == 1 && messages != nullptr) {
        messages->push_back("the faces were oriented inward and have been turned over");
      }
      complex = solid.build(part, true);
    }
    Polyhedron piece{std::move(complex)};
    result = result.is_empty() ? std::move(piece) : regularize(symmetric_difference(result, piece));
  }
  return result;
}

}  // namespace nef
