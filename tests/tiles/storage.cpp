// SPDX-License-Identifier: Apache-2.0
//
// Tiles in files: the same sets in however little memory; folders that are whole or refused.
#include <catch2/catch.hpp>
#include <memory>

#include "nef/construct/round_shapes.h"
#include "nef/io/file_bytes.h"
#include "nef/tiles/storage/tile_folder.h"
#include "nef/tiles/storage/tile_store.h"
#include "tests/support/temporary_folder.h"
#include "tests/tiles/cuts.h"

namespace nef::test {
namespace {

std::shared_ptr<TileStore> store_in(const TemporaryFolder& folder, std::uint64_t memory) {
  return std::make_shared<TileStore>(folder.path(), memory);
}

std::size_t tile_files(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".nef") ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("sets in a store of next to no memory are what they are in memory") {
  for (const bool bounded : {true, false}) {
    CHECK(rc::check(bounded ? "bounded" : "unbounded", [bounded] {
      const Polyhedron a = (*recipes(bounded, 4).as("A")).make();
      const Polyhedron b = (*recipes(bounded, 4).as("B")).make();
      const TemporaryFolder folder;
      const Tiling tiling{*rc::gen::inRange<std::size_t>(8, 40), store_in(folder, 1)};
      const Monitor monitor = Monitor().on_threads(*rc::gen::element(1U, 2U));
      const TiledPolyhedron x(a, tiling);
      leaves_are_valid(x.tree(), "A");
      glued_is(x, a, "A");
      glued_is(unite(x, b, monitor), unite(a, b), "A + B");
      glued_is(subtract(subtract(x, b), TiledPolyhedron(b, tiling, monitor), monitor), subtract(a, b), "A - B - B");
      glued_is(complement(intersect(complement(x), b)), unite(a, complement(b)), "!(!A * B)");
      RC_ASSERT(volume(x) == volume(a));
      // Written to a folder, and read in both ways.
      const std::string path = folder.file("a.tiles");
      write_tiles(path, x);
      glued_is(read_tiles(path), a, "read");
      const TiledPolyhedron later = read_tiles(path, store_in(folder, 1));
      RC_ASSERT(later.tiling().limit == tiling.limit);
      glued_is(symmetric_difference(later, b), symmetric_difference(a, b), "read later");
    }));
  }
}

TEST_CASE("a store holds what fits, and leaves nothing behind") {
  const TemporaryFolder folder;
  const Polyhedron sphere = make_sphere(10, 60);
  {
    const std::shared_ptr<TileStore> store = store_in(folder, 400'000);
    TiledPolyhedron set(sphere, {200, store});
    std::vector<TiledPolyhedron> versions;
    for (int i = 0; i < 20; ++i) {
      versions.push_back(set);
      set = subtract(set, notch(i));
      CHECK(store->counts().bytes <= 400'000);
    }
    CHECK(store->counts().written > 0);
    CHECK(store->counts().read > 0);
    CHECK(folder.file_count() == 1);  // the folder of this run
    glued_is(versions[0], sphere, "the first version");
  }
  CHECK(folder.file_count() == 0);
  {
    const std::shared_ptr<TileStore> store = store_in(folder, 1'000'000'000);
    const TiledPolyhedron set(sphere, {200, store});
    CHECK(store->counts().written == 0);
  }
  CHECK(folder.file_count() == 0);
}

TEST_CASE("what a killed run left is removed by the next one that needs files") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / ".nef-tiles-dead00");
  static_cast<void>(folder.write(".nef-tiles-dead00/alive", ""));
  static_cast<void>(folder.write(".nef-tiles-dead00/1.nef", "x"));
  const std::shared_ptr<TileStore> alive = store_in(folder, 1);
  const TiledPolyhedron first(make_sphere(10, 30), {100, alive});
  CHECK_FALSE(std::filesystem::exists(folder.path() / ".nef-tiles-dead00"));
  // A run that is alive keeps its own.
  const TiledPolyhedron second(make_sphere(10, 30), {100, store_in(folder, 1)});
  CHECK(folder.file_count() == 2);
  glued_is(first, make_sphere(10, 30), "the first");
}

TEST_CASE("volume and box read each tile once, on one thread and on several") {
  const TemporaryFolder folder;
  const std::string path = folder.file("s.tiles");
  const Polyhedron solid = subtract(make_sphere(10, 60), notch(1));
  write_tiles(path, TiledPolyhedron(solid, {200}));
  for (const unsigned threads : {1U, 3U}) {
    const std::shared_ptr<TileStore> store = store_in(folder, 1);  // holds one
    const TiledPolyhedron set = read_tiles(path, store, Monitor().on_threads(threads));
    for (const bool inside_out : {false, true}) {
      const std::size_t before = store->counts().read;
      const auto [found, box] = volume_and_bounding_box(inside_out ? complement(set) : set);
      CHECK(found == (inside_out ? std::nullopt : volume(solid)));
      CHECK(box == bounding_box(solid));
      CHECK(store->counts().read - before <= set.tile_count());
    }
  }
  // A leaf without boundary counts as its region.
  const TiledPolyhedron half = TiledPolyhedron(make_halfspace(1, 0, 0, 0), {});
  CHECK(volume_and_bounding_box(half).volume == std::nullopt);
  CHECK(volume_and_bounding_box(half).box == bounding_box(make_halfspace(1, 0, 0, 0)));
  CHECK(volume_and_bounding_box(TiledPolyhedron()).volume == Rational(0));
}

TEST_CASE("versions in folders share nothing that they lose, and write what is new") {
  const TemporaryFolder folder;
  const Polyhedron sphere = make_sphere(10, 60);
  const std::string path = folder.file("s.tiles");
  write_tiles(path, TiledPolyhedron(sphere, {200}));
  const std::size_t first_files = tile_files(path);
  REQUIRE(first_files > 5);
  const std::shared_ptr<TileStore> store = store_in(folder, 1'000'000'000);
  const TiledPolyhedron old = read_tiles(path, store);
  CHECK(store->counts().read == 0);
  const TiledPolyhedron next = subtract(old, notch(1));
  CHECK(store->counts().read <= 4);  // a notch touches few tiles
  write_tiles(path, next);
  glued_is(read_tiles(path), subtract(sphere, notch(1)), "the new version");
  // The old one is still in use, so its files stay until it is written once more without it.
  CHECK(tile_files(path) > next.tile_count());
  glued_is(old, sphere, "the old version");
  write_tiles(path, read_tiles(path));
  CHECK(tile_files(path) == next.tile_count());
  write_tiles(path, TiledPolyhedron());
  CHECK(tile_files(path) == 0);
  CHECK(read_tiles(path).is_empty());
  write_tiles(path, TiledPolyhedron(Polyhedron::everything()));
  CHECK(read_tiles(path).is_everything());
}

TEST_CASE("damaged folders are refused with a line") {
  const TemporaryFolder folder;
  const std::string path = folder.file("s.tiles");
  write_tiles(path, TiledPolyhedron(make_sphere(10, 30), {100}));
  const std::string index = slurp(path + "/index");
  // Any byte of the index.
  for (std::size_t i = 0; i < index.size(); i += 7) {
    std::string damaged = index;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    static_cast<void>(folder.write("s.tiles/index", damaged));
    CHECK_THROWS_AS(read_tiles(path), FileError);
    static_cast<void>(folder.write("s.tiles/index", index.substr(0, i)));
    CHECK_THROWS_AS(read_tiles(path), FileError);
  }
  static_cast<void>(folder.write("s.tiles/index", index));
  std::string name;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    if (entry.path().extension() == ".nef") name = entry.path().filename().string();
  }
  const std::string tile = slurp(path + "/" + name);
  std::string damaged = tile;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 4);
  static_cast<void>(folder.write("s.tiles/" + name, damaged));
  CHECK_THROWS_WITH(read_tiles(path), Catch::Contains(name) && Catch::Contains("damaged"));
  // Read later: whoever needs the tile is told.
  const TiledPolyhedron later = read_tiles(path, store_in(folder, 1));
  CHECK_THROWS_AS(later.polyhedron(), FileError);
  std::filesystem::remove(path + "/" + name);
  CHECK_THROWS_WITH(read_tiles(path), Catch::Contains("missing"));
  static_cast<void>(folder.write("file.tiles", "no folder"));
  CHECK_THROWS_AS(write_tiles(folder.file("file.tiles"), TiledPolyhedron()), FileError);
  CHECK_THROWS_AS(write_tiles(folder.file(std::string(400, 'n') + ".tiles"), TiledPolyhedron()), FileError);
}

}  // namespace nef::test
