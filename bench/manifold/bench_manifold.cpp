// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_manifold CASE_DIRECTORY [REPEAT]: the Manifold library (doubles, not exact) on one case.
#include <manifold/manifold.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/manifold/read_off.h"
#include "bench/report.h"

namespace nef::bench {
namespace {

using manifold::Manifold;
using manifold::MeshGL64;

Manifold evaluated(const Manifold& lazy) {
  if (lazy.Status() != Manifold::Error::NoError) throw std::runtime_error("Manifold refuses it");
  return lazy;
}

// Each mesh is converted before the next one is read.
std::vector<Manifold> build(const std::string& directory, Report& report) {
  std::ifstream in(directory + "/case.txt");
  std::string word;
  in >> word >> word;
  std::vector<Manifold> operands;
  double seconds = 0;
  for (std::string kind; in >> kind;) {
    if (kind == "surface") throw std::runtime_error("not a solid");
    const MeshGL64 mesh = read_off(directory + "/" + std::to_string(operands.size()) + ".off");
    const Stopwatch watch;
    operands.push_back(evaluated(Manifold(mesh)));
    seconds += watch.seconds();
  }
  return_freed_memory();
  report.build_s.push_back(seconds);
  return operands;
}

Report run(const std::string& directory, int repeat) {
  std::ifstream in(directory + "/case.txt");
  std::string name;
  int operation = 0;
  if (!(in >> name >> operation)) throw std::runtime_error("no case");
  if (operation == 2) throw std::runtime_error("not a Boolean");
  const bool difference = operation == 1;
  Report report;
  // In the order of nef_bench_nef, so that each conversion finds the memory that the one before it has left, and not
  // what an operation did.
  std::vector<Manifold> operands;
  for (int i = 0; i < repeat; ++i) {
    operands.clear();
    operands = build(directory, report);
  }
  const bool together = operation > 2;
  const std::size_t before = difference ? operands.size() - 1 : 1;
  Manifold base = operands[0];
  for (std::size_t k = 1; k < before; ++k) base = evaluated(base + operands[k]);
  Manifold result;
  for (int i = 0; i < repeat; ++i) {
    result = Manifold();
    const Stopwatch operate;
    if (together) {
      result = evaluated(
          Manifold::BatchBoolean(operands, operation == 3 ? manifold::OpType::Add : manifold::OpType::Subtract));
      static_cast<void>(result.NumTri());
    } else if (difference) {
      result = evaluated(base - operands.back());
    } else {
      result = base;
      for (std::size_t k = 1; k < operands.size(); ++k) result = evaluated(result + operands[k]);
    }
    report.op_s.push_back(operate.seconds());
  }
  for (int i = 0; i < repeat; ++i) {
    const Stopwatch write;
    const MeshGL64 out = result.GetMeshGL64();
    report.export_s.push_back(write.seconds());
    report.triangles = out.NumTri();
  }
  report.vertices = result.NumVert();
  report.edges = result.NumEdge();
  report.facets = result.NumTri();
  return report;
}

}  // namespace
}  // namespace nef::bench

int main(int argc, char** argv) {
  return nef::bench::engine_main("nef_bench_manifold", argc, argv, [](const std::string& directory, int repeat, int) {
    return nef::bench::run(directory, repeat);
  });
}
