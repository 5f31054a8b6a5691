// SPDX-License-Identifier: Apache-2.0
//
// OMPL.app's meshes (COLLADA, 3DS, ...) through assimp. Its coordinates are single-precision floats,
// which are rationals and are taken as they are. Assimp runs in a process with bounds, since there are files on which
// it never ends (an index of a COLLADA face that is no number).
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <new>
#include <set>
#include <span>

#include "apps/planner/scene/shapes.h"
#include "nef/base/error.h"
#include "nef/io/bounded_process.h"

namespace nef::planner {
namespace {

// Points with the number of vertices at each, and triangles between them.
struct Triangles {
  std::vector<std::array<double, 3>> points;
  std::vector<std::uint32_t> vertices;  // at each point
  std::vector<std::array<std::uint32_t, 3>> corners;
};

// As bytes, from one process to another.
template <typename T>
void append(std::string& bytes, const std::vector<T>& values) {
  const std::uint64_t count = values.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
}

template <typename T>
void take(std::string_view& bytes, std::vector<T>& values) {
  std::uint64_t count = 0;
  std::memcpy(&count, bytes.data(), sizeof count);
  values.resize(count);
  std::memcpy(values.data(), bytes.data() + sizeof count, count * sizeof(T));
  bytes.remove_prefix(sizeof count + count * sizeof(T));
}

std::string to_bytes(const Triangles& t) {
  std::string bytes;
  append(bytes, t.points);
  append(bytes, t.vertices);
  append(bytes, t.corners);
  return bytes;
}

Triangles from_bytes(std::string_view bytes) {
  Triangles t;
  take(bytes, t.points);
  take(bytes, t.vertices);
  take(bytes, t.corners);
  return t;
}

class Collector {
 public:
  explicit Collector(const aiScene& scene) : scene_(scene) {}

  void walk(const aiNode& node, const aiMatrix4x4& above) {
    const aiMatrix4x4 here = above * node.mTransformation;
    for (const unsigned mesh : std::span(node.mMeshes, node.mNumMeshes)) add(*scene_.mMeshes[mesh], here);
    for (const aiNode* child : std::span(node.mChildren, node.mNumChildren)) walk(*child, here);
  }

  [[nodiscard]] const Triangles& triangles() const { return result_; }

 private:
  void add(const aiMesh& source, const aiMatrix4x4& matrix) {
    std::vector<std::uint32_t> index(source.mNumVertices);
    for (unsigned v = 0; v < source.mNumVertices; ++v) {
      const aiVector3D moved = matrix * source.mVertices[v];
      const std::array<double, 3> key{moved.x, moved.y, moved.z};
      if (!std::isfinite(key[0] + key[1] + key[2])) throw InputError("a coordinate is not a finite number");
      const auto [place, is_new] = index_of_.emplace(key, static_cast<std::uint32_t>(result_.points.size()));
      if (is_new) {
        result_.points.push_back(key);
        result_.vertices.push_back(0);
      }
      index[v] = place->second;
      ++result_.vertices[place->second];
    }
    for (const aiFace& face : std::span(source.mFaces, source.mNumFaces)) {
      if (face.mNumIndices != 3) continue;
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        if (face.mIndices[i] >= index.size()) throw InputError("a face names a vertex that does not exist");
        corners[i] = index[face.mIndices[i]];
      }
      std::array<std::uint32_t, 3> sorted = corners;
      std::sort(sorted.begin(), sorted.end());
      if (sorted[0] == sorted[1] || sorted[1] == sorted[2]) continue;
      if (faces_.insert(sorted).second) result_.corners.push_back(corners);
    }
  }

  const aiScene& scene_;
  Triangles result_;
  std::map<std::array<double, 3>, std::uint32_t> index_of_;
  std::set<std::array<std::uint32_t, 3>> faces_;
};

Triangles read_triangles(const std::string& path) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(
      path, aiProcess_GenNormals | aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType);
  if (scene == nullptr) {
    const std::string why = importer.GetErrorString();
    // It tells lack of memory in these words, which are nothing for a user; the bounds have their own.
    if (why.find("std::bad_alloc") != std::string::npos) throw std::bad_alloc();
    throw InputError(why);
  }
  if (scene->mRootNode == nullptr || scene->mNumMeshes == 0) throw InputError("contains no mesh");
  Collector collector(*scene);
  collector.walk(*scene->mRootNode, aiMatrix4x4());
  return collector.triangles();
}

// Far more than assimp takes for a sound file: bounds that grow with the file, on top of what any may take.
Triangles read_triangles_bounded(const std::string& path) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  const ParserLimits limits = parser_limits(ignored ? 0 : static_cast<std::size_t>(size));
  try {
    const std::optional<std::string> bytes = run_bounded(limits, [&] { return to_bytes(read_triangles(path)); });
    if (bytes) return from_bytes(*bytes);
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
  throw InputError(path + ": assimp could not read the file within " + limits_text(limits) +
                   "; it is damaged, or else convert it to OFF, OBJ, STL or PLY");
}

}  // namespace

Mesh read_with_assimp(const std::string& path, Rational3* mean) {
  const Triangles triangles = read_triangles_bounded(path);
  Mesh mesh;
  Rational3 sum;
  unsigned long count = 0;
  for (std::size_t p = 0; p < triangles.points.size(); ++p) {
    Rational3& vertex = mesh.vertices.emplace_back();
    count += triangles.vertices[p];
    for (std::size_t i = 0; i < 3; ++i) {
      vertex[i] = exact_rational(triangles.points[p][i]);
      sum[i] += vertex[i] * triangles.vertices[p];
    }
  }
  for (const auto& corners : triangles.corners) mesh.push_face(corners);
  if (mean != nullptr) {
    for (std::size_t i = 0; i < 3; ++i) (*mean)[i] = sum[i] / std::max(count, 1UL);
  }
  return mesh;
}

}  // namespace nef::planner
