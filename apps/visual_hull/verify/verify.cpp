// SPDX-License-Identifier: Apache-2.0
//
// The measured part of the verification: areas by scan lines. The outline and each projected facet become intervals on
// the same horizontal lines; intervals are united on each line, and the area is the sum of their lengths times the
// distance of the lines. Whether the hull is inside is decided exactly, in verify_inside.cpp.
#include "apps/visual_hull/verify/verify.h"

#include <algorithm>
#include <cmath>

#include "apps/visual_hull/verify/verify_inside.h"
#include "nef/polyhedron.h"

namespace nef::visual_hull {
namespace {

using Vec = std::array<double, 2>;
using PixelInterval = std::array<double, 2>;

/// Sets of intervals on equidistant horizontal lines.
class ScanLines {
 public:
  ScanLines(double low, double high, double step)
      : low_(low), step_(step), lines_(static_cast<std::size_t>(std::ceil((high - low) / step)) + 1) {}

  // The inside (by parity) of a polygon with holes.
  void add(const std::vector<std::vector<Vec>>& cycles) {
    std::size_t first = lines_.size();
    std::size_t last = 0;
    for (const auto& cycle : cycles) {
      for (std::size_t i = 0; i < cycle.size(); ++i) cross(cycle[i], cycle[(i + 1) % cycle.size()], first, last);
    }
    for (std::size_t line = first; line <= last && line < lines_.size(); ++line) {
      auto& xs = crossings_[line];
      std::sort(xs.begin(), xs.end());
      for (std::size_t i = 0; i + 1 < xs.size(); i += 2) lines_[line].push_back({xs[i], xs[i + 1]});
      xs.clear();
    }
  }

  void unite() {
    for (auto& line : lines_) {
      std::sort(line.begin(), line.end());
      std::vector<PixelInterval> merged;
      for (const PixelInterval& i : line) {
        if (!merged.empty() && i[0] <= merged.back()[1]) {
          merged.back()[1] = std::max(merged.back()[1], i[1]);
        } else {
          merged.push_back(i);
        }
      }
      line = std::move(merged);
    }
  }

  double area() const {
    double sum = 0;
    for (const auto& line : lines_) {
      for (const PixelInterval& i : line) sum += i[1] - i[0];
    }
    return sum * step_;
  }

  double common_area(const ScanLines& other) const {
    double sum = 0;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      auto a = lines_[k].begin();
      auto b = other.lines_[k].begin();
      while (a != lines_[k].end() && b != other.lines_[k].end()) {
        sum += std::max(0.0, std::min((*a)[1], (*b)[1]) - std::max((*a)[0], (*b)[0]));
        (*a)[1] < (*b)[1] ? ++a : ++b;
      }
    }
    return sum * step_;
  }

 private:
  void cross(const Vec& p, const Vec& q, std::size_t& first, std::size_t& last) {
    if (crossings_.empty()) crossings_.resize(lines_.size());
    const Vec& a = p[1] < q[1] ? p : q;
    const Vec& b = p[1] < q[1] ? q : p;
    // Lines with a.y <= y < b.y; line k is at low + (k + 1/2) step.
    const double from = std::ceil((a[1] - low_) / step_ - 0.5);
    const double to = std::ceil((b[1] - low_) / step_ - 0.5);
    const double end = std::min(to, static_cast<double>(lines_.size()));
    for (double k = std::max(from, 0.0); k < end; ++k) {
      const double y = low_ + (k + 0.5) * step_;
      const auto line = static_cast<std::size_t>(k);
      crossings_[line].push_back(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
      first = std::min(first, line);
      last = std::max(last, line);
    }
  }

  double low_;
  double step_;
  std::vector<std::vector<PixelInterval>> lines_;
  std::vector<std::vector<double>> crossings_;
};

struct Extent {
  double low = INFINITY;
  double high = -INFINITY;
  void add(double y) {
    low = std::min(low, y);
    high = std::max(high, y);
  }
};

}  // namespace

std::vector<std::vector<std::vector<Vec>>> project_facets(const nef::Polyhedron& hull, const Camera& camera) {
  const nef::Complex& complex = hull.complex();
  std::array<std::array<double, 4>, 3> m{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) m[i][j] = nef::nearest_double(camera.matrix()[i][j]);
  }
  nef::IndexedVector<nef::VertexId, Vec> seen(complex.vertex_count());
  nef::IndexedVector<nef::VertexId, bool> front(complex.vertex_count());
  for (const nef::VertexId v : complex.vertex_ids()) {
    const auto& p = complex.points.approximate(nef::point_of(v));
    std::array<double, 3> x{};
    for (std::size_t i = 0; i < 3; ++i) x[i] = m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2] + m[i][3];
    const double scale =
        std::abs(m[2][0] * p[0]) + std::abs(m[2][1] * p[1]) + std::abs(m[2][2] * p[2]) + std::abs(m[2][3]);
    front[v] = x[2] > scale * 1e-12;
    if (front[v]) seen[v] = {x[0] / x[2], x[1] / x[2]};
  }
  std::vector<std::vector<std::vector<Vec>>> result;
  for (const nef::Facet& facet : complex.facets) {
    std::vector<std::vector<Vec>> cycles;
    bool visible = true;
    for (const nef::CycleId c : facet.cycles()) {
      cycles.emplace_back();
      for (const nef::SHalfedgeId corner : complex.corners_of(c)) {
        const nef::VertexId v = complex.shalfedge_vertex(corner);
        visible = visible && front[v];
        cycles.back().push_back(seen[v]);
      }
    }
    if (visible) result.push_back(std::move(cycles));
  }
  return result;
}

Verification verify_view(const nef::Polyhedron& hull, const Camera& camera, const Silhouette& silhouette,
                         int lines_per_pixel, const nef::Monitor& monitor) {
  Verification result;
  result.problem = why_outside(hull, camera, silhouette, monitor);
  result.inside = result.problem.empty();

  const auto facets = project_facets(hull, camera);
  Extent extent;
  std::vector<std::vector<Vec>> outline;
  for (const Ring& ring : silhouette.rings) {
    outline.emplace_back();
    for (const Point2& p : ring) {
      outline.back().push_back(p.approximate);
      extent.add(p.approximate[1]);
    }
  }
  for (const auto& facet : facets) {
    for (const auto& cycle : facet) {
      for (const Vec& p : cycle) extent.add(p[1]);
    }
  }
  if (!(extent.low < extent.high)) return result;
  // Image planes need not be in pixels (polygons in world units): at least a thousand lines.
  const double height = extent.high - extent.low;
  const double step = std::clamp(1.0 / lines_per_pixel, height / 20000, height / 1000);
  ScanLines wanted(extent.low, extent.high, step);
  wanted.add(outline);
  wanted.unite();
  ScanLines got(extent.low, extent.high, step);
  for (const auto& facet : facets) got.add(facet);
  got.unite();
  const double common = wanted.common_area(got);
  result.silhouette_area = wanted.area();
  result.difference_area = std::max(0.0, wanted.area() + got.area() - 2 * common);
  return result;
}

}  // namespace nef::visual_hull
