// SPDX-License-Identifier: Apache-2.0
//
// Polyhedra in place of balls and cylinders, with the corners that OpenSCAD gives them.
#pragma once

#include <vector>

#include "nef/base/monitor.h"
#include "nef/forward.h"
#include "nef/number/number.h"

namespace nef {

/// A ball about the origin: rings of `fragments` (at least 3) corners on the sphere, (fragments + 1) / 2 of them, half
/// a step from the poles, so that it is a bit shorter than the ball. Sines and cosines are rounded to doubles; what is
/// made of them is exact, so that the faces between two rings are planar. Throws InputError if the radius is not
/// positive.
Polyhedron make_sphere(const Rational& radius, unsigned fragments, const Monitor& monitor = {});

/// A cylinder or a piece of a cone about the z axis, from z = 0 with the radius `bottom` to `height` with the radius
/// `top`, one of which may be 0: polygons of `fragments` (at least 3) corners, the first in the direction of x.
/// Throws InputError if the height is not positive, a radius is negative, or both are 0.
Polyhedron make_cylinder(const Rational& height, const Rational& bottom, const Rational& top, unsigned fragments,
                         const Monitor& monitor = {});

/// The corners of a regular polygon on the circle of radius one, counterclockwise from (1, 0), rounded to doubles;
/// multiples of 30 and 45 degrees as exact as these can be.
std::vector<std::array<Rational, 2>> unit_circle(unsigned fragments);

/// How many corners OpenSCAD gives a circle of this radius: `number` ($fn) if that is positive, else as many as the
/// smallest angle ($fa, degrees) and the smallest length of sides ($fs) allow, at least five.
unsigned openscad_fragments(double radius, double number, double angle, double size);

}  // namespace nef
