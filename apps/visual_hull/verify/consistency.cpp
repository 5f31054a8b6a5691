// SPDX-License-Identifier: Apache-2.0
//
// Each view samples lines of sight, and every other view cuts each line into the parts that it sees in its silhouette.
// Sorted by depth, the ends of these parts are a sweep along the line that knows how many views reject the present
// point; sums over the numbers and the squares of the rejecting views tell which they are while they are one or two.
// Only the part of a line where at most two views may reject matters, so that the events elsewhere are counted and not
// sorted. The sums over all lines give R, D and U of each view (docs/how/visual_hull.md).
//
// Sets of views without a common point: the sets of views that see some point of a line are collected, and the smallest
// combinations that no such set contains are candidates.
#include "apps/visual_hull/verify/consistency.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <numeric>
#include <set>
#include <string>

#include "apps/visual_hull/verify/sight_lines.h"
#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

constexpr std::size_t kMostRays = 300;     // of a view; more change nothing
constexpr std::size_t kRaysInAll = 10000;  // where there are many views, each has fewer
constexpr std::size_t kFewestRays = 100;
constexpr double kGuiltyScore = 1.5;
constexpr double kGuiltyLead = 0.7;
constexpr double kFewestLines =
    4;  // of sight, that a guilty view blinds: up to three are what pixels do to clean views
constexpr std::size_t kFewViews = 5;

// What the lines of sight of one view tell about all views.
struct Tally {
  double residual = 0;           // R of the view
  std::vector<double> excluded;  // E: share of its lines that are residual, and hold a point that only v rejects
  std::vector<double> alone;     // volume that v alone rejects
  std::vector<double> in_pair;   // volume that v and exactly one other reject
  double common = 0;             // volume that no view rejects
};

// A place on a line where a view begins or ceases to see it in its silhouette.
struct SightEvent {
  double s = 0;
  std::uint32_t view = 0;
  std::int32_t rejecting = 0;  // views more than before: -1 or 1
};

// A line of sight.
struct SightLine {
  DepthInterval range;             // in the box
  std::vector<SightEvent> events;  // of one view after the other
  std::size_t seen = 0;            // by how many other views, anywhere
  // Where the last three of these begin to see it, the last one first, and where the first three see it no more.
  std::array<double, 3> begins{};
  std::array<double, 3> ends{};

  void start(const DepthInterval& in_box) {
    range = in_box;
    events.clear();
    seen = 0;
    begins.fill(-INFINITY);
    ends.fill(INFINITY);
  }

  /// `parts` are the ends of what the view sees.
  void add(std::uint32_t view, const std::vector<double>& parts) {
    if (parts.empty()) return;
    for (std::size_t k = 0; k < parts.size(); ++k) events.push_back({parts[k], view, k % 2 == 0 ? -1 : 1});
    ++seen;
    double begin = parts.front();
    double end = parts.back();
    for (std::size_t k = 0; k < 3; ++k) {
      const double later = std::max(begins[k], begin);
      begin = std::min(begins[k], begin);
      begins[k] = later;
      const double sooner = std::min(ends[k], end);
      end = std::max(ends[k], end);
      ends[k] = sooner;
    }
  }

  /// The part in which at most two of n - 1 other views may reject: n - 3 see something before and behind.
  [[nodiscard]] DepthInterval where_few_reject(std::size_t n) const {
    if (n <= 3) return range;
    if (seen + 3 < n) return {1, 0};
    return {begins[seen + 3 - n], ends[seen + 3 - n]};
  }
};

struct Lines {
  std::vector<SightView> views;
  Eigen::Vector3d low, high;

  Lines(const std::vector<ComparedView>& compared, const WorldBox& box) {
    views.reserve(compared.size());
    for (const ComparedView& view : compared) views.emplace_back(view);
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double a = nef::nearest_double(box.low[k]);
      const double b = nef::nearest_double(box.high[k]);
      low[i] = a - (b - a);
      high[i] = b + (b - a);
    }
  }

  [[nodiscard]] std::size_t rays() const {
    return std::clamp(kRaysInAll / std::max<std::size_t>(views.size(), 1), kFewestRays, kMostRays);
  }

  /// Calls visit(line) for every line of sight of view i.
  template <typename Visit>
  void each_line(std::size_t i, Visit&& visit) const {
    std::vector<SightPencil> pencils;
    pencils.reserve(views.size());
    for (const SightView& view : views) pencils.emplace_back(view, views[i].centre());
    SightLine line;
    std::vector<double> ends;
    for (const Eigen::Vector2d& p : views[i].sample(rays())) {
      const Eigen::Vector3d direction = views[i].ray(p);
      const DepthInterval range = in_box(views[i].centre(), direction, low, high);
      if (!(range.from < range.to)) continue;
      line.start(range);
      for (std::uint32_t j = 0; j < views.size(); ++j) {
        if (j == i) continue;
        pencils[j].cut(direction, range, ends);
        line.add(j, ends);
      }
      visit(line);
    }
  }
};

