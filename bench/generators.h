// SPDX-License-Identifier: Apache-2.0
//
// The experiments of Hachenberger's thesis, chapter 9, as exact meshes, and a few of today's:
// generated from their parameters alone, the same on every machine.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "nef/construct/construct.h"

namespace nef::bench {

/// A mesh as it goes to a file: the boundary of a solid, or a two-dimensional set.
struct Operand {
  Mesh mesh;
  bool surface = false;
};

enum class Operation : std::uint8_t { kUnion, kDifference, kLocate, kUniteAll, kSubtractAll };

/// Operands and what is to be done with them: their union from left to right, the union of all but the last minus the
/// last, 1000 point locations in the union, the union in any order, or the first minus all others.
struct Case {
  std::string name;
  Operation operation = Operation::kUnion;
  std::vector<Operand> operands;
};

/// TETGRID (9.1): n^3 random tetrahedra of integer coordinates and (n-1)^3 cubes around the
/// corners of their cells.
Case tetgrid(int n);

/// QUADRATICWALLGRID (9.2.2): n walls across n walls, half as high.
Case quadratic_wall_grid(int n);

/// COMPLEXFACET (9.2.3): a cube and n x n tetrahedra that stand in its top.
Case complex_facet(int n);

/// COMPLEXMINUSSIMPLE (9.2.3): the union of the former minus a small cube. The first two operands
/// are to be united beforehand, the third is subtracted.
Case complex_minus_simple(int n);

/// COMPLEXSPHEREMAP (9.3.2): two fans of n+1 triangles with a common apex.
Case complex_sphere_map(int n);

/// ROTCYLINDER (9.3.3): a cylinder of n sides and a copy rotated by `degrees` about its axis.
Case rotated_cylinder(int n, double degrees);

/// The cascade of 9.5: as ROTCYLINDER, with the exact rotation of sin = 2*10^i / (10^2i + 1), so
/// that coordinates grow with i. If `both`, the other operand is rotated the other way, so that
/// both have grown.
Case growing_cylinder(int n, int i, bool both);

/// WORSTCASERAYSHOOTING (9.3.3): an inclined n-gon and n/4 tetrahedra beside it.
Case worst_case_ray_shooting(int n);

/// Two spheres of 20 * 4^level triangles, one shifted by (.30, .17, .11) radii.
Case shifted_spheres(int level);

/// Two models of 20 * 4^level triangles as a scanner makes them: bumps of a tenth of the radius, noise of a
/// ten-thousandth, vertices and triangles in no order; one shifted by (.30, .17, .11) radii.
Case shifted_scans(int level);

/// A sphere of 8 * 4^level triangles minus a cube of a thousandth of its radius on its surface.
Case big_minus_small(int level);

/// n boxes, each overlapping the one before: united one after the other.
Case staircase(int n);

/// A plate minus n cylinders of 64 sides through it, in rows.
Case drill_holes(int n);

/// n boxes of random places and sizes, so that many overlap.
Case random_boxes(int n);

/// n^3 cubes of side 5/4 on a grid: neighbours overlap, with their sides in common planes.
Case lattice(int n);

/// 1000 pseudo-random points in the union of tetgrid(n).
Case point_location(int n);

/// The points that point_location asks for.
std::vector<Rational3> query_points(int n);

/// The case of a name as on the command line: "tetgrid-12", "cylinder-1000-1e-6", ...
/// Throws InputError for a name that is none.
Case make_case(const std::string& name);

/// Writes operands as OFF files <directory>/0.off, 1.off, ... and <directory>/case.txt: the
/// operation, then a line "solid" or "surface" for each operand.
void write_case(const Case& bench_case, const std::string& directory);

/// What a case asks for, without its operands.
struct CaseKind {
  std::string name;
  Operation operation = Operation::kUnion;
};

/// Of what write_case wrote.
CaseKind read_case_kind(const std::string& directory);

/// Reads the operands of what write_case wrote, one after the other, and hands each to `take`: as in a program that
/// converts a file before it reads the next, no two of them are there at once.
void read_operands(const std::string& directory, const std::function<void(const Operand&)>& take);

}  // namespace nef::bench
