// SPDX-License-Identifier: Apache-2.0
//
// A search from seeds: a vertex whose mark is known gives it to its neighbours along uncrossed edges. The seeds, from
// cheap to dear: vertices outside of the other operand's box; the contacts of an edge that are next to its ends;
// touched neighbours, whose local pyramid in the other operand shows what the edge leads into; and a point location for
// one vertex of a component that has none of these. The stages run one after another, and each seed spreads before the
// next one is looked for, so that each vertex is settled once: O(items) and one point location for each untouched
// component.
#include "nef/boolean/result/untouched.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"
#include "nef/base/union_find.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef {
namespace {

class UntouchedMarks {
 public:
  UntouchedMarks(const std::array<Operand, 2>& operands, std::size_t x, const CommonTables& tables,
                 const Intersections& intersections, const Monitor& monitor)
      : own_(operands[x]),
        other_(operands[1 - x]),
        tables_(tables),
        monitor_(monitor),
        items_(intersections.vertex_item[x]),
        contacts_(intersections.contacts[x]),
        marks_(own_.complex().vertex_count(), 0),
        known_(marks_.size(), false),
        crossed_(own_.complex().svertex_count(), false) {
    for (const EdgeContact& contact : contacts_) {
      crossed_[contact.edge] = true;
      crossed_[own_.complex().twin[contact.edge]] = true;
    }
  }

  IndexedVector<VertexId, LabelId> run(const std::function<const QueryStructure&()>& queries) {
    const LabelId outer = other_.complex().volumes[kOuterVolume].mark;
    // Of surfaces, all volumes have one mark, and nobody asks which of them holds a vertex.
    const auto& volumes = other_.complex().volumes;
    if (std::all_of(volumes.begin(), volumes.end(), [outer](const Volume& v) { return v.mark == outer; })) {
      marks_.assign(marks_.size(), outer);
      return std::move(marks_);
    }
    for (const VertexId v : marks_.ids()) {
      if (!touched(v) && !own_.vertex_box(v).overlaps(other_.bounds())) settle(v, outer);
    }
    spread();
    // Each answer spreads before the next one is looked for: at a vertex of high degree one costs as much as it has
    // edges. Contacts inside facets, which are most, cost least, so they come first.
    for (std::size_t i = 0; i < contacts_.size();) {
      std::size_t j = i;
      while (j < contacts_.size() && contacts_[j].edge == contacts_[i].edge) ++j;
      seed_from_contacts(std::span(contacts_).subspan(i, j - i));
      i = j;
    }
    seed_from_touched_ends();
    for (const VertexId v : marks_.ids()) {
      if (touched(v) || known_[v]) continue;
      const VolumeId volume =
          queries().volume_at(other_.complex(), PointRef{&own_.complex().points, point_of(v)}, monitor_);
      settle(v, other_.complex().volumes[volume].mark);
      spread();
    }
    return std::move(marks_);
  }

 private:
  bool touched(VertexId v) const { return items_[v].valid(); }

  void settle(VertexId v, LabelId mark) {
    if (known_[v]) return;
    known_[v] = true;
    marks_[v] = mark;
    queue_.push_back(v);
  }

  void spread() {
    while (!queue_.empty()) {
      const VertexId v = queue_.back();
      queue_.pop_back();
      for (const HalfedgeId h : own_.complex().halfedges(v)) {
        const VertexId w = own_.target(h);
        if (!known_[w] && !crossed_[h] && !touched(w)) settle(w, marks_[v]);
      }
    }
  }

  void seed_from_touched_ends() {
    for (const VertexId v : items_.ids()) {
      if (!touched(v)) continue;
      for (const HalfedgeId h : own_.complex().halfedges(v)) {
        const VertexId w = own_.target(h);
        if (touched(w) || known_[w] || crossed_[h]) continue;
        settle(w, mark_toward(items_[v], h, w));
        spread();
      }
    }
  }

  // The mark of the other operand's volume that halfedge h leads into from `item`, toward w.
  LabelId mark_toward(const ItemRef& item, HalfedgeId h, VertexId w) const {
    if (item.kind == ItemRef::Kind::kFacet) {
      const Facet& facet = other_.complex().facets[item.facet()];
      const int side =
          side_of_plane(tables_.planes, other_.plane(facet.plane), tables_.points, own_.point(w), monitor_);
      NEF_ASSERT(side != 0);
      return other_.complex().volumes[side > 0 ? facet.volume_above : facet.volume_below].mark;
    }
    return other_.volume_mark(tables_.planes, item, direction_of(tables_.planes, own_.svertex(h)), monitor_);
  }

  // All contacts of one edge: the extreme ones tell about its ends.
  void seed_from_contacts(std::span<const EdgeContact> contacts) {
    const HalfedgeId h = contacts.front().edge;
    const VertexId source = own_.source(h);
    const VertexId target = own_.target(h);
    const bool want_source = !touched(source) && !known_[source];
    const bool want_target = !touched(target) && !known_[target];
    if (!want_source && !want_target) return;
    const Direction direction = direction_of(tables_.planes, own_.svertex(h));
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (std::fabs(direction.approximate[i]) > std::fabs(direction.approximate[axis])) axis = i;
    }
    const int rising = direction.approximate[axis] > 0 ? 1 : -1;
    const auto before = [&](const EdgeContact& a, const EdgeContact& b) {
      return rising * compare_coordinate(tables_.points, a.point, b.point, static_cast<int>(axis), monitor_) < 0;
    };
    if (want_source) {
      const auto nearest = std::min_element(contacts.begin(), contacts.end(), before);
      settle(source, mark_toward(nearest->other, own_.complex().twin[h], source));
      spread();
    }
    if (want_target && !known_[target]) {
      const auto nearest = std::max_element(contacts.begin(), contacts.end(), before);
      settle(target, mark_toward(nearest->other, h, target));
      spread();
    }
  }

  const Operand& own_;
  const Operand& other_;
  const CommonTables& tables_;
  Monitor monitor_;
  const IndexedVector<VertexId, ItemRef>& items_;
  const std::vector<EdgeContact>& contacts_;
  IndexedVector<VertexId, LabelId> marks_;
  IndexedVector<VertexId, bool> known_;
  IndexedVector<HalfedgeId, bool> crossed_;
  std::vector<VertexId> queue_;
};

}  // namespace

IndexedVector<VertexId, LabelId> marks_of_untouched(const std::array<Operand, 2>& operands, std::size_t x,
                                                    const CommonTables& tables, const Intersections& intersections,
                                                    const std::function<const QueryStructure&()>& queries_of_other,
                                                    const Monitor& monitor) {
  return UntouchedMarks(operands, x, tables, intersections, monitor).run(queries_of_other);
}

}  // namespace nef
