// SPDX-License-Identifier: Apache-2.0
//
// candidate points -> local pyramid in each operand -> overlay -> simplify -> synthesize.
// Vertices that the other operand does not touch see only one of its marks: they are dropped,
// copied, or (for label functions that merge some marks) simplified on their own.
#include "nef/boolean/overlay_complexes.h"

#include <algorithm>
#include <deque>

#include "nef/base/progress.h"
#include "nef/boolean/result_assembly.h"
#include "nef/complex/local_pyramid.h"
#include "nef/sphere_map/overlay.h"

namespace nef {
namespace {

class ComplexOverlay {
 public:
  ComplexOverlay(const Complex& a, const Complex& b, const LabelFunction& f)
      : f_(f), operands_{Operand(a, tables_), Operand(b, tables_)}, result_(operands_, tables_) {}

  // Nothing if the result is operand 0.
  std::optional<Complex> run(const std::function<const QueryStructure&()>& queries_a,
                             const std::function<const QueryStructure&()>& queries_b) {
    Intersections found = intersect_boundaries(operands_, tables_);
    for (std::size_t x = 0; x < 2; ++x) {
      const std::vector<LabelId> marks =
          marks_of_untouched(operands_, x, tables_, found, x == 0 ? queries_b : queries_a);
      const std::vector<Item>& items = found.vertex_item[x];
      for (std::uint32_t v = 0; v < items.size(); ++v) {
        tell_progress_of_item("sphere maps", v, items.size());
        if (items[v].kind == Item::Kind::kNone) {
          push_untouched(x, v, marks[v]);
        } else if (x == 0 || items[v].kind != Item::Kind::kVertex) {
          std::array<Item, 2> pair;
          pair[x] = {Item::Kind::kVertex, v};
          pair[1 - x] = items[v];
          push_overlay(operands_[x].point(v), pair);
        }
      }
    }
    for (std::size_t k = 0; k < found.crossings.size(); ++k) {
      tell_progress_of_item("sphere maps of crossings", k, found.crossings.size());
      push_overlay(found.crossings[k].point, found.crossings[k].item);
    }
    return finished(std::move(found));
  }

 private:
  std::optional<Complex> finished(Intersections&& found) {
    const Complex& a = operands_[0].complex();
    const Complex& b = operands_[1].complex();
    const LabelId outer = f_(a.volumes[kOuterVolume].mark, b.volumes[kOuterVolume].mark);
    if (result_.is_first_operand() && outer == a.volumes[kOuterVolume].mark) return std::nullopt;
    ComplexBuilder builder(tables_.planes);
    result_.write(tables_.planes, builder);
    if ((a.has_box() || b.has_box()) && builder.has_idle_box()) return builder.finish(outer);
    std::optional<KnownLinks> known;
    if (result_.is_mostly_copies()) {
      known = copied_links(builder.so_far(), result_.origins(), {&a, &b}, found.contacts);
    }
    found = {};
    tables_.points = PointTable();
    return known ? builder.finish(outer, *std::move(known)) : builder.finish(outer);
  }

  void push_overlay(PointId point, const std::array<Item, 2>& items) {
    const SphereMapView a = operands_[0].pyramid(items[0], 0, scratch_[0]);
    const SphereMapView b = operands_[1].pyramid(items[1], 0, scratch_[1]);
    overlay_.overlay(tables_.planes, a, b, f_, out_);
    push_result(point);
  }

  void push_result(PointId point) {
    if (is_vertex(tables_.planes, out_.view())) result_.add(point, out_.view());
  }

  // What f does to the marks of operand x beside one mark of the other.
  enum class Effect { kConstant, kIdentity, kInjective, kGeneral };
  struct Restriction {
    Effect effect = Effect::kGeneral;
    std::vector<LabelId> map;
  };
  using Restrictions = std::deque<std::pair<LabelId, Restriction>>;  // keeps its items in place

  const Restriction& restriction(std::size_t x, LabelId other) {
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

  void push_untouched(std::size_t x, std::uint32_t v, LabelId other) {
    const Restriction& r = restriction(x, other);
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
        if (push_if_injective(x, v, other)) return;
        std::array<Item, 2> items;
        items[x] = {Item::Kind::kVertex, v};
        const SphereMapView a = operands_[0].pyramid(items[0], other, scratch_[0]);
        const SphereMapView b = operands_[1].pyramid(items[1], other, scratch_[1]);
        overlay_.overlay(tables_.planes, a, b, f_, out_);
        push_result(operands_[x].point(v));
        return;
      }
    }
  }

  // Copies a vertex if f keeps apart all the marks around it: then nothing simplifies.
  bool push_if_injective(std::size_t x, std::uint32_t v, LabelId other) {
    const auto image = [&](LabelId mark) { return x == 0 ? f_(mark, other) : f_(other, mark); };
    const SphereMapView map = operands_[x].pyramid({Item::Kind::kVertex, v}, other, scratch_[x]);
    marks_.assign(1, map.mark);
    for (const SVertex& item : map.svertices) marks_.push_back(item.mark);
    for (const SHalfedge& item : map.shalfedges) marks_.push_back(item.mark);
    for (const SLoop& item : map.sloops) marks_.push_back(item.mark);
    for (const SFace& item : map.sfaces) marks_.push_back(item.mark);
    std::sort(marks_.begin(), marks_.end());
    marks_.erase(std::unique(marks_.begin(), marks_.end()), marks_.end());
    for (LabelId& mark : marks_) mark = image(mark);
    std::sort(marks_.begin(), marks_.end());
    if (std::adjacent_find(marks_.begin(), marks_.end()) != marks_.end()) return false;
    copy_with_marks(map, image);
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
  CommonTables tables_;
  std::array<Operand, 2> operands_;
  SphereOverlay overlay_;
  std::array<SphereMapBuffer, 2> scratch_;
  SphereMapBuffer out_;
  std::vector<LabelId> marks_;
  std::array<Restrictions, 2> restrictions_;
  ResultAssembly result_;
};

}  // namespace

std::optional<Complex> overlay_complexes(const Complex& a, const Complex& b, const LabelFunction& f,
                                         const std::function<const QueryStructure&()>& queries_a,
                                         const std::function<const QueryStructure&()>& queries_b) {
  return ComplexOverlay(a, b, f).run(queries_a, queries_b);
}

}  // namespace nef
