// SPDX-License-Identifier: Apache-2.0
//
// The lists are copied behind each other. Equal corners are found by hashes, in shares for several threads; then points
// and planes are made in ranges, each with tables of its own, which are put together in order. Facets that are left out
// get no planes.
#include "apps/minkowski/convolution/facets/numbered_facets.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nef/base/threads/first_equal.h"
#include "nef/base/threads/parallel.h"
#include "nef/geometry/plane_finder.h"

namespace nef::minkowski {
namespace {

// Indices that a thread takes at a time.
constexpr std::size_t kRange = 4096;

std::size_t ranges_of(std::size_t count) { return (count + kRange - 1) / kRange; }

}  // namespace

class FacetNumbering {
 public:
  FacetNumbering(const SolidFeatures& a, const SolidFeatures& b, BoundaryMarks marks, const Monitor& monitor)
      : a_(a), b_(b), monitor_(monitor) {
    result_.marks = marks;
  }

  ConvolutionFacets run(std::vector<FacetList>&& lists) {
    join(std::move(lists));
    const Monitor own = for_vertices(corners_.size(), monitor_);
    parallel_calls(
        own, {[&](const Monitor& threads) { make_points(threads); }, [&](const Monitor& threads) { cover(threads); }});
    drop_covered(own);
    find_planes(own);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool mixed() const { return result_.marks == BoundaryMarks::kMixed; }

  // Where the facets of a list go.
  struct Place {
    std::size_t facets = 0, corners = 0, points = 0;
  };

  void join(std::vector<FacetList>&& lists) {
    std::vector<Place> places(lists.size() + 1);
    for (std::size_t i = 0; i < lists.size(); ++i) {
      places[i + 1] = {places[i].facets + lists[i].ends_.size(), places[i].corners + lists[i].corners_.size(),
                       places[i].points + lists[i].points_.size()};
    }
    const Place& all = places.back();
    corners_.resize(all.corners);
    normals_.resize(all.facets);
    points_.resize(all.points);
    result_.begin.resize(all.facets + 1);
    if (mixed()) {
      result_.inside_marks.resize(all.facets);
      result_.corner_marks.resize(all.corners);
      result_.side_marks.resize(all.corners);
    }
    parallel_for(lists.size(), for_vertices(all.corners, monitor_), [&](std::size_t i, const Monitor&) {
      copy(lists[i], places[i]);
      lists[i] = FacetList();
    });
  }

  void copy(const FacetList& list, const Place& to) {
    for (std::size_t k = 0; k < list.corners_.size(); ++k) {
      const std::uint64_t corner = list.corners_[k];
      corners_[to.corners + k] = is_point(corner) ? corner + to.points : corner;
    }
    for (std::size_t k = 0; k < list.ends_.size(); ++k) {
      result_.begin[to.facets + k + 1] = static_cast<std::uint32_t>(to.corners + list.ends_[k]);
    }
    std::copy(list.normals_.begin(), list.normals_.end(), normals_.begin() + static_cast<std::ptrdiff_t>(to.facets));
    std::copy(list.points_.begin(), list.points_.end(), points_.begin() + static_cast<std::ptrdiff_t>(to.points));
    const auto copy_marks = [](const std::vector<std::uint8_t>& from, std::vector<std::uint8_t>& all, std::size_t at) {
      std::copy(from.begin(), from.end(), all.begin() + static_cast<std::ptrdiff_t>(at));
    };
    if (!mixed()) return;  // there are none, and no place to put them
    copy_marks(list.inside_marks_, result_.inside_marks, to.facets);
    copy_marks(list.corner_marks_, result_.corner_marks, to.corners);
    copy_marks(list.side_marks_, result_.side_marks, to.corners);
  }

  static bool is_point(std::uint64_t corner) { return corner >> 32U == FacetList::kNoVertex; }

  [[nodiscard]] Rational3 point_of(std::uint64_t corner) const {
    const auto second = static_cast<std::uint32_t>(corner);
    return is_point(corner) ? points_[second] : plus(a_.points()[corner >> 32U], b_.points()[second]);
  }

  void make_points(const Monitor& monitor) {
    FirstNumbers corners = numbers_by_first(first_equal(
        corners_.size(), monitor, [&](std::size_t i) { return mixed_bits(corners_[i]); },
        [&](std::uint32_t i, std::uint32_t k) { return corners_[i] == corners_[k]; }));
    const std::size_t count = corners.first.size();
    result_.rounded.resize(count);
    std::vector<PointTable> tables(ranges_of(count));
    parallel_for_ranges(count, kRange, monitor, [&](std::size_t from, std::size_t to, const Monitor&) {
      PointTable& table = tables[from / kRange];
      for (std::size_t i = from; i < to; ++i) {
        const Rational3 point = point_of(corners_[corners.first[i]]);
        table.push(point);
        result_.rounded[i] = nearest_doubles(point);
      }
    });
    for (PointTable& table : tables) {
      result_.points.append(table, 0, table.size());
      table = PointTable();
    }
    result_.corners = std::move(corners.number);
    corners_ = {};
    points_ = {};
  }

  // Few facets are not worth a grid.
  void cover(const Monitor& monitor) {
    constexpr std::size_t kFew = 500;
    if (normals_.size() < kFew) return;
    const auto cells = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(normals_.size())));
    result_.covered = CoveredVoxels(a_, b_, std::min(cells, 128U), monitor);
  }

