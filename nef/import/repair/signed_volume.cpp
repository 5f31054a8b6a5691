// SPDX-License-Identifier: Apache-2.0
#include "nef/import/repair/signed_volume.h"

#include <cmath>
#include <vector>

#include "nef/geometry/vectors.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/number/interval.h"

namespace nef {
namespace {

using Interval3 = std::array<Interval, 3>;

// The nearest double is next to the number.
Interval around(const Rational& x) {
  const double nearest = nearest_double(x);
  return {std::nextafter(nearest, -HUGE_VAL), std::nextafter(nearest, HUGE_VAL)};
}

}  // namespace

MeasuredVolume signed_volume(const Mesh& mesh, const Monitor& monitor) {
  if (mesh.vertices.empty()) return {};
  const MeshSurface surface(mesh, monitor);
  std::vector<Interval3> from_first;  // vectors from the first vertex, as doubles have most digits there
  from_first.reserve(mesh.vertices.size());
  for (const Rational3& v : mesh.vertices) {
    const Rational3 vector = minus(v, mesh.vertices[0]);
    from_first.push_back({around(vector[0]), around(vector[1]), around(vector[2])});
  }
  Interval six_volumes;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    surface.for_each_triangle(mesh, f, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      six_volumes += dot(from_first[a], cross(from_first[b], from_first[c]));
    });
  }
  const Interval result = six_volumes / Interval(6);
  return {result.middle(), result.radius()};
}

}  // namespace nef
