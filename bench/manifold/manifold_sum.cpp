// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_manifold_sum A.stl B.stl: the Minkowski sum of two solids by the Manifold library (doubles, not exact).
// Reads STL in text, since that library takes triangles only, and prints the triangles and the volume of the sum.
#include <manifold/manifold.h>

#include <array>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

namespace {

manifold::MeshGL64 read_stl(const std::string& path) {
  std::ifstream in(path);
  manifold::MeshGL64 mesh;
  mesh.numProp = 3;
  std::map<std::array<double, 3>, std::size_t> number;
  for (std::string word; in >> word;) {
    if (word != "vertex") continue;
    std::array<double, 3> p{};
    if (!(in >> p[0] >> p[1] >> p[2])) throw std::runtime_error(path + ": ends too early");
    const auto [at, is_new] = number.emplace(p, number.size());
    if (is_new) mesh.vertProperties.insert(mesh.vertProperties.end(), p.begin(), p.end());
    mesh.triVerts.push_back(at->second);
  }
  return mesh;
}

manifold::Manifold evaluated(const manifold::Manifold& lazy) {
  if (lazy.Status() != manifold::Manifold::Error::NoError) throw std::runtime_error("Manifold refuses it");
  return lazy;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: nef_bench_manifold_sum A.stl B.stl\n");
    return 2;
  }
  try {
    const manifold::Manifold a = evaluated(manifold::Manifold(read_stl(argv[1])));
    const manifold::Manifold b = evaluated(manifold::Manifold(read_stl(argv[2])));
    const manifold::Manifold sum = evaluated(a.MinkowskiSum(b));
    std::printf("%zu triangles, volume %.9g\n", sum.NumTri(), sum.Volume());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nef_bench_manifold_sum: %s\n", error.what());
    return 2;
  }
  return 0;
}
