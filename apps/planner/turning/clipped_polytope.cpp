// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/clipped_polytope.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "nef/base/error.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

constexpr std::uint32_t kNoVertex = 0xffffffffU;

// Of a solid with vertices on both sides of a plane: the part below.
class Clip {
 public:
  // `beyond` says how far each vertex is beyond the plane.
  Clip(const Mesh& solid, const std::vector<Rational>& beyond)
      : solid_(solid), beyond_(beyond), number_(beyond.size(), kNoVertex) {}

  Mesh run() {
    for (std::size_t f = 0; f < solid_.face_count(); ++f) cut_face(solid_.face(f));
    // The cut is one convex face.
    NEF_ASSERT(cut_.size() >= 3);
    std::vector<std::uint32_t> ring;
    for (auto at = cut_.begin(); ring.size() < cut_.size(); at = cut_.find(at->second)) {
      NEF_ASSERT(at != cut_.end());
      ring.push_back(at->first);
    }
    result_.push_face(ring);
    return std::move(result_);
  }

 private:
  void cut_face(std::span<const std::uint32_t> ring) {
    std::vector<std::uint32_t> rest;
    std::uint32_t entry = kNoVertex;  // where the face comes back from beyond ...
    std::uint32_t exit = kNoVertex;   // ... and where it leaves
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::uint32_t from = ring[k];
      const std::uint32_t to = ring[(k + 1) % ring.size()];
      if (beyond_[from] <= 0) {
        rest.push_back(kept(from));
        if (beyond_[to] <= 0) continue;
        if (beyond_[from] < 0) rest.push_back(crossing(from, to));
        exit = rest.back();
      } else if (beyond_[to] < 0) {
        rest.push_back(crossing(from, to));
        entry = rest.back();
      } else if (beyond_[to] == 0) {
        entry = kept(to);
      }
    }
    if (rest.size() > 2) result_.push_face(rest);
    // The face beyond the plane has the cut to its other side; one that only has a vertex in the plane has no part of
    // it.
    if (entry != exit) cut_[entry] = exit;
  }

  std::uint32_t kept(std::uint32_t v) {
    if (number_[v] == kNoVertex) number_[v] = added(solid_.vertices[v]);
    return number_[v];
  }

  std::uint32_t crossing(std::uint32_t a, std::uint32_t b) {
    const auto [place, is_new] = crossings_.try_emplace(std::minmax(a, b), 0);
    if (is_new) {
      const Rational t = beyond_[a] / (beyond_[a] - beyond_[b]);
      Rational3 point = solid_.vertices[a];
      for (std::size_t c = 0; c < 3; ++c) point[c] += t * (solid_.vertices[b][c] - point[c]);
      place->second = added(point);
    }
    return place->second;
  }

  std::uint32_t added(const Rational3& point) {
    result_.vertices.push_back(point);
    return static_cast<std::uint32_t>(result_.vertices.size() - 1);
  }

  const Mesh& solid_;
  const std::vector<Rational>& beyond_;
  std::vector<std::uint32_t> number_;  // of kept vertices in the result
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings_;
  std::map<std::uint32_t, std::uint32_t> cut_;  // the vertex after a vertex, counterclockwise as seen from beyond
  Mesh result_;
};

}  // namespace

std::optional<Mesh> clipped(Mesh solid, const Rational3& normal, const Rational& offset) {
  std::vector<Rational> beyond;
  for (const Rational3& v : solid.vertices) beyond.push_back(dot(normal, v) - offset);
  const auto [least, most] = std::minmax_element(beyond.begin(), beyond.end());
  if (*most <= 0) return solid;
  if (*least >= 0) return std::nullopt;
  return Clip(solid, beyond).run();
}

}  // namespace nef::planner
