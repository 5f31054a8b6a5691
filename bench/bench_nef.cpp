// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_nef CASE_DIRECTORY [REPEAT [THREADS]]: this library on one case, on so many threads.
#include <span>
#include <string>

#include "bench/generators.h"
#include "bench/report.h"
#include "nef/base/freed_memory.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/export/to_mesh.h"
#include "nef/polyhedron.h"

namespace nef::bench {
namespace {

Polyhedron united(const std::vector<Polyhedron>& operands, std::size_t count, const Monitor& monitor) {
  Polyhedron result = operands[0];
  for (std::size_t i = 1; i < count; ++i) result = unite(result, operands[i], monitor);
  return result;
}

Polyhedron imported(const Operand& operand, const Monitor& monitor) {
  MeshOptions options;
  options.monitor = monitor;
  options.as_surface = operand.surface;
  return from_mesh(operand.mesh, options);
}

// One mesh after the other, so that no two are in memory; on several threads side by side, as programs read several
// files (Session::load_all).
std::vector<Polyhedron> build(const std::string& directory, const Monitor& monitor, Report& report) {
  std::vector<Polyhedron> operands;
  double seconds = 0;
  double wall_seconds = 0;
  const auto timed = [&](const auto& step) {
    const Stopwatch watch;
    const nef::Stopwatch clock;
    step();
    seconds += watch.seconds();
    wall_seconds += clock.seconds();
  };
  if (monitor.threads() == 1) {
    read_operands(directory,
                  [&](const Operand& operand) { timed([&] { operands.push_back(imported(operand, monitor)); }); });
  } else {
    std::vector<Operand> meshes;
    read_operands(directory, [&](const Operand& operand) { meshes.push_back(operand); });
    operands.resize(meshes.size());
    timed([&] {
      parallel_for(meshes.size(), monitor, [&](std::size_t i, const Monitor& own) {
        operands[i] = imported(meshes[i], own.on_threads(monitor.threads()));
      });
    });
  }
  return_freed_memory();  // as read_polyhedron does behind large files
  report.build_s.push_back(seconds);
  report.build_wall_s.push_back(wall_seconds);
  return operands;
}

Report run(const std::string& directory, int repeat, const Monitor& monitor) {
  const CaseKind kind = read_case_kind(directory);
  Report report;
  std::vector<Polyhedron> operands;
  for (int i = 0; i < repeat; ++i) {
    operands.clear();
    operands = build(directory, monitor, report);
  }
  Polyhedron result;
  const auto operate = [&](const auto& operation) {
    for (int i = 0; i < repeat; ++i) {
      result = Polyhedron();
      const Stopwatch watch;
      const nef::Stopwatch clock;
      result = operation();
      report.op_s.push_back(watch.seconds());
      report.op_wall_s.push_back(clock.seconds());
    }
  };
  if (kind.operation == Operation::kUnion) {
    operate([&] { return united(operands, operands.size(), monitor); });
  } else if (kind.operation == Operation::kUniteAll) {
    operate([&] { return unite_all(operands, monitor); });
  } else if (kind.operation == Operation::kSubtractAll) {
    operate([&] { return subtract(operands[0], unite_all(std::span(operands).subspan(1), monitor), monitor); });
  } else if (kind.operation == Operation::kDifference) {
    const Polyhedron base = united(operands, operands.size() - 1, monitor);
    operate([&] { return subtract(base, operands.back(), monitor); });
  } else {
    result = united(operands, operands.size(), monitor);
    const std::vector<Rational3> points = query_points(std::stoi(kind.name.substr(kind.name.find('-') + 1)));
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
  return nef::bench::engine_main(
      "nef_bench_nef", argc, argv, [](const std::string& directory, int repeat, int threads) {
        return nef::bench::run(directory, repeat, nef::Monitor().on_threads(static_cast<unsigned>(threads)));
      });
}
