// SPDX-License-Identifier: Apache-2.0
//
// 1. A triangle is blocked at all orientations of its layer, and a tetrahedron at the orientation where its layer ends:
//    all corners have a point that two pieces share there, so all positions between them do; or all are beyond a side
//    of the box.
// 2. The triangles of a layer have no border modulo 2; and those of two successive layers together are the border of
//    the tetrahedra between them. So triangles times ranges of orientations, and tetrahedra, are a cycle modulo 2 in
//    the space of poses: a path that does not meet it has both ends on the same side. A ray at the orientation of the
//    start or the goal says which side that is, by the parity of its crossings.
// 3. Neighbours may be cut in different ways, so borders are compared as sets of points: triangles of one plane cancel
//    out modulo 2 if their edges do, edges of one line if their ends do. Thus it is enough to count ends, each with
//    its line (and the plane).
#include <algorithm>
#include <tuple>

#include "apps/planner/orientation/orientation_cells.h"
#include "apps/planner/proofs/check/blocked_poses.h"
#include "apps/planner/proofs/check/check_parts.h"
#include "nef/base/error.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

using LayersComplaint = std::optional<std::string>;
using BarrierTriangle = std::array<Rational3, 3>;

// The shortest integer vector that is parallel to one, its first coordinate that is not zero positive.
Integer3 unit_along(const Rational3& v) {
  Integer3 result = primitive(v);
  const auto first = std::find_if(result.begin(), result.end(), [](const Integer& x) { return x != 0; });
  if (first != result.end() && *first < 0) {
    for (Integer& x : result) x = -x;
  }
  return result;
}

// An end of an edge, with its line, and with the plane of its triangle where that matters.
struct EdgeEnd {
  Integer3 normal;
  Rational height;
  Integer3 along;
  Rational3 moment;
  Rational3 end;

  bool operator<(const EdgeEnd& other) const {
    return std::tie(normal, height, along, moment, end) <
           std::tie(other.normal, other.height, other.along, other.moment, other.end);
  }
  bool operator==(const EdgeEnd& other) const = default;
};

class EdgeEnds {
 public:
  // False if the triangle has no extent.
  bool add(const BarrierTriangle& triangle, bool with_plane) {
    const Integer3 normal = unit_along(cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0])));
    if (is_zero(normal)) return false;
    const Rational height = dot(to_rational(normal), triangle[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational3& a = triangle[k];
      const Rational3& b = triangle[(k + 1) % 3];
      const Integer3 along = unit_along(minus(b, a));
      const Rational3 moment = cross(a, to_rational(along));
      for (const Rational3* end : {&a, &b}) {
        ends_.push_back(
            {with_plane ? normal : Integer3{0, 0, 0}, with_plane ? height : Rational(0), along, moment, *end});
      }
    }
    return true;
  }

  // Whether each of them is there an even number of times.
  bool cancel_out() {
    std::sort(ends_.begin(), ends_.end());
    for (auto at = ends_.begin(); at != ends_.end();) {
      const auto next = std::find_if(at, ends_.end(), [&](const EdgeEnd& end) { return !(end == *at); });
      if ((next - at) % 2 != 0) return false;
      at = next;
    }
    return true;
  }

 private:
  std::vector<EdgeEnd> ends_;
};

// A layer of which all is known to be blocked.
struct CheckedLayer {
  std::vector<BarrierTriangle> barrier;
  std::vector<std::array<Rational3, 4>> closing;
};

class LayersCheck {
 public:
  LayersCheck(const PathProof& proof, const Monitor& monitor)
      : claim_(proof.claim), layers_(*proof.layers), monitor_(monitor) {}

  LayersComplaint run() {
    if (claim_.path.size() != 2) return "the path must be two poses, start and goal";
    try {
      orientations_.emplace(Orientations::along(*claim_.rotations));
    } catch (const InputError& error) {
      return error.what();
    }
    if (layers_.charts.size() != orientations_->charts().size())
      return "there must be layers for each arc of the chain";
    blocked_.emplace(claim_, *orientations_, Rational3{0, 0, 0});
    for (std::uint32_t chart = 0; chart < layers_.charts.size(); ++chart) {
      first_.push_back(checked_.size());
      if (LayersComplaint complaint = check_chart(chart)) return complaint;
    }
    if (LayersComplaint complaint = check_cycle()) return complaint;
    const auto start = is_inside(0);
    const auto goal = is_inside(1);
    if (!start || !goal) return "start or goal is not in the chain, or on the barrier";
    if (*start == *goal) return "start and goal are on the same side of the barrier";
    return std::nullopt;
  }

