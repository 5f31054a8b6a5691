// SPDX-License-Identifier: Apache-2.0
#include "apps/view/page/item_details.h"

#include "apps/view/page/exact_text.h"
#include "apps/view/page/sphere_arrays.h"
#include "nef/base/error.h"

namespace nef::view {

nlohmann::json item_details(const Polyhedron& set, std::span<const std::uint32_t> vertices,
                            std::optional<std::uint32_t> facet) {
  const Complex& complex = set.complex();
  nlohmann::json details{{"points", nlohmann::json::array()}};
  SphereArrays spheres;
  for (const std::uint32_t index : vertices) {
    if (index >= complex.vertex_count()) throw InputError("the set has no vertex " + std::to_string(index));
    const VertexId vertex{index};
    if (!complex.points.finite(point_of(vertex))) throw InputError("this vertex is at infinity");
    details["points"].push_back(point_text(complex, vertex));
    spheres.add(draw_sphere_map(complex, vertex));
  }
  details["spheres"] = {{"begin", spheres.begin},     {"directions", spheres.directions},
                        {"dots", spheres.dots},       {"normals", spheres.normals},
                        {"arcs", spheres.arcs},       {"circleNormals", spheres.circle_normals},
                        {"circles", spheres.circles}, {"regions", spheres.regions}};
  if (facet) {
    if (*facet >= complex.facet_count()) throw InputError("the set has no facet " + std::to_string(*facet));
    details["plane"] = plane_text(complex, FacetId{*facet});
  }
  return details;
}

}  // namespace nef::view
