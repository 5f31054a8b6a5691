// SPDX-License-Identifier: Apache-2.0
//
// The faces are sorted to their corners (a counting sort by vertex), and then each vertex makes its own sphere map: an
// edge of a face is a node, the corner of a face an arc between two nodes, with the inside on one side. Ordinary
// vertices, around which the faces form one ring, need no drawing: `PlainRing` reads their map off the planes. The
// others are drawn, sorted around each node and checked: inside and outside must alternate around every edge. The
// writer simplifies the maps, so coplanar neighbours become one facet, and links them.
//
// The infimaximal box and half-spaces are such solids, with corners at R (thesis 3.3).
#include "nef/construct/solid.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "nef/base/error.h"
#include "nef/base/fast_path.h"
#include "nef/base/threads/group_by.h"
#include "nef/base/threads/parallel.h"
#include "nef/boolean/overlay_complexes.h"
#include "nef/construct/face_links.h"
#include "nef/construct/plain_ring.h"
#include "nef/geometry/plane_finder.h"
#include "nef/geometry/vectors.h"
#include "nef/location/query_structure.h"
#include "nef/sphere_map/arrangement.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {
namespace {

// to - from as an integer vector, up to a positive factor (both finite or both with parts in R:
// then the part in R decides unless it is equal).
Direction vector_between(const PointTable& points, PointId from, PointId to) {
  Integer3 v;
  const std::array<IntegerView, 4> a = points.coordinates(from);
  const std::array<IntegerView, 4> b = points.coordinates(to);
  const auto subtract = [&](std::size_t i, mpz_srcptr of_from, mpz_srcptr of_to) {
    mpz_mul(v[i].get_mpz_t(), of_to, a[3]);
    mpz_submul(v[i].get_mpz_t(), of_from, b[3]);
  };
  if (!points.finite(from) || !points.finite(to)) {
    for (std::size_t i = 0; i < 3; ++i) subtract(i, points.coordinate(from, 4 + i), points.coordinate(to, 4 + i));
    if (!is_zero(v)) return Direction::exact(v[0], v[1], v[2]);
  }
  for (std::size_t i = 0; i < 3; ++i) subtract(i, a[i], b[i]);
  return Direction::exact(v[0], v[1], v[2]);
}

class SolidBuilder {
 public:
  SolidBuilder(SolidFaces&& faces, const SolidMarks& marks, const Monitor& monitor, SphereMaps maps = SphereMaps::kRead)
      : f_(std::move(faces)), marks_(marks), maps_(maps), monitor_(monitor) {}

  std::variant<Complex, Defect> run() {
    ComplexBuilder result(f_.planes, monitor_);
    collect_corners();
    reserve(result);
    const std::size_t plain_corners = add_vertices(result);
    std::optional<KnownLinks> known;
    if (2 * plain_corners > corners_.size() && !result.has_idle_box()) {
      result.drop_idle_planes();
      known = face_links(result.so_far(), {f_, corners_, first_, made_}, monitor_);
    }
    // Links need room.
    f_.points = PointTable();
    f_.names = {};
    f_.plane = {};
    f_.begin = {};
    f_.corners = {};
    corners_ = {};
    first_ = {};
    made_ = {};
    return known ? result.try_finish(marks_.outside, *std::move(known)) : result.try_finish(marks_.outside);
  }

 private:
  struct Spoke {
    std::uint32_t to;  // vertex
    PlaneId first;     // planes of faces around the edge; second differs from first
    PlaneId second;
    std::uint32_t arcs = 0;
    bool turns = false;       // faces in one plane, turned differently, meet here
    LabelId mark = kOutside;  // none yet
  };