  [[nodiscard]] std::vector<std::uint8_t> covered_facets(const Monitor& monitor) const {
    constexpr std::size_t kAtOnce = 1024;
    std::vector<std::uint8_t> result(normals_.size(), 0);
    parallel_for_ranges(result.size(), kAtOnce, monitor, [&](std::size_t from, std::size_t to, const Monitor&) {
      std::vector<Double3> polygon;
      for (std::size_t f = from; f < to; ++f) {
        polygon.clear();
        for (std::uint32_t c = result_.begin[f]; c < result_.begin[f + 1]; ++c) {
          polygon.push_back(result_.rounded[result_.corners[c]]);
        }
        result[f] = result_.covered.cover(polygon) ? 1 : 0;
      }
    });
    return result;
  }

  // Facets that lie inside of the sum as far as the grid tells.
  void drop_covered(const Monitor& monitor) {
    const std::vector<std::uint8_t> is_covered = covered_facets(monitor);
    std::uint32_t kept = 0;
    std::uint32_t end = 0;  // of the corners that are kept
    for (std::uint32_t f = 0; f < normals_.size(); ++f) {
      const std::uint32_t first = result_.begin[f];
      const std::uint32_t last = result_.begin[f + 1];
      result_.begin[kept] = end;
      if (is_covered[f] != 0) continue;
      normals_[kept] = normals_[f];
      if (mixed()) result_.inside_marks[kept] = result_.inside_marks[f];
      for (std::uint32_t c = first; c < last; ++c, ++end) {
        result_.corners[end] = result_.corners[c];
        if (!mixed()) continue;
        result_.corner_marks[end] = result_.corner_marks[c];
        result_.side_marks[end] = result_.side_marks[c];
      }
      ++kept;
    }
    result_.begin[kept] = end;
    result_.begin.resize(kept + 1);
    result_.corners.resize(end);
    normals_.resize(kept);
    if (!mixed()) return;
    result_.inside_marks.resize(kept);
    result_.corner_marks.resize(end);
    result_.side_marks.resize(end);
  }

  [[nodiscard]] Integer3 integers_of(const FacetList::Normal& normal) const {
    using Kind = FacetList::Normal::Kind;
    if (normal.kind == Kind::kFacetOfA) return a_.normal(normal.plane).integers();
    if (normal.kind == Kind::kFacetOfB) return b_.normal(normal.plane).integers();
    const Integer3 of_a = a_.lines().integers(normal.a);
    const Integer3 of_b = b_.lines().integers(normal.b);
    return normal.kind == Kind::kLines ? cross(of_a, of_b) : cross(of_b, of_a);
  }

  void find_planes(const Monitor& monitor) {
    result_.plane.resize(normals_.size());
    std::vector<PlaneTable> tables(ranges_of(normals_.size()));
    parallel_for_ranges(normals_.size(), kRange, monitor, [&](std::size_t from, std::size_t to, const Monitor&) {
      PlaneTable& table = tables[from / kRange];
      table.merge_later();
      PlaneFinder finder;
      for (std::size_t f = from; f < to; ++f) {
        const PointId corner{result_.corners[result_.begin[f]]};
        const PlaneId plane = finder.through(table, result_.points, integers_of(normals_[f]), corner);
        result_.plane[f] = plane.in_row(plane.row() + static_cast<std::uint32_t>(from));  // a row each
      }
    });
    normals_ = {};
    result_.planes.merge_later();
    for (PlaneTable& table : tables) {
      result_.planes.append_new(table, 0, table.size());
      table = PlaneTable();
    }
    const std::vector<std::uint32_t> rows = result_.planes.merge_equal();
    if (rows.empty()) return;
    for (PlaneId& plane : result_.plane) plane = plane.in_row(rows[plane.row()]);
  }

  const SolidFeatures& a_;
  const SolidFeatures& b_;
  Monitor monitor_;
  std::vector<std::uint64_t> corners_;  // as FacetList has them
  std::vector<Rational3> points_;       // those that are no sums of vertices
  std::vector<FacetList::Normal> normals_;
  ConvolutionFacets result_;
};

ConvolutionFacets numbered_facets(const SolidFeatures& a, const SolidFeatures& b, BoundaryMarks marks,
                                  std::vector<FacetList>&& lists, const Monitor& monitor) {
  return FacetNumbering(a, b, marks, monitor).run(std::move(lists));
}

}  // namespace nef::minkowski
