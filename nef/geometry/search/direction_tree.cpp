// SPDX-License-Identifier: Apache-2.0
//
// A face of the cube is seen through the pyramid |x_b|, |x_c| <= s x_a, where a is its axis and s its side, and a point
// in it at (x_b, x_c) / (s x_a). Coordinates are relative to the centre. Let m be the largest one of a polygon's
// corners, and e <= 2^-34 m a bound of their errors, the rounding of the differences included.
//
// Clipping by a plane computes the distances of two corners from it, off by 3 e + 2^-50 m, and a point between them
// that is off by e + 2^-50 m across the segment. How far it is off along the segment does not matter: what is cut off
// has distances below 4 e + 2^-48 m < 2^-31 m, and each plane is moved out by more than that. First the polygon is cut
// to the cube |x| <= 2^-11 m. If nothing is left, no point has all coordinates within 2^-12 m. So a point in a pyramid
// has s x_a > 2^-12 m, and its distances from the planes s x_a (1 + 2^-16) >= |x_b|, |x_c| are above 2^-28 m: it is
// not cut off. What is left has s x_a > 2^-13 m; its coordinates, after five cuts at most, are off by
// 5 (e + 2^-50 m) < 2^-31 m, and the quotients, which are below 1 + 2^-15, by 2^-17 at most. kSlack is twice that.
//
// A plane that no corner of the polygon lies beyond does not cut it; what the others leave is beyond it by 2^-31 m at
// most, so that quotients are below 1 + 2^-16 + 2^-18. A plane that all corners lie beyond has no point of the pyramid
// on their side, as above.
#include "nef/geometry/search/direction_tree.h"

#include <algorithm>
#include <cmath>

namespace nef {
namespace {

constexpr double kSlack = 0x1p-16;

// A convex polygon that is cut by half-spaces. Each adds a corner at most, to three; where rounding makes it more, and
// there is no room, it overflows.
struct Cut {
  std::array<Double3, 12> corners{};
  std::size_t count = 0;
  bool overflows = false;

  void push(const Double3& p) {
    if (count == corners.size()) {
      overflows = true;
    } else {
      corners[count++] = p;
    }
  }

  // Keeps where n.x + d >= 0. Most planes leave all of a polygon, or nothing.
  void by(const Double3& n, double d) {
    std::array<double, 12> at;
    std::size_t outside = 0;
    for (std::size_t i = 0; i < count; ++i) {
      at[i] = dot(n, corners[i]) + d;
      outside += at[i] < 0 ? 1 : 0;
    }
    if (outside == count) count = 0;
    if (outside == 0 || count == 0) return;
    Cut kept;
    kept.overflows = overflows;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t j = i + 1 == count ? 0 : i + 1;
      const Double3& p = corners[i];
      const Double3& q = corners[j];
      if (at[i] >= 0) kept.push(p);
      // The two ends of a segment are walked between twice.
      if ((at[i] < 0) == (at[j] < 0) || count == 1 || (count == 2 && i == 1)) continue;
      const double t = at[i] / (at[i] - at[j]);
      kept.push({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])});
    }
    *this = kept;
  }
};

bool near_centre(const Cut& whole, double size) {
  const double limit = 0x1p-11 * size;
  const std::span<const Double3> all = std::span(whole.corners).first(whole.count);
  // Most polygons lie beyond one side of the cube, and are not cut.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      if (std::all_of(all.begin(), all.end(), [&](const Double3& p) { return sign * p[axis] + limit < 0; }))
        return false;
    }
  }
  Cut cut = whole;
  for (std::size_t axis = 0; axis < 3 && cut.count > 0; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Double3 n{};
      n[axis] = sign;
      cut.by(n, limit);
    }
  }
  return cut.count > 0 || cut.overflows;
}

// Where points lie to the sides of a face's pyramid.
enum class Place { kInside, kAcross, kOutside };

Place place_of(std::span<const Double3> points, const Double3& n) {
  const auto outside = std::count_if(points.begin(), points.end(), [&](const Double3& p) { return dot(n, p) < 0; });
  return outside == 0 ? Place::kInside
                      : (static_cast<std::size_t>(outside) == points.size() ? Place::kOutside : Place::kAcross);
}

using Corner = std::array<double, 2>;

// A side of a polygon, and the range of the polygon across it, with slack: corners are off by half of kSlack;
// coordinates are at most 1 + 2^-15, so what is rounded here is 2^-49 of the side at most, much less than the other
// half.
struct Side {
  Corner normal{};
  double low = HUGE_VAL;
  double high = -HUGE_VAL;

  Side() = default;
  Side(std::span<const Corner> polygon, std::size_t i) {
    const Corner& p = polygon[i];
    const Corner& q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    normal = {p[1] - q[1], q[0] - p[0]};
    for (const Corner& corner : polygon) {
      low = std::min(low, at(corner));
      high = std::max(high, at(corner));
    }
    const double slack = 2 * kSlack * (std::fabs(normal[0]) + std::fabs(normal[1]));
    low -= slack;
    high += slack;
  }

