// SPDX-License-Identifier: Apache-2.0
//
// Vertices become points along a space-filling curve, and faces follow by their first point, so that planes are in
// spatial order, too. The plane of a face comes from one of its triangles, whose orientation is that of the face.
#include "nef/import/mesh_faces.h"

#include <algorithm>
#include <utility>

#include "nef/base/error.h"
#include "nef/base/fast_path.h"
#include "nef/base/threads/group_by.h"
#include "nef/base/threads/parallel.h"
#include "nef/geometry/plane_finder.h"
#include "nef/mesh/mesh_check.h"
#include "nef/number/int128.h"

namespace nef {

MeshFaces::MeshFaces(const Mesh& mesh, const MeshSurface& surface, const MeshOptions& options, Messages* messages)
    : mesh_(mesh),
      surface_(surface),
      options_(options),
      messages_(messages),
      rank_(mesh.vertices.size()),
      point_of_(mesh.vertices.size()) {
  order_.reserve(surface.curve.size());
  for (const SpatialKey& key : surface.curve) {
    if (surface.place[key.index] != key.index) continue;
    rank_[key.index] = static_cast<std::uint32_t>(order_.size());
    order_.push_back(key.index);
  }
}

SolidFaces solid_faces(const CheckedSurface& checked, const MeshOptions& options, Messages* messages) {
  MeshFaces faces(checked.mesh(), checked.surface(), options, messages);
  faces.reverse_ = checked.inside_out();
  if (checked.inside_out() && messages != nullptr) messages->emplace_back(kTurnedOver);
  return faces.collect({});
}

Complex MeshFaces::surface(std::span<const std::uint32_t> faces) {
  return make_surface(collect(faces), 1, options_.monitor);
}

Complex MeshFaces::oriented_surface(std::span<const std::uint32_t> faces) {
  return make_oriented_surface(collect(faces), options_.monitor);
}

// Some faces with planes in a table of their own; points and names are those of all.
class MeshFaces::Block {
 public:
  Block(const MeshFaces& all, std::span<const std::uint32_t> faces);

  Listed take() { return {std::move(f_), std::move(messages_)}; }

 private:
  void add_face(std::uint32_t face);
  [[nodiscard]] std::array<std::uint32_t, 3> corners_of(std::uint32_t triangle) const;
  void push(std::span<const std::uint32_t> ring, PlaneId plane);
  PlaneId plane_of_triangle(std::span<const std::uint32_t> t);
  void add_triangles(std::uint32_t face);
  void push_triangles(std::uint32_t face);

