// SPDX-License-Identifier: Apache-2.0
#include "fuzz/fuzzer.h"

#include <array>

namespace nef::fuzz {

Polyhedron Case::valid(Polyhedron set, std::string_view what) const {
  const std::string broken = validate(set.complex());
  if (!broken.empty()) throw Failure("validate: " + broken + " after " + std::string(what));
  count("sets validated");
  return set;
}

std::span<const Fuzzer> fuzzers() {
  static constexpr std::array kAll{
      Fuzzer{"arrangement",
             "sets from open and closed half-spaces, small and huge, at a point of every cell of their planes",
             fuzz_arrangement},
      Fuzzer{"nested", "coplanar pieces nested in each other: slits, loops, holes, islands, points", fuzz_nested},
      Fuzzer{"voxels", "meshes that touch, nest, overlap or contradict each other, by winding numbers", fuzz_voxels},
      Fuzzer{"dirty",
             "meshes with folds, slits, faces doubled, turned and missing, on 1, 2 and 4 threads, by volumes and rays",
             fuzz_dirty},
      Fuzzer{"crossings", "soups of meshes that cross, double and undo each other, by winding numbers in fractions",
             fuzz_crossings},
      Fuzzer{"repairs",
             "soups with faces turned, doubled and missing, repaired and closed, by winding numbers in fractions",
             fuzz_repairs},
      Fuzzer{"stars", "cones of very many sides with an apex in common, point by point", fuzz_stars},
      Fuzzer{"files", "damaged files of every format", fuzz_files},
      Fuzzer{"written",
             "Booleans of turned and shifted solids, written in every mesh format, read and checked strictly",
             fuzz_written},
      Fuzzer{"planning", "robots and obstacles of all dimensions on a grid, by breadth-first search", fuzz_planning},
      Fuzzer{"assemblies", "assemblies of unit cubes, by a search over all sets of parts", fuzz_assemblies},
      Fuzzer{"turning-assemblies", "parts that turn about one axis in a pocket of a block, by a grid of poses",
             fuzz_turning_assemblies},
      Fuzzer{"turning", "flat robots that turn in a plane anywhere in space, by a fine grid of poses", fuzz_turning},
      Fuzzer{"motions", "moving and turning solids and triangle soups, at exact poses of each motion", fuzz_motions},
      Fuzzer{"no-paths",
             "proofs that a convex robot passes no hole, where it does at a known orientation, and where it does not",
             fuzz_no_paths},
      Fuzzer{"rigid-paths",
             "robots that turn freely among boxes and prisms, by a grid of poses and by balls in the robot",
             fuzz_rigid_paths},
      Fuzzer{"slots", "prisms that turn freely, and a slot of exactly their cross section in a turned wall",
             fuzz_slots},
      Fuzzer{"ranges", "ranges of motion of hinges and sliders, by Booleans at many values", fuzz_ranges},
      Fuzzer{"visibility", "convex prisms among convex prisms, by an exact visibility graph", fuzz_visibility},
      Fuzzer{"wide", "solids among meshes: paths with room, swept piece by piece and against the complete way",
             fuzz_wide},
      Fuzzer{"silhouettes", "visual hulls of random cameras and polygons, point by point", fuzz_silhouettes},
      Fuzzer{"jobs", "work that was left behind, after files were replaced, touched or renamed", fuzz_jobs},
      Fuzzer{"image-names", "folders of images with numbers in their names, by the numbers", fuzz_image_names},
      Fuzzer{"tiles", "sets in tiles under steps, with awkward cuts, point by point", fuzz_tiles},
      Fuzzer{"sums", "Minkowski sums of open, closed and mixed sets on a grid", fuzz_sums},
      Fuzzer{"convolutions",
             "Minkowski sums of solids without cells, by intersections and by cells, and ways out of overlaps",
             fuzz_convolutions},
      Fuzzer{"parts", "Minkowski sums of turned, extruded and drilled parts, two strategies and Booleans", fuzz_parts},
  };
  return kAll;
}

}  // namespace nef::fuzz
