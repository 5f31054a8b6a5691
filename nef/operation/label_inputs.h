// SPDX-License-Identifier: Apache-2.0
//
// Which input a point, and a face of a result, comes from: all inputs overlaid, each point labelled with those that
// hold it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/labeled_polyhedron.h"

namespace nef {

/// Indices of inputs, in rising order.
using InputSet = std::vector<std::uint32_t>;

/// Every point carries the set of inputs that hold it. Any Boolean combination of them is
/// `result.where([](const InputSet& inputs) { ... })`, and the facets of the complex are cut where they change from one
/// input to another. Inputs that overlap in many ways need many labels: UnsupportedError beyond some 65000. The cost is
/// that of uniting the sets with their inner walls kept.
LabeledPolyhedron<InputSet> label_inputs(std::span<const Polyhedron> inputs, const Monitor& monitor = {});

/// The inputs on whose boundary a facet lies, from the inputs that hold its two sides: those on one side only.
InputSet origins(const InputSet& one_side, const InputSet& other_side);

}  // namespace nef
