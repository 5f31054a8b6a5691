// SPDX-License-Identifier: Apache-2.0
//
// Seams between charts: what neighbouring charts still differ by after blend_views.
#pragma once

#include "apps/visual_hull/texture/charts.h"
#include "apps/visual_hull/texture/sampling.h"
#include "apps/visual_hull/texture/texels.h"

namespace nef::visual_hull {

/// Adds to the colours of all charts of views what makes them agree along their seams: an offset for each vertex of
/// each chart, interpolated over triangles, by least squares (differences along seams; differences of offsets of
/// neighbours in a chart; the offsets themselves), as in Lempitsky and Ivanov 2007. A sparse Cholesky
/// factorization of as many unknowns as charts have vertices.
void level_seams(const Surface& surface, const Atlas& atlas, Texels& texels);

}  // namespace nef::visual_hull
