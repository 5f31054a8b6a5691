// SPDX-License-Identifier: Apache-2.0
//
// What thresholds of verdicts reach on sets that they were not chosen by: leaving one set out.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace nef::visual_hull::bench {

/// The view with the highest score of one comparison, and what a verdict about it would be.
struct TopView {
  std::size_t set = 0;
  bool damaged = false;  ///< one view of the set is; otherwise an accusation is a false alarm
  bool right = false;    ///< it is this one
  bool seen = false;     ///< by lines of sight enough for a verdict
  double score = 0;
  double lead = 0;  ///< over the second highest score
};

/// Verdicts by thresholds that were chosen for the other sets.
struct UnseenRates {
  std::size_t damaged = 0, right = 0, wrong = 0;  ///< comparisons with a damaged view, and verdicts on them
  std::size_t clean = 0, alarms = 0;              ///< the same without
  double least_score = 0, most_score = 0;         ///< thresholds that were chosen, over all sets that were left out
  double least_lead = 0, most_lead = 0;
  double score = 0, lead = 0;  ///< those that all sets together choose
};

/// For each set, thresholds of score and lead are chosen from a grid by all other sets: those with the most right
/// verdicts, less ten for each wrong one and each false alarm; of equals the middle ones. Then the set is judged by
/// them.
UnseenRates leave_one_out(const std::vector<TopView>& views, std::size_t sets);

}  // namespace nef::visual_hull::bench
