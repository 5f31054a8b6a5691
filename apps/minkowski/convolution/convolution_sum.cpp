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

// Measured: stars and gears have a hundred pairs a facet, meshes with many parallel facets about one.
constexpr std::size_t kCoplanarPairs = 8;

}  // namespace

std::optional<Polyhedron> convolution_sum(const Polyhedron& a, const Polyhedron& b, const ConvolutionOptions& options,
                                          ConvolutionReport& report) {
  if (options.only_if_fast && is_convex(a) && is_convex(b)) return std::nullopt;
  const SolidFeatures of_a(a);
  const SolidFeatures of_b(b);
  ConvolutionFacets facets = reduced_convolution(of_a, of_b);
  if (options.only_if_fast && coplanar_pairs(facets) > kCoplanarPairs * facets.size()) return std::nullopt;
  const auto poll = [&options](double share) {
    if (options.poll) options.poll(share);
  };
  const RoundedFacets rounded(facets);
  const SurvivingIntervals intervals = surviving_intervals(facets, rounded, [&poll](double share) { poll(share / 2); });
  ConvolutionRegions regions(facets, rounded, intervals);
  const Polyhedron turned = negate(b);
  const auto contains_point = [&](const Rational3& x) {
    return !intersect(a, transform(turned, AffineMap::translate(x))).is_empty();
  };
  std::variant<Complex, Defect> sum = regions.run(contains_point, [&poll](double share) { poll((1 + share) / 2); });
  // Synthesis checks what it is given; should it refuse, the cells are there, and the tests see that they were needed.
  if (std::holds_alternative<Defect>(sum)) return std::nullopt;
  report = {facets.size(), intervals.segments.size(), intervals.intervals.size(), regions.counts().points,
            regions.counts().regions};
  return Polyhedron(std::get<Complex>(std::move(sum)));
}

}  // namespace nef::minkowski
