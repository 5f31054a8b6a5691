// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid/rigid_body.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "apps/minkowski/minkowski.h"
#include "nef/base/error.h"
#include "nef/geometry/vectors.h"
#include "nef/polyhedron.h"

namespace nef::planner {
namespace {

RigidBody::Piece piece_of(const Mesh& mesh, bool flat) {
  RigidBody::Piece piece;
  piece.flat = flat;
  piece.mesh.vertices = mesh.vertices;
  for (const Rational3& v : mesh.vertices) {
    piece.points.push_back(to_vector(v));
    // A few roundings: the coordinates, two sums.
    piece.reach = std::max(piece.reach, piece.points.back().lpNorm<1>() * (1 + 0x1p-50));
  }
  Vector3d low = piece.points.front();
  Vector3d high = low;
  for (const Vector3d& p : piece.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  piece.diameter = (high - low).norm() + 0x1p-48 * piece.reach;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<Rational3> corners;
    for (const std::uint32_t corner : mesh.face(f)) corners.push_back(mesh.vertices[corner]);
    const Rational3 normal = normal_of(std::span<const Rational3>(corners));
    if (is_zero(normal)) continue;  // a triangle that is a segment: its vertices say all
    piece.mesh.push_face(mesh.face(f));
    piece.normals.push_back(direction_of(normal));
  }
  return piece;
}

}  // namespace

RigidBody RigidBody::of_set(const Polyhedron& set, const Monitor& monitor) {
  if (set.is_empty() || !set.is_bounded()) throw InputError("a rigid body must be bounded and not empty");
  // Walls between the cells of a solid are no surfaces.
  const Polyhedron solid = set.is_regular() ? set : regularize(set, monitor);
  std::vector<Piece> pieces;
  for (const minkowski::ConvexCell& cell : minkowski::decompose(solid, monitor)) {
    if (cell.dimension == 3) pieces.push_back(piece_of(cell.mesh, false));
  }
  if (!set.is_regular()) {
    for (const minkowski::ConvexCell& cell :
         minkowski::decompose(closure(subtract(set, solid, monitor), monitor), monitor)) {
      pieces.push_back(piece_of(cell.mesh, true));
    }
  }
  return RigidBody(std::move(pieces));
}

RigidBody RigidBody::of_surface(const Mesh& mesh) {
  std::vector<Piece> pieces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    Mesh one;
    std::vector<std::uint32_t> ring;
    for (const std::uint32_t corner : mesh.face(f)) {
      ring.push_back(static_cast<std::uint32_t>(one.vertices.size()));
      one.vertices.push_back(mesh.vertices[corner]);
    }
    one.push_face(ring);
    pieces.push_back(piece_of(one, true));
  }
  if (pieces.empty()) throw InputError("a rigid body must have faces");
  return RigidBody(std::move(pieces));
}

RigidBody RigidBody::together(std::span<const RigidBody> bodies) {
  std::vector<Piece> pieces;
  for (const RigidBody& body : bodies) pieces.insert(pieces.end(), body.pieces_.begin(), body.pieces_.end());
  return RigidBody(std::move(pieces));
}

RigidBody::RigidBody(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
  if (pieces_.empty()) return;
  std::vector<std::uint32_t> order(pieces_.size());
  std::iota(order.begin(), order.end(), 0U);
  nodes_.reserve(2 * pieces_.size());
  nodes_.emplace_back();
  build(0, order);
}

void RigidBody::build(std::uint32_t node, std::span<std::uint32_t> members) {
  std::vector<Vector3d> points;
  for (const std::uint32_t member : members) {
    points.insert(points.end(), pieces_[member].points.begin(), pieces_[member].points.end());
  }
  OrientedBox box = box_around(points, Eigen::Matrix3d::Identity());
  const auto take_if_smaller = [&](const Eigen::Matrix3d& axes) {
    const OrientedBox other = box_around(points, axes);
    if (other.size() < box.size()) box = other;
  };
  if (members.size() > 1) {
    take_if_smaller(axes_of_scatter(points));
    nodes_[node].box = box;
    split(node, members);
    for (const std::uint32_t child : {0U, 1U}) take_if_smaller(nodes_[nodes_[node].first + child].box.axes);
  } else {
    const Piece& piece = pieces_[members.front()];
    for (std::size_t f = 0; f < piece.normals.size(); ++f) {
      std::vector<Vector3d> ring;
      for (const std::uint32_t corner : piece.mesh.face(f)) ring.push_back(points[corner]);
      take_if_smaller(axes_of_polygon(ring, piece.normals[f]));
    }
    if (piece.normals.empty()) take_if_smaller(axes_of_scatter(points));
    nodes_[node].first = members.front();
  }
  Node& made = nodes_[node];
  made.box = box;
  made.leaf = members.size() == 1;
  made.radius = box.half.norm() * (1 + 0x1p-40);
  made.reach = (box.centre.lpNorm<1>() + (box.axes.cwiseAbs() * box.half).sum()) * (1 + 0x1p-40);
}

// In the middle of the longest extent of the node's box.
void RigidBody::split(std::uint32_t node, std::span<std::uint32_t> members) {
  Eigen::Index longest = 0;
  nodes_[node].box.half.maxCoeff(&longest);
  const Vector3d axis = nodes_[node].box.axes.col(longest);
  std::vector<double> places(pieces_.size());
  for (const std::uint32_t member : members) {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (const Vector3d& p : pieces_[member].points) {
      low = std::min(low, axis.dot(p));
      high = std::max(high, axis.dot(p));
    }
    places[member] = low + high;
  }
  const std::size_t half = members.size() / 2;
  std::nth_element(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(half), members.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return std::pair(places[a], a) < std::pair(places[b], b); });
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = first;
  nodes_.resize(nodes_.size() + 2);
  build(first, members.subspan(0, half));
  build(first + 1, members.subspan(half));
}

}  // namespace nef::planner
