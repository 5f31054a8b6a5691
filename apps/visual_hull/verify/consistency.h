// SPDX-License-Identifier: Apache-2.0
//
// Which view disagrees with the others. Statistics from rays, in doubles; no set depends on them.
#pragma once

#include <optional>
#include <vector>

#include "apps/visual_hull/cones/cone.h"

namespace nef::visual_hull {

/// One view to compare. Refers to its parts.
struct ComparedView {
  const Camera* camera = nullptr;
  const Silhouette* silhouette = nullptr;
  bool cut_by_frame = false;  ///< it may disagree because of what its image does not show, so it is not accused
};

/// What is known about one view. A point is rejected by the views that do not see it in their silhouettes.
struct ViewConsistency {
  double residual = 0;  ///< R: share of the silhouette whose lines of sight meet no point of the hull
  double fall = 0;      ///< D: by how much the residuals of all views together would fall without this one
  double removed = 0;   ///< U: volume that this view alone rejects
  double relative = 0;  ///< d: U over the mean volume that this view and exactly one other reject
  double score = 0;     ///< S: the logarithms of D and of d over their medians, added
};

struct Consistency {
  std::vector<ViewConsistency> views;
  double residual = 0;                ///< the sum of all R
  std::optional<std::size_t> guilty;  ///< the view that disagrees with the others, where the numbers are clear

  /// The views with the highest scores, best first.
  [[nodiscard]] std::vector<std::size_t> ranked() const;
  /// The share of the inconsistency that leaving out a view removes.
  [[nodiscard]] double share(std::size_t view) const;
};

/// Compares views by up to 300 lines of sight a view, spread evenly over its silhouette, each cut by all other
/// silhouettes in their images. The residual accuses the innocent (a mask that lost a part leaves residuals in all
/// *other* views); D and d do not: see docs/how/visual_hull.md. A view is guilty if its score exceeds 1.5 and the
/// second one by 0.7, and D comes from four lines of sight or more; with up to five views the score is that of D alone.
/// Views that the frame cuts are compared, and neither accused nor among those that the score has to exceed. `box`
/// bounds the part of space that is looked at (grown to thrice its size). O(views^2 (rays + vertices of a silhouette)).
Consistency compare_views(const std::vector<ComparedView>& views, const WorldBox& box, const nef::Monitor& monitor);

/// Smallest sets of at most four views that have no point in common as far as the lines of sight tell: what remains is
/// to confirm them exactly. At most `most` sets, all of the least size that there is; none if every four views meet.
std::vector<std::vector<std::size_t>> disjoint_views(const std::vector<ComparedView>& views, const WorldBox& box,
                                                     std::size_t most, const nef::Monitor& monitor);

}  // namespace nef::visual_hull
