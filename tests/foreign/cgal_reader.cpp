// SPDX-License-Identifier: Apache-2.0
//
// What CGAL makes of files of meshes: a line for each with its number of faces, whether it is closed, whether it
// crosses itself, and its volume. .ci/stage compiles it where CGAL is installed.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>

#include <iomanip>
#include <iostream>

int main(int argc, char** argv) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  namespace processing = CGAL::Polygon_mesh_processing;
  std::cout << std::setprecision(17);
  for (int i = 1; i < argc; ++i) {
    Mesh mesh;
    if (!processing::IO::read_polygon_mesh(argv[i], mesh)) {
      std::cout << argv[i] << " unreadable\n";
      continue;
    }
    processing::triangulate_faces(mesh);
    const bool closed = CGAL::is_closed(mesh);
    std::cout << argv[i] << " " << mesh.number_of_faces() << " " << (closed ? "closed" : "open") << " "
              << (processing::does_self_intersect(mesh) ? "crosses" : "simple") << " "
              << (closed ? processing::volume(mesh) : 0) << "\n";
  }
  return 0;
}
