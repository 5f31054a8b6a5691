// SPDX-License-Identifier: Apache-2.0
//
// view_make_pages FOLDER: the pages that the browser test loads. Exit code 77 if there is no viewer bundle.
#include <cmath>
#include <iostream>

#include "apps/view/image.h"
#include "apps/view/page.h"
#include "view/sets.h"

namespace nef::view {
namespace {

// A wavy ground of n x n squares without a polyhedron behind it: the viewer's load, without the time to build the set.
Layer terrain(std::uint32_t n) {
  Layer layer;
  layer.name = "terrain";
  Scene& scene = layer.scene;
  scene.volumes = {{0, 0, false}, {1, 1, true}};
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      const Point position{8.0 * x / n, 8.0 * y / n, std::sin(16.0 * x / n) * std::cos(12.0 * y / n)};
      scene.vertices.push_back({position, kArtificial, 1, Origin::kOwn, false});
    }
  }
  const auto add = [&scene](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    scene.facets.push_back({static_cast<std::uint32_t>(scene.triangles.size()), 1, kArtificial, 1, Origin::kOwn, 0, 1});
    scene.triangles.push_back({a, b, c});
    scene.edges.push_back({a, b, kArtificial, 1, Origin::kOwn, false});
    scene.edges.push_back({b, c, kArtificial, 1, Origin::kOwn, false});
  };
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t at = y * (n + 1) + x;
      add(at, at + 1, at + n + 2);
      add(at, at + n + 2, at + n + 1);
    }
  }
  return layer;
}

void write_all(const std::string& folder) {
  write_page({layer_of("mixture", mixture())}, folder + "/mixture.html", {.title = "mixture"});

  const std::vector<Polyhedron> sets{subtract(cube(0, 6), interior(cube(2, 4))), make_halfspace(0, 0, 1, 1),
                                     cube(7, 8)};
  SceneOptions options;
  options.box = visible_box(sets);
  std::vector<Layer> layers{layer_of("hollow", sets[0], options), layer_of("halfspace", sets[1], options),
                            layer_of("robot", sets[2], options)};
  layers[1].opacity = 0.5;
  layers[2].motion = {{0, 4}, {{0, 0, 0}, {0, -7, 0}}};
  layers[2].lines.push_back({"path", {{7.5, 7.5, 7.5}, {7.5, 0.5, 7.5}}, {200, 30, 30}});
  const Image red{2, 2, {255, 0, 0, 255, 0, 0, 255, 0, 0, 255, 0, 0}};
  layers[0].photos.push_back({"camera 1",
                              {{{-3, -3, 5}, {-1, -3, 5}, {-1, -3, 3}, {-3, -3, 3}}},
                              Point{-2, -6, 4},
                              "image/png",
                              png_bytes(red)});
  write_page(layers, folder + "/layers.html", {.title = "layers"});

  // A small robot to begin with, a large free space to be switched on; two bodies in one layer.
  std::vector<Layer> focus{layer_of("robot", unite(cube(0, 1), cube(3, 4))), layer_of("free space", cube(-100, 100))};
  focus[1].visible = false;
  write_page(focus, folder + "/focus.html", {.title = "focus"});
  write_page({layer_of("two bodies", unite(cube(0, 1), cube(3, 4)))}, folder + "/bodies.html", {.title = "bodies"});

  write_page({terrain(224)}, folder + "/terrain.html", {.title = "100352 triangles"});
}

}  // namespace
}  // namespace nef::view

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: view_make_pages FOLDER\n";
    return 2;
  }
  if (!nef::view::has_viewer_bundle()) {
    std::cerr << "skipped: the viewer bundle was not built (no node, npm or network at configure time)\n";
    return 77;
  }
  try {
    nef::view::write_all(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
