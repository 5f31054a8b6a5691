// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_nef CASE_DIRECTORY [REPEAT [THREADS]]: this library on one case, on so many threads.
#include <cstdlib>
#include <exception>
#include <span>
#include <string>

#include "bench/generators.h"
#include "bench/report.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/export/to_mesh.h"
#include "nef/polyhedron.h"

namespace nef::bench {
namespace {

Polyhedron united(const std::vector<Polyhedron>& operands, std::size_t count, unsigned threads) {
  Polyhedron result = operands[0];
  for (std::size_t i = 1; i < count; ++i) result = unite(result, operands[i], threads);
  return result;
}

Report run(const std::string& directory, int repeat, unsigned threads) {
  const Case bench_case = read_case(directory);
  Report report;
  std::vector<Polyhedron> operands;
  for (int i = 0; i < repeat; ++i) {
    operands.clear();
    const Stopwatch watch;
    const nef::Stopwatch clock;
    for (const Operand& operand : bench_case.operands) {
      MeshOptions options;
      options.threads = threads;
      options.as_surface = operand.surface;
      operands.push_back(from_mesh(operand.mesh, options));
    }
    report.build_s.push_back(watch.seconds());
    report.build_wall_s.push_back(clock.seconds());
  }
  Polyhedron result;
  if (bench_case.operation == Operation::kUnion) {
    for (int i = 0; i < repeat; ++i) {
      const Stopwatch watch;
      const nef::Stopwatch clock;
      result = united(operands, operands.size(), threads);
      report.op_s.push_back(watch.seconds());
      report.op_wall_s.push_back(clock.seconds());
    }
  } else if (bench_case.operation == Operation::kUniteAll || bench_case.operation == Operation::kSubtractAll) {
    const bool all = bench_case.operation == Operation::kUniteAll;
    for (int i = 0; i < repeat; ++i) {
      const Stopwatch watch;
      const nef::Stopwatch clock;
      result = all ? unite_all(operands, threads)
                   : subtract(operands[0], unite_all(std::span(operands).subspan(1), threads), threads);
      report.op_s.push_back(watch.seconds());
      report.op_wall_s.push_back(clock.seconds());
    }
  } else if (bench_case.operation == Operation::kDifference) {
    const Polyhedron base = united(operands, operands.size() - 1, threads);
    for (int i = 0; i < repeat; ++i) {
      const Stopwatch watch;
      const nef::Stopwatch clock;
      result = subtract(base, operands.back(), threads);
      report.op_s.push_back(watch.seconds());
      report.op_wall_s.push_back(clock.seconds());
    }
  } else {
    result = united(operands, operands.size(), threads);
    const std::vector<Rational3> points =
        query_points(std::stoi(bench_case.name.substr(bench_case.name.find('-') + 1)));
    static_cast<void>(contains(result, points[0]));  // CGAL's structure is there after the union; build ours, too
    for (int i = 0; i < repeat; ++i) {
      const Stopwatch watch;
      report.inside = 0;
      for (const Rational3& point : points) report.inside += contains(result, point) ? 1 : 0;
      report.op_s.push_back(watch.seconds());
    }
  }
  for (int i = 0; i < repeat; ++i) {
    const Stopwatch watch;
    report.triangles = to_rounded_mesh(result).mesh.face_count();
    report.export_s.push_back(watch.seconds());
  }
  report.bytes = result.complex().bytes();
  const Counts n = counts(result);
  report.vertices = n.vertices;
  report.edges = n.edges;
  report.facets = n.facets;
  report.volumes = n.volumes;
  return report;
}

}  // namespace
}  // namespace nef::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: nef_bench_nef CASE_DIRECTORY [REPEAT [THREADS]]\n");
    return 2;
  }
  try {
    const int repeat = argc > 2 ? std::max(1, std::atoi(argv[2])) : 1;
    const int threads = argc > 3 ? std::max(1, std::atoi(argv[3])) : 1;
    nef::bench::run(argv[1], repeat, static_cast<unsigned>(threads)).print();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nef_bench_nef: %s\n", error.what());
    return 2;
  }
  return 0;
}
