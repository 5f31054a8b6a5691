// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "nef/construct/solid.h"

namespace nef {

/// A corner of a face of a solid.
struct FaceCorner {
  std::uint32_t face;
  std::uint32_t next;  ///< points
  std::uint32_t previous;
  std::uint32_t position;  ///< among the corners of all faces
};

/// Reads the sphere maps of ordinary vertices of a closed surface off their faces, without drawing them: those around
/// which the faces form one ring, neighbours in different planes. Such a map is told by its planes in order, and by
/// three bits an edge: which plane has the smaller row, how the face of the edge is turned to its plane, and whether
/// the edge has the direction of the product of the normals. Vertices with the same bits have the same pattern.
class PlainRing {
 public:
  /// The faces must outlive this object.
  explicit PlainRing(const SolidFaces& faces) : faces_(faces) {}

  /// Reads the vertex at a point from its corners; the first one begins the ring. False if it is no plain ring, if it
  /// is a long one, or if doubles can not tell the directions of its edges. O(n^2) for the few corners of a vertex.
  [[nodiscard]] bool read(std::uint32_t point, std::span<const FaceCorner> corners);

  /// The corners of the vertex that was read, in the order of the ring.
  [[nodiscard]] std::span<const FaceCorner> corners() const { return ring_; }

  /// The planes of the corners of the vertex that was read, in the order of the ring.
  [[nodiscard]] std::span<const PlaneId> planes() const { return planes_; }

  /// The sphere map of the vertex that was read, as drawing it would make it; false if the marks hide a part of it.
  [[nodiscard]] bool write(const SolidMarks& marks, SphereMapBuffer& map) const;

  /// A vertex that was learned with the same bits, if there is one.
  [[nodiscard]] VertexId like() const {
    const auto known = known_.find(bits_);
    return known == known_.end() ? VertexId() : known->second;
  }

  /// The vertex that was read has become this one of the complex.
  void learn(VertexId vertex) { known_.emplace(bits_, vertex); }

 private:
  // Unflipped planes whose normals have the direction of an edge for their product, or the second one flipped.
  struct EdgePlanes {
    PlaneId p, q;
  };

  bool order(std::span<const FaceCorner> corners);
  [[nodiscard]] std::optional<int> direction(std::uint32_t from, std::uint32_t to, PlaneId first, PlaneId second) const;

  const SolidFaces& faces_;
  std::vector<FaceCorner> ring_;
  std::vector<PlaneId> planes_;
  std::vector<EdgePlanes> edges_;  // to the next points of the ring
  std::uint64_t bits_ = 0;
  std::unordered_map<std::uint64_t, VertexId> known_;
};

}  // namespace nef
