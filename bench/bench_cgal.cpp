// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_cgal CASE_DIRECTORY [REPEAT]: CGAL's Nef_polyhedron_3 over Epeck on one case.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "bench/generators.h"
#include "bench/report.h"

namespace nef::bench {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;
using Surface = CGAL::Polyhedron_3<Kernel>;

Kernel::FT number(const Rational& value) {
  if (value.get_den() == 1 && value.get_num().fits_slong_p() && std::abs(value.get_num().get_si()) < (1L << 53)) {
    return Kernel::FT(static_cast<double>(value.get_num().get_si()));
  }
  using Exact = Kernel::FT::ET;
  return Kernel::FT(Exact(value.get_str()));
}

Kernel::Point_3 point(const Rational3& p) { return {number(p[0]), number(p[1]), number(p[2])}; }

class Builder : public CGAL::Modifier_base<Surface::HalfedgeDS> {
 public:
  explicit Builder(const Mesh& mesh) : mesh_(mesh) {}
  void operator()(Surface::HalfedgeDS& target) override {
    CGAL::Polyhedron_incremental_builder_3<Surface::HalfedgeDS> builder(target, true);
    builder.begin_surface(mesh_.vertices.size(), mesh_.face_count());
    for (const Rational3& v : mesh_.vertices) builder.add_vertex(point(v));
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      const auto face = mesh_.face(f);
      builder.add_facet(face.begin(), face.end());
    }
    builder.end_surface();
  }

 private:
  const Mesh& mesh_;
};

// The union of the faces, by halves so that early operands stay small.
Nef sheet(const Mesh& mesh, std::size_t first, std::size_t last) {
  if (last - first == 1) {
    std::vector<Kernel::Point_3> points;
    for (const std::uint32_t corner : mesh.face(first)) points.push_back(point(mesh.vertices[corner]));
    return Nef(points.begin(), points.end());
  }
  const std::size_t middle = (first + last) / 2;
  return sheet(mesh, first, middle) + sheet(mesh, middle, last);
}

Nef operand_of(const Operand& operand) {
  if (operand.surface) return sheet(operand.mesh, 0, operand.mesh.face_count());
  Surface surface;
  Builder builder(operand.mesh);
  surface.delegate(builder);
  return Nef(surface);
}

Nef united(const std::vector<Nef>& operands, std::size_t count) {
  Nef result = operands[0];
  for (std::size_t i = 1; i < count; ++i) result = result + operands[i];
  return result;
}

bool inside(const Nef& set, const Rational3& p) {
  const Nef::Object_handle place = set.locate(point(p));
  Nef::Vertex_const_handle v;
  Nef::Halfedge_const_handle e;
  Nef::Halffacet_const_handle f;
  Nef::Volume_const_handle c;
  if (CGAL::assign(v, place)) return v->mark();
  if (CGAL::assign(e, place)) return e->mark();
  if (CGAL::assign(f, place)) return f->mark();
  CGAL::assign(c, place);
  return c->mark();
}

std::vector<Nef> build(const std::string& directory, Report& report) {
  std::vector<Nef> operands;
  double seconds = 0;
  read_operands(directory, [&](const Operand& operand) {
    const Stopwatch watch;
    operands.push_back(operand_of(operand));
    seconds += watch.seconds();
  });
  report.build_s.push_back(seconds);
  return operands;
}

Report run(const std::string& directory, int repeat) {
  const CaseKind kind = read_case_kind(directory);
  if (kind.operation > Operation::kLocate) throw std::runtime_error("not asked to do many operands at once");
  Report report;
  std::vector<Nef> operands;
  for (int i = 0; i < repeat; ++i) {
    operands.clear();
    operands = build(directory, report);
  }
  Nef result;
  const bool locating = kind.operation == Operation::kLocate;
  const std::size_t base_count = operands.size() - (kind.operation == Operation::kDifference ? 1 : 0);
  Nef base;
  if (kind.operation != Operation::kUnion) base = united(operands, base_count);
  std::vector<Rational3> points;
  if (locating) {
    points = query_points(std::stoi(kind.name.substr(kind.name.find('-') + 1)));
    result = base;
    static_cast<void>(inside(result, points[0]));
  }
  for (int i = 0; i < repeat; ++i) {
    if (!locating) result = Nef();
    const Stopwatch watch;
    if (locating) {
      report.inside = 0;
      for (const Rational3& p : points) report.inside += inside(result, p) ? 1 : 0;
    } else {
      result = kind.operation == Operation::kUnion ? united(operands, operands.size()) : base - operands.back();
    }
    report.op_s.push_back(watch.seconds());
  }
  report.vertices = result.number_of_vertices();
  report.edges = result.number_of_edges();
  report.facets = result.number_of_facets();
  report.volumes = result.number_of_volumes();
  return report;
}

}  // namespace
}  // namespace nef::bench

int main(int argc, char** argv) {
  return nef::bench::engine_main("nef_bench_cgal", argc, argv, [](const std::string& directory, int repeat, int) {
    return nef::bench::run(directory, repeat);
  });
}
