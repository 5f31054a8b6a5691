// SPDX-License-Identifier: Apache-2.0
//
// Unary operations change marks locally, simplify, and synthesize. In a simplified complex every
// vertex, edge and facet is a boundary item, which makes the topological operations simple:
// interior deselects all of them, closure and boundary select all of them (thesis 4.5, 5.2).
#include "nef/operation/for_each_mark.h"
#include "nef/polyhedron.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {
namespace {

enum class Lower { kClear, kSelect };
enum class Volumes { kKeep, kClear };

class MarkChanger {
 public:
  MarkChanger(const Complex& c, Lower lower, Volumes volumes, const Monitor& monitor)
      : c_(c), lower_(lower == Lower::kSelect ? 1 : 0), clear_volumes_(volumes == Volumes::kClear), monitor_(monitor) {}

  Complex run() {
    PlaneTable planes = c_.planes;
    ComplexBuilder result(planes, monitor_);
    for (const VertexId v : c_.vertex_ids()) {
      monitor_.tell_progress_of_item("sphere maps", v.index(), c_.vertex_count());
      load(c_.sphere_map(v));
      if (!c_.points.finite(point_of(v))) mark_trace_on_box();
      result.add(c_.points, point_of(v), drawing_);
    }
    return result.finish(volume_mark(c_.volumes[kOuterVolume].mark));
  }

 private:
  LabelId volume_mark(LabelId mark) const {
    if (mark == kOutside) return kOutside;
    return clear_volumes_ ? LabelId{0} : mark;
  }

  void load(const SphereMapView& map) {
    drawing_.load(c_.planes, map);
    drawing_.centre = lower_;
    drawing_.background = volume_mark(drawing_.background);
    for (Arrangement::Node& node : drawing_.nodes) {
      node.mark = lower_;
      node.around = volume_mark(node.around);
    }
    for (Arrangement::Arc& arc : drawing_.arcs) {
      arc.mark = lower_;
      arc.left = volume_mark(arc.left);
      arc.right = volume_mark(arc.right);
    }
    drawing_.circle.mark = lower_;
    drawing_.circle.left = volume_mark(drawing_.circle.left);
    drawing_.circle.right = volume_mark(drawing_.circle.right);
  }

  // Items on the infimaximal box are no boundary items: each is the trace of an item that would go
  // on beyond the box, and has its mark.
  void mark_trace_on_box() {
    LabelId centre = 0;
    int centre_rank = -1;  // dimension of the traced item decides: edge before facet before volume
    const auto offer = [&](int rank, LabelId mark) {
      if (rank <= centre_rank) return;
      centre_rank = rank;
      centre = mark;
    };
    // A whole circle is a wall that an edge without facets meets.
    Arrangement::Circle& circle = drawing_.circle;
    if (circle.present && c_.planes.infimaximal(circle.plane)) {
      circle.mark = circle.left == kOutside ? circle.right : circle.left;
      offer(0, circle.mark);
    }
    std::vector<bool> on_wall(drawing_.nodes.size(), false);
    for (Arrangement::Arc& arc : drawing_.arcs) {
      if (!c_.planes.infimaximal(arc.plane)) {
        offer(1, arc.mark);
        continue;
      }
      arc.mark = arc.left == kOutside ? arc.right : arc.left;
      on_wall[arc.source] = on_wall[arc.target] = true;
      offer(0, arc.mark);
    }
    for (const Arrangement::Arc& arc : drawing_.arcs) {
      for (const std::uint32_t end : {arc.source, arc.target}) {
        if (on_wall[end] && c_.planes.infimaximal(arc.plane)) drawing_.nodes[end].mark = arc.mark;
      }
    }
    for (const Arrangement::Arc& arc : drawing_.arcs) {
      for (const std::uint32_t end : {arc.source, arc.target}) {
        if (on_wall[end] && !c_.planes.infimaximal(arc.plane)) drawing_.nodes[end].mark = arc.mark;
      }
    }
    for (std::uint32_t n = 0; n < drawing_.nodes.size(); ++n) {
      if (!on_wall[n]) offer(2, drawing_.nodes[n].mark);
    }
    drawing_.centre = centre;
  }

  const Complex& c_;
  LabelId lower_;
  bool clear_volumes_;
  Monitor monitor_;
  Arrangement drawing_;
};

}  // namespace

Polyhedron without_labels(const Polyhedron& a, const Monitor& monitor) {
  if (a.complex().label_count <= 2) return a;
  return overlay(
      a, Polyhedron(), [](LabelId x, LabelId) { return static_cast<LabelId>(x != 0 ? 1 : 0); }, monitor);
}

Polyhedron complement(const Polyhedron& a) {
  Complex c = without_labels(a).take_complex();
  // Different marks stay different, so nothing but the marks changes.
  for_each_mark(c, [](LabelId& mark) {
    if (mark != kOutside) mark = mark == 0 ? 1 : 0;
  });
  return Polyhedron(std::move(c));
}

Polyhedron interior(const Polyhedron& a, const Monitor& monitor) {
  return Polyhedron(MarkChanger(without_labels(a, monitor).complex(), Lower::kClear, Volumes::kKeep, monitor).run());
}

Polyhedron closure(const Polyhedron& a, const Monitor& monitor) {
  return Polyhedron(MarkChanger(without_labels(a, monitor).complex(), Lower::kSelect, Volumes::kKeep, monitor).run());
}

Polyhedron boundary(const Polyhedron& a, const Monitor& monitor) {
  return Polyhedron(MarkChanger(without_labels(a, monitor).complex(), Lower::kSelect, Volumes::kClear, monitor).run());
}

Polyhedron exterior(const Polyhedron& a, const Monitor& monitor) { return interior(complement(a), monitor); }

Polyhedron regularize(const Polyhedron& a, const Monitor& monitor) { return closure(interior(a, monitor), monitor); }

}  // namespace nef
