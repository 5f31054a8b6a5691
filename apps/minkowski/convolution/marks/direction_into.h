// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "nef/sphere_map/sphere_map.h"

namespace nef::minkowski {

/// A direction inside of an sface, with integers that are no longer than need be. The map must not be trivial.
/// O(size of the map), a few times.
Direction direction_into(const PlaneTable& planes, const SphereMapView& map, std::uint32_t sface,
                         const Monitor& monitor);
/// The same near a given shalfedge of the sface.
Direction direction_into(const PlaneTable& planes, const SphereMapView& map, std::uint32_t sface,
                         std::uint32_t shalfedge, const Monitor& monitor);

/// A direction inside of an arc, from the shalfedge's source to its target, or of a great circle.
Direction direction_on_arc(const PlaneTable& planes, const SphereMapView& map, std::uint32_t shalfedge,
                           const Monitor& monitor);
Direction direction_on_circle(const PlaneTable& planes, PlaneId plane);

}  // namespace nef::minkowski
