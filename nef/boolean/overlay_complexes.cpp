// SPDX-License-Identifier: Apache-2.0
//
// candidate points -> local pyramid in each operand -> overlay -> simplify -> synthesize.
// Vertices that the other operand does not touch see only one of its marks: they are dropped,
// copied, or (for label functions that merge some marks) simplified on their own.
#include "nef/boolean/overlay_complexes.h"

#include <algorithm>
#include <deque>

#include "nef/base/fast_path.h"
#include "nef/base/threads/parallel.h"
#include "nef/boolean/pyramid_overlay.h"
#include "nef/boolean/result/result_assembly.h"
#include "nef/complex/local_pyramid.h"

namespace nef {
namespace {

class ComplexOverlay {
 public:
  ComplexOverlay(const Complex& a, const Complex& b, const LabelFunction& f, const Monitor& monitor)
      : f_(f),
        monitor_(monitor),
        tables_(a, b, monitor_),
        operands_{Operand(a, tables_, 0), Operand(b, tables_, 1)},
        result_(operands_, tables_) {}

  // Nothing if the result is operand 0.
  std::optional<Complex> run(const std::function<const QueryStructure&()>& queries_a,
                             const std::function<const QueryStructure&()>& queries_b) {
    // Whoever listens hears of every overlay, also of one where no boundaries meet and nothing is made.
    monitor_.tell_progress("edges through facets", 0, 0);
    Intersections found = intersect_boundaries(operands_, tables_, monitor_);
    collect(found, queries_a, queries_b);
    return finished(std::move(found));
  }

 private:
  // The vertices of the result.
  void collect(const Intersections& found, const std::function<const QueryStructure&()>& queries_a,
               const std::function<const QueryStructure&()>& queries_b) {
    std::array<IndexedVector<VertexId, LabelId>, 2> marks;
    const auto find_marks = [&](std::size_t x, const Monitor& own) {
      marks[x] = marks_of_untouched(operands_, x, tables_, found, x == 0 ? queries_b : queries_a, own);
    };
    parallel_calls(monitor_,
                   {[&](const Monitor& own) { find_marks(0, own); }, [&](const Monitor& own) { find_marks(1, own); }});
    std::vector<Meeting> meetings;
    const auto note_meeting = [&](const Meeting& meeting) { meetings.push_back(meeting); };
    for_each_vertex(
        found, [](std::size_t, VertexId) {}, note_meeting);
    for (const Crossing& crossing : found.crossings) note_meeting({crossing.point, crossing.item});
    overlaid_.emplace(operands_, tables_, f_, meetings, monitor_);
    std::size_t next = 0;
    const auto push_next = [&](const Meeting&) { result_.add((*overlaid_)[next++]); };
    for_each_vertex(
        found, [&](std::size_t x, VertexId v) { push_untouched(x, v, marks[x][v]); }, push_next);
    while (next < meetings.size()) result_.add((*overlaid_)[next++]);
  }

  // The vertices of both operands in the order of the result: those that touch nothing, and those at which pyramids
  // meet. Where two vertices meet, that of operand 0. Gone through twice: what meets is overlaid on several threads,
  // and then put in its place.
  template <typename Untouched, typename Met>
  void for_each_vertex(const Intersections& found, const Untouched& untouched, const Met& met) const {
    for (std::size_t x = 0; x < 2; ++x) {
      const IndexedVector<VertexId, ItemRef>& items = found.vertex_item[x];
      for (const VertexId v : items.ids()) {
        if (!items[v].valid()) {
          untouched(x, v);
        } else if (x == 0 || items[v].kind != ItemRef::Kind::kVertex) {
          std::array<ItemRef, 2> pair;
          pair[x] = ItemRef(v);
          pair[1 - x] = items[v];
          met({operands_[x].point(v), pair});
        }
      }
    }
  }

  std::optional<Complex> finished(Intersections&& found) {
    const Complex& a = operands_[0].complex();
    const Complex& b = operands_[1].complex();
    const LabelId outer = f_(a.volumes[kOuterVolume].mark, b.volumes[kOuterVolume].mark);
    if (result_.is_first_operand() && outer == a.volumes[kOuterVolume].mark) return std::nullopt;
    // What is done with goes before the result needs room.
    tables_.points = PointTable();
    found.vertex_item = {};
    found.crossings = {};
    ComplexBuilder builder(tables_.planes, monitor_);
    result_.write(tables_.planes, builder, monitor_);
    overlaid_.reset();
    if ((a.has_box() || b.has_box()) && builder.has_idle_box()) return builder.finish(outer);
    std::optional<KnownLinks> known;
    if (kFastPaths && result_.is_mostly_copies()) {
      known = copied_links(builder.so_far(), result_.origins(), {&a, &b}, found.contacts, monitor_);
    }
    found = {};
    return known ? builder.finish(outer, *std::move(known)) : builder.finish(outer);
  }

  // What f does to the marks of operand x beside one mark of the other.
  enum class Effect { kConstant, kIdentity, kInjective, kGeneral };
  // The same at one vertex, of the marks around it.
  enum class Verdict : std::uint8_t { kUnknown, kIdentity, kInjective, kGeneral };
  struct Restriction {
    Effect effect = Effect::kGeneral;
    std::vector<LabelId> map;
    std::vector<Verdict> of_pattern;  // filled as vertices ask
  };
  using Restrictions = std::deque<std::pair<LabelId, Restriction>>;  // keeps its items in place

