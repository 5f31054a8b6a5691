// SPDX-License-Identifier: Apache-2.0
//
// IntersectionQuery finds the places where the boundaries touch. A local pyramid is read from its sphere map as a
// LocalCone: the directions of its edges, and the planes of its facets. Let C be the complement of b's pyramid B, and A
// the pyramid of a, which lies in C. If C is convex, A + d stays in C iff d is in C, so blocked is what is behind a
// plane of C. The same holds for the complement of A, with -d. If neither is convex, A and B are cut into convex cones
// A_i and B_j: blocked are the insides of the hulls of B_j and -A_i, whose facets are found by trying all pairs of
// rays.
//
// Parts that fit each other have such contacts at nearly all of their vertices, but half-spaces tell all of them. Where
// facets of A and B look against each other, all directions behind their plane are blocked. And only such directions
// can be blocked that lead behind the plane of a facet of C, since whatever leaves C goes out through a facet; so
// contacts whose facets, all of A or all of B, give known half-spaces say nothing new, nor do pairs of A_i and B_j on
// both sides of one known plane.
#include "apps/planner/assembly/contact_cones.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "nef/complex/local_pyramid.h"
#include "nef/distance/intersects.h"
#include "nef/distance/nearest_features.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"
#include "nef/polyhedron.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::planner {
namespace {

using Rays = std::vector<Integer3>;  // that span a convex cone

// An arc of the boundary of a local pyramid, less than a half circle, counterclockwise about the inward normal.
struct BoundaryArc {
  Integer3 inward;
  Integer3 from;
  Integer3 to;

  [[nodiscard]] Integer3 middle() const { return plus(from, to); }
  // Whether the inside of the arc has a ray in its plane.
  [[nodiscard]] bool has(const Integer3& ray) const {
    return sgn(dot(inward, cross(from, ray))) > 0 && sgn(dot(inward, cross(ray, to))) > 0;
  }
};

// A local pyramid of a solid.
struct LocalCone {
  Rays rays;                     // along its edges, and one inside each half circle of its boundary
  std::vector<Integer3> inward;  // normals of its facets
  std::vector<BoundaryArc> arcs;
  bool convex = false;
  bool hollow = false;  // its complement is convex

  [[nodiscard]] bool on_side(int side) const {
    return std::all_of(inward.begin(), inward.end(), [&](const Integer3& n) {
      return std::all_of(rays.begin(), rays.end(), [&](const Integer3& ray) { return side * sgn(dot(n, ray)) >= 0; });
    });
  }
};

// The only sface with (or without) a mark, if its boundary is one cycle.
bool is_one_disc(const SphereMapView& map, bool marked) {
  std::size_t count = 0;
  bool disc = false;
  for (const SFace& face : map.sfaces) {
    if ((face.mark != 0) != marked) continue;
    ++count;
    disc = face.entry_count == 1;
  }
  return count == 1 && disc;
}

LocalCone local_cone(const PlaneTable& planes, const SphereMapView& map) {
  LocalCone cone;
  const auto normal = [&](PlaneId plane) { return primitive(Direction::normal(planes, plane).integers()); };
  const auto ray = [&](std::uint32_t v) { return primitive(direction_of(planes, map.svertices[v]).integers()); };
  for (std::uint32_t v = 0; v < map.svertices.size(); ++v) cone.rays.push_back(ray(v));
  bool short_arcs = true;  // none is longer than a half circle
  for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
    const SHalfedge arc = map.shalfedges[e];
    if (map.sfaces[arc.sface].mark == 0) continue;
    const Integer3 inward = normal(arc.plane);
    const Integer3& from = cone.rays[arc.source];
    const Integer3& to = cone.rays[map.target(e)];
    const int turn = sgn(dot(inward, cross(from, to)));
    short_arcs = short_arcs && turn >= 0 && from != to;
    if (turn == 0) cone.rays.push_back(cross(inward, from));
    if (turn > 0) cone.arcs.push_back({inward, from, to});
    cone.inward.push_back(inward);
  }
  for (const SLoop& loop : map.sloops) {
    if (map.sfaces[loop.sface].mark != 0) cone.inward.push_back(normal(loop.plane));
  }
  const bool simple = short_arcs && map.sloops.empty();
  cone.convex = simple && is_one_disc(map, true) && cone.on_side(1);
  cone.hollow = (simple && is_one_disc(map, false) && cone.on_side(-1)) || map.svertices.empty();  // or a half-space
  return cone;
}

// The part of a cone, whose rays are in cyclic order, on the side n * x >= 0; no rays if that has no inside.
Rays clipped(const Rays& cone, const Integer3& n) {
  Rays result;
  bool inside = false;
  for (std::size_t i = 0; i < cone.size(); ++i) {
    const Integer3& p = cone[i];
    const Integer3& q = cone[(i + 1) % cone.size()];
    const Integer at_p = dot(n, p);
    const Integer at_q = dot(n, q);
    inside = inside || at_p > 0;
    if (at_p >= 0) result.push_back(p);
    if (sgn(at_p) * sgn(at_q) >= 0) continue;
    Integer3 crossing;
    for (std::size_t k = 0; k < 3; ++k) crossing[k] = abs(at_q) * p[k] + abs(at_p) * q[k];
    result.push_back(primitive(crossing));
  }
  return inside ? result : Rays{};
}

