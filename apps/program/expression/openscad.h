// SPDX-License-Identifier: Apache-2.0
//
// Sets of OpenSCAD's .csg files.
#pragma once

#include <string_view>

#include "apps/program/expression/expression.h"

namespace nef {

/// The set that a .csg file stands for (openscad -o model.csg model.scad makes them), exactly: the numbers of the file
/// are the decimals that they spell, circles have the corners that OpenSCAD gives them, and nothing else is rounded.
/// Booleans are regularized, as OpenSCAD's are: solids without walls of no thickness. Two-dimensional models become
/// facets in the plane z = 0. A shape whose size is zero or negative is empty, as in OpenSCAD, and `options.warn` is
/// told. `options` make the sets of imported files (named as in the text) and Minkowski sums.
///
/// Read are: cube, sphere, cylinder, polyhedron; square, circle, polygon; union, difference, intersection, hull,
/// minkowski, group, render, color, multmatrix; linear_extrude without twist, rotate_extrude; import of meshes. Throws
/// InputError with the line for anything else: text, offset, projection, resize, surface, twist.
Polyhedron evaluate_openscad(std::string_view text, const ExpressionOptions& options = {});

}  // namespace nef
