// SPDX-License-Identifier: Apache-2.0
//
// The order in which the parts of a motion are examined.
#pragma once

#include <deque>
#include <utility>

namespace nef::planner {

/// The parts of a motion that are still to be looked at, each with what its parent has left open: the larger ones
/// first, or in the order of time.
template <typename Open>
class MotionParts {
 public:
  struct Part {
    double from = 0;
    double to = 1;
    unsigned depth = 0;
    Open open;
    [[nodiscard]] double middle() const { return (from + to) / 2; }
  };

  explicit MotionParts(bool in_order) : in_order_(in_order) {}

  [[nodiscard]] bool empty() const { return parts_.empty(); }
  void add(Part part) { parts_.push_back(std::move(part)); }
  /// Takes the next one out; there must be one.
  [[nodiscard]] Part next() {
    Part part = std::move(in_order_ ? parts_.back() : parts_.front());
    in_order_ ? parts_.pop_back() : parts_.pop_front();
    return part;
  }
  /// Adds both halves of a part, with what it has left open.
  void halve(const Part& part, Open open) {
    Part first{part.from, part.middle(), part.depth + 1, open};
    Part second{part.middle(), part.to, part.depth + 1, std::move(open)};
    if (in_order_) std::swap(first, second);
    parts_.push_back(std::move(first));
    parts_.push_back(std::move(second));
  }

 private:
  bool in_order_;
  std::deque<Part> parts_;
};

}  // namespace nef::planner