// Convex cones whose union is the closure of a pyramid: the octants, cut by all of its planes.
std::vector<Rays> convex_parts(const PlaneTable& planes, const SphereMapView& map, const LocalCone& cone,
                               const Monitor& monitor) {
  if (cone.convex) return {cone.rays};
  std::vector<Rays> parts;
  for (unsigned octant = 0; octant < 8; ++octant) {
    Rays& rays = parts.emplace_back();
    for (unsigned k = 0; k < 3; ++k) {
      Integer3 axis{0, 0, 0};
      axis[k] = (octant >> k & 1U) != 0 ? 1 : -1;
      rays.push_back(axis);
    }
  }
  const std::set<Integer3> cuts(cone.inward.begin(), cone.inward.end());
  for (const Integer3& n : cuts) {
    std::vector<Rays> halves;
    for (const Rays& part : parts) {
      for (const Integer3& side : {n, opposite(n)}) {
        if (Rays half = clipped(part, side); !half.empty()) halves.push_back(std::move(half));
      }
    }
    parts = std::move(halves);
  }
  std::erase_if(parts, [&](const Rays& part) {
    Integer3 middle{0, 0, 0};
    for (const Integer3& ray : part) middle = plus(middle, ray);
    const SphereLocation at = locate(planes, map, Direction::exact(middle[0], middle[1], middle[2]), monitor);
    return mark_at(map, at) == 0;
  });
  return parts;
}

// The inside of the cone that rays span: the outward normals of its facets. Every facet contains two of the rays.
OpenCone inside_of_hull(const Rays& rays) {
  std::set<Integer3> normals;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    for (std::size_t j = i + 1; j < rays.size(); ++j) {
      const Integer3 n = cross(rays[i], rays[j]);
      if (is_zero(n)) continue;
      bool above = false;
      bool below = false;
      for (std::size_t k = 0; k < rays.size() && !(above && below); ++k) {
        const int side = sgn(dot(n, rays[k]));
        above = above || side > 0;
        below = below || side < 0;
      }
      if (above != below) normals.insert(primitive(above ? opposite(n) : n));
    }
  }
  return {normals.begin(), normals.end()};
}

// The pyramids of the items of a solid, each made once.
class Pyramids {
 public:
  explicit Pyramids(const Complex& complex) : complex_(complex) {}

  struct Pyramid {
    LocalCone cone;
    std::vector<Rays> parts;  // convex ones; made when they are needed
  };

  Pyramid& at(const ItemRef& item) {
    const auto [found, fresh] = known_.try_emplace(item);
    if (fresh) {
      pyramid_of(complex_, item, buffer_);
      found->second.cone = local_cone(complex_.planes, buffer_.view());
    }
    return found->second;
  }
  const std::vector<Rays>& parts_at(const ItemRef& item, const Monitor& monitor) {
    Pyramid& pyramid = at(item);
    if (pyramid.parts.empty()) {
      pyramid_of(complex_, item, buffer_);
      pyramid.parts = convex_parts(complex_.planes, buffer_.view(), pyramid.cone, monitor);
    }
    return pyramid.parts;
  }

 private:
  const Complex& complex_;
  SphereMapBuffer buffer_;
  std::map<ItemRef, Pyramid> known_;
};

// The inward normals of a's facets that have a facet of b against them: an arc of both pyramids has a common inner
// part.
void add_facing(const LocalCone& a, const LocalCone& b, std::set<Integer3>& blocked) {
  for (const BoundaryArc& of_a : a.arcs) {
    for (const BoundaryArc& of_b : b.arcs) {
      if (of_b.inward != opposite(of_a.inward)) continue;
      if (of_a.has(of_b.middle()) || of_b.has(of_a.middle())) blocked.insert(of_a.inward);
    }
  }
}

// Whether all directions that a contact may block are in half-spaces that are known.
bool is_known(const LocalCone& a, const LocalCone& b, const std::set<Integer3>& blocked) {
  return std::all_of(a.inward.begin(), a.inward.end(), [&](const Integer3& n) { return blocked.contains(n); }) ||
         std::all_of(b.inward.begin(), b.inward.end(),
                     [&](const Integer3& n) { return blocked.contains(opposite(n)); });
}

