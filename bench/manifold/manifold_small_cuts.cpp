// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_manifold_small_cuts CASE_DIRECTORY: what nef_bench_small_cuts does, by the Manifold library.
#include <manifold/manifold.h>

#include <cstddef>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "bench/manifold/read_off.h"
#include "bench/report.h"
#include "bench/tiles/small_cubes.h"

namespace nef::bench {
namespace {

using manifold::Manifold;
using manifold::MeshGL64;

void run(const std::string& directory) {
  const MeshGL64 mesh = read_off(directory + "/0.off");
  const Stopwatch all;
  const Stopwatch import;
  Manifold solid(mesh);
  static_cast<void>(solid.NumTri());
  const double import_s = import.seconds();
  const Stopwatch cuts;
  for (const CubeCorners& cube : small_cubes()) {
    const auto side = static_cast<double>(cube.high[0] - cube.low[0]);
    solid = solid - Manifold::Cube({side, side, side})
                        .Translate({static_cast<double>(cube.low[0]), static_cast<double>(cube.low[1]),
                                    static_cast<double>(cube.low[2])});
    if (solid.Status() != Manifold::Error::NoError) throw std::runtime_error("Manifold refuses it");
    static_cast<void>(solid.NumTri());
  }
  const double cuts_s = cuts.seconds();
  const Stopwatch writing;
  const MeshGL64 out = solid.GetMeshGL64();
  std::printf("{\"import_s\": %.4g, \"cuts_s\": %.4g, \"export_s\": %.4g, \"all_s\": %.4g, \"triangles\": %zu}\n",
              import_s, cuts_s, writing.seconds(), all.seconds(), static_cast<std::size_t>(out.NumTri()));
}

}  // namespace
}  // namespace nef::bench

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::runtime_error("usage: nef_bench_manifold_small_cuts CASE_DIRECTORY");
    nef::bench::run(argv[1]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "nef_bench_manifold_small_cuts: %s\n", e.what());
    return 1;
  }
  return 0;
}
