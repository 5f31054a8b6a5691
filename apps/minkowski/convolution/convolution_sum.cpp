// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/convolution_sum.h"

#include <variant>
#include <vector>

#include "apps/minkowski/convolution/convolution_regions.h"
#include "apps/minkowski/minkowski.h"

namespace nef::minkowski {

bool has_convolution(const Polyhedron& a) { return !a.is_empty() && a.is_bounded() && a.is_regular(); }

namespace {

// How many pairs of facets lie in one plane.
std::size_t coplanar_pairs(const ConvolutionFacets& facets) {
  std::vector<std::size_t> count(facets.planes.size(), 0);
  std::size_t pairs = 0;
  for (const PlaneId plane : facets.plane) pairs += count[plane.row()]++;
  return pairs;
}

// The definition: x is in A + B iff A meets x - B.
class Membership {
 public:
  Membership(const Polyhedron& a, const Polyhedron& b) : a_(a), b_(b), turned_(negate(b)) {}

  [[nodiscard]] bool operator()(const Rational3& x) const {
    return reaches(a_, b_, x) || reaches(b_, a_, x) ||
           !intersect(a_, transform(turned_, AffineMap::translate(x))).is_empty();
  }

 private:
  // True if x - v is in A for one of some vertices v of B: mostly that settles it, for a hundredth of the price.
  static bool reaches(const Polyhedron& a, const Polyhedron& b, const Rational3& x) {
    constexpr std::size_t kAsked = 32;
    const std::size_t count = b.complex().vertex_count();
    for (std::size_t v = 0; v < count; v += 1 + count / kAsked) {
      const Rational3 p = b.complex().points.rational(PointId{static_cast<std::uint32_t>(v)});
      if (contains(a, {x[0] - p[0], x[1] - p[1], x[2] - p[2]})) return true;
    }
    return false;
  }

  const Polyhedron& a_;
  const Polyhedron& b_;
  Polyhedron turned_;
};

// Measured: stars and gears have a hundred pairs a facet, meshes with many parallel facets about one.
constexpr std::size_t kCoplanarPairs = 8;
// So many sums of pieces of two parallel facets tell that before anything is summed.
constexpr std::size_t kParallelPieces = 100;

bool are_caps(const SolidFeatures& a, const SolidFeatures& b) {
  for (const SolidFacet& f : a.facets()) {
    for (const SolidFacet& g : b.facets()) {
      if (f.pieces.size() * g.pieces.size() > kParallelPieces && same_direction(f.normal, g.normal)) return true;
    }
  }
  return false;
}

}  // namespace

std::optional<Polyhedron> convolution_sum(const Polyhedron& a, const Polyhedron& b, const ConvolutionOptions& options,
                                          ConvolutionReport& report) {
  if (options.only_if_fast && is_convex(a) && is_convex(b)) return std::nullopt;
  const SolidFeatures of_a(a);
  const SolidFeatures of_b(b);
  if (options.only_if_fast && are_caps(of_a, of_b)) return std::nullopt;
  ConvolutionFacets facets = reduced_convolution(of_a, of_b);
  if (options.only_if_fast && coplanar_pairs(facets) > kCoplanarPairs * facets.size()) return std::nullopt;
  const auto poll = [&options](double share) {
    if (options.poll) options.poll(share);
  };
  const RoundedFacets rounded(facets);
  const SurvivingIntervals intervals = surviving_intervals(facets, rounded, [&poll](double share) { poll(share / 2); });
  ConvolutionRegions regions(facets, rounded, intervals);
  std::variant<Complex, Defect> sum = regions.run(Membership(a, b), [&poll](double share) { poll((1 + share) / 2); });
  // Synthesis checks what it is given; should it refuse, the cells are there, and the tests see that they were needed.
  if (std::holds_alternative<Defect>(sum)) return std::nullopt;
  report = {facets.size(), intervals.segments.size(), intervals.intervals.size(), regions.counts().points,
            regions.counts().regions};
  return Polyhedron(std::get<Complex>(std::move(sum)));
}

}  // namespace nef::minkowski
