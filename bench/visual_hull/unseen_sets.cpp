// SPDX-License-Identifier: Apache-2.0
#include "bench/visual_hull/unseen_sets.h"

#include <algorithm>

namespace nef::visual_hull::bench {
namespace {

constexpr long kPrice = 10;  // right verdicts that a wrong one outweighs

/// A verdict is given above these.
struct Thresholds {
  double score = 0, lead = 0;

  [[nodiscard]] bool accuse(const TopView& view) const { return view.seen && view.score > score && view.lead >= lead; }
};

std::vector<Thresholds> grid() {
  std::vector<Thresholds> result;
  for (int s = 5; s <= 30; ++s) {
    for (int l = 0; l <= 15; ++l) result.push_back({0.1 * s, 0.1 * l});
  }
  return result;
}

// The middle one of the best; all sets but one count.
Thresholds chosen(const std::vector<TopView>& views, std::size_t left_out) {
  std::vector<Thresholds> best;
  long most = 0;
  for (const Thresholds& thresholds : grid()) {
    long worth = 0;
    for (const TopView& view : views) {
      if (view.set == left_out || !thresholds.accuse(view)) continue;
      worth += view.damaged && view.right ? 1 : -kPrice;
    }
    if (best.empty() || worth > most) {
      best.clear();
      most = worth;
    }
    if (worth == most) best.push_back(thresholds);
  }
  return best[best.size() / 2];
}

}  // namespace

UnseenRates leave_one_out(const std::vector<TopView>& views, std::size_t sets) {
  UnseenRates rates;
  const Thresholds of_all = chosen(views, sets);
  rates.score = of_all.score;
  rates.lead = of_all.lead;
  for (std::size_t set = 0; set < sets; ++set) {
    const Thresholds thresholds = chosen(views, set);
    rates.least_score = set == 0 ? thresholds.score : std::min(rates.least_score, thresholds.score);
    rates.most_score = std::max(rates.most_score, thresholds.score);
    rates.least_lead = set == 0 ? thresholds.lead : std::min(rates.least_lead, thresholds.lead);
    rates.most_lead = std::max(rates.most_lead, thresholds.lead);
    for (const TopView& view : views) {
      if (view.set != set) continue;
      ++(view.damaged ? rates.damaged : rates.clean);
      if (!thresholds.accuse(view)) continue;
      if (!view.damaged) {
        ++rates.alarms;
      } else {
        ++(view.right ? rates.right : rates.wrong);
      }
    }
  }
  return rates;
}

}  // namespace nef::visual_hull::bench
