// SPDX-License-Identifier: Apache-2.0
#include "nef/boolean/union_order.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "nef/complex/item_boxes.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

double middle(const UnionOperand& operand, std::size_t axis) {
  const double low = operand.box.low[axis];
  const double high = operand.box.high[axis];
  return operand.bounded && low <= high ? low / 2 + high / 2 : 0;
}

}  // namespace

UnionOperand union_operand(const Polyhedron& set) {
  // What a union costs beside its vertices, in vertices.
  constexpr std::size_t kAnyway = 8;
  const Complex& c = set.complex();
  return {vertices_box(c), c.vertex_count() + kAnyway, set.is_bounded()};
}

UnionOrder::UnionOrder(std::span<const UnionOperand> operands, std::size_t tasks) : operands_(operands) {
  std::vector<std::uint32_t> all(operands.size());
  std::iota(all.begin(), all.end(), 0U);
  weight_of_task_ = weight(all) / tasks;
  steps_.reserve(all.size());
  order(all);
}

std::size_t UnionOrder::weight(std::span<const std::uint32_t> group) const {
  std::size_t sum = 0;
  for (const std::uint32_t i : group) sum += operands_[i].weight;
  return sum;
}

UnionOrder::Group UnionOrder::order(std::span<std::uint32_t> group) {
  if (group.size() == 1) return {group[0], 0};
  const std::size_t all = weight(group);
  const auto first_step = static_cast<std::uint32_t>(steps_.size());
  const std::size_t half = split(group, all);
  const Group a = order(group.first(half));
  const Group b = order(group.subspan(half));
  const auto step = static_cast<std::uint32_t>(steps_.size());
  steps_.push_back({a.result, b.result});
  Group result{static_cast<std::uint32_t>(operands_.size()) + step, 0};
  // A task swallows those before it that it is made of.
  if (all <= weight_of_task_) {
    while (!tasks_.empty() && tasks_.back().first >= first_step) tasks_.pop_back();
    tasks_.push_back({first_step, step + 1});
  } else {
    result.round = std::max(a.round, b.round) + 1;
    if (rounds_.size() < result.round) rounds_.resize(result.round);
    rounds_[result.round - 1].push_back(step);
  }
  return result;
}

// Puts those of the first half in front and returns their number.
std::size_t UnionOrder::split(std::span<std::uint32_t> group, std::size_t weight) const {
  const auto bounded =
      std::partition(group.begin(), group.end(), [this](std::uint32_t i) { return operands_[i].bounded; });
  if (bounded != group.begin() && bounded != group.end()) return static_cast<std::size_t>(bounded - group.begin());
  const auto heaviest = std::max_element(group.begin(), group.end(), [this](std::uint32_t i, std::uint32_t j) {
    return operands_[i].weight < operands_[j].weight;
  });
  if (operands_[*heaviest].weight > weight / 2) {
    std::iter_swap(heaviest, group.end() - 1);
    return group.size() - 1;
  }
  std::array<double, 3> low{};
  std::array<double, 3> high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = high[axis] = middle(operands_[group[0]], axis);
    for (const std::uint32_t i : group) {
      low[axis] = std::min(low[axis], middle(operands_[i], axis));
      high[axis] = std::max(high[axis], middle(operands_[i], axis));
    }
  }
  std::size_t axis = 0;
  for (std::size_t other = 1; other < 3; ++other) {
    if (high[other] - low[other] > high[axis] - low[axis]) axis = other;
  }
  const auto before = [this, axis](std::uint32_t i, std::uint32_t j) {
    const double x = middle(operands_[i], axis);
    const double y = middle(operands_[j], axis);
    return x < y || (x == y && i < j);
  };
  // The place where half of the weight is reached, between first and last.
  std::size_t first = 0;
  std::size_t last = group.size();
  std::size_t before_first = 0;
  while (last - first > 1) {
    const std::size_t place = first + (last - first) / 2;
    std::nth_element(group.begin() + static_cast<std::ptrdiff_t>(first),
                     group.begin() + static_cast<std::ptrdiff_t>(place),
                     group.begin() + static_cast<std::ptrdiff_t>(last), before);
    const std::size_t below = before_first + this->weight(group.subspan(first, place - first));
    if (2 * below <= weight) {
      first = place;
      before_first = below;
    } else {
      last = place;
    }
  }
  return std::max<std::size_t>(first, 1);
}

}  // namespace nef
