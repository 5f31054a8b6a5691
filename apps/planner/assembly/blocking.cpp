// SPDX-License-Identifier: Apache-2.0
//
// A body is the hull of the differences of vertices of two convex pieces, as half-spaces. A ray from the origin meets
// its inside iff an interval of parameters, one bound for each face, is not empty; a motion begins inside iff the
// origin is behind every face, or on it where the direction leads behind it. The sum of two boxes answers first, so
// bodies are made only for pairs whose boxes meet. Candidate directions are the cross products of the normals of all
// faces through the origin, plus the coordinate axes: O(k^2) for k normals, at most 120 of them. All numbers are
// rational.
#include "apps/planner/assembly/blocking.h"

#include <algorithm>
#include <set>

#include "apps/minkowski/minkowski.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

using minkowski::ConvexCell;

Rational3 to_rational(const Integer3& v) { return {Rational(v[0]), Rational(v[1]), Rational(v[2])}; }

Integer3 opposite(const Integer3& v) { return {-v[0], -v[1], -v[2]}; }

}  // namespace

Blocking::Blocking(const std::vector<Polyhedron>& parts, const Monitor& monitor) : monitor_(monitor) {
  for (const Polyhedron& part : parts) {
    boxes_.push_back(*bounding_box(part));
    std::vector<std::vector<Rational3>>& pieces = pieces_.emplace_back();
    for (const ConvexCell& cell : minkowski::decompose(part, monitor_)) {
      if (cell.dimension == 3) pieces.push_back(cell.mesh.vertices);
    }
  }
  pairs_.resize(size() * size());
  for (std::size_t a = 0; a < size(); ++a) {
    for (std::size_t b = a + 1; b < size(); ++b) pair(a, b).box = box_body(a, b);
  }
}

Blocking::Body Blocking::box_body(std::size_t a, std::size_t b) const {
  Body body;
  for (std::size_t i = 0; i < 3; ++i) {
    Rational3 up;
    up[i] = 1;
    Rational3 down;
    down[i] = -1;
    body.faces.push_back({up, boxes_[b][1][i] - boxes_[a][0][i]});
    body.faces.push_back({down, boxes_[a][1][i] - boxes_[b][0][i]});
  }
  return body;
}

const std::vector<Blocking::Body>& Blocking::bodies(std::size_t a, std::size_t b) {
  std::optional<std::vector<Body>>& known = pair(a, b).bodies;
  if (known) return *known;
  std::vector<Body> made;
  for (const std::vector<Rational3>& p : pieces_[a]) {
    for (const std::vector<Rational3>& q : pieces_[b]) {
      std::vector<Rational3> differences;
      for (const Rational3& x : p) {
        for (const Rational3& y : q) differences.push_back(minus(y, x));
      }
      made.push_back({half_spaces_of(minkowski::hull_cell(differences, monitor_).mesh)});
    }
  }
  return known.emplace(std::move(made));
}

// The parameters t > 0 with normal * d t < offset for all faces are an open interval.
bool Blocking::Body::meets_ray(const Rational3& d) const {
  Rational low = 0;
  std::optional<Rational> high;
  for (const HalfSpace& face : faces) {
    const Rational slope = dot(face.normal, d);
    if (slope == 0) {
      if (face.offset <= 0) return false;
      continue;
    }
    const Rational t = face.offset / slope;
    if (slope < 0) {
      low = std::max(low, t);
    } else if (!high || t < *high) {
      high = t;
    }
  }
  return !high || low < *high;
}

bool Blocking::Body::meets_start(const Rational3& d) const {
  return std::all_of(faces.begin(), faces.end(), [&d](const HalfSpace& face) {
    return face.offset > 0 || (face.offset == 0 && dot(face.normal, d) < 0);
  });
}

bool Blocking::Body::holds_origin(bool inside) const {
  return std::all_of(faces.begin(), faces.end(),
                     [inside](const HalfSpace& face) { return inside ? face.offset > 0 : face.offset >= 0; });
}

std::optional<std::pair<std::size_t, std::size_t>> Blocking::overlapping() {
  for (std::size_t a = 0; a < size(); ++a) {
    for (std::size_t b = a + 1; b < size(); ++b) {
      if (!pair(a, b).box.holds_origin(true)) continue;
      for (const Body& body : bodies(a, b)) {
        if (body.holds_origin(true)) return std::pair{a, b};
      }
    }
  }
  return std::nullopt;
}

bool Blocking::blocks(std::size_t a, std::size_t b, const Rational3& d) {
  // b moved against a meets it where a moved against b does, the other way.
  if (a > b) return blocks(b, a, {-d[0], -d[1], -d[2]});
  if (!pair(a, b).box.meets_ray(d)) return false;
  const std::vector<Body>& all = bodies(a, b);
  return std::any_of(all.begin(), all.end(), [&d](const Body& body) { return body.meets_ray(d); });
}

bool Blocking::blocks_at_once(std::size_t a, std::size_t b, const Rational3& d) {
  if (a > b) return blocks_at_once(b, a, {-d[0], -d[1], -d[2]});
  if (!pair(a, b).box.meets_start(d)) return false;
  const std::vector<Body>& all = bodies(a, b);
  return std::any_of(all.begin(), all.end(), [&d](const Body& body) { return body.meets_start(d); });
}

std::vector<std::vector<Rational3>> Blocking::blocked_cones(std::size_t a) {
  std::vector<std::vector<Rational3>> result;
  for (std::size_t b = 0; b < size(); ++b) {
    const std::size_t first = std::min(a, b);
    const std::size_t second = std::max(a, b);
    if (a == b || !pair(first, second).box.holds_origin(false)) continue;
    for (const Body& body : bodies(first, second)) {
      if (!body.holds_origin(false)) continue;
      std::vector<Rational3>& normals = result.emplace_back();
      for (const HalfSpace& face : body.faces) {
        if (face.offset != 0) continue;
        const Rational3& n = face.normal;
        normals.push_back(a < b ? n : Rational3{-n[0], -n[1], -n[2]});
      }
    }
  }
  return result;
}

std::optional<std::vector<Rational3>> Blocking::directions() {
  constexpr std::size_t kMostNormals = 120;
  std::set<Integer3> normals{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (std::size_t a = 0; a < size(); ++a) {
    for (std::size_t b = a + 1; b < size(); ++b) {
      if (!pair(a, b).box.holds_origin(false)) continue;
      for (const Body& body : bodies(a, b)) {
        if (!body.holds_origin(false)) continue;
        for (const HalfSpace& face : body.faces) {
          if (face.offset != 0) continue;
          const Integer3 normal = primitive(face.normal);
          normals.insert(std::max(normal, opposite(normal)));
        }
      }
    }
    if (normals.size() > kMostNormals) return std::nullopt;
  }
  std::set<std::pair<Integer, Integer3>> found;
  for (auto p = normals.begin(); p != normals.end(); ++p) {
    for (auto q = std::next(p); q != normals.end(); ++q) {
      const Integer3 d = primitive(cross(to_rational(*p), to_rational(*q)));
      const Integer size = abs(d[0]) + abs(d[1]) + abs(d[2]);
      found.emplace(size, d);
      found.emplace(size, opposite(d));
    }
  }
  std::vector<Rational3> result;
  for (const auto& [size, d] : found) result.push_back(to_rational(d));
  return result;
}

}  // namespace nef::planner
