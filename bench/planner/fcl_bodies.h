// SPDX-License-Identifier: Apache-2.0
//
// Rigid bodies as FCL's models, for benchmarks that have it for a peer (Debian: libfcl-dev).
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include <memory>

#include "apps/planner/rigid/rigid_body.h"

namespace nef::planner {

using FclModel = fcl::BVHModel<fcl::OBBRSSd>;

/// The faces of all pieces, rounded to doubles, as triangles. FCL knows no inside: a model that is inside another one
/// without touching its faces does not collide.
inline std::shared_ptr<FclModel> fcl_model_of(const RigidBody& body) {
  auto model = std::make_shared<FclModel>();
  model->beginModel();
  for (const RigidBody::Piece& piece : body.pieces()) {
    for (std::size_t f = 0; f < piece.mesh.face_count(); ++f) {
      const auto ring = piece.mesh.face(f);
      for (std::size_t i = 2; i < ring.size(); ++i) {
        model->addTriangle(piece.points[ring[0]], piece.points[ring[i - 1]], piece.points[ring[i]]);
      }
    }
  }
  model->endModel();
  return model;
}

/// Whether a robot at a pose meets obstacles that stay.
inline bool fcl_collides(const FclModel& robot, const fcl::Transform3d& pose, const FclModel& obstacles) {
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(&robot, pose, &obstacles, fcl::Transform3d::Identity(), request, result) != 0;
}

}  // namespace nef::planner
