// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
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
  static constexpr std::size_t kMost = 20;  ///< edges whose bits fit into a word

  /// The faces must outlive this object.
  explicit PlainRing(const SolidFaces& faces) : faces_(faces) {}

  /// Reads the vertex at a point from its corners; the first one begins the ring. False if it is no plain ring, if it
  /// is a long one, or if doubles can not tell the directions of its edges. O(n^2) for the few corners of a vertex.
  [[nodiscard]] bool read(std::uint32_t point, std::span<const FaceCorner> corners);

  /// The corners of the vertex that was read, in the order of the ring. Read again in this order, they make the same
  /// ring.
  [[nodiscard]] std::span<const FaceCorner> corners() const { return std::span(ring_).first(size_); }

  /// The bits of the vertex that was read; never 0.
  [[nodiscard]] std::uint64_t bits() const { return bits_; }

  /// The sphere map of the vertex that was read, as drawing it would make it, if the marks hide no part of it.
  void write(const SolidMarks& marks, SphereMapBuffer& map) const;

 private:
  // Unflipped planes whose normals have the direction of an edge for their product, or the second one flipped.
  struct EdgePlanes {
    PlaneId p, q;
  };

  bool order(std::span<const FaceCorner> corners);
  [[nodiscard]] std::optional<int> direction(std::uint32_t from, std::uint32_t to, PlaneId first, PlaneId second) const;

  const SolidFaces& faces_;
  // Of the vertex that was read, which has size_ edges.
  std::array<FaceCorner, kMost> ring_{};
  std::array<PlaneId, kMost> planes_;
  std::array<EdgePlanes, kMost> edges_;  // to the next points of the ring
  std::size_t size_ = 0;
  std::uint64_t bits_ = 0;
};

/// Vertices of a complex by the bits of their rings.
class KnownRings {
 public:
  /// A vertex that was learned with these bits, if there is one.
  [[nodiscard]] VertexId like(std::uint64_t bits) const {
    return known_.empty() ? VertexId() : known_[place_of(bits)].vertex;
  }

  /// The vertex has these bits, which no other one was learned with.
  void learn(std::uint64_t bits, VertexId vertex);

 private:
  struct Known {
    std::uint64_t bits = 0;
    VertexId vertex;
  };

  [[nodiscard]] std::size_t place_of(std::uint64_t bits) const;

  std::vector<Known> known_;  // open addressing, at most half full
  std::size_t count_ = 0;
};

}  // namespace nef