 private:
  LayersComplaint check_chart(std::uint32_t chart) {
    static const std::string kOrder = "the layers of an arc do not go from -1 up to 1";
    Rational low = -1;
    for (const PathProof::Layer& layer : layers_.charts[chart]) {
      monitor_.check_interruption();
      if (layer.until <= low || layer.until > 1) return kOrder;
      CheckedLayer& checked = checked_.emplace_back();
      OrientationBox<Rational> box;
      box.chart = chart;
      box.low[0] = low;
      box.high[0] = layer.until;
      for (const PathProof::BlockedSimplex& simplex : layer.barrier) {
        if (LayersComplaint complaint = check_simplex(simplex, box, checked.barrier.emplace_back())) return complaint;
      }
      box.low[0] = layer.until;
      for (const PathProof::BlockedSimplex& simplex : layer.closing) {
        if (LayersComplaint complaint = check_simplex(simplex, box, checked.closing.emplace_back())) return complaint;
      }
      low = layer.until;
    }
    if (low != 1) return kOrder;
    return std::nullopt;
  }

  template <std::size_t kCount>
  LayersComplaint check_simplex(const PathProof::BlockedSimplex& simplex, const OrientationBox<Rational>& box,
                                std::array<Rational3, kCount>& corners) const {
    if (simplex.corners.size() != kCount) return "a layer has a simplex with too few or too many corners";
    for (std::size_t k = 0; k < kCount; ++k) {
      if (simplex.corners[k] >= layers_.points.size()) return "a layer names a point that does not exist";
      corners[k] = layers_.points[simplex.corners[k]];
    }
    if (simplex.hit) {
      return blocked_->complaint(box, corners, simplex.hit->robot, simplex.hit->obstacle, simplex.hit->common);
    }
    if (!is_beyond_a_side(claim_.box, corners)) return "a position in a layer may be free";
    return std::nullopt;
  }

  LayersComplaint check_cycle() {
    static const std::string kNoExtent = "a triangle of a layer has no extent";
    const bool is_closed = !claim_.places && are_proportional(claim_.rotations->front(), claim_.rotations->back());
    for (std::size_t i = 0; i < checked_.size(); ++i) {
      monitor_.check_interruption();
      EdgeEnds border;
      for (const BarrierTriangle& triangle : checked_[i].barrier) {
        if (!border.add(triangle, false)) return kNoExtent;
      }
      if (!border.cancel_out()) return "the triangles of a layer have a border";
      if (i + 1 == checked_.size() && !is_closed) {
        if (!checked_[i].closing.empty()) return "no layer follows on the last one";
        break;
      }
      EdgeEnds sides;
      bool have_extent = true;
      for (const auto* barrier : {&checked_[i].barrier, &checked_[(i + 1) % checked_.size()].barrier}) {
        for (const BarrierTriangle& triangle : *barrier) have_extent = sides.add(triangle, true) && have_extent;
      }
      for (const std::array<Rational3, 4>& solid : checked_[i].closing) {
        for (std::size_t k = 0; k < 4; ++k) {
          const BarrierTriangle side{solid[(k + 1) % 4], solid[(k + 2) % 4], solid[(k + 3) % 4]};
          have_extent = sides.add(side, true) && have_extent;
        }
      }
      if (!have_extent) return kNoExtent;
      if (!sides.cancel_out()) return "there is a gap between two layers";
    }
    return std::nullopt;
  }

  // Whether the barrier of its layer goes round the start (0) or the goal (1); nothing if that cannot be said.
  [[nodiscard]] std::optional<bool> is_inside(std::size_t end) const {
    const std::vector<Quaternion>& chain = *claim_.rotations;
    const RigidPose& pose = claim_.path[end];
    std::size_t place = 0;
    if (claim_.places) {
      place = (*claim_.places)[end];
    } else {
      while (place < chain.size() && !are_proportional(chain[place], pose.quaternion)) ++place;
    }
    if (place >= chain.size() || !are_proportional(chain[place], pose.quaternion)) return std::nullopt;
    const std::size_t layer = place < first_.size() ? first_[place] : checked_.size() - 1;
    return crosses_odd(checked_[layer].barrier, pose.position);
  }

  const PathProof::Claim& claim_;
  const PathProof::Layers& layers_;
  const Monitor& monitor_;
  std::optional<Orientations> orientations_;
  std::optional<BlockedPoses> blocked_;
  std::vector<CheckedLayer> checked_;
  std::vector<std::size_t> first_;  // the first layer of each chart
};

}  // namespace

std::optional<std::string> complaint_about_layers(const PathProof& proof, const Monitor& monitor) {
  return LayersCheck(proof, monitor).run();
}

}  // namespace nef::planner
