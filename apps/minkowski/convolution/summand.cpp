// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/summand.h"

#include "apps/minkowski/minkowski.h"

namespace nef::minkowski {
namespace {

// True if all items of the boundary have the inside of the set on one side and nothing of it on another.
bool is_bounded_by_facets(const Complex& c) {
  for (const Facet& f : c.facets) {
    if ((c.volumes[f.volume_above].mark != 0) == (c.volumes[f.volume_below].mark != 0)) return false;
  }
  for (const VertexId v : c.vertex_ids()) {
    const SphereMapView map = c.sphere_map(v);
    if (map.trivial()) return false;
    for (const SVertex& s : map.svertices) {
      if (s.out == kNone) return false;
    }
  }
  return true;
}

}  // namespace

const Polyhedron& Summand::filled(const Monitor& monitor) {
  if (!filled_) {
    filled_ = set_.is_closed() || is_bounded_by_facets(set_.complex())
                  ? set_
                  : unite(set_, interior(regularize(set_, monitor), monitor), monitor);
  }
  return *filled_;
}

const Polyhedron& Summand::turned(const Monitor& monitor) {
  if (!turned_) turned_ = negate(filled(monitor), monitor);
  return *turned_;
}

const SolidFeatures& Summand::features(const Monitor& monitor) {
  if (!features_) features_.emplace(filled(monitor), monitor);
  return *features_;
}

const Saddles& Summand::saddles(const Monitor& monitor) {
  if (!saddles_) saddles_.emplace(filled(monitor), monitor);
  return *saddles_;
}

bool Summand::is_convex(const Monitor& monitor) {
  if (!is_convex_) is_convex_ = minkowski::is_convex(set_, monitor);
  return *is_convex_;
}

bool Summand::has_convex_closure(const Monitor& monitor) {
  if (!has_convex_closure_) has_convex_closure_ = minkowski::is_convex(closure(filled(monitor), monitor), monitor);
  return *has_convex_closure_;
}

}  // namespace nef::minkowski