  [[nodiscard]] std::span<FaceCorner> corners_of(std::uint32_t v) {
    return std::span(corners_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

  // Where marks are such that parts of a sphere map may be hidden, all are drawn.
  [[nodiscard]] bool reads_maps() const {
    const bool hides = marks_.outside == marks_.inside &&
                       (marks_.boundary == marks_.inside || marks_.flipped_boundary == marks_.inside);
    return kFastPaths && maps_ == SphereMaps::kRead && !hides;
  }

  // Puts the corners of plain vertices in the order of their ring.
  void read_rings(const Monitor& monitor) {
    if (!reads_maps()) return;
    constexpr std::size_t kBlock = 1024;
    parallel_for_ranges(bits_.size(), kBlock, monitor, [&](std::size_t first, std::size_t last, const Monitor&) {
      PlainRing ring(f_);
      for (auto v = static_cast<std::uint32_t>(first); v < last; ++v) {
        const std::span<FaceCorner> corners = corners_of(v);
        if (!ring.read(v, corners)) continue;
        std::copy(ring.corners().begin(), ring.corners().end(), corners.begin());
        bits_[v] = ring.bits();
      }
    });
  }

  // Returns how many corners are at plain vertices.
  std::size_t add_vertices(ComplexBuilder& result) {
    const auto count = static_cast<std::uint32_t>(f_.points.size());
    const Monitor monitor = for_vertices(count, monitor_);
    bits_.assign(count, 0);
    made_.assign(count, VertexId());
    std::size_t plain_corners = 0;
    read_rings(monitor);
    for (std::uint32_t v = 0; v < count; ++v) {
      const std::span<const FaceCorner> corners = corners_of(v);
      if (corners.empty()) continue;
      if (bits_[v] == 0) {
        add_drawn(result, v, corners);
      } else if (add_plain(result, v, corners)) {
        plain_corners += corners.size();
      }
    }
    return plain_corners;
  }

  void add_drawn(ComplexBuilder& result, std::uint32_t v, std::span<const FaceCorner> corners) {
    draw(v, corners);
    drawing_.sort_around_nodes(f_.planes, monitor_);
    check_sides(v);
    result.add_sorted(f_.points, PointId{v}, drawing_);
  }

  // False if nothing is added, since something was wrong before.
  bool add_plain(ComplexBuilder& result, std::uint32_t v, std::span<const FaceCorner> corners) {
    const VertexId next{result.so_far().vertex_count()};
    const VertexId like = known_.like(bits_[v]);
    if (like.valid()) {
      std::array<PlaneId, PlainRing::kMost> planes;
      for (std::size_t i = 0; i < corners.size(); ++i) planes[i] = f_.plane[corners[i].face];
      if (!result.append_like(f_.points, PointId{v}, like, std::span(planes).first(corners.size()))) return false;
    } else {
      PlainRing ring(f_);
      const bool is_plain = ring.read(v, corners);
      NEF_ASSERT(is_plain && ring.bits() == bits_[v]);
      ring.write(marks_, map_);
      if (!result.add(f_.points, PointId{v}, map_.view())) return false;
      known_.learn(bits_[v], next);
    }
    made_[v] = next;
    return true;
  }

  // As for faces that are all facets, which is as much as there can be of each.
  void reserve(ComplexBuilder& result) const {
    std::uint32_t used = 0;
    for (std::size_t v = 0; v + 1 < first_.size(); ++v) used += first_[v] < first_[v + 1] ? 1 : 0;
    const auto corners = static_cast<std::uint32_t>(corners_.size());
    VertexRecord size;
    size.svertices = HalfedgeId{corners};
    size.shalfedges = SHalfedgeId{2 * corners};
    size.sfaces = SFaceId{2 * used};
    result.reserve(used, size);
  }

  void collect_corners() {
    corners_.resize(f_.corners.size());
    const auto each_corner = [this](const auto& visit) {
      for (std::uint32_t face = 0; face + 1 < f_.begin.size(); ++face) {
        for (std::uint32_t i = f_.begin[face]; i < f_.begin[face + 1]; ++i) visit(f_.corners[i], face, i);
      }
    };
    const auto put = [this](std::uint32_t place, std::uint32_t face, std::uint32_t i) {
      const std::uint32_t begin = f_.begin[face];
      const std::uint32_t end = f_.begin[face + 1];
      corners_[place] = {face, f_.corners[i + 1 == end ? begin : i + 1], f_.corners[i == begin ? end - 1 : i - 1], i};
    };
    first_ = group_by(f_.points.size(), each_corner, put, for_vertices(f_.points.size(), monitor_));
  }

  // Of the edge to w among the spokes; their number if it is a new one, which then is added.
  std::uint32_t place_of_spoke(std::uint32_t w) {
    constexpr std::size_t kFew = 64;  // spokes that are looked through faster than a table is asked
    if (spokes_.size() < kFew) {
      std::uint32_t n = 0;
      while (n < spokes_.size() && spokes_[n].to != w) ++n;
      return n;
    }
    if (spokes_.size() == kFew) {
      spoke_at_.clear();
      for (std::uint32_t n = 0; n < kFew; ++n) spoke_at_.emplace(spokes_[n].to, n);
    }
    return spoke_at_.emplace(w, static_cast<std::uint32_t>(spokes_.size())).first->second;
  }

  // The node of the edge from v to w, and one more plane around it.
  std::uint32_t node_toward(std::uint32_t w, PlaneId plane) {
    const std::uint32_t n = place_of_spoke(w);
    if (n == spokes_.size()) {
      spokes_.push_back({w, plane, PlaneId()});
    } else if (spokes_[n].first.row() == plane.row()) {
      spokes_[n].turns = spokes_[n].turns || spokes_[n].first.flipped() != plane.flipped();
    } else if (!spokes_[n].second.valid()) {
      spokes_[n].second = plane;
    }
    ++spokes_[n].arcs;
    return n;
  }

  // The border of a surface lies in one face only, and faces with different marks may meet within one plane. The
  // direction of such an edge needs a second plane: the one across the face.
  [[nodiscard]] bool needs_plane_across(const Spoke& spoke) const {
    return spoke.arcs == 1 || (!spoke.second.valid() && spoke.turns && marks_.boundary != marks_.flipped_boundary);
  }

  PlaneId plane_across(std::uint32_t v, const Spoke& spoke) {
    const Direction along = vector_between(f_.points, PointId{v}, PointId{spoke.to});
    const Direction up = Direction::normal(f_.planes, spoke.first);
    return plane_through(f_.planes, f_.points, cross(up.integers(), along.integers()), PointId{v});
  }

  // An edge between two planes has the direction of their meeting, up to its sign, which the
  // rounded coordinates tell unless its ends are very close to each other. An edge within one
  // plane disappears when the map is simplified; until then its vector stands for it.
  Direction direction_along(std::uint32_t v, const Spoke& spoke) const {
    if (!spoke.second.valid()) return vector_between(f_.points, PointId{v}, PointId{spoke.to});
    Direction d = Direction::cross(f_.planes, spoke.first, spoke.second);
    const std::array<double, 3>& a = f_.points.approximate(PointId{v});
    const std::array<double, 3>& b = f_.points.approximate(PointId{spoke.to});
    double dot = 0;
    double length = 0;
    double magnitude = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      dot += d.approximate[i] * (b[i] - a[i]);
      length = std::max(length, std::fabs(b[i] - a[i]));
      magnitude = std::max({magnitude, std::fabs(a[i]), std::fabs(b[i])});
    }
    // Coordinates are within 2^-51 relative, and within 2^-1074 below 2^-1022, so where the difference is over 2^-40 of
    // them, and not tiny, it is right to a thousandth, and so is d (kMostDirectionError): parallel vectors then have a
    // product of at least half their lengths' product.
    const bool reliable = length > 0x1p-40 * magnitude && length > 1e-290 && magnitude < 1e300;
    const int sign = reliable ? (dot > 0 ? 1 : -1)
                              : sign_of_dot(d, vector_between(f_.points, PointId{v}, PointId{spoke.to}), monitor_);
    return sign > 0 ? std::move(d) : Direction::cross(f_.planes, spoke.second, spoke.first);
  }

  // Where faces of different marks meet, the mark of the boundary.
  void join_marks(LabelId& so_far, LabelId mark) const {
    if (so_far == kOutside) so_far = mark;
    if (so_far != mark) so_far = marks_.boundary;
  }

  void draw(std::uint32_t v, std::span<const FaceCorner> corners) {
    drawing_.clear();
    spokes_.clear();
    for (const FaceCorner& corner : corners) {
      const std::uint32_t source = node_toward(corner.next, f_.plane[corner.face]);
      const std::uint32_t target = node_toward(corner.previous, f_.plane[corner.face]);
      const LabelId mark = f_.plane[corner.face].flipped() ? marks_.flipped_boundary : marks_.boundary;
      join_marks(spokes_[source].mark, mark);
      join_marks(spokes_[target].mark, mark);
      drawing_.arcs.push_back({f_.plane[corner.face], source, target, mark, marks_.outside, marks_.inside});
    }
    drawing_.nodes.resize(spokes_.size());
    for (std::size_t n = 0; n < spokes_.size(); ++n) {
      if (needs_plane_across(spokes_[n])) spokes_[n].second = plane_across(v, spokes_[n]);
      drawing_.nodes[n].direction = direction_along(v, spokes_[n]);
      drawing_.nodes[n].mark = spokes_[n].mark;
    }
    drawing_.centre = spokes_[0].mark;
    for (const Spoke& spoke : spokes_) join_marks(drawing_.centre, spoke.mark);
  }

  [[nodiscard]] std::string name(std::uint32_t point) const {
    return std::to_string(f_.names.empty() ? point : f_.names[point]);
  }

  void check_sides(std::uint32_t v) const {
    for (std::uint32_t n = 0; n < drawing_.nodes.size(); ++n) {
      const std::span<const std::uint32_t> ring = drawing_.around(n);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t next = ring[(i + 1) % ring.size()];
        if (drawing_.left(ring[i]) != drawing_.left(next ^ 1U)) {
          throw InputError(
              "the faces around the edge from vertex " + name(v) + " to vertex " + name(spokes_[n].to) +
              " do not separate inside from outside; the mesh crosses itself or is not consistently oriented");
        }
      }
    }
  }

