// SPDX-License-Identifier: Apache-2.0
#include "nef/operation/label_inputs.h"

#include <algorithm>
#include <iterator>

#include "nef/base/threads/parallel.h"

namespace nef {
namespace {

using Labeled = LabeledPolyhedron<InputSet>;

InputSet both(const InputSet& a, const InputSet& b) {
  InputSet result;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

}  // namespace

LabeledPolyhedron<InputSet> label_inputs(std::span<const Polyhedron> inputs, const Monitor& monitor) {
  if (inputs.empty()) return Labeled(InputSet{});
  std::vector<Labeled> left;
  for (std::uint32_t i = 0; i < inputs.size(); ++i) left.emplace_back(inputs[i], InputSet{}, InputSet{i});
  // Neighbours in the order of inputs are paired, round after round, whatever the number of threads.
  while (left.size() > 1) {
    std::vector<Labeled> next(left.size() / 2, Labeled(InputSet{}));
    parallel_for(next.size(), monitor, [&](std::size_t i, const Monitor& own) {
      next[i] = overlay(left[2 * i], left[2 * i + 1], both, own);
    });
    if (left.size() % 2 == 1) next.push_back(std::move(left.back()));
    left = std::move(next);
  }
  return std::move(left.front());
}

InputSet origins(const InputSet& one_side, const InputSet& other_side) {
  InputSet result;
  std::set_symmetric_difference(one_side.begin(), one_side.end(), other_side.begin(), other_side.end(),
                                std::back_inserter(result));
  return result;
}

}  // namespace nef
