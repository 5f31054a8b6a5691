// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/union/union_vertices.h"

#include <algorithm>
#include <optional>

namespace nef::minkowski {

UnionVertices::UnionVertices(std::span<const ConvexCell> cells, const RoundedCells& rounded, const BoxTree& boxes,
                             const Monitor& monitor)
    : cells_(cells),
      rounded_(rounded),
      boxes_(boxes),
      monitor_(monitor),
      exact_(cells, rounded, monitor),
      or_(2, 2, [](LabelId a, LabelId b) { return static_cast<LabelId>(a | b); }),
      result_(exact_.planes, monitor) {}

std::uint32_t UnionVertices::add_vertex(std::uint32_t cell, std::uint32_t vertex) {
  const PointId point = exact_.point(cell, vertex);
  const std::uint32_t name = meetings_.first_equal(point).index();
  if (name == point.index() && located_.insert(name).second) add_point(point);
  return name;
}

bool UnionVertices::is_on(std::uint32_t name, std::uint32_t face) const {
  const auto at = faces_at_.find(name);
  return at != faces_at_.end() && std::binary_search(at->second.begin(), at->second.end(), face);
}

// Points next to each other are mostly in one cell; that they sometimes are not costs time only.
std::uint64_t UnionVertices::grid_cell(const Double3& x) const {
  const double scale = 0x1p20 / std::max(rounded_.extent(), 0x1p-900);
  std::uint64_t key = 0;
  for (const double value : x) key = key << 21U | (static_cast<std::uint64_t>((value * scale) + 0x1p20) & 0x1fffffU);
  return key;
}

void UnionVertices::add_meeting(std::uint32_t f, std::uint32_t g, std::uint32_t h, const Double3& guess) {
  work_ += 50;
  const auto [first_near, last_near] = near_.equal_range(grid_cell(guess));
  for (auto at = first_near; at != last_near; ++at) {
    if (is_on(at->second, h) && is_on(at->second, f) && is_on(at->second, g)) return;
  }
  const std::array<PlaneId, 3> planes = {exact_.plane(f), exact_.plane(g), exact_.plane(h)};
  const std::optional<Meeting> meeting = meetings_.meet(planes);
  if (!meeting || meeting->planes_known) return;
  // Weights of exact steps against one evaluation of a form: measured, and they decide about time only.
  work_ += 1500 + 800 * meeting->limbs;
  if (meeting->is_new) add_point(meeting->point);
}

// A pyramid whose planes are among those of another one holds that one. Sums of cells that share a
// facet are full of these.
void UnionVertices::drop_covered(std::vector<CellLocation>& touched) {
  if (touched.size() < 2) return;
  using Boundary = ConvexCell::Boundary;
  struct Pyramid {
    std::vector<PlaneId> planes;  // sorted
    Boundary boundary;
    std::size_t index;
  };
  std::vector<Pyramid> pyramids;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    Pyramid& p = pyramids.emplace_back();
    for (const std::uint32_t f : touched[i].faces) p.planes.push_back(exact_.plane(f));
    std::sort(p.planes.begin(), p.planes.end());
    p.boundary = cells_[rounded_.cell_of_face(touched[i].faces[0])].boundary;
    p.index = i;
  }
  std::stable_sort(pyramids.begin(), pyramids.end(),
                   [](const Pyramid& a, const Pyramid& b) { return a.planes.size() < b.planes.size(); });
  std::vector<const Pyramid*> kept;
  std::vector<CellLocation> rest;
  for (const Pyramid& p : pyramids) {
    const bool covered = std::any_of(kept.begin(), kept.end(), [&p](const Pyramid* k) {
      const bool marks =
          k->boundary == Boundary::kClosed || (k->boundary == Boundary::kOpen && p.boundary == Boundary::kOpen);
      return marks && std::includes(p.planes.begin(), p.planes.end(), k->planes.begin(), k->planes.end());
    });
    if (covered) continue;
    kept.push_back(&p);
    rest.push_back(std::move(touched[p.index]));
  }
  touched = std::move(rest);
}

void UnionVertices::add_point(PointId point) {
  Box box;
  box.add_rounded(exact_.points.approximate(point));
  std::vector<CellLocation> touched;
  bool inside = false;
  boxes_.for_each_overlap(box, [&](std::uint32_t cell) {
    if (inside) return;
    work_ += 20;
    exact_.locate(cell, point, location_);
    if (location_.kind == CellLocation::Kind::kInside) inside = true;
    if (location_.kind == CellLocation::Kind::kBoundary) touched.push_back(location_);
  });
  if (inside || touched.empty()) return;
  work_ += 3000 * touched.size();
  std::vector<std::uint32_t>& faces = faces_at_[point.index()];
  for (const CellLocation& at : touched) faces.insert(faces.end(), at.faces.begin(), at.faces.end());
  std::sort(faces.begin(), faces.end());
  near_.emplace(grid_cell(exact_.points.approximate(point)), point.index());
  drop_covered(touched);
  SphereMapBuffer* map = &maps_[0];
  exact_.pyramid(touched[0], *map);
  SphereMapBuffer* next = &maps_[1];
  for (std::size_t i = 1; i < touched.size(); ++i) {
    exact_.pyramid(touched[i], maps_[2]);
    overlay_.overlay(exact_.planes, map->view(), maps_[2].view(), or_, *next, monitor_);
    std::swap(map, next);
  }
  result_.add(exact_.points, point, map->view());
}

Complex UnionVertices::finish() { return result_.finish(0); }

}  // namespace nef::minkowski
