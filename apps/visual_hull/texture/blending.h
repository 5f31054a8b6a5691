// SPDX-License-Identifier: Apache-2.0
//
// Colours that do not depend on the direction of view: each chart keeps the detail of its own photograph, and takes
// what is smooth from all that see it.
#pragma once

#include "apps/visual_hull/texture/charts.h"
#include "apps/visual_hull/texture/sampling.h"
#include "apps/visual_hull/texture/texels.h"

namespace nef::visual_hull {

/// Adds to the colours of each chart the smoothed difference between the means and them, so that lamps, highlights and
/// exposures of one photograph are averaged away while its detail stays sharp: blending in two bands, as by Baumberg
/// 2002. The width of the smoothing (about a Gaussian) is a hundredth of the square root of the surface in texels, so
/// it does not depend on the resolution. Charts in parallel; O(texels).
void blend_views(const Atlas& atlas, const MeanColors& means, Texels& texels, const nef::Monitor& monitor);

}  // namespace nef::visual_hull