// The cones of all pairs of convex parts of a and b but those in a known half-space that belongs to a facet of one.
void add_pairs(const LocalCone& a, const LocalCone& b, const std::vector<Rays>& parts_a,
               const std::vector<Rays>& parts_b, const std::set<Integer3>& blocked, std::set<OpenCone>& cones) {
  std::set<Integer3> planes;
  for (const Integer3& n : a.inward) planes.insert(n);
  for (const Integer3& n : b.inward) planes.insert(opposite(n));
  std::erase_if(planes, [&](const Integer3& n) { return !blocked.contains(n); });
  // For each part the planes of which it is all on one side.
  const auto sides = [&](const std::vector<Rays>& parts, int side) {
    std::vector<std::vector<bool>> result;
    for (const Rays& part : parts) {
      std::vector<bool>& of_part = result.emplace_back();
      for (const Integer3& n : planes) {
        of_part.push_back(
            std::all_of(part.begin(), part.end(), [&](const Integer3& ray) { return side * sgn(dot(n, ray)) >= 0; }));
      }
    }
    return result;
  };
  const auto above = sides(parts_a, 1);
  const auto below = sides(parts_b, -1);
  for (std::size_t j = 0; j < parts_b.size(); ++j) {
    for (std::size_t i = 0; i < parts_a.size(); ++i) {
      bool is_in_half_space = false;
      for (std::size_t k = 0; k < planes.size(); ++k)
        is_in_half_space = is_in_half_space || (above[i][k] && below[j][k]);
      if (is_in_half_space) continue;
      Rays rays = parts_b[j];
      for (const Integer3& ray : parts_a[i]) rays.push_back(opposite(ray));
      cones.insert(inside_of_hull(rays));
    }
  }
}

// A point where two items touch, of which one is a vertex, or both are edges.
Rational3 common_point(const Complex& a, const Complex& b, const ItemRef& of_a, const ItemRef& of_b) {
  if (of_a.kind == ItemRef::Kind::kVertex) return a.points.rational(point_of(of_a.vertex()));
  if (of_b.kind == ItemRef::Kind::kVertex) return b.points.rational(point_of(of_b.vertex()));
  const auto segment = [](const Complex& c, HalfedgeId h) {
    return std::array{c.points.rational(point_of(c.source(h))), c.points.rational(point_of(c.target(h)))};
  };
  return nearest_of_segments(segment(a, of_a.halfedge()), segment(b, of_b.halfedge())).on_a;
}

}  // namespace

bool contains(const OpenCone& cone, const Rational3& direction) {
  return std::all_of(cone.begin(), cone.end(), [&](const Integer3& n) { return dot(to_rational(n), direction) < 0; });
}

OpenCone inside_of_hull(const std::vector<Rational3>& vectors) {
  Rays rays;
  for (const Rational3& v : vectors) {
    if (!is_zero(v)) rays.push_back(primitive(v));
  }
  return inside_of_hull(rays);
}

OpenCone opposite_cone(const OpenCone& cone) {
  OpenCone result;
  for (const Integer3& n : cone) result.push_back(opposite(n));
  std::sort(result.begin(), result.end());
  return result;
}

std::optional<ContactCones> contact_cones(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  const auto contacts = IntersectionQuery(a, b).contacts({}, monitor);
  if (!contacts) return std::nullopt;
  Pyramids of_a(a.complex());
  Pyramids of_b(b.complex());
  std::set<Integer3> half_spaces;  // all directions behind these planes are blocked
  for (const auto& [item_a, item_b] : *contacts) {
    const LocalCone& cone_b = of_b.at(item_b).cone;
    if (cone_b.hollow) {
      for (const Integer3& inward : cone_b.inward) half_spaces.insert(opposite(inward));
      continue;  // without the pyramid of a, which takes as long
    }
    const LocalCone& cone_a = of_a.at(item_a).cone;
    if (cone_a.hollow) {
      half_spaces.insert(cone_a.inward.begin(), cone_a.inward.end());
    } else {
      add_facing(cone_a, cone_b, half_spaces);
    }
  }
  std::set<OpenCone> cones;
  for (const Integer3& n : half_spaces) cones.insert({n});
  for (const auto& [item_a, item_b] : *contacts) {
    const LocalCone& cone_b = of_b.at(item_b).cone;
    if (cone_b.hollow) continue;
    const LocalCone& cone_a = of_a.at(item_a).cone;
    if (cone_a.hollow || is_known(cone_a, cone_b, half_spaces)) continue;
    add_pairs(cone_a, cone_b, of_a.parts_at(item_a, monitor), of_b.parts_at(item_b, monitor), half_spaces, cones);
  }
  ContactCones result;
  for (const OpenCone& cone : cones) {
    const bool in_another = cone.size() > 1 && std::any_of(cone.begin(), cone.end(),
                                                           [&](const Integer3& n) { return cones.contains({n}); });
    if (!in_another) result.blocked.push_back(cone);
  }
  if (!contacts->empty()) {
    const auto& [item_a, item_b] = contacts->front();
    result.point = common_point(a.complex(), b.complex(), item_a, item_b);
  }
  return result;
}

}  // namespace nef::planner
