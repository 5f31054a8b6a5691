// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_corefinement CASE_DIRECTORY [REPEAT]: CGAL's corefinement of triangle meshes over
// EPICK (exact predicates, rounded coordinates) on one case. It refuses what is not a manifold.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>

#include <stdexcept>
#include <string>

#include "bench/generators.h"
#include "bench/report.h"

namespace nef::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

Surface surface_of(const Operand& operand) {
  if (operand.surface) throw std::runtime_error("not a solid");
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  for (const Rational3& v : operand.mesh.vertices) {
    vertices.push_back(surface.add_vertex({v[0].get_d(), v[1].get_d(), v[2].get_d()}));
  }
  for (std::size_t f = 0; f < operand.mesh.face_count(); ++f) {
    std::vector<Surface::Vertex_index> face;
    for (const std::uint32_t corner : operand.mesh.face(f)) face.push_back(vertices[corner]);
    surface.add_face(face);
  }
  pmp::triangulate_faces(surface);
  return surface;
}

Report run(const std::string& directory, int repeat) {
  const Operation operation = read_case_kind(directory).operation;
  if (operation >= Operation::kLocate) throw std::runtime_error("no Boolean of two");
  Report report;
  std::vector<Surface> operands;
  double build_seconds = 0;
  read_operands(directory, [&](const Operand& operand) {
    const Stopwatch watch;
    operands.push_back(surface_of(operand));
    build_seconds += watch.seconds();
  });
  report.build_s.push_back(build_seconds);
  const bool difference = operation == Operation::kDifference;
  const std::size_t before = difference ? operands.size() - 1 : 1;
  Surface base = operands[0];
  bool ok = true;
  for (std::size_t i = 1; i < before && ok; ++i) {
    Surface next;
    Surface other = operands[i];
    ok = pmp::corefine_and_compute_union(base, other, next);
    base = next;
  }
  Surface result;
  for (int r = 0; r < repeat && ok; ++r) {
    Surface left = base;
    std::vector<Surface> others(operands.begin() + static_cast<long>(before), operands.end());
    const Stopwatch watch;
    for (Surface& other : others) {
      Surface next;
      ok = ok && (difference ? pmp::corefine_and_compute_difference(left, other, next)
                             : pmp::corefine_and_compute_union(left, other, next));
      left = std::move(next);
    }
    report.op_s.push_back(watch.seconds());
    result = std::move(left);
  }
  if (!ok) throw std::runtime_error("refused: the result is no manifold");
  report.vertices = result.number_of_vertices();
  report.edges = result.number_of_edges();
  report.facets = result.number_of_faces();
  return report;
}

}  // namespace
}  // namespace nef::bench

int main(int argc, char** argv) {
  return nef::bench::engine_main(
      "nef_bench_corefinement", argc, argv,
      [](const std::string& directory, int repeat, int) { return nef::bench::run(directory, repeat); });
}