// By depth.
void sort_events(std::vector<SightEvent>& events) {
  std::sort(events.begin(), events.end(), [](const SightEvent& a, const SightEvent& b) { return a.s < b.s; });
}

// The views that reject a point: as long as they are one or two, sums over their numbers tell which.
struct Rejecting {
  std::int64_t count = 0;
  std::int64_t sum = 0;
  std::int64_t squares = 0;

  /// All of n views but one.
  static Rejecting all_but(std::size_t view, std::size_t n) {
    const auto v = static_cast<std::int64_t>(view);
    const auto m = static_cast<std::int64_t>(n);
    return {m - 1, m * (m - 1) / 2 - v, (m - 1) * m * (2 * m - 1) / 6 - v * v};
  }

  void happens(const SightEvent& e, std::int64_t weight) {
    const std::int64_t view = e.view;
    count += weight;
    sum += weight * view;
    squares += weight * view * view;
  }

  [[nodiscard]] std::size_t one() const { return static_cast<std::size_t>(sum); }

  /// v + w and v^2 + w^2 are known.
  [[nodiscard]] std::array<std::size_t, 2> two() const {
    const double difference = std::sqrt(static_cast<double>(2 * squares - sum * sum));
    const std::int64_t apart = std::lround(difference);
    return {static_cast<std::size_t>((sum - apart) / 2), static_cast<std::size_t>((sum + apart) / 2)};
  }
};

Tally tally_of(const Lines& lines, std::size_t i) {
  const std::size_t n = lines.views.size();
  Tally tally;
  tally.excluded.assign(n, 0);
  tally.alone.assign(n, 0);
  tally.in_pair.assign(n, 0);
  std::size_t count = 0;
  std::vector<bool> only(n);  // v is the only one to reject some point of the line
  lines.each_line(i, [&](SightLine& line) {
    ++count;
    const DepthInterval part_of_few = line.where_few_reject(n);
    if (part_of_few.from > part_of_few.to) {
      tally.residual += 1;
      return;
    }
    only.assign(n, false);
    Rejecting rejecting = Rejecting::all_but(i, n);
    bool covered = false;
    double at = n > 3 ? part_of_few.from : line.range.from;
    const auto pass = [&](double to) {
      if (to <= at) return;
      const double part = (to * to * to - at * at * at) / 3;
      if (rejecting.count == 0) {
        covered = true;
        tally.common += part;
      } else if (rejecting.count == 1) {
        only[rejecting.one()] = true;
        tally.alone[rejecting.one()] += part;
      } else if (rejecting.count == 2) {
        for (const std::size_t v : rejecting.two()) tally.in_pair[v] += part;
      }
      at = to;
    };
    // What comes before that part only counts, what comes behind it does not; without branches, as either is as likely.
    std::size_t kept = 0;
    for (const SightEvent e : line.events) {
      const bool before = e.s < part_of_few.from;
      rejecting.happens(e, before ? e.rejecting : 0);
      line.events[kept] = e;
      kept += !before && e.s <= part_of_few.to ? 1 : 0;
    }
    line.events.resize(kept);
    sort_events(line.events);
    for (const SightEvent& e : line.events) {
      pass(e.s);
      rejecting.happens(e, e.rejecting);
    }
    pass(line.range.to);
    if (covered) return;
    tally.residual += 1;
    for (std::size_t v = 0; v < n; ++v) tally.excluded[v] += only[v] ? 1 : 0;
  });
  const double total = std::max<double>(static_cast<double>(count), 1);
  const double volume = lines.views[i].solid_angle() / total;
  tally.residual /= total;
  for (double& e : tally.excluded) e /= total;
  for (double& v : tally.alone) v *= volume;
  for (double& v : tally.in_pair) v *= volume;
  tally.common *= volume;
  return tally;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

void score(std::vector<ViewConsistency>& views) {
  std::vector<double> falls;
  std::vector<double> relatives;
  for (const ViewConsistency& v : views) {
    falls.push_back(v.fall);
    relatives.push_back(v.relative);
  }
  const double fall = median(falls);
  const double relative = median(relatives);
  for (ViewConsistency& v : views) {
    v.score = std::log((v.fall + .002) / (fall + .002));
    if (views.size() > kFewViews) v.score += std::log((v.relative + .05) / (relative + .05));
  }
}

}  // namespace