  const MeshFaces& all_;
  SolidFaces f_;
  Messages messages_;
  std::vector<std::uint32_t> ring_;
  PlaneFinder finder_;
};

SolidFaces MeshFaces::collect(std::span<const std::uint32_t> faces) {
  f_ = {};
  add_points(faces.empty() ? order_ : places_of(faces));
  add_faces(in_order_of_points(faces));
  const std::vector<std::uint32_t> rows = f_.planes.merge_equal(for_vertices(f_.planes.size(), options_.monitor));
  if (!rows.empty()) {
    for (PlaneId& plane : f_.plane) plane = plane.in_row(rows[plane.row()]);
  }
  return std::move(f_);
}

void MeshFaces::add_faces(std::span<const std::uint32_t> faces) {
  constexpr std::size_t kBlock = 8192;
  join(blocks_of(faces.size(), kBlock, for_vertices(faces.size(), options_.monitor),
                 [&](std::size_t first, std::size_t last, const Monitor&) {
                   return Block(*this, faces.subspan(first, last - first)).take();
                 }));
}

void MeshFaces::join(std::vector<Listed>&& blocks) {
  std::size_t faces = 0;
  std::size_t corners = 0;
  std::size_t limbs = 0;
  for (const Listed& block : blocks) {
    faces += block.faces.plane.size();
    corners += block.faces.corners.size();
    limbs += block.faces.planes.limbs();
    if (messages_ != nullptr) messages_->insert(messages_->end(), block.messages.begin(), block.messages.end());
  }
  SolidFaces& all = blocks.front().faces;
  if (blocks.size() > 1) {
    all.plane.reserve(faces);
    all.planes.reserve(faces, limbs);
    all.begin.reserve(faces + 1);
    all.corners.reserve(corners);
  }
  for (std::size_t i = 1; i < blocks.size(); ++i) {
    const SolidFaces block = std::move(blocks[i].faces);
    const auto rows = static_cast<std::uint32_t>(all.planes.size());
    const auto before = static_cast<std::uint32_t>(all.corners.size());
    all.planes.append_new(block.planes, 0, block.planes.size());
    for (const PlaneId plane : block.plane) all.plane.push_back(plane.in_row(plane.row() + rows));
    for (const std::uint32_t end : std::span(block.begin).subspan(1)) all.begin.push_back(before + end);
    all.corners.insert(all.corners.end(), block.corners.begin(), block.corners.end());
  }
  f_.planes = std::move(all.planes);
  f_.plane = std::move(all.plane);
  f_.begin = std::move(all.begin);
  f_.corners = std::move(all.corners);
}

// Faces by their first point, so that their planes, too, come in spatial order; those without corners are left out.
std::vector<std::uint32_t> MeshFaces::in_order_of_points(std::span<const std::uint32_t> faces) const {
  const auto count = static_cast<std::uint32_t>(faces.empty() ? mesh_.face_count() : faces.size());
  const Monitor monitor = for_vertices(count, options_.monitor);
  const auto face = [&](std::size_t i) { return faces.empty() ? static_cast<std::uint32_t>(i) : faces[i]; };
  const std::vector<std::uint32_t> first_point = vector_of(count, monitor, [&](std::size_t i) {
    std::uint32_t result = 0xffffffffU;
    for (const std::uint32_t v : mesh_.face(face(i))) result = std::min(result, point_of_[surface_.place[v]]);
    return result;
  });
  const auto each_face = [&](const auto& visit) {
    for (std::uint32_t i = 0; i < count; ++i) visit(first_point[i], i);
  };
  std::vector<std::uint32_t> order(count);
  const auto put = [&](std::uint32_t place, std::uint32_t i) { order[place] = face(i); };
  order.resize(group_by(f_.points.size(), each_face, put, monitor).back());
  return order;
}

// Those of the faces, along the curve.
std::vector<std::uint32_t> MeshFaces::places_of(std::span<const std::uint32_t> faces) const {
  std::vector<std::uint32_t> ranks;
  std::vector<bool> known(order_.size(), false);
  for (const std::uint32_t face : faces) {
    for (const std::uint32_t v : mesh_.face(face)) {
      const std::uint32_t rank = rank_[surface_.place[v]];
      if (!known[rank]) ranks.push_back(rank);
      known[rank] = true;
    }
  }
  std::sort(ranks.begin(), ranks.end());
  for (std::uint32_t& rank : ranks) rank = order_[rank];
  return ranks;
}

void MeshFaces::add_points(std::span<const std::uint32_t> places) {
  const PointTable& known = surface_.points.table();
  f_.points.reserve(places.size(), known.limbs());
  integers_.clear();
  if (known.size() == 0) {
    integers_.reserve(places.size());
    for (const std::uint32_t v : places) integers_.push_back(surface_.points.integers(v));
  }
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const std::uint32_t v = places[i];
    point_of_[v] = (known.size() > 0 ? f_.points.push_from(known, PointId{v}) : push_small_point(integers_[i])).index();
  }
  f_.names.assign(places.begin(), places.end());
}

// A vertex with small integers over the common denominator.
PointId MeshFaces::push_small_point(const std::array<std::int64_t, 3>& x) {
  std::int64_t common = surface_.points.denominator();
  for (const std::int64_t value : x) common = common_divisor(common, value);
  return f_.points.push_homogeneous(
      std::array<Int128, 7>{x[0] / common, x[1] / common, x[2] / common, surface_.points.denominator() / common});
}