  SolidFaces f_;
  SolidMarks marks_;
  SphereMaps maps_;
  Monitor monitor_;
  std::vector<std::uint32_t> first_;
  std::vector<FaceCorner> corners_;
  std::vector<Spoke> spokes_;
  std::unordered_map<std::uint32_t, std::uint32_t> spoke_at_;  // by where they lead, if there are many
  Arrangement drawing_;
  std::vector<std::uint64_t> bits_;  // of each plain vertex (PlainRing), 0 of others
  std::vector<VertexId> made_;       // of each plain vertex
  KnownRings known_;                 // those that were made
  SphereMapBuffer map_;              // of the vertex at hand, where it need not be drawn
};

// Where a defect is a bug.
Complex complex_of(std::variant<Complex, Defect>&& made) {
  if (Defect* defect = std::get_if<Defect>(&made)) throw detail::BrokenInvariant(std::move(*defect));
  return std::get<Complex>(std::move(made));
}

// The box [-R, R]^2 x [-R, top], with top = R or 0.
SolidFaces infimaximal_box_faces(bool half) {
  SolidFaces f;
  for (int i = 0; i < 8; ++i) {
    std::array<Integer, 7> h;
    h[3] = 1;
    h[4] = (i & 1) != 0 ? 1 : -1;
    h[5] = (i & 2) != 0 ? 1 : -1;
    h[6] = (i & 4) != 0 ? (half ? 0 : 1) : -1;
    f.points.push_homogeneous(h);
  }
  add_box_sides(f, [&](std::size_t i) {
    Integer3 n;
    n[i / 2] = i % 2 == 0 ? -1 : 1;
    return f.planes.intern(n[0], n[1], n[2], 0, half && i == 5 ? 0 : -1);
  });
  return f;
}

}  // namespace

