// SPDX-License-Identifier: Apache-2.0
//
// The places where two parts touch tell whether they overlap, touch or are apart (contact_cones.h), without a Boolean;
// only parts that overlap are intersected, and only parts that are apart are measured. From the same places come the
// directions of first motion of each part. Straight ways out are tried along the rays of that cone, between them, away
// from the planes of contact, and along the axes.
#include "apps/planner/verdict/verdict.h"

#include <algorithm>
#include <set>
#include <utility>

#include "apps/program/set_info.h"
#include "nef/distance/nearest_features.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"
#include "nef/query/location_name.h"

namespace nef::planner {
namespace {

// Directions in which a part may leave, shorter vectors first. For a part that can move along a line or in a plane
// only, all rays are among them.
std::vector<Rational3> ways_to_try(const FreeDirections& first) {
  constexpr std::size_t kMost = 64;
  constexpr std::size_t kPaired = 8;  // rays between which directions are tried
  std::set<std::pair<Integer, Integer3>> found;
  const auto add = [&](const Integer3& d) {
    if (!is_zero(d)) found.emplace(abs(d[0]) + abs(d[1]) + abs(d[2]), d);
  };
  for (std::size_t i = 0; i < first.rays.size(); ++i) {
    add(first.rays[i]);
    for (std::size_t j = 0; j < std::min(i, kPaired); ++j) add(plus(first.rays[i], first.rays[j]));
  }
  for (const FreeDirections::Stop& stop : first.stops) {
    for (const Integer3& n : stop.directions) add(n);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    Integer3 axis{0, 0, 0};
    axis[k] = 1;
    add(axis);
    add(opposite(axis));
  }
  std::vector<Rational3> result;
  for (const auto& [size, d] : found) {
    if (result.size() < kMost) result.push_back(to_rational(d));
  }
  return result;
}

class Judge {
 public:
  Judge(const Assembly& assembly, const VerdictOptions& options)
      : parts_(assembly.parts), options_(options), blocking_(assembly.parts, options.monitor) {}

  PartsVerdict run() {
    PartsVerdict result;
    std::set<std::size_t> overlapping;
    for (std::size_t a = 0; a < parts_.size(); ++a) {
      for (std::size_t b = a + 1; b < parts_.size(); ++b) {
        options_.monitor.check_interruption();
        result.pairs.push_back(judge_pair(a, b));
        if (result.pairs.back().interference) overlapping.insert({a, b});
      }
    }
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      if (overlapping.contains(part)) {
        result.parts.push_back({PartVerdict::Status::kOverlapping, std::nullopt, {}});
      } else {
        result.parts.push_back(judge_part(part));
      }
    }
    return result;
  }

 private:
  PairVerdict judge_pair(std::size_t a, std::size_t b) {
    PairVerdict result;
    result.a = a;
    result.b = b;
    const std::optional<ContactCones>& contact = blocking_.contact(a, b);
    Distance& distance = result.distance;
    if (!contact) {
      result.interference = interference(a, b);
      distance.contact = nef::Contact::kOverlapping;
      distance.common_point = true;
      const Complex& region = result.interference->region.complex();
      distance.on_a = distance.on_b = region.points.rational(point_of(*region.vertex_ids().begin()));
    } else if (contact->point) {
      distance.contact = nef::Contact::kTouching;
      distance.common_point = true;
      distance.on_a = distance.on_b = *contact->point;
      result.touching = {item_at(a, *contact->point), item_at(b, *contact->point)};
    } else {
      NearestPair pair = nearest_features(parts_[a].complex(), parts_[b].complex(), options_.monitor);
      distance.squared = std::move(pair.squared);
      distance.on_a = std::move(pair.on_a);
      distance.on_b = std::move(pair.on_b);
    }
    return result;
  }

  [[nodiscard]] std::string item_at(std::size_t part, const Rational3& point) const {
    const Location at = locate(parts_[part], point, options_.monitor);
    return std::string(location_name(at.kind)) + " " + std::to_string(at.index);
  }

  [[nodiscard]] Interference interference(std::size_t a, std::size_t b) const {
    Interference result;
    result.region = intersect(blocking_.interior(a), blocking_.interior(b), options_.monitor);
    result.box = *bounding_box(result.region, options_.monitor);
    result.volume = approximate_volume(result.region, options_.monitor);
    if (options_.exact_volumes || has_short_measures(result.region)) result.exact_volume = volume(result.region);
    return result;
  }

  PartVerdict judge_part(std::size_t part) {
    PartVerdict result;
    result.first = free_directions(blocking_, part, options_.monitor);
    if (result.first.dimension == 0) {
      result.status = PartVerdict::Status::kStuck;
      return result;
    }
    for (const Rational3& d : ways_to_try(result.first)) {
      if (!leaves(part, d)) continue;
      result.status = PartVerdict::Status::kRemovable;
      result.direction = d;
      break;
    }
    return result;
  }

  bool leaves(std::size_t part, const Rational3& d) {
    for (const bool whole_way : {false, true}) {
      for (std::size_t other = 0; other < parts_.size(); ++other) {
        if (other == part) continue;
        if (whole_way ? blocking_.blocks(part, other, d) : blocking_.blocks_at_once(part, other, d)) return false;
      }
    }
    return true;
  }

  const std::vector<Polyhedron>& parts_;
  const VerdictOptions& options_;
  Blocking blocking_;
};

}  // namespace

const char* status_name(PartVerdict::Status status) {
  switch (status) {
    case PartVerdict::Status::kOverlapping:
      return "overlapping";
    case PartVerdict::Status::kRemovable:
      return "removable";
    case PartVerdict::Status::kStuck:
      return "stuck";
    case PartVerdict::Status::kUndecided:
      break;
  }
  return "undecided";
}

bool PartsVerdict::interferes() const {
  return std::any_of(pairs.begin(), pairs.end(), [](const PairVerdict& pair) { return pair.interference.has_value(); });
}

std::optional<std::size_t> PartsVerdict::smallest_gap() const {
  std::optional<std::size_t> smallest;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].distance.contact != nef::Contact::kDisjoint) continue;
    if (!smallest || pairs[i].distance.squared < pairs[*smallest].distance.squared) smallest = i;
  }
  return smallest;
}

PartsVerdict verdict(const Assembly& assembly, const VerdictOptions& options) { return Judge(assembly, options).run(); }

}  // namespace nef::planner
