// SPDX-License-Identifier: Apache-2.0
#include "apps/view/page/sphere_arrays.h"

#include <cmath>

namespace nef::view {
namespace {

// Six-decimal directions would be finer than any screen; 16 bits are enough for a sphere of a few hundred pixels.
void push_unit(std::vector<std::int16_t>& out, const std::array<double, 3>& v) {
  for (const double x : v) out.push_back(static_cast<std::int16_t>(std::lround(x * 32767)));
}

}  // namespace

void SphereArrays::add(const SphereDrawing& drawing) {
  for (const auto& dot : drawing.dots) {
    push_unit(directions, dot.direction);
    dots.insert(dots.end(), {dot.mark, dot.halfedge});
  }
  for (const auto& arc : drawing.arcs) {
    push_unit(normals, arc.normal);
    arcs.insert(arcs.end(), {arc.source, arc.target, arc.mark, arc.facet, arc.left, arc.right});
  }
  for (const auto& circle : drawing.circles) {
    push_unit(circle_normals, circle.normal);
    circles.insert(circles.end(), {circle.mark, circle.facet, circle.left, circle.right});
  }
  for (const auto& region : drawing.regions) regions.insert(regions.end(), {region.mark, region.volume});
  begin.insert(begin.end(),
               {static_cast<std::uint32_t>(dots.size() / 2), static_cast<std::uint32_t>(arcs.size() / 6),
                static_cast<std::uint32_t>(circles.size() / 4), static_cast<std::uint32_t>(regions.size() / 2)});
}

}  // namespace nef::view
