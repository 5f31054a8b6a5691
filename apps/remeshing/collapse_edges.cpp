// SPDX-License-Identifier: Apache-2.0
#include "apps/remeshing/collapse_edges.h"

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <limits>
#include <numeric>

#include "nef/base/error.h"

namespace nef {
namespace {

using Quadric = OpenMesh::Decimater::ModQuadricT<TriangleMesh>;

/// A module of OpenMesh's decimater that holds the limits of vertices, and notes what is collapsed into what.
template <typename MeshT>
class ModLimitsT : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(ModLimitsT, MeshT, Limits)

  explicit ModLimitsT(MeshT& mesh) : Base(mesh, true) {}

  /// To be called before anything is collapsed.
  void begin(Quadric& quadric, const CollapseLimits& limits) {
    quadric_ = &quadric;
    limits_ = limits;
    collapses_.into.resize(limits.size());
    std::iota(collapses_.into.begin(), collapses_.into.end(), 0U);
    collapses_.error.assign(limits.size(), 0);
  }

  float collapse_priority(const CollapseInfo& collapse) override {
    const float limit = std::min(limits_[index(collapse.v0)], limits_[index(collapse.v1)]);
    if (limit == std::numeric_limits<float>::infinity()) return Base::LEGAL_COLLAPSE;
    const bool allowed = limit >= 0 && quadric_->collapse_priority(collapse) <= limit;
    return allowed ? Base::LEGAL_COLLAPSE : Base::ILLEGAL_COLLAPSE;
  }

  // The quadrics are added up after the collapse.
  void preprocess_collapse(const CollapseInfo& collapse) override {
    const std::size_t gone = index(collapse.v0);
    const std::size_t kept = index(collapse.v1);
    collapses_.into[gone] = static_cast<std::uint32_t>(kept);
    limits_[kept] = std::min(limits_[kept], limits_[gone]);
    float& error = collapses_.error[kept];
    error = std::max({error, collapses_.error[gone], quadric_->collapse_priority(collapse)});
  }

  Collapses take() {
    std::vector<std::uint32_t>& into = collapses_.into;
    for (std::uint32_t& target : into) {
      while (into[target] != target) target = into[target];
    }
    return std::move(collapses_);
  }

 private:
  static std::size_t index(typename MeshT::VertexHandle vertex) { return static_cast<std::size_t>(vertex.idx()); }

  Quadric* quadric_ = nullptr;
  CollapseLimits limits_;
  Collapses collapses_;
};

}  // namespace

Collapses collapse_edges(TriangleMesh& work, std::size_t triangles, const CollapseLimits& limits) {
  NEF_ASSERT(limits.size() == work.n_vertices());
  work.request_vertex_status();
  work.request_edge_status();
  work.request_halfedge_status();
  work.request_face_status();
  work.request_face_normals();
  work.update_face_normals();
  // A border is where sheets were taken apart; it has to stay as it is, or a crack opens between them.
  for (const auto v : work.vertices()) {
    if (work.is_boundary(v) || limits[static_cast<std::size_t>(v.idx())] < 0) work.status(v).set_locked(true);
  }
  OpenMesh::Decimater::DecimaterT<TriangleMesh> decimater(work);
  OpenMesh::Decimater::ModQuadricT<TriangleMesh>::Handle quadric;
  OpenMesh::Decimater::ModNormalFlippingT<TriangleMesh>::Handle no_flips;
  ModLimitsT<TriangleMesh>::Handle within;
  decimater.add(quadric);
  decimater.add(no_flips);
  decimater.add(within);
  decimater.module(quadric).unset_max_err();
  decimater.module(within).begin(decimater.module(quadric), limits);
  const bool ready = decimater.initialize();
  NEF_ASSERT(ready);
  decimater.decimate_to_faces(0, triangles);
  return decimater.module(within).take();
}

}  // namespace nef
