// SPDX-License-Identifier: Apache-2.0
//
// OMPL.app's meshes (COLLADA, 3DS, ...) through assimp. Its coordinates are single-precision floats,
// which are rationals and are taken as they are.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <set>

#include "apps/planner/scene/shapes.h"
#include "nef/base/error.h"

namespace nef::planner {
namespace {

class Collector {
 public:
  Collector(const aiScene& scene, const std::string& path) : scene_(scene), path_(path) {}

  void walk(const aiNode& node, const aiMatrix4x4& above) {
    const aiMatrix4x4 here = above * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene_.mMeshes[node.mMeshes[i]], here);
    for (unsigned i = 0; i < node.mNumChildren; ++i) walk(*node.mChildren[i], here);
  }

  [[nodiscard]] Mesh take() { return std::move(mesh_); }
  [[nodiscard]] Rational3 mean() const {
    Rational3 result = sum_;
    for (Rational& value : result) value /= Rational(static_cast<unsigned long>(std::max<std::size_t>(count_, 1)));
    return result;
  }

 private:
  void add(const aiMesh& source, const aiMatrix4x4& matrix) {
    std::vector<std::uint32_t> index(source.mNumVertices);
    for (unsigned v = 0; v < source.mNumVertices; ++v) {
      const aiVector3D moved = matrix * source.mVertices[v];
      const std::array<double, 3> key{moved.x, moved.y, moved.z};
      if (!std::isfinite(key[0] + key[1] + key[2])) throw InputError(path_ + ": a coordinate is not a finite number");
      const auto [place, is_new] = vertices_.emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
      const Rational3 exact{exact_rational(key[0]), exact_rational(key[1]), exact_rational(key[2])};
      if (is_new) mesh_.vertices.push_back(exact);
      index[v] = place->second;
      for (std::size_t i = 0; i < 3; ++i) sum_[i] += exact[i];
      ++count_;
    }
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
      const aiFace& face = source.mFaces[f];
      if (face.mNumIndices != 3) continue;
      const std::array<std::uint32_t, 3> corners{index[face.mIndices[0]], index[face.mIndices[1]],
                                                 index[face.mIndices[2]]};
      std::array<std::uint32_t, 3> sorted = corners;
      std::sort(sorted.begin(), sorted.end());
      if (sorted[0] == sorted[1] || sorted[1] == sorted[2]) continue;
      if (faces_.insert(sorted).second) mesh_.push_face(corners);
    }
  }

  const aiScene& scene_;
  const std::string& path_;
  Mesh mesh_;
  Rational3 sum_;
  std::size_t count_ = 0;
  std::map<std::array<double, 3>, std::uint32_t> vertices_;
  std::set<std::array<std::uint32_t, 3>> faces_;
};

}  // namespace

Mesh read_with_assimp(const std::string& path, Rational3* mean) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(
      path, aiProcess_GenNormals | aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType);
  if (scene == nullptr) throw InputError(path + ": " + importer.GetErrorString());
  if (scene->mRootNode == nullptr || scene->mNumMeshes == 0) throw InputError(path + ": holds no mesh");
  Collector collector(*scene, path);
  collector.walk(*scene->mRootNode, aiMatrix4x4());
  if (mean != nullptr) *mean = collector.mean();
  return collector.take();
}

}  // namespace nef::planner
