// SPDX-License-Identifier: Apache-2.0
#include "apps/view/page/exact_text.h"

namespace nef::view {

std::string point_text(const Complex& complex, VertexId vertex) {
  const Rational3 point = complex.points.rational(point_of(vertex));
  return to_string(point[0]) + ' ' + to_string(point[1]) + ' ' + to_string(point[2]);
}

std::string plane_text(const Complex& complex, FacetId facet) {
  const PlaneId plane = complex.facets[facet].plane;
  std::string text;
  for (std::size_t i = 0; i < 4; ++i) {
    text += (i == 0 ? "" : " ") + complex.planes.oriented_coefficient(plane, i).get_str();
  }
  return text;
}

}  // namespace nef::view
