// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_small_cuts CASE_DIRECTORY [LIMIT...]: the first solid of a case, a sphere of radius 2^30 around the origin,
// minus 50 small cubes, one after another, in tiles of at most so many vertices, from mesh to mesh.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/generators.h"
#include "bench/report.h"
#include "bench/tiles/small_cubes.h"
#include "nef/base/freed_memory.h"
#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/polyhedron.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef::bench {
namespace {

Mesh first_solid(const std::string& directory) {
  Mesh mesh;
  read_operands(directory, [&](const Operand& operand) {
    if (mesh.face_count() == 0) mesh = operand.mesh;
  });
  return_freed_memory();
  return mesh;
}

// Prints the CPU seconds of each step.
void run(const Mesh& mesh, const std::vector<Polyhedron>& cubes, std::size_t limit) {
  const Tiling tiling{.limit = limit};
  const Stopwatch all;
  const Stopwatch import;
  Polyhedron whole = from_mesh(mesh);
  const double import_s = import.seconds();
  const Stopwatch division;
  TiledPolyhedron tiles(whole, tiling);
  whole = Polyhedron();
  const double division_s = division.seconds();
  const Stopwatch cuts;
  for (const Polyhedron& cube : cubes) tiles = subtract(tiles, cube);
  const double cuts_s = cuts.seconds();
  const Stopwatch gluing;
  const Polyhedron result = tiles.polyhedron();
  const double gluing_s = gluing.seconds();
  const Stopwatch writing;
  const std::size_t triangles = to_rounded_mesh(result).mesh.face_count();
  std::printf(
      "{\"limit\": %zu, \"tiles\": %zu, \"import_s\": %.4g, \"tiles_s\": %.4g, \"cuts_s\": %.4g, \"gluing_s\": %.4g, "
      "\"export_s\": %.4g, \"all_s\": %.4g, \"triangles\": %zu}\n",
      limit, tiles.tile_count(), import_s, division_s, cuts_s, gluing_s, writing.seconds(), all.seconds(), triangles);
}

}  // namespace
}  // namespace nef::bench

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw std::runtime_error("usage: nef_bench_small_cuts CASE_DIRECTORY [LIMIT...]");
    const nef::Mesh mesh = nef::bench::first_solid(argv[1]);
    std::vector<nef::Polyhedron> cubes;
    for (const auto& [low, high] : nef::bench::small_cubes()) {
      cubes.push_back(nef::make_box({low[0], low[1], low[2]}, {high[0], high[1], high[2]}));
    }
    if (argc == 2) nef::bench::run(mesh, cubes, nef::tiling_for(mesh.vertices.size()).limit);
    for (int i = 2; i < argc; ++i) nef::bench::run(mesh, cubes, std::strtoul(argv[i], nullptr, 10));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "nef_bench_small_cuts: %s\n", e.what());
    return 1;
  }
  return 0;
}
