// SPDX-License-Identifier: Apache-2.0
//
// An octant is a cone of three rays. Half-spaces cut it down; what is left is a convex polygon of directions, an arc, a
// direction, or nothing. A cone of several normals leaves what is in front of one of its planes, which is a choice:
// choices that the cone at hand leaves no alternative to, or none at all, are made first.
#include "apps/planner/assembly/first_motions.h"

#include <algorithm>
#include <utility>

#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

using ConeRays = std::vector<Integer3>;  // in cyclic order

// What of a closed cone is on the side n * x >= 0; no rays if that is the origin only.
ConeRays in_front(const ConeRays& cone, const Integer3& n) {
  ConeRays result;
  const auto add = [&result](Integer3 ray) {
    if (std::find(result.begin(), result.end(), ray) == result.end()) result.push_back(std::move(ray));
  };
  std::vector<Integer> heights;
  for (const Integer3& ray : cone) heights.push_back(dot(n, ray));
  for (std::size_t i = 0; i < cone.size(); ++i) {
    const std::size_t j = (i + 1) % cone.size();
    if (heights[i] >= 0) add(cone[i]);
    if (sgn(heights[i]) * sgn(heights[j]) >= 0) continue;
    Integer3 crossing;
    for (std::size_t k = 0; k < 3; ++k) crossing[k] = abs(heights[j]) * cone[i][k] + abs(heights[i]) * cone[j][k];
    add(primitive(std::move(crossing)));
  }
  return result;
}

bool is_in_front(const ConeRays& cone, const Integer3& n) {
  return std::all_of(cone.begin(), cone.end(), [&n](const Integer3& ray) { return sgn(dot(n, ray)) >= 0; });
}

class FreeConeSearch {
 public:
  FreeConeSearch(const std::set<OpenCone>& blocked, std::size_t most, const Monitor& monitor)
      : most_(most), monitor_(monitor) {
    for (const OpenCone& cone : blocked) {
      if (cone.size() == 1) {
        half_spaces_.push_back(cone.front());
      } else {
        choices_.push_back(cone);
      }
    }
  }

  /// Closed convex cones of free directions, at most so many.
  std::vector<ConeRays> run() {
    if (!choices_.empty() && choices_.front().empty()) return {};  // all directions are blocked
    for (unsigned octant = 0; octant < 8 && found_.size() < most_; ++octant) {
      ConeRays cone;
      for (unsigned k = 0; k < 3; ++k) {
        Integer3 axis{0, 0, 0};
        axis[k] = (octant >> k & 1U) != 0 ? -1 : 1;
        cone.push_back(axis);
      }
      for (const Integer3& n : half_spaces_) {
        cone = in_front(cone, n);
        if (cone.empty()) break;
      }
      if (!cone.empty()) search(cone, choices_);
    }
    return std::move(found_);
  }

 private:
  void search(ConeRays cone, const std::vector<OpenCone>& choices) {
    monitor_.check_interruption();
    std::vector<OpenCone> left = choices;
    std::vector<ConeRays> fewest;  // alternatives of the choice that has the fewest
    for (bool cut = true; cut;) {
      cut = false;
      fewest.clear();
      for (std::size_t i = 0; i < left.size() && !cut;) {
        if (std::any_of(left[i].begin(), left[i].end(), [&cone](const Integer3& n) { return is_in_front(cone, n); })) {
          left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
          continue;
        }
        std::vector<ConeRays> alternatives;
        for (const Integer3& n : left[i]) {
          if (ConeRays rest = in_front(cone, n); !rest.empty()) alternatives.push_back(std::move(rest));
        }
        if (alternatives.empty()) return;
        if (alternatives.size() == 1) {
          cone = std::move(alternatives.front());
          cut = true;
        } else if (fewest.empty() || alternatives.size() < fewest.size()) {
          fewest = std::move(alternatives);
        }
        ++i;
      }
    }
    if (fewest.empty()) {
      found_.push_back(std::move(cone));
      return;
    }
    for (const ConeRays& alternative : fewest) {
      if (found_.size() < most_) search(alternative, left);
    }
  }

  std::size_t most_;
  const Monitor& monitor_;
  std::vector<Integer3> half_spaces_;
  std::vector<OpenCone> choices_;
  std::vector<ConeRays> found_;
};

}  // namespace

std::optional<std::vector<Integer3>> free_cone(const std::set<OpenCone>& blocked, const Monitor& monitor) {
  std::vector<ConeRays> found = FreeConeSearch(blocked, 1, monitor).run();
  if (found.empty()) return std::nullopt;
  return std::move(found.front());
}

std::vector<Rational3> free_ways(const std::set<OpenCone>& blocked, const Monitor& monitor) {
  constexpr std::size_t kMostCones = 16;
  constexpr std::size_t kMostWays = 64;
  // Of the same size, those up are first.
  std::set<std::pair<Integer, Integer3>> ways;
  const auto add = [&ways](const Integer3& d) { ways.emplace(abs(d[0]) + abs(d[1]) + abs(d[2]), opposite(d)); };
  const auto is_free = [&blocked](const Integer3& d) {
    return std::none_of(blocked.begin(), blocked.end(),
                        [&d](const OpenCone& cone) { return contains(cone, to_rational(d)); });
  };
  for (std::size_t k = 0; k < 3; ++k) {
    Integer3 axis{0, 0, 0};
    for (const int sign : {1, -1}) {
      axis[k] = sign;
      if (is_free(axis)) add(axis);
    }
  }
  for (const ConeRays& cone : FreeConeSearch(blocked, kMostCones, monitor).run()) {
    Integer3 middle{0, 0, 0};
    for (const Integer3& ray : cone) {
      add(ray);
      middle = plus(middle, ray);
    }
    add(primitive(middle));
  }
  std::vector<Rational3> result;
  for (const auto& [size, back] : ways) {
    if (result.size() < kMostWays) result.push_back(to_rational(opposite(back)));
  }
  return result;
}

}  // namespace nef::planner
