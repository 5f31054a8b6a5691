// SPDX-License-Identifier: Apache-2.0
//
// What is marked kOutside lies beyond the box [-R, R]^3, all of it and nothing else. The boundary of the outer volume
// must be one shell of facets on the six planes of the box, each seen from beyond its plane. No other bounded region of
// these planes has all its faces that way, so that the shell is the box; nothing may stick out of it.
#include "nef/validation/validate.h"

namespace nef::detail {
namespace {

// The halffacet lies on a plane x_i = R seen from greater x_i, or on x_i = -R seen from smaller x_i.
bool on_box(const PlaneTable& planes, PlaneId plane, bool from_below) {
  int axes = 0;
  for (std::size_t i = 0; i < 3; ++i) axes += planes.oriented_coefficient(plane, i) != 0 ? 1 : 0;
  // Rows of planes are primitive with a positive first component: x_i - R = 0 or x_i + R = 0.
  return axes == 1 && planes.oriented_coefficient(plane, 3) == 0 &&
         planes.oriented_coefficient(plane, 4) == (from_below ? 1 : -1);
}

}  // namespace

void check_box(const Complex& c) {
  if (!c.has_box()) return;
  const char* const name = "what is outside lies beyond an infimaximal box";
  require(c.volumes[kOuterVolume].shell_count == 1, name, {{"volume", kOuterVolume}});
  bool any = false;
  for (const FacetId f : c.facets.ids()) {
    const Facet& facet = c.facets[f];
    for (const bool from_below : {false, true}) {
      if ((from_below ? facet.volume_below : facet.volume_above) != kOuterVolume) continue;
      any = true;
      require(on_box(c.planes, facet.plane, from_below), name, {{"facet", f}});
    }
  }
  require(any, name, {{"volume", kOuterVolume}});
  for (const HalfedgeId h : c.halfedge_ids()) {
    const SVertex& s = c.svertex(h);
    if (s.out != kNone) continue;
    const SFaceId sface = c.vertices[c.source(h)].sfaces + s.sface;
    require(c.sface_volume(sface) != kOuterVolume, "nothing lies beyond an infimaximal box", {{"halfedge", h}});
  }
}

}  // namespace nef::detail
