// SPDX-License-Identifier: Apache-2.0
//
// The one way to write a complex: vertices are added with their sphere maps, drawn or finished, or copied in runs;
// finish() links them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "nef/base/defect.h"
#include "nef/base/monitor.h"
#include "nef/complex/patterns/pattern_interner.h"
#include "nef/sphere_map/arrangement.h"
#include "nef/synthesis/known_links.h"

namespace nef {

/// Collects the vertices of a complex. Vertices may be added in any order; the items of the complex are numbered in
/// this order.
///
/// Sphere maps that come from sets always fit together. Those made from somebody's data may not: the first thing found
/// wrong is kept, what is added afterwards is ignored, and finish() or try_finish() tells of it.
class ComplexBuilder {
 public:
  /// `planes` are those of all sphere maps. It must outlive the builder; finishing takes the planes out of it.
  ComplexBuilder(PlaneTable& planes, const Monitor& monitor) : planes_(planes), monitor_(monitor) {}
  ComplexBuilder(const ComplexBuilder&) = delete;
  ComplexBuilder& operator=(const ComplexBuilder&) = delete;

  /// Makes room for this many vertices with this many sphere items altogether; `limbs` as in
  /// PointTable::reserve.
  void reserve(std::size_t vertices, const VertexRecord& items, std::size_t limbs = 0);

  /// Sorts the drawing around its nodes, simplifies it, and adds it as a vertex at the point, unless a point with this
  /// sphere map lies inside a volume, facet or edge. True if it is a vertex.
  bool add(const Rational3& point, Arrangement& drawing);
  /// The same for a point of a table.
  bool add(const PointTable& points, PointId point, Arrangement& drawing);
  /// The same for the point where three planes meet; their normals must be linearly independent.
  bool add(const std::array<PlaneId, 3>& meeting, Arrangement& drawing);
  /// The same for a drawing that has been sorted around its nodes.
  bool add_sorted(const PointTable& points, PointId point, Arrangement& drawing);
  /// The same for a simplified sphere map.
  bool add(const PointTable& points, PointId point, const SphereMapView& map);

  /// Adds a simplified sphere map without asking whether it is one of a vertex.
  void append(const PointTable& points, PointId point, const SphereMapView& map);

  /// Adds a vertex whose sphere map is that of one added before, `like`, but for its planes: `planes` are those of its
  /// even shalfedges. It must have no sloops, and its svertices must name planes of these only.
  /// False if nothing is added, since something was wrong before.
  bool append_like(const PointTable& points, PointId point, VertexId like, std::span<const PlaneId> planes);

  /// Adds copies of consecutive vertices of another complex, from `first` on. Rows of its planes become rows[row]
  /// unless `rows` is empty, its marks other than kOutside become marks[mark] unless `marks` is empty. O(their items),
  /// with a few memcpys.
  void copy(const Complex& from, VertexId first, std::uint32_t count, std::span<const std::uint32_t> rows = {},
            std::span<const LabelId> marks = {});

  /// The same of all vertices.
  void copy(const Complex& from, std::span<const std::uint32_t> rows = {}, std::span<const LabelId> marks = {}) {
    copy(from, VertexId{0}, from.vertex_ids().size(), rows, marks);
  }

  /// What copy() is asked to do; what it refers to must outlive the call.
  struct CopiedRun {
    const Complex* from;
    VertexId first;
    std::uint32_t count;
    std::span<const std::uint32_t> rows;
    std::span<const LabelId> marks;
  };
  /// The same for all of these, one after the other. The thread that calls need not be the
  /// builder's, and brings its monitor.
  void copy(std::span<const CopiedRun> runs, const Monitor& monitor);

  /// Takes the vertices of a complex as they are, in place of those added so far.
  void take_vertices(Complex&& from);

  /// The vertices added so far, without planes and links.
  [[nodiscard]] const Complex& so_far() const { return complex_; }

  /// The same, taken out of the builder.
  [[nodiscard]] Complex take_so_far();

  /// True if finish() would remove an infimaximal box.
  [[nodiscard]] bool has_idle_box() const;

  /// Drops planes that nothing uses, as finish() does.
  void drop_idle_planes();

  /// Removes an infimaximal box that nothing reaches, drops planes that nothing uses, and synthesizes. `outer` is the
  /// mark of all of space if there are no vertices. To be called once. For sphere maps that must fit together: a
  /// defect is a bug, and thrown as such. O(n log n), partly on the threads of its monitor.
  [[nodiscard]] Complex finish(LabelId outer);

  /// The same complex, where some links are known: then there must be no idle box, and no plane that nothing uses.
  [[nodiscard]] Complex finish(LabelId outer, KnownLinks&& known);

  /// What finish() returns, or what is wrong with the sphere maps.
  [[nodiscard]] std::variant<Complex, Defect> try_finish(LabelId outer);
  [[nodiscard]] std::variant<Complex, Defect> try_finish(LabelId outer, KnownLinks&& known);

  /// The same with the box and the planes as they are.
  [[nodiscard]] std::variant<Complex, Defect> try_finish_unreduced(LabelId outer);

 private:
  bool simplify(Arrangement& drawing, bool sorted);
  void push(const SphereMapView& map);
  void copy_records(std::span<const CopiedRun> runs);
  void copy_planes(const CopiedRun& run);
  void copy_sloops(const CopiedRun& run);
  void drop_idle_box(LabelId& outer);
  Complex take();
  Complex finish_unreduced(LabelId outer);

  PlaneTable& planes_;
  Monitor monitor_;
  Complex complex_;
  PatternInterner interner_;  // of complex_.patterns
  SphereMapBuffer map_;
  std::optional<Defect> defect_;
};

}  // namespace nef
