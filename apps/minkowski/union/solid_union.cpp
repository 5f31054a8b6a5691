// SPDX-License-Identifier: Apache-2.0
//
// A vertex of the union is a vertex of a cell, or where an edge of one meets a face of another, or
// where faces of three cells meet. All of the latter lie on segments: edges of cells and meetings of two
// faces. Along a segment each cell has an interval inside; what no such interval covers is left, and
// only there points are made. Here, all that is done in doubles: intervals surely inside cover, faces that
// may cut are cut with. Points that come from this are candidates; UnionVertices decides exactly.
#include "apps/minkowski/union/solid_union.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "apps/minkowski/union/face_remains.h"
#include "apps/minkowski/union/union_vertices.h"
#include "nef/base/error.h"
#include "nef/base/parallel.h"

namespace nef::minkowski {
namespace {

struct Interval {
  double low = 0, high = 1;
};

// A segment whose true ends are within `error` of these. Faces f and g hold it.
struct Segment {
  Vector from{}, to{};
  Box box;  // around it
  double error = 0;
  std::uint32_t f = 0, g = 0;
  std::uint32_t from_point = kNone, to_point = kNone;  // where it ends, if that is a candidate already
  std::vector<Interval> open;                          // what is not surely covered

  void set_box() {
    for (std::size_t i = 0; i < 3; ++i) {
      box.low[i] = std::min(from[i], to[i]) - error;
      box.high[i] = std::max(from[i], to[i]) + error;
    }
  }
};

// A box around a part of a segment.
Box box_of_part(const Segment& s, const Interval& part) {
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    const double slope = s.to[i] - s.from[i];
    const double a = s.from[i] + part.low * slope;
    const double b = s.from[i] + part.high * slope;
    // Sums and products here are off by a few units of roundoff of the largest of these.
    const double slack = s.error + 8 * kUnit * (std::fabs(s.from[i]) + std::fabs(s.to[i]));
    box.low[i] = std::min(a, b) - slack;
    box.high[i] = std::max(a, b) + slack;
  }
  return box;
}

// Where a face's plane is on a segment: value(t) = at + t * slope, each within `error`.
struct Cut {
  double at = 0, slope = 0, error = 0;
  Cut(const RoundedFace& face, const Segment& s) {
    at = face.value(s.from);
    slope = face.value(s.to) - at;
    error = 2 * (face.slack + face.weight * s.error);
  }
};

// The part of [0, 1] where at + t * slope < bound (a little less if `strict`, a little more if not).
void clip(Interval& t, double at, double slope, double bound, bool strict) {
  constexpr double kRounding = 1e-13;
  const double margin = strict ? kRounding : -kRounding;
  if (slope > 0) {
    t.high = std::min(t.high, (bound - at) / slope - margin);
  } else if (slope < 0) {
    t.low = std::max(t.low, (bound - at) / slope + margin);
  } else if (!(at < bound)) {
    t.high = -1;
  }
}

class SolidUnion {
 public:
  SolidUnion(std::span<const ConvexCell> cells, const RoundedCells& rounded)
      : cells_(cells), rounded_(rounded), boxes_(rounded.boxes()), vertices_(cells, rounded, boxes_) {}

  Polyhedron run(std::size_t* dropped, unsigned threads, const std::function<void()>& poll) {
    find_faces(dropped, threads);
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      if (poll) poll();
      search(i);
    }
    return Polyhedron(vertices_.finish());
  }

 private:
  struct Rest {
    std::uint32_t face;
    Box box;
  };

  // Faces that are not inside of other cells.
  void find_faces(std::size_t* dropped, unsigned threads) {
    std::vector<std::vector<Rest>> rest(cells_.size());
    constexpr std::size_t kChunk = 64;
    const FaceRemains prototype(rounded_);
    parallel_for((cells_.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
      FaceRemains remains(prototype);
      const std::size_t end = std::min(cells_.size(), (chunk + 1) * kChunk);
      for (std::size_t cell = chunk * kChunk; cell < end; ++cell) {
        rest[cell] = rest_of(static_cast<std::uint32_t>(cell), remains);
      }
    });
    left_.assign(rounded_.face_count(), 0);
    for (const std::vector<Rest>& faces : rest) {
      if (faces.empty() && dropped != nullptr) ++*dropped;
      for (const Rest& r : faces) {
        left_[r.face] = 1;
        faces_.push_back(r.face);
        face_boxes_.push_back(r.box);
      }
    }
    tree_ = BoxTree(face_boxes_);
  }

