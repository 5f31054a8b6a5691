// SPDX-License-Identifier: Apache-2.0
//
// The validator's parts: sphere maps, and what synthesis adds to them. The whole complex is
// checked by validate(const Complex&) in nef/polyhedron.h.
#pragma once

#include <string>

#include "nef/base/defect.h"
#include "nef/base/monitor.h"
#include "nef/complex/complex.h"

namespace nef {

/// Checks every invariant of a sphere map: index ranges, twins, next and prev, directions on
/// their circles, cyclic order around svertices, arcs that cross nothing, boundary entries of
/// sfaces, and that it is simplified (no redundant arc, sloop or svertex). Returns the name of
/// the first broken one with the guilty items (local indices), or an empty string.
/// O(k^2) for k arcs and svertices.
std::string validate(const PlaneTable& planes, const SphereMapView& map, const Monitor& monitor = {});

namespace detail {

/// nef::validate without the sphere maps and the planes through their vertices, for who has checked each of these
/// before synthesis.
std::string validate_links(const Complex& complex, const Monitor& monitor);

/// Facets: cycles closed, planar, oriented and nested; marks and volumes equal all around.
void check_facets(const Complex& complex);

/// Shells and volumes: shells partition the sfaces by connection, nest as geometry says.
void check_volumes(const Complex& complex, const Monitor& monitor);

/// The infimaximal box: the boundary of the outer volume, if that is marked kOutside. Shells and facets must be right.
void check_box(const Complex& complex);

}  // namespace detail
}  // namespace nef
