// SPDX-License-Identifier: Apache-2.0
//
// Cross-sections as drawings in their plane, in doubles.
#pragma once

#include <string>

#include "nef/parts/section.h"

namespace nef::view {

/// The area of the polygons of a section.
double section_area(const Section& section);

/// A drawing in the units of the set, as seen from the side to which the normal points: the axes of the drawing are the
/// coordinate axes if the normal is one (x and y if it is z), and else an orthonormal pair of which the first is
/// horizontal (parallel to the xy-plane). Distances are true to rounding. Segments are drawn as lines, points as dots.
std::string section_svg(const Section& section, const Rational3& normal);

/// The same for CAD programs, as ASCII DXF (R12): closed polylines for the rings, lines and points, in layer "section".
std::string section_dxf(const Section& section, const Rational3& normal);

}  // namespace nef::view
