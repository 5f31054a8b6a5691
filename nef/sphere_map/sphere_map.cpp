// SPDX-License-Identifier: Apache-2.0
#include "nef/sphere_map/sphere_map.h"

namespace nef {

void SphereMapBuffer::clear() {
  svertices.clear();
  shalfedges.clear();
  sloops.clear();
  sfaces.clear();
  entries.clear();
  mark = 0;
}

void SphereMapBuffer::assign(const SphereMapView& map) {
  svertices.assign(map.svertices.begin(), map.svertices.end());
  shalfedges.assign(map.shalfedges.begin(), map.shalfedges.end());
  sloops.assign(map.sloops.begin(), map.sloops.end());
  sfaces.assign(map.sfaces.begin(), map.sfaces.end());
  entries.assign(map.entries.begin(), map.entries.end());
  mark = map.mark;
}

void SphereMapBuffer::assign_trivial(LabelId label) {
  clear();
  mark = label;
  sfaces.push_back({0, 0, label});
}

void SphereMapBuffer::assign_circle(PlaneId plane, LabelId facet, LabelId positive, LabelId negative) {
  clear();
  mark = facet;
  sloops.push_back({plane, 0, facet});
  sloops.push_back({plane.opposite(), 1, facet});
  sfaces.push_back({0, 1, positive});
  sfaces.push_back({1, 1, negative});
  entries.push_back({SFaceEntry::Kind::kLoop, 0});
  entries.push_back({SFaceEntry::Kind::kLoop, 1});
}

}  // namespace nef
