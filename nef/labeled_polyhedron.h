// SPDX-License-Identifier: Apache-2.0
//
// Marks of any type (thesis 4.2, 10.2.1): materials, origins, counts, weights.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/operation/compact_marks.h"
#include "nef/polyhedron.h"

namespace nef {

/// A subdivision of space in which every vertex, edge, facet and volume carries a value of type
/// Label; neighbouring items with equal labels are one (the representation is as unique as that
/// of sets). Label needs operator==. The labels are interned, so the core moves small numbers only;
/// a polyhedron can hold some 65000 different ones.
template <typename Label>
class LabeledPolyhedron {
 public:
  /// All of space carries `label`.
  explicit LabeledPolyhedron(Label label) : labels_{label, label} {}

  /// `inside` where the set is, `outside` elsewhere.
  LabeledPolyhedron(Polyhedron set, Label outside, Label inside)
      : set_(std::move(set)), labels_{std::move(outside), std::move(inside)} {
    if (labels_[0] == labels_[1]) throw InputError("the labels inside and outside of a set must differ");
  }

  /// The complex; its marks are indices into labels().
  [[nodiscard]] const Polyhedron& polyhedron() const { return set_; }
  [[nodiscard]] const std::vector<Label>& labels() const { return labels_; }
  [[nodiscard]] const Label& label(LabelId mark) const { return labels_[mark]; }

  /// The label at a point.
  [[nodiscard]] const Label& at(const Rational3& point) const { return labels_[locate(set_, point).mark]; }

  /// Every point carries f(its label in a, its label in b). f is called once for each pair of
  /// labels that meet, maybe for others; the result keeps the labels that some point has.
  /// Cost as for a Boolean operation, and one comparison for each pair and label of the result.
  template <typename Function>
  friend LabeledPolyhedron overlay(const LabeledPolyhedron& a, const LabeledPolyhedron& b, Function&& f,
                                   const Monitor& monitor = {}) {
    std::vector<Label> labels;
    const auto intern = [&labels](Label label) {
      const auto at = std::find(labels.begin(), labels.end(), label);
      const auto index = static_cast<std::size_t>(at - labels.begin());
      if (at == labels.end()) labels.push_back(std::move(label));
      if (index >= kOutside) throw UnsupportedError("more than 65535 different labels in one polyhedron");
      return static_cast<LabelId>(index);
    };
    const auto combined = [&](LabelId x, LabelId y) {
      // Asked for labels up to the larger of 2 and those in use.
      const auto clamp = [](LabelId id, const std::vector<Label>& known) {
        return std::min<std::size_t>(id, known.size() - 1);
      };
      return intern(f(a.labels_[clamp(x, a.labels_)], b.labels_[clamp(y, b.labels_)]));
    };
    Polyhedron set = nef::overlay(a.set_, b.set_, combined, monitor);
    // f may have been asked for pairs that meet nowhere, too.
    CompactMarks compact = compact_marks(set);
    std::vector<Label> in_use;
    for (const LabelId mark : compact.old) in_use.push_back(std::move(labels[mark]));
    return LabeledPolyhedron(std::move(compact.set), std::move(in_use));
  }

  /// The set of points whose label satisfies the predicate.
  template <typename Predicate>
  [[nodiscard]] Polyhedron where(Predicate&& predicate, const Monitor& monitor = {}) const {
    const auto satisfies = [&](LabelId x, LabelId) {
      return static_cast<LabelId>(x < labels_.size() && predicate(labels_[x]));
    };
    return nef::overlay(set_, Polyhedron(), satisfies, monitor);
  }

 private:
  LabeledPolyhedron(Polyhedron set, std::vector<Label> labels) : set_(std::move(set)), labels_(std::move(labels)) {}

  Polyhedron set_;
  std::vector<Label> labels_;  // by mark
};

}  // namespace nef
