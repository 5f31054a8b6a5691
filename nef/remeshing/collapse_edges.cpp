// SPDX-License-Identifier: Apache-2.0
#include "nef/remeshing/collapse_edges.h"

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "nef/base/error.h"

namespace nef {

void collapse_edges(TriangleMesh& work, std::size_t triangles) {
  work.request_vertex_status();
  work.request_edge_status();
  work.request_halfedge_status();
  work.request_face_status();
  work.request_face_normals();
  work.update_face_normals();
  // A border is where sheets were taken apart; it has to stay as it is, or a crack opens between them.
  for (const auto v : work.vertices()) {
    if (work.is_boundary(v)) work.status(v).set_locked(true);
  }
  OpenMesh::Decimater::DecimaterT<TriangleMesh> decimater(work);
  OpenMesh::Decimater::ModQuadricT<TriangleMesh>::Handle quadric;
  OpenMesh::Decimater::ModNormalFlippingT<TriangleMesh>::Handle no_flips;
  decimater.add(quadric);
  decimater.add(no_flips);
  decimater.module(quadric).unset_max_err();
  const bool ready = decimater.initialize();
  NEF_ASSERT(ready);
  decimater.decimate_to_faces(0, triangles);
}

}  // namespace nef
