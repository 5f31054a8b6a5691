// SPDX-License-Identifier: Apache-2.0
#include "bench/minkowski/cgal_peer.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/convex_decomposition_3.h>
#include <CGAL/minkowski_sum_3.h>

#include <sstream>

#include "nef/base/timing/stopwatch.h"

namespace nef::bench {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Surface = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

Kernel::FT number(const Rational& value) {
  Kernel::FT result;
  std::istringstream(value.get_str()) >> result;
  return result;
}

class Builder : public CGAL::Modifier_base<Surface::HalfedgeDS> {
 public:
  explicit Builder(const Mesh& mesh) : mesh_(mesh) {}
  void operator()(Surface::HalfedgeDS& target) override {
    CGAL::Polyhedron_incremental_builder_3<Surface::HalfedgeDS> builder(target, true);
    builder.begin_surface(mesh_.vertices.size(), mesh_.face_count());
    for (const Rational3& p : mesh_.vertices) {
      builder.add_vertex(Kernel::Point_3(number(p[0]), number(p[1]), number(p[2])));
    }
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      const auto face = mesh_.face(f);
      builder.begin_facet();
      for (const std::uint32_t v : face) builder.add_vertex_to_facet(v);
      builder.end_facet();
    }
    builder.end_surface();
  }

 private:
  const Mesh& mesh_;
};

Nef solid(const Mesh& mesh) {
  Surface surface;
  Builder builder(mesh);
  surface.delegate(builder);
  return Nef(surface);
}

}  // namespace

PeerResult cgal_minkowski_sum(const Mesh& a, const Mesh& b) {
  Nef x = solid(a);
  Nef y = solid(b);
  PeerResult result;
  Nef pieces = x;
  CGAL::convex_decomposition_3(pieces);
  for (auto volume = pieces.volumes_begin(); volume != pieces.volumes_end(); ++volume) {
    if (volume->mark()) ++result.pieces;
  }
  const ThreadStopwatch watch;
  const Nef sum = CGAL::minkowski_sum_3(x, y);
  result.seconds = watch.seconds();
  result.vertices = sum.number_of_vertices();
  result.facets = sum.number_of_facets();
  result.volumes = sum.number_of_volumes();
  return result;
}

}  // namespace nef::bench