  std::vector<Rest> rest_of(std::uint32_t cell, FaceRemains& remains) const {
    std::vector<std::uint32_t> neighbours;
    boxes_.for_each_overlap(rounded_.box(cell), [&](std::uint32_t other) {
      if (other != cell) neighbours.push_back(other);
    });
    std::vector<Rest> result;
    std::vector<Vector> ring;
    for (std::uint32_t f = rounded_.first_face(cell); f < rounded_.end_face(cell); ++f) {
      ring.clear();
      for (const std::uint32_t v : corners(f)) ring.push_back(corner(f, v));
      const Box box = remains.box_of_rest(ring, neighbours);
      if (box.low[0] <= box.high[0]) result.push_back({f, box});
    }
    return result;
  }

  [[nodiscard]] std::span<const std::uint32_t> corners(std::uint32_t face) const {
    const std::uint32_t cell = rounded_.cell_of_face(face);
    return cells_[cell].mesh.face(face - rounded_.first_face(cell));
  }
  [[nodiscard]] const Vector& corner(std::uint32_t face, std::uint32_t vertex) const {
    return rounded_.vertices(rounded_.cell_of_face(face))[vertex];
  }

  void search(std::uint32_t i) {
    const std::uint32_t f = faces_[i];
    const std::uint32_t own = rounded_.cell_of_face(f);
    find_neighbours(f, face_boxes_[i]);
    const auto ring = corners(f);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      search_edge(f, face_boxes_[i], ring[k], ring[(k + 1) % ring.size()]);
    }
    tree_.for_each_overlap(face_boxes_[i], [&](std::uint32_t j) {
      if (j > i && rounded_.cell_of_face(faces_[j]) != own) search_meeting(i, j);
    });
  }

  // The cells that may have a part of the face inside or touch it.
  void find_neighbours(std::uint32_t face, const Box& box) {
    neighbours_.clear();
    const std::uint32_t own = rounded_.cell_of_face(face);
    const auto ring = corners(face);
    boxes_.for_each_overlap(box, [&](std::uint32_t cell) {
      if (cell == own) return;
      for (std::uint32_t h = rounded_.first_face(cell); h < rounded_.end_face(cell); ++h) {
        const RoundedFace& plane = rounded_.face(h);
        if (std::all_of(ring.begin(), ring.end(),
                        [&](std::uint32_t v) { return plane.value(corner(face, v)) > plane.slack; })) {
          return;
        }
      }
      neighbours_.push_back(cell);
    });
  }

  // The face of the same cell on the other side of an edge.
  [[nodiscard]] std::uint32_t face_beyond(std::uint32_t face, std::uint32_t from, std::uint32_t to) const {
    const std::uint32_t cell = rounded_.cell_of_face(face);
    for (std::uint32_t g = rounded_.first_face(cell); g < rounded_.end_face(cell); ++g) {
      const auto ring = corners(g);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        if (ring[k] == to && ring[(k + 1) % ring.size()] == from) return g;
      }
    }
    throw Error("an edge of a convex cell has one face only");
  }

  void search_edge(std::uint32_t face, const Box& box, std::uint32_t from, std::uint32_t to) {
    const std::uint32_t beyond = face_beyond(face, from, to);
    // Each edge once; not at all if a face of it is inside of a cell.
    if (left_[beyond] == 0 || beyond < face) return;
    Segment& s = segment_;
    s.from = corner(face, from);
    s.to = corner(face, to);
    s.error = 4 * kUnit * rounded_.extent();
    s.f = face;
    s.g = beyond;
    Interval whole{0, 1};
    s.set_box();
    if (!clip_to_box(s, box, whole) || covered(s, whole)) return;
    const std::uint32_t cell = rounded_.cell_of_face(face);
    s.from_point = s.open.front().low <= 0 ? vertices_.add_vertex(cell, from) : kNone;
    s.to_point = s.open.back().high >= 1 ? vertices_.add_vertex(cell, to) : kNone;
    cut(s, cell, cell);
  }

  // Where two faces of different cells cross in their insides, the meeting is a segment that no edge holds.
  void search_meeting(std::uint32_t i, std::uint32_t j) {
    const std::uint32_t f = faces_[i];
    const std::uint32_t g = faces_[j];
    Chord on_f;
    Chord on_g;
    if (!chord(f, g, on_f) || !chord(g, f, on_g)) return;
    Segment& s = segment_;
    s.f = f;
    s.g = g;
    s.from_point = s.to_point = kNone;
    s.from = on_f.point[0];
    s.to = on_f.point[1];
    s.error = on_f.error;
    s.set_box();
    Interval whole;
    if (!overlap(on_f, on_g, whole) || !clip_to_box(s, face_boxes_[i], whole) ||
        !clip_to_box(s, face_boxes_[j], whole) || covered(s, whole)) {
      return;
    }
    cut(s, rounded_.cell_of_face(f), rounded_.cell_of_face(g));
  }

  // The cut of a face with another one's plane, if that is a segment through the face's inside.
  struct Chord {
    std::array<Vector, 2> point{};
    double error = 0;
  };
  bool chord(std::uint32_t face, std::uint32_t other, Chord& result) {
    const std::uint32_t cell = rounded_.cell_of_face(face);
    const auto ring = corners(face);
    const RoundedFace& plane = rounded_.face(other);
    sides_.clear();
    values_.clear();
    bool above = false;
    bool below = false;
    bool doubtful = false;
    for (const std::uint32_t v : ring) {
      const double value = plane.value(corner(face, v));
      values_.push_back(value);
      const int side = value > plane.slack ? 1 : value < -plane.slack ? -1 : 0;
      sides_.push_back(side);
      above = above || side > 0;
      below = below || side < 0;
      doubtful = doubtful || side == 0;
    }
    if (!doubtful && !(above && below)) return false;
    if (doubtful) {
      if (vertices_.exact().plane(face).row() == vertices_.exact().plane(other).row()) return false;
      for (std::size_t k = 0; k < ring.size(); ++k) {
        if (sides_[k] == 0) sides_[k] = vertices_.exact().side(other, cell, ring[k]);
        above = above || sides_[k] > 0;
        below = below || sides_[k] < 0;
      }
      // Otherwise the plane meets the face in an edge or a vertex of it at most.
      if (!(above && below)) return false;
    }
    std::size_t count = 0;
    result.error = 0;
    for (std::size_t k = 0; k < ring.size() && count < 2; ++k) {
      const std::size_t next = (k + 1) % ring.size();
      if (sides_[k] == 0) {
        result.point[count++] = corner(face, ring[k]);
        result.error = std::max(result.error, 4 * kUnit * rounded_.extent());
      } else if (sides_[k] * sides_[next] < 0) {
        cross(corner(face, ring[k]), corner(face, ring[next]), values_[k], values_[next], plane.slack,
              result.point[count++], result.error);
      }
    }
    NEF_ASSERT(count == 2);
    return true;
  }

  // A point of the edge pq where a form is zero that has values a, b of opposite signs at its ends.
  void cross(const Vector& p, const Vector& q, double a, double b, double slack, Vector& point, double& error) const {
    const double span = std::fabs(a - b);
    double share = 0.5;
    double doubt = 0.5;
    if (span > 16 * slack) {
      share = std::clamp(a / (a - b), 0.0, 1.0);
      doubt = 4 * slack / span + 4 * kUnit;
    }
    double length = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      point[i] = p[i] + share * (q[i] - p[i]);
      length = std::max(length, std::fabs(q[i] - p[i]));
    }
    error = std::max(error, 1.01 * length * doubt + 8 * kUnit * rounded_.extent());
  }

  // What of chord a may be in chord b, which is on the same line, as an interval of a's parameter.
  static bool overlap(const Chord& a, const Chord& b, Interval& result) {
    result = {0, 1};
    Vector d{};
    double square = 0;
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      d[i] = a.point[1][i] - a.point[0][i];
      square += d[i] * d[i];
      largest = std::max(largest, std::fabs(d[i]));
    }
    // The ends of a, and of b, are off by at most `error` in each coordinate.
    if (largest < 100 * (a.error + b.error) || square == 0) return true;
    std::array<double, 2> t{};
    double far = 1;
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t i = 0; i < 3; ++i) t[k] += d[i] * (b.point[k][i] - a.point[0][i]);
      t[k] /= square;
      far = std::max(far, std::fabs(t[k]));
    }
    const double doubt = 20 * (a.error + b.error) / largest * far + 1e-12 * far;
    result.low = std::max(0.0, std::min(t[0], t[1]) - doubt);
    result.high = std::min(1.0, std::max(t[0], t[1]) + doubt);
    return result.low <= result.high;
  }

  // Narrows an interval of a segment to where the segment may be in a box; false if that is nowhere.
  static bool clip_to_box(const Segment& s, const Box& box, Interval& t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double slope = s.to[i] - s.from[i];
      clip(t, s.from[i], slope, box.high[i] + s.error, false);
      clip(t, -s.from[i], -slope, -box.low[i] + s.error, false);
    }
    return t.low <= t.high;
  }

  // Takes from s.open what is surely inside of cells; true if nothing is left.
  bool covered(Segment& s, const Interval& whole) {
    s.open.assign(1, whole);
    const std::uint32_t own = rounded_.cell_of_face(s.f);
    const std::uint32_t other = rounded_.cell_of_face(s.g);
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
      const std::uint32_t cell = neighbours_[k];
      if (cell == own || cell == other || !s.box.overlaps(rounded_.box(cell))) continue;
      Interval inside{-1, 2};  // so that a cell which surely holds an end covers it
      for (std::uint32_t h = rounded_.first_face(cell); h < rounded_.end_face(cell) && inside.low < inside.high; ++h) {
        const Cut c(rounded_.face(h), s);
        clip(inside, c.at, c.slope, -c.error, true);
      }
      if (!(inside.low < inside.high)) continue;
      take(s.open, inside);
      if (s.open.empty()) {
        // Neighbouring segments are likely to be covered by the same cell.
        std::rotate(neighbours_.begin(), neighbours_.begin() + static_cast<std::ptrdiff_t>(k),
                    neighbours_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        return true;
      }
    }
    return false;
  }

  // Subtracts the open interval `inside` from closed ones.
  void take(std::vector<Interval>& open, const Interval& inside) {
    pieces_.clear();
    for (const Interval& t : open) {
      if (inside.high <= t.low || inside.low >= t.high) {
        pieces_.push_back(t);
        continue;
      }
      if (t.low <= inside.low) pieces_.push_back({t.low, inside.low});
      if (inside.high <= t.high) pieces_.push_back({inside.high, t.high});
    }
    std::swap(open, pieces_);
  }

  // Candidates: faces of neighbours that may cut what is left of a segment.
  void cut(const Segment& s, std::uint32_t own, std::uint32_t other) {
    const Interval left{s.open.front().low, s.open.back().high};
    const Box box = box_of_part(s, left);
    for (const std::uint32_t cell : neighbours_) {
      if (cell == own || cell == other || !box.overlaps(rounded_.box(cell))) continue;
      Interval near = left;
      cuts_.clear();
      for (std::uint32_t h = rounded_.first_face(cell); h < rounded_.end_face(cell) && near.low <= near.high; ++h) {
        cuts_.emplace_back(rounded_.face(h), s);
        clip(near, cuts_.back().at, cuts_.back().slope, cuts_.back().error, false);
      }
      if (!(near.low <= near.high)) continue;
      for (std::uint32_t h = rounded_.first_face(cell); h < rounded_.end_face(cell); ++h) {
        if (left_[h] == 0) continue;
        const Cut& c = cuts_[h - rounded_.first_face(cell)];
        // Where |at + t * slope| <= error.
        Interval at = near;
        clip(at, c.at, c.slope, c.error, false);
        clip(at, -c.at, -c.slope, c.error, false);
        if (!(at.low <= at.high)) continue;
        const bool is_left = std::any_of(s.open.begin(), s.open.end(),
                                         [&](const Interval& t) { return at.low <= t.high && t.low <= at.high; });
        const bool is_end =
            (at.low <= 0 && vertices_.is_on(s.from_point, h)) || (at.high >= 1 && vertices_.is_on(s.to_point, h));
        if (!is_left || is_end) continue;
        const double t = (at.low + at.high) / 2;
        Vector guess{};
        for (std::size_t i = 0; i < 3; ++i) guess[i] = s.from[i] + t * (s.to[i] - s.from[i]);
        vertices_.add_meeting(s.f, s.g, h, guess);
      }
    }
  }

  std::span<const ConvexCell> cells_;
  const RoundedCells& rounded_;
  BoxTree boxes_;
  UnionVertices vertices_;
  std::vector<std::uint8_t> left_;    // per face: not inside of other cells
  std::vector<std::uint32_t> faces_;  // those that are left
  std::vector<Box> face_boxes_;       // around what is left of them
  BoxTree tree_;                      // over face_boxes_

  // Scratch.
  std::vector<std::uint32_t> neighbours_;  // of the face at hand
  Segment segment_;
  std::vector<int> sides_;
  std::vector<double> values_;
  std::vector<Interval> pieces_;
  std::vector<Cut> cuts_;
};