std::vector<std::size_t> Consistency::ranked() const {
  std::vector<std::size_t> order(views.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [this](std::size_t a, std::size_t b) { return views[a].score > views[b].score; });
  return order;
}

double Consistency::share(std::size_t view) const {
  return residual > 0 ? std::min(1.0, views[view].fall / residual) : 0;
}

Consistency compare_views(const std::vector<ComparedView>& compared, const WorldBox& box, const nef::Monitor& monitor) {
  Consistency result;
  const std::size_t n = compared.size();
  result.views.resize(n);
  if (n < 3) return result;
  const Lines lines(compared, box);
  std::vector<Tally> tallies(n);
  nef::parallel_for(n, monitor, [&](std::size_t i, const nef::Monitor&) { tallies[i] = tally_of(lines, i); });
  double common = 0;
  for (const Tally& tally : tallies) common += tally.common / static_cast<double>(n);
  for (std::size_t v = 0; v < n; ++v) {
    ViewConsistency& view = result.views[v];
    view.residual = tallies[v].residual;
    view.fall = view.residual;
    double pairs = 0;
    for (const Tally& tally : tallies) {
      view.fall += tally.excluded[v];
      view.removed += tally.alone[v];
      pairs += tally.in_pair[v];
    }
    // Every other view has measured what v alone rejects, all but two what v and another one do.
    const auto others = static_cast<double>(n - 1);
    view.removed /= others;
    const double mean = pairs / (others * std::max(1.0, others - 1));
    view.relative = view.removed / std::max({mean, 1e-4 * common, 1e-300});
    result.residual += view.residual;
  }
  score(result.views);
  std::vector<std::size_t> order = result.ranked();
  order.erase(std::remove_if(order.begin(), order.end(), [&](std::size_t v) { return compared[v].cut_by_frame; }),
              order.end());
  if (order.size() < 2) return result;
  const double lead = result.views[order[0]].score - result.views[order[1]].score;
  const ViewConsistency& first = result.views[order[0]];
  const bool seen = first.fall * static_cast<double>(lines.rays()) >= kFewestLines;
  if (seen && first.score > kGuiltyScore && lead >= kGuiltyLead) result.guilty = order[0];
  return result;
}

std::vector<std::vector<std::size_t>> disjoint_views(const std::vector<ComparedView>& compared, const WorldBox& box,
                                                     std::size_t most, const nef::Monitor& monitor) {
  constexpr std::size_t kMostViews = 256;
  using Set = std::bitset<kMostViews>;
  const std::size_t n = compared.size();
  if (n < 2 || n > kMostViews) return {};
  const Lines lines(compared, box);
  // The sets of views that some point of a line is seen by.
  std::vector<std::set<std::string>> seen(n);
  nef::parallel_for(n, monitor, [&](std::size_t i, const nef::Monitor&) {
    lines.each_line(i, [&](SightLine& line) {
      Set accepting;
      accepting.set(i);
      sort_events(line.events);
      for (const SightEvent& e : line.events) {
        if (e.rejecting > 0) seen[i].insert(accepting.to_string());
        accepting.set(e.view, e.rejecting < 0);
      }
    });
  });
  std::vector<Set> sets;
  {
    std::set<std::string> all;
    for (const auto& part : seen) all.insert(part.begin(), part.end());
    for (const std::string& text : all) sets.emplace_back(text);
    std::sort(sets.begin(), sets.end(), [](const Set& a, const Set& b) { return a.count() > b.count(); });
    constexpr std::size_t kMostSets = 20000;
    if (sets.size() > kMostSets) sets.resize(kMostSets);
  }
  const auto meet = [&sets](const Set& wanted) {
    return std::any_of(sets.begin(), sets.end(), [&](const Set& s) { return (s & wanted) == wanted; });
  };
  for (std::size_t size = 2; size <= 4; ++size) {
    std::vector<std::vector<std::size_t>> found;
    std::vector<std::size_t> pick(size);
    std::iota(pick.begin(), pick.end(), std::size_t{0});
    while (pick.back() < n && found.size() < most) {
      Set wanted;
      for (const std::size_t v : pick) wanted.set(v);
      if (!meet(wanted)) found.push_back(pick);
      // The next combination in order.
      std::size_t k = size;
      while (k > 0 && pick[k - 1] == n - size + k - 1) --k;
      if (k == 0) break;
      ++pick[k - 1];
      for (std::size_t m = k; m < size; ++m) pick[m] = pick[m - 1] + 1;
    }
    if (!found.empty()) return found;
  }
  return {};
}

}  // namespace nef::visual_hull
