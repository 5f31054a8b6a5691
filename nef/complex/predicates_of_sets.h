// SPDX-License-Identifier: Apache-2.0
//
// Yes-or-no properties of the set that a complex stands for. A complex is simplified, so each of
// its vertices, edges and facets is part of the topological boundary of the set; the items of an
// infimaximal box are not in space and do not count.
#pragma once

#include "nef/complex/complex.h"

namespace nef {

/// True if the label stands for points of the set: every label but 0 and the mark of the space
/// beyond an infimaximal box.
constexpr bool is_selected(LabelId mark) { return mark != 0 && mark != kOutside; }

/// True if the item belongs to the infimaximal box (a vertex: lies on it).
bool is_box_vertex(const Complex& complex, VertexId vertex);
bool is_box_edge(const Complex& complex, HalfedgeId halfedge);
bool is_box_facet(const Complex& complex, FacetId facet);
/// True if no corner of the facet lies on the infimaximal box.
bool has_finite_corners(const Complex& complex, const Facet& facet);

/// No boundary point is in the set. O(n).
bool is_open_set(const Complex& complex);

/// Every boundary point is in the set. O(n).
bool is_closed_set(const Complex& complex);

/// The set lies in the closure of its interior: it is full-dimensional near each of its points. O(n).
bool is_full_dimensional_set(const Complex& complex);

/// The set is the closure of its interior: closed, and full-dimensional near each of its points.
/// O(n).
bool is_regular_set(const Complex& complex);

/// The set (not its complement) fits into some ball. O(n).
bool is_bounded_set(const Complex& complex);

}  // namespace nef
