// SPDX-License-Identifier: Apache-2.0
//
// What is asked about a set besides its measures: a section, the distance of two parts, which shapes hold what of it.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/studio/panels/panel.h"
#include "nef/polyhedron.h"

namespace nef::studio {

/// The exact section of "section": {"axis": 0, 1 or 2, "offset": a number}, if there is one: report "section" (the area
/// of its polygons in doubles, how many there are, a drawing as SVG), set "section", and a piece. Throws
/// FieldError.
void answer_section(const Json& request, const ExpressionCache::Result& set, const PanelContext& context,
                    PanelResult& result);

/// The exact distance of "from" and "to", two expressions, if both are texts that are not blank: report "distance"
/// (contact, squared, length, both nearest points), and a piece with these and the way between them. Throws FieldError.
void answer_distance(const Json& request, const PanelContext& context, PanelResult& result);

/// The most shapes of a text that are told apart by colour.
inline constexpr std::size_t kMostShapes = 12;

/// Layers that together show a set of some shapes: one for each group of them (named by their numbers, from 1 on) whose
/// points in the set lie in these shapes and in no other one. Throws UnsupportedError for more shapes than kMostShapes.
/// The cost is that of label_inputs, and of two Boolean operations for each layer.
std::vector<view::Layer> layers_by_shapes(const Polyhedron& set, const std::vector<Polyhedron>& shapes,
                                          const Monitor& monitor);

}  // namespace nef::studio