// A key that equal cells share, whatever the order of their vertices.
std::uint64_t vertex_hash(std::span<const Vector> vertices) {
  std::uint64_t sum = vertices.size();
  for (const Vector& v : vertices) {
    std::uint64_t h = 0;
    // Adding 0 makes one of the two zeros.
    for (const double x : v) h = (h ^ (h >> 31U) ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15ULL;
    sum += h ^ (h >> 29U);
  }
  return sum;
}

// Cells that occurred before (A + A has every sum of two cells twice).
std::vector<bool> repeated(std::span<const ConvexCell> cells, const RoundedCells& rounded) {
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> seen;
  std::vector<bool> result(cells.size(), false);
  const auto sorted = [&](std::uint32_t i) {
    std::vector<Rational3> vertices = cells[i].mesh.vertices;
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  };
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    std::vector<std::uint32_t>& same = seen[vertex_hash(rounded.vertices(i))];
    result[i] = std::any_of(same.begin(), same.end(), [&](std::uint32_t j) {
      return cells[i].boundary == cells[j].boundary && cells[i].boundary != ConvexCell::Boundary::kMixed &&
             sorted(i) == sorted(j);
    });
    if (!result[i]) same.push_back(i);
  }
  return result;
}

}  // namespace

Polyhedron unite_solids(std::span<const ConvexCell> cells, std::size_t* dropped, unsigned threads,
                        const std::function<void()>& poll) {
  if (cells.empty()) return {};
  if (cells.size() == 1) return to_polyhedron(cells[0]);
  const RoundedCells rounded(cells);
  const std::vector<bool> is_repeated = repeated(cells, rounded);
  const auto repeats = static_cast<std::size_t>(std::count(is_repeated.begin(), is_repeated.end(), true));
  if (repeats == 0) return SolidUnion(cells, rounded).run(dropped, threads, poll);
  std::vector<ConvexCell> different;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!is_repeated[i]) different.push_back(cells[i]);
  }
  if (dropped != nullptr) *dropped += repeats;
  if (different.size() == 1) return to_polyhedron(different[0]);
  return SolidUnion(different, RoundedCells(different)).run(dropped, threads, poll);
}

}  // namespace nef::minkowski
