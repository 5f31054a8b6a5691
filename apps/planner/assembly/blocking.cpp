// SPDX-License-Identifier: Apache-2.0
//
// Boxes answer first. Candidate directions are the cross products of the normals of all cones of directions that are
// blocked somewhere, plus the coordinate axes: O(k^2) for k normals, at most 60 of them.
#include "apps/planner/assembly/blocking.h"

#include <algorithm>
#include <set>

#include "apps/planner/assembly/closed_sets.h"
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

// The parameters t > 0, less than `most` if there is one, at which the box of a, moved by from + t d, overlaps that of
// b are an open interval.
bool Blocking::box_meets(std::size_t a, std::size_t b, const Rational3& from, const Rational3& d,
                         std::optional<Rational> most) const {
  Rational low = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational first = boxes_[b][0][i] - boxes_[a][1][i] - from[i];  // first < t d_i < last
    const Rational last = boxes_[b][1][i] - boxes_[a][0][i] - from[i];
    if (d[i] == 0) {
      if (first >= 0 || last <= 0) return false;
      continue;
    }
    const Rational begin = (d[i] > 0 ? first : last) / d[i];
    const Rational end = (d[i] > 0 ? last : first) / d[i];
    low = std::max(low, begin);
    if (!most || end < *most) most = end;
  }
  return !most || low < *most;
}

bool Blocking::boxes_meet_on(std::size_t a, std::size_t b, const Rational3& from, const Rational3& to) const {
  return box_meets(a, b, from, minus(to, from), Rational(1));
}

std::array<Rational3, 2> Blocking::box_of(const PartSet& parts) const {
  std::array<Rational3, 2> result = boxes_[parts.front()];
  for (const std::size_t part : parts) {
    for (std::size_t i = 0; i < 3; ++i) {
      result[0][i] = std::min(result[0][i], boxes_[part][0][i]);
      result[1][i] = std::max(result[1][i], boxes_[part][1][i]);
    }
  }
  return result;
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
  if (!box_meets(a, b, {}, d, std::nullopt)) return false;
  std::map<Pair, bool>& known = blocks_[d];
  const auto found = known.find({a, b});
  if (found != known.end()) return found->second;
  const bool result = entry_faces(a, d).is_before(entry_faces(b, d), monitor_);
  known.emplace(Pair{a, b}, result);
  return result;
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

std::set<OpenCone> Blocking::blocked_cones(const PartSet& moving, const PartSet& stay) {
  std::set<OpenCone> result;
  for (const std::size_t a : moving) {
    for (const std::size_t b : stay) {
      if (!blocks_some_beginning(a, b)) continue;
      for (OpenCone& cone : blocked_cones(a, b)) result.insert(std::move(cone));
    }
  }
  return result;
}

bool Blocking::blocks_some_beginning(std::size_t a, std::size_t b) {
  const std::optional<ContactCones>& found = contact(std::min(a, b), std::max(a, b));
  return !found || !found->blocked.empty();
}

const std::vector<Blocking::Tie>& Blocking::ties() {
  if (ties_) return *ties_;
  std::vector<Tie> result;
  std::map<Integer3, std::size_t> numbers;
  for (std::size_t a = 0; a < size(); ++a) {
    for (std::size_t b = 0; b < size(); ++b) {
      if (a == b || !blocks_some_beginning(a, b)) continue;
      Tie& tie = result.emplace_back();
      tie.parts = {a, b};
      for (const OpenCone& cone : blocked_cones(a, b)) {
        std::vector<std::size_t>& normals = tie.cones.emplace_back();
        for (const Integer3& normal : cone) {
          const auto [known, fresh] = numbers.try_emplace(normal, numbers.size());
          if (fresh) normals_.push_back(to_rational(normal));
          normals.push_back(known->second);
        }
      }
    }
  }
  ties_ = std::move(result);
  return *ties_;
}

bool Blocking::are_tied_at_once(const PartSet& parts, const Rational3& d) {
  const std::vector<Tie>& ties = this->ties();
  std::vector<bool> behind;  // the planes of the normals
  for (const Rational3& normal : normals_) behind.push_back(dot(normal, d) < 0);
  std::vector<std::size_t> places(size(), parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) places[parts[i]] = i;
  BlockingGraph graph(parts.size());
  for (const Tie& tie : ties) {
    const std::size_t a = places[tie.parts.first];
    const std::size_t b = places[tie.parts.second];
    if (a == parts.size() || b == parts.size()) continue;
    const bool blocked = std::any_of(tie.cones.begin(), tie.cones.end(), [&behind](const auto& cone) {
      return std::all_of(cone.begin(), cone.end(), [&behind](std::size_t normal) { return behind[normal]; });
    });
    if (blocked) graph[a].push_back(b);
  }
  return minimal_closed_sets(graph).front().size() == parts.size();
}

std::optional<std::vector<Rational3>> Blocking::directions() {
  constexpr std::size_t kMostNormals = 60;
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
