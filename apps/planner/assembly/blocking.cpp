// SPDX-License-Identifier: Apache-2.0
//
// Boxes answer first. Candidate directions are the cross products of the normals of all cones of directions that are
// blocked somewhere, plus the coordinate axes: O(k^2) for k normals, at most 120 of them.
#include "apps/planner/assembly/blocking.h"

#include <algorithm>
#include <set>

#include "nef/export/to_mesh.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
Blocking::Blocking(const std::vector<Polyhedron>& parts, const Monitor& monitor) : monitor_(monitor) {
  for (const Polyhedron& part : parts) {
    boxes_.push_back(*bounding_box(part, monitor));
    interiors_.push_back(nef::interior(part, monitor));
  }
  contacts_.resize(size() * size());
  meshes_.resize(size());
}

bool Blocking::boxes_meet(std::size_t a, std::size_t b) const {
  for (std::size_t i = 0; i < 3; ++i) {
    if (boxes_[a][1][i] < boxes_[b][0][i] || boxes_[b][1][i] < boxes_[a][0][i]) return false;
  }
  return true;
}

// The parameters t > 0 at which the box of a, moved by t d, overlaps that of b are an open interval.
bool Blocking::box_meets_ray(std::size_t a, std::size_t b, const Rational3& d) const {
  Rational low = 0;
  std::optional<Rational> high;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational first = boxes_[b][0][i] - boxes_[a][1][i];  // first < t d_i < last
    const Rational last = boxes_[b][1][i] - boxes_[a][0][i];
    if (d[i] == 0) {
      if (first >= 0 || last <= 0) return false;
      continue;
    }
    const Rational begin = (d[i] > 0 ? first : last) / d[i];
    const Rational end = (d[i] > 0 ? last : first) / d[i];
    low = std::max(low, begin);
    if (!high || end < *high) high = end;
  }
  return !high || low < *high;
}

const std::optional<ContactCones>& Blocking::contact(std::size_t a, std::size_t b) {
  std::optional<std::optional<ContactCones>>& known = contacts_[a * size() + b];
  if (!known) known = boxes_meet(a, b) ? contact_cones(interiors_[a], interiors_[b], monitor_) : ContactCones();
  return *known;
}

const EntryFaces& Blocking::entry_faces(std::size_t part, const Rational3& d) {
  if (d != direction_) {
    faces_.clear();
    direction_ = d;
  }
  const auto known = faces_.find(part);
  if (known != faces_.end()) return known->second;
  if (!meshes_[part]) meshes_[part] = to_mesh(interiors_[part], {}, monitor_).mesh;
  return faces_.try_emplace(part, *meshes_[part], d, monitor_).first->second;
}

std::optional<std::pair<std::size_t, std::size_t>> Blocking::overlapping() {
  for (std::size_t a = 0; a < size(); ++a) {
    for (std::size_t b = a + 1; b < size(); ++b) {
      if (!contact(a, b)) return std::pair{a, b};
    }
  }
  return std::nullopt;
}

bool Blocking::blocks(std::size_t a, std::size_t b, const Rational3& d) {
  return box_meets_ray(a, b, d) && entry_faces(a, d).is_before(entry_faces(b, d), monitor_);
}

bool Blocking::blocks_at_once(std::size_t a, std::size_t b, const Rational3& d) {
  // b moved against a meets it where a moved against b does, the other way.
  if (a > b) return blocks_at_once(b, a, opposite(d));
  const std::optional<ContactCones>& found = contact(a, b);
  return !found || std::any_of(found->blocked.begin(), found->blocked.end(),
                               [&d](const OpenCone& cone) { return contains(cone, d); });
}

std::vector<OpenCone> Blocking::blocked_cones(std::size_t a, std::size_t b) {
  const std::optional<ContactCones>& found = contact(std::min(a, b), std::max(a, b));
  if (!found) return {OpenCone{}};
  std::vector<OpenCone> result = found->blocked;
  if (a > b) {
    for (OpenCone& cone : result) cone = opposite_cone(cone);
  }
  return result;
}

std::optional<std::vector<Rational3>> Blocking::directions() {
  constexpr std::size_t kMostNormals = 120;
  std::set<Integer3> normals{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (std::size_t a = 0; a < size(); ++a) {
    for (std::size_t b = a + 1; b < size(); ++b) {
      for (const OpenCone& cone : blocked_cones(a, b)) {
        for (const Integer3& normal : cone) normals.insert(std::max(normal, opposite(normal)));
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