MeshFaces::Block::Block(const MeshFaces& all, std::span<const std::uint32_t> faces) : all_(all) {
  std::size_t corners = 0;
  for (const std::uint32_t face : faces) corners += all_.mesh_.face(face).size();
  f_.plane.reserve(faces.size());
  f_.planes.reserve(faces.size());
  f_.begin.reserve(faces.size() + 1);
  f_.corners.reserve(corners);
  f_.planes.merge_later();
  constexpr std::size_t kAhead = 12;  // faces of a mesh without order lie anywhere in memory
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (i + kAhead < faces.size()) __builtin_prefetch(all_.mesh_.face(faces[i + kAhead]).data());
    add_face(faces[i]);
  }
}

void MeshFaces::Block::add_face(std::uint32_t face) {
  if (all_.surface_.defects[face] == FaceDefect::kNoArea) return;
  NEF_ASSERT(all_.surface_.defects[face] == FaceDefect::kNone);
  const std::span<const std::uint32_t> corners = all_.mesh_.face(face);
  ring_.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) ring_[i] = all_.point_of_[all_.surface_.place[corners[i]]];
  if (all_.reverse_) std::reverse(ring_.begin(), ring_.end());
  if (ring_.size() == 3 && !all_.surface_.irregular[face]) {
    const PlaneId plane = plane_of_triangle(ring_);
    if (plane.valid()) push(ring_, plane);
  } else if (!all_.surface_.planar[face]) {
    add_triangles(face);
  } else if (all_.surface_.irregular[face]) {
    push_triangles(face);
  } else {
    // Any triangle that it was cut into has its orientation.
    const PlaneId plane = plane_of_triangle(corners_of(all_.surface_.triangle_begin[face]));
    push(ring_, plane);
  }
}

// A triangle of the surface as points.
std::array<std::uint32_t, 3> MeshFaces::Block::corners_of(std::uint32_t triangle) const {
  std::array<std::uint32_t, 3> t = all_.surface_.triangles[triangle];
  for (std::uint32_t& v : t) v = all_.point_of_[v];
  if (all_.reverse_) std::swap(t[1], t[2]);
  return t;
}

void MeshFaces::Block::push(std::span<const std::uint32_t> ring, PlaneId plane) {
  f_.plane.push_back(plane);
  f_.corners.insert(f_.corners.end(), ring.begin(), ring.end());
  f_.begin.push_back(static_cast<std::uint32_t>(f_.corners.size()));
}

// No plane if the points are on one line.
PlaneId MeshFaces::Block::plane_of_triangle(std::span<const std::uint32_t> t) {
  if (kFastPaths && !all_.integers_.empty()) {
    const std::optional<PlaneId> plane =
        PlaneFinder::through(f_.planes, {all_.integers_[t[0]], all_.integers_[t[1]], all_.integers_[t[2]]},
                             all_.surface_.points.denominator());
    if (plane) return *plane;
  }
  return finder_.through(f_.planes, all_.f_.points, PointId{t[0]}, PointId{t[1]}, PointId{t[2]});
}

// A face that is not planar, as the check has cut it.
void MeshFaces::Block::add_triangles(std::uint32_t face) {
  const std::string name = not_planar_text(all_.mesh_, face);
  if (all_.options_.strict) throw InputError(name + "; triangulate it, or read the mesh without --strict");
  if (all_.messages_ != nullptr) messages_.push_back(name + " and was triangulated");
  push_triangles(face);
}

void MeshFaces::Block::push_triangles(std::uint32_t face) {
  for (std::uint32_t i = all_.surface_.triangle_begin[face]; i < all_.surface_.triangle_begin[face + 1]; ++i) {
    const std::array<std::uint32_t, 3> t = corners_of(i);
    const PlaneId plane = plane_of_triangle(t);
    if (plane.valid()) push(t, plane);
  }
}

}  // namespace nef