  Restriction& restriction(std::size_t x, LabelId other) {
    auto& cache = restrictions_[x];
    const auto known = std::find_if(cache.begin(), cache.end(), [other](const auto& r) { return r.first == other; });
    if (known != cache.end()) return known->second;
    Restriction r;
    const LabelId labels = operands_[x].complex().label_count;
    // Of many labels few occur beside this one, and fewer at one vertex: each vertex is looked at by itself.
    if (labels > 256) {
      cache.emplace_back(other, std::move(r));
      return cache.back().second;
    }
    bool constant = true;
    bool identity = true;
    std::vector<LabelId> image;
    for (LabelId label = 0; label < labels; ++label) {
      r.map.push_back(x == 0 ? f_(label, other) : f_(other, label));
      constant = constant && r.map.back() == r.map.front();
      identity = identity && r.map.back() == label;
    }
    image = r.map;
    std::sort(image.begin(), image.end());
    const bool injective = std::adjacent_find(image.begin(), image.end()) == image.end();
    // Beside the box's outside no mark survives; a constant drops everything but the box.
    if (other == kOutside || (constant && !operands_[x].complex().has_box())) {
      r.effect = Effect::kConstant;
    } else if (identity) {
      r.effect = Effect::kIdentity;
    } else if (injective) {
      r.effect = Effect::kInjective;
    }
    cache.emplace_back(other, std::move(r));
    return cache.back().second;
  }

  void push_untouched(std::size_t x, VertexId v, LabelId other) {
    Restriction& r = restriction(x, other);
    switch (r.effect) {
      case Effect::kConstant:
        return;
      case Effect::kIdentity:
        result_.copy(x, v, nullptr);
        return;
      case Effect::kInjective:
        result_.copy(x, v, &r.map);
        return;
      case Effect::kGeneral: {
        if (push_if_injective(x, v, other, verdict_on(x, v, other, r))) return;
        std::array<ItemRef, 2> items;
        items[x] = ItemRef(v);
        const SphereMapBuffer& map = overlay_.at(items, other);
        if (is_vertex(tables_.planes, map.view(), monitor_)) result_.add(operands_[x].point(v), map.view());
        return;
      }
    }
  }

  // Of vertices without sloops, whose marks are those of their pattern, the first one of each pattern is looked at.
  Verdict verdict_on(std::size_t x, VertexId v, LabelId other, Restriction& r) {
    const Complex& c = operands_[x].complex();
    if (c.vertices[v].sloops != c.vertices[v.next()].sloops) return judge(c.sphere_map(v), x, other);
    r.of_pattern.resize(c.patterns.size(), Verdict::kUnknown);
    Verdict& known = r.of_pattern[c.vertices.pattern(v).index()];
    if (known == Verdict::kUnknown) known = judge(c.sphere_map(v), x, other);
    return known;
  }

  Verdict judge(const SphereMapView& map, std::size_t x, LabelId other) {
    marks_.assign(1, map.mark);
    for (const SVertex& item : map.svertices) marks_.push_back(item.mark);
    for (const SHalfedge& item : map.shalfedges) marks_.push_back(item.mark);
    for (const SLoop& item : map.sloops) marks_.push_back(item.mark);
    for (const SFace& item : map.sfaces) marks_.push_back(item.mark);
    std::sort(marks_.begin(), marks_.end());
    marks_.erase(std::unique(marks_.begin(), marks_.end()), marks_.end());
    if (std::all_of(marks_.begin(), marks_.end(), [&](LabelId mark) { return image(mark, x, other) == mark; })) {
      return Verdict::kIdentity;
    }
    for (LabelId& mark : marks_) mark = image(mark, x, other);
    std::sort(marks_.begin(), marks_.end());
    return std::adjacent_find(marks_.begin(), marks_.end()) == marks_.end() ? Verdict::kInjective : Verdict::kGeneral;
  }

  [[nodiscard]] LabelId image(LabelId mark, std::size_t x, LabelId other) const {
    return x == 0 ? f_(mark, other) : f_(other, mark);
  }

  // Copies a vertex if f keeps apart all the marks around it: then nothing simplifies.
  bool push_if_injective(std::size_t x, VertexId v, LabelId other, Verdict verdict) {
    if (verdict == Verdict::kGeneral) return false;
    // What f leaves as it is keeps its links, too.
    if (verdict == Verdict::kIdentity) {
      result_.copy(x, v, nullptr);
      return true;
    }
    copy_with_marks(operands_[x].pyramid(ItemRef(v), other, scratch_),
                    [&](LabelId mark) { return image(mark, x, other); });
    result_.add(operands_[x].point(v), out_.view());
    return true;
  }

  template <typename Change>
  void copy_with_marks(const SphereMapView& map, const Change& change) {
    const auto apply = [&change](LabelId& mark) {
      if (mark != kOutside) mark = change(mark);
    };
    out_.assign(map);
    apply(out_.mark);
    for (SVertex& item : out_.svertices) apply(item.mark);
    for (SHalfedge& item : out_.shalfedges) apply(item.mark);
    for (SLoop& item : out_.sloops) apply(item.mark);
    for (SFace& item : out_.sfaces) apply(item.mark);
  }

  const LabelFunction& f_;
  Monitor monitor_;
  CommonTables tables_;
  std::array<Operand, 2> operands_;
  PyramidOverlay overlay_{operands_, tables_, f_, monitor_};
  SphereMapBuffer scratch_;
  SphereMapBuffer out_;
  std::vector<LabelId> marks_;
  std::array<Restrictions, 2> restrictions_;
  std::optional<OverlaidMeetings> overlaid_;  // holds what the result takes from it until that is written
  ResultAssembly result_;
};

}  // namespace

std::optional<Complex> overlay_complexes(const Complex& a, const Complex& b, const LabelFunction& f,
                                         const std::function<const QueryStructure&()>& queries_a,
                                         const std::function<const QueryStructure&()>& queries_b,
                                         const Monitor& monitor) {
  return ComplexOverlay(a, b, f, monitor).run(queries_a, queries_b);
}

}  // namespace nef
