// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_autorefine MESH.off: CGAL's autorefine_and_remove_self_intersections over EPICK (exact predicates, rounded
// coordinates) on a mesh that crosses itself, as a line of JSON: CPU seconds of the call alone, without reading the
// file, and whether CGAL says that the result has no crossings. The peer of bench/mesh_rows.py.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <cstdio>
#include <exception>

#include "bench/report.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

}  // namespace

int main(int argc, char** argv) {
  Surface surface;
  if (argc != 2 || !pmp::IO::read_polygon_mesh(argv[1], surface)) {
    std::fprintf(stderr, "Usage: nef_bench_autorefine MESH.off, a mesh that is a manifold\n");
    return 2;
  }
  try {
    const nef::bench::Stopwatch watch;
    const bool free = pmp::experimental::autorefine_and_remove_self_intersections(surface);
    const double seconds = watch.seconds();
    std::printf("{\"seconds\": %.6g, \"free\": %s, \"faces\": %zu, \"peak_kb\": %ld}\n", seconds,
                free ? "true" : "false", static_cast<std::size_t>(surface.number_of_faces()), nef::bench::peak_kb());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "refused: %s\n", error.what());
    return 3;
  }
  return 0;
}
