// SPDX-License-Identifier: Apache-2.0
#include "apps/view/scene/item_finder.h"

#include <algorithm>

namespace nef::view {
namespace {

// A point inside an item: the mean of some of its corners.
Rational3 mean(std::initializer_list<const Rational3*> points) {
  Rational3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const Rational3* point : points) result[i] += (*point)[i];
    result[i] /= static_cast<unsigned long>(points.size());
  }
  return result;
}

std::uint32_t index_if(const Location& found, Location::Kind kind) {
  return found.kind == kind ? found.index : kArtificial;
}

}  // namespace

void find_items(const Complex& drawn, Scene& scene, const Monitor& monitor) {
  const Complex& source = scene.source.complex();
  std::vector<Rational3> points;
  for (SceneVertex& vertex : scene.vertices) {
    points.push_back(drawn.points.rational(PointId{vertex.index}));
    vertex.index = index_if(locate(scene.source, points.back(), monitor), Location::Kind::kVertex);
  }
  for (SceneEdge& edge : scene.edges) {
    const Location found = locate(scene.source, mean({&points[edge.from], &points[edge.to]}), monitor);
    edge.index = index_if(found, Location::Kind::kEdge);
    if (edge.index != kArtificial) edge.index = source.edge(HalfedgeId{edge.index}).index();
  }
  for (SceneVolume& volume : scene.volumes) volume.index = kArtificial;
  for (SceneFacet& facet : scene.facets) {
    const auto& [a, b, c] = scene.triangles[facet.first_triangle];
    const Location found = locate(scene.source, mean({&points[a], &points[b], &points[c]}), monitor);
    facet.index = index_if(found, Location::Kind::kFacet);
    if (found.kind == Location::Kind::kFacet) {
      // Both complexes see the facet from the same side of the same plane.
      scene.volumes[facet.above].index = source.facets[found.facet()].volume_above.index();
      scene.volumes[facet.below].index = source.facets[found.facet()].volume_below.index();
    } else if (found.kind == Location::Kind::kVolume) {
      // A cut through a volume: what lies behind it is part of that volume, what lies before it was cut away.
      const std::uint32_t kept = facet.above == 0 ? facet.below : facet.above;
      scene.volumes[kept].index = found.index;
      if (facet.origin == Origin::kBox) scene.volumes[kept].bounded = false;
    }
  }
}

void forget_items(Scene& scene) {
  for (SceneVertex& vertex : scene.vertices) vertex.index = kArtificial;
  for (SceneEdge& edge : scene.edges) edge.index = kArtificial;
  for (SceneFacet& facet : scene.facets) facet.index = kArtificial;
  for (SceneVolume& volume : scene.volumes) volume.index = kArtificial;
}

}  // namespace nef::view