Complex make_solid(SolidFaces&& faces, const SolidMarks& marks, const Monitor& monitor) {
  return complex_of(try_make_solid(std::move(faces), marks, monitor));
}

std::variant<Complex, Defect> try_make_solid(SolidFaces&& faces, const SolidMarks& marks, const Monitor& monitor,
                                             SphereMaps maps) {
  return SolidBuilder(std::move(faces), marks, monitor, maps).run();
}

Complex make_surface(SolidFaces&& faces, LabelId mark, const Monitor& monitor) {
  return complex_of(SolidBuilder(std::move(faces), {mark, 0, 0}, monitor).run());
}

Complex make_oriented_surface(SolidFaces&& faces, const Monitor& monitor) {
  return complex_of(SolidBuilder(std::move(faces), {1, 0, 0, 2}, monitor).run());
}

Complex make_infimaximal_box(const Monitor& monitor) {
  return make_solid(infimaximal_box_faces(false), {1, 1, 0}, monitor);
}

Complex clip_to_infimaximal_box(const Complex& solid, const Monitor& monitor) {
  const Complex box = make_infimaximal_box(monitor);
  const LabelFunction clip(solid.label_count, 2,
                           [](LabelId mark, LabelId in_box) { return in_box != 0 ? mark : kOutside; });
  std::unique_ptr<const QueryStructure> of_solid;
  std::unique_ptr<const QueryStructure> of_box;
  const auto ask = [](const Complex& c, std::unique_ptr<const QueryStructure>& slot) -> const QueryStructure& {
    if (!slot) slot = std::make_unique<const QueryStructure>(c);
    return *slot;
  };
  return overlay_complexes(
             solid, box, clip, [&]() -> const QueryStructure& { return ask(solid, of_solid); },
             [&]() -> const QueryStructure& { return ask(box, of_box); }, monitor)
      .value_or(solid);
}

Complex make_lower_halfspace(const Monitor& monitor) {
  return clip_to_infimaximal_box(make_solid(infimaximal_box_faces(true), {1, 1, 0}, monitor), monitor);
}

}  // namespace nef