  // True if a line along the side surely has the polygon and a box, or another polygon, on either side.
  [[nodiscard]] bool separates(const Box& box) const {
    double least = 0;
    double most = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const double n = normal[k];
      least += n * (n > 0 ? box.low[k] : box.high[k]);
      most += n * (n > 0 ? box.high[k] : box.low[k]);
    }
    return least > high || most < low;
  }
  [[nodiscard]] bool separates(std::span<const Corner> polygon) const {
    return std::all_of(polygon.begin(), polygon.end(), [&](const Corner& c) { return at(c) > high; }) ||
           std::all_of(polygon.begin(), polygon.end(), [&](const Corner& c) { return at(c) < low; });
  }

 private:
  [[nodiscard]] double at(const Corner& c) const { return normal[0] * c[0] + normal[1] * c[1]; }
};

}  // namespace

std::optional<DirectionTree::Seen> DirectionTree::seen(std::span<const Double3> polygon) const {
  Cut whole;
  double size = 0;
  double largest = 0;
  for (const Double3& p : polygon) {
    whole.push(minus(p, centre_));
    for (std::size_t i = 0; i < 3; ++i) {
      size = std::max(size, std::fabs(whole.corners[whole.count - 1][i]));
      largest = std::max({largest, std::fabs(p[i]), std::fabs(centre_[i])});
    }
  }
  const double error = 2 * margin_ + 0x1p-48 * largest;
  // Far or huge polygons, whose products may leave the range of doubles, are not told apart.
  if (!(error <= 0x1p-34 * size) || size < 1e-100 || size > 1e100 || near_centre(whole, size)) return std::nullopt;
  Seen seen;
  for (std::size_t face = 0; face < 6; ++face) {
    const std::size_t a = face / 2;
    const std::size_t b = (a + 1) % 3;
    const std::size_t c = (a + 2) % 3;
    const double s = face % 2 == 0 ? 1.0 : -1.0;
    // Behind the centre, where no point of the pyramid is near.
    const std::span<const Double3> all = std::span(whole.corners).first(whole.count);
    if (std::all_of(all.begin(), all.end(), [&](const Double3& p) { return s * p[a] < 0; })) continue;
    std::array<Double3, 4> sides{};
    for (std::size_t i = 0; i < sides.size(); ++i) {
      sides[i][a] = s * (1 + 0x1p-16);
      sides[i][i < 2 ? b : c] = i % 2 == 0 ? 1.0 : -1.0;
    }
    // Of six pyramids a small polygon is in one, mostly, and is not cut.
    std::array<Place, 4> places{};
    for (std::size_t i = 0; i < sides.size(); ++i) places[i] = place_of(all, sides[i]);
    if (std::find(places.begin(), places.end(), Place::kOutside) != places.end()) continue;
    Cut cut = whole;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (places[i] == Place::kAcross) cut.by(sides[i], 0);
    }
    if (cut.overflows) return std::nullopt;
    for (std::size_t i = 0; i < cut.count; ++i) {
      const Double3& p = cut.corners[i];
      seen[face].add({p[b] / (s * p[a]), p[c] / (s * p[a])});
    }
  }
  return seen;
}

void DirectionTree::Shape::add(const std::array<double, 2>& corner) {
  corners[count++] = corner;
  for (std::size_t k = 0; k < 2; ++k) {
    box.low[k] = std::min(box.low[k], corner[k] - kSlack);
    box.high[k] = std::max(box.high[k], corner[k] + kSlack);
  }
  box.low[2] = box.high[2] = 0;
}

bool DirectionTree::add(std::uint32_t item, std::span<const Double3> polygon) {
  const std::optional<Seen> seen = this->seen(polygon);
  if (!seen) return false;
  for (std::size_t i = 0; i < 6; ++i) {
    const Shape& shape = (*seen)[i];
    Face& face = faces_[i];
    if (shape.count == 0) continue;
    face.boxes.push_back(shape.box);
    face.item_of.push_back(item);
    face.corners.insert(face.corners.end(), shape.polygon().begin(), shape.polygon().end());
    face.corner_begin.push_back(static_cast<std::uint32_t>(face.corners.size()));
  }
  return true;
}

void DirectionTree::build() {
  for (Face& face : faces_) face.tree = BoxTree(face.boxes, BoxSplit::kMedians);
}

bool DirectionTree::find(std::span<const Double3> polygon, std::vector<std::uint32_t>& items) const {
  const std::optional<Seen> seen = this->seen(polygon);
  if (!seen) return false;
  for (std::size_t k = 0; k < 6; ++k) {
    const Shape& shape = (*seen)[k];
    const Face& face = faces_[k];
    if (shape.count == 0) continue;
    const std::span<const Corner> corners = shape.polygon();
    std::array<Side, 12> room;
    const std::span<Side> sides = std::span(room).first(corners.size());
    for (std::size_t i = 0; i < sides.size(); ++i) sides[i] = Side(corners, i);
    const auto separate = [&](const auto& other) {
      return std::any_of(sides.begin(), sides.end(), [&](const Side& side) { return side.separates(other); });
    };
    const auto meets = [&](const Box& box) { return shape.box.overlaps(box) && !separate(box); };
    face.tree.for_each_if(meets, [&](std::uint32_t i) {
      const std::span<const Corner> other =
          std::span(face.corners).subspan(face.corner_begin[i], face.corner_begin[i + 1] - face.corner_begin[i]);
      if (separate(other)) return;
      for (std::size_t side = 0; side < other.size(); ++side) {
        if (Side(other, side).separates(corners)) return;
      }
      items.push_back(face.item_of[i]);
    });
  }
  return true;
}

}  // namespace nef
