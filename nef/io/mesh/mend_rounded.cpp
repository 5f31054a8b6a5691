// SPDX-License-Identifier: Apache-2.0
//
// Rounding moves vertices by half a unit in the last place, so it can only harm what is about as thin: a needle (two
// corners that are very close) is contracted, a cap (a corner very close to the opposite side) loses that side to the
// other diagonal of it and its neighbour, and other faces that cross get their corners shaken a little. Each round
// looks at faces that are somewhat thicker and shakes somewhat more.
#include "nef/io/mesh/mend_rounded.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <span>
#include <unordered_map>
#include <variant>

#include "nef/base/error.h"
#include "nef/base/fast_path.h"
#include "nef/base/threads/parallel.h"
#include "nef/export/nearest_float.h"
#include "nef/geometry/vectors.h"
#include "nef/import/try_from_mesh.h"
#include "nef/io/number_text.h"
#include "nef/io/text_cursor.h"
#include "nef/mesh/edge_order.h"
#include "nef/mesh/mesh_check.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/surface/nested_components.h"
#include "nef/mesh/surface/surface_contacts.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

using VertexTriple = std::array<std::uint32_t, 3>;

constexpr int kRounds = 24;

struct Finding {
  bool legal = true;
  std::string text;                       // of the first problem
  std::set<std::uint32_t> guilty;         // faces of problems, without those of the next
  std::vector<std::uint32_t> degenerate;  // faces without area
};

// True if some pairs of triangles have nothing in common but vertices and edges in a reading of their corners. A mesh
// of these triangles alone is searched, so any contact counts: the faces that could make one harmless are not there.
bool are_apart(const MeshSurface& surface, const OpenPairs& pairs, std::span<const Double3> doubles,
               const std::function<Rational(double)>& reading, const Monitor& monitor) {
  std::set<std::uint32_t> triangles;
  for (const auto& pair : pairs) triangles.insert(pair.begin(), pair.end());
  Mesh few;
  std::unordered_map<std::uint32_t, std::uint32_t> vertices;
  for (const std::uint32_t t : triangles) {
    VertexTriple corners = surface.triangles[t];
    for (std::uint32_t& v : corners) {
      const auto [known, is_new] = vertices.emplace(v, static_cast<std::uint32_t>(few.vertices.size()));
      if (is_new) few.vertices.push_back({reading(doubles[v][0]), reading(doubles[v][1]), reading(doubles[v][2])});
      v = known->second;
    }
    few.push_face(corners);
  }
  const MeshSurface read(few, monitor);
  const auto is_sound = [](FaceDefect defect) { return defect == FaceDefect::kNone; };
  return std::all_of(read.defects.begin(), read.defects.end(), is_sound) &&
         face_contacts(read, SurfaceContacts(read, monitor)).empty();
}

// True if it is shown that the mesh is strictly legal, and its components fit together, with its vertices anywhere near
// doubles as in MeshPoints::near: then it is so in every reading. Pairs of triangles of which doubles cannot tell are
// looked at in each reading.
bool surely_legal_near(const Mesh& mesh, std::span<const Double3> doubles, const Rounding& rounding,
                       const Monitor& monitor) {
  if (!kFastPaths) return false;
  try {
    const MeshSurface surface(mesh, MeshPoints::near({doubles.begin(), doubles.end()}), monitor);
    const MeshCheckOptions first{.max_per_kind = 1, .only_verdict = true};
    OpenPairs open;
    const std::vector<MeshProblem> problems = check_mesh(mesh, surface, first, monitor, nullptr, &open);
    return std::all_of(problems.begin(), problems.end(), is_strictly_legal) && surely_one_solid(surface, monitor) &&
           (open.empty() || std::all_of(rounding.readings.begin(), rounding.readings.end(), [&](const auto& reading) {
              return are_apart(surface, open, doubles, reading, monitor);
            }));
  } catch (const OpenQuestion&) {
    return false;
  }
}

// Whether a mesh is strictly legal (is_strictly_legal) and its components fit together.
Finding examine(const Mesh& mesh, const Monitor& monitor) {
  Finding found;
  const auto note = [&](const std::string& text) {
    if (found.legal) found.text = text;
    found.legal = false;
  };
  const MeshSurface surface(mesh, monitor);
  for (const MeshProblem& problem : check_mesh(mesh, surface, {}, monitor)) {
    if (is_strictly_legal(problem)) continue;
    note(problem.text);
    if (problem.kind == MeshProblemKind::kDegenerateFace) {
      found.degenerate.insert(found.degenerate.end(), problem.faces.begin(), problem.faces.end());
    } else {
      found.guilty.insert(problem.faces.begin(), problem.faces.end());
    }
  }
  // How components lie to each other is known when the solid is made.
  if (!found.legal || surely_one_solid(surface, monitor)) return found;
  const std::variant<Polyhedron, MeshRefusal> made = try_from_mesh(mesh, {.monitor = monitor});
  if (const auto* refused = std::get_if<MeshRefusal>(&made)) note(refused->text);
  return found;
}

class Mender {
 public:
  Mender(const Mesh& exact, const Rounding& rounding, const Monitor& monitor)
      : exact_(exact), rounding_(rounding), monitor_(monitor), random_(1) {}

  std::string problem() {
    round();
    return surely_legal_near(exact_, points_, rounding_, monitor_) ? "" : examine_exact_faces().text;
  }

  MendedMesh run() {
    round();
    nearest_ = points_;
    MendedMesh result;
    Finding found = surely_legal_near(exact_, points_, rounding_, monitor_) ? Finding() : examine_exact_faces();
    if (found.legal) {
      result.mesh = with_faces_of(exact_, exact_rational);
      return result;
    }
    cut_into_triangles();
    const std::size_t before = triangles_.size();
    for (int round = 0; round < kRounds; ++round) {
      clean_up();
      if (triangles_.empty()) return lost();
      found = examine_readings([&](const auto& reading) { return mesh_of_triangles(reading); });
      if (found.legal) break;
      mend(found, round);
    }
    result.legal = found.legal;
    result.problem = found.text;
    result.dropped = before - triangles_.size();
    result.mesh = mesh_of_triangles(exact_rational);
    result.face_of = face_of_;
    drop_unused_vertices(result.mesh);
    return measured(std::move(result));
  }

 private:
  void round() {
    for (const Rational3& p : exact_.vertices) {
      points_.push_back({rounding_.nearest(p[0]), rounding_.nearest(p[1]), rounding_.nearest(p[2])});
    }
  }

  [[nodiscard]] Finding examine_exact_faces() const {
    return examine_readings([&](const auto& reading) { return with_faces_of(exact_, reading); });
  }

  [[nodiscard]] static MendedMesh lost() {
    MendedMesh result;
    result.legal = false;
    result.problem = "nothing is left of it";
    return result;
  }

  // All readings must be legal; the guilty faces are those of the first that is not. One thread looks no further.
  template <typename Make>
  Finding examine_readings(Make make) const {
    std::vector<Finding> found(rounding_.readings.size());
    bool go_on = true;
    parallel_for(found.size(), monitor_, [&](std::size_t i, const Monitor& own) {
      if (monitor_.threads() == 1 && !go_on) return;
      found[i] = examine(make(rounding_.readings[i]), own);
      if (monitor_.threads() == 1) go_on = found[i].legal;
    });
    for (Finding& one : found) {
      if (!one.legal) return std::move(one);
    }
    return std::move(found[0]);
  }

  template <typename Reading>
  [[nodiscard]] std::vector<Rational3> read(const Reading& reading) const {
    std::vector<Rational3> vertices;
    vertices.reserve(points_.size());
    for (const Double3& p : points_) vertices.push_back({reading(p[0]), reading(p[1]), reading(p[2])});
    return vertices;
  }

  template <typename Reading>
  [[nodiscard]] Mesh with_faces_of(const Mesh& other, const Reading& reading) const {
    return {read(reading), other.face_begin, other.corners};
  }

  template <typename Reading>
  [[nodiscard]] Mesh mesh_of_triangles(const Reading& reading) const {
    Mesh mesh;
    mesh.vertices = read(reading);
    for (const VertexTriple& t : triangles_) mesh.push_face(t);
    return mesh;
  }

  void cut_into_triangles() {
    const MeshSurface surface(exact_, monitor_);
    triangles_ = surface.triangles;
    face_of_ = surface.face_of;
  }

  // One vertex for each point, no triangles that come to one twice, none that lie back to back.
  void clean_up() {
    std::map<Double3, std::uint32_t> vertex_at;
    std::vector<std::uint32_t> vertex(points_.size());
    for (std::uint32_t v = 0; v < points_.size(); ++v) vertex[v] = vertex_at.emplace(points_[v], v).first->second;
    struct Face {
      VertexTriple corners;
      std::uint32_t face_of;
    };
    std::map<VertexTriple, std::vector<Face>> by_corners;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      VertexTriple t = triangles_[i];
      for (std::uint32_t& v : t) v = vertex[v];
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      VertexTriple sorted = t;
      std::sort(sorted.begin(), sorted.end());
      std::vector<Face>& same = by_corners[sorted];
      const auto is_opposite = [&t](const Face& face) { return face.corners == VertexTriple{t[0], t[2], t[1]}; };
      const auto opposite = std::find_if(same.begin(), same.end(), is_opposite);
      if (opposite != same.end()) {
        same.erase(opposite);
      } else {
        same.push_back({t, face_of_[i]});
      }
    }
    triangles_.clear();
    face_of_.clear();
    for (const auto& [corners, same] : by_corners) {
      for (const Face& face : same) {
        triangles_.push_back(face.corners);
        face_of_.push_back(face.face_of);
      }
    }
  }

  void mend(const Finding& found, int round) {
    neighbours_.clear();
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for_each_side(triangles_[t], [&](std::uint32_t u, std::uint32_t v) { neighbours_[pair_key(u, v)].push_back(t); });
    }
    touched_.assign(triangles_.size(), false);
    flip_of_round_ = 0;
    for (const std::uint32_t t : found.degenerate) {
      if (!remove_thin(t)) shake(t, round);
    }
    for (const std::uint32_t t : found.guilty) {
      if (remove_if_thin(t, round) || remove_thin_neighbour(t, round)) continue;
      shake(t, round);
    }
    flips_ += flip_of_round_;
  }

  bool remove_if_thin(std::uint32_t t, int round) { return is_thin(t, round) && remove_thin(t); }

  // A cap whose corner was rounded over its long side crosses nothing itself: the faces on both sides of it do. True
  // also if one of its neighbours has been changed, which may be enough.
  bool remove_thin_neighbour(std::uint32_t t, int round) {
    bool any = false;
    for_each_side(VertexTriple(triangles_[t]), [&](std::uint32_t u, std::uint32_t v) {
      const auto others = neighbours_.find(pair_key(v, u));
      if (others == neighbours_.end()) return;
      for (const std::uint32_t other : others->second) any = touched_[other] || remove_if_thin(other, round) || any;
    });
    return any;
  }

  [[nodiscard]] double squared_distance(std::uint32_t a, std::uint32_t b) const {
    const Double3 d = minus(points_[a], points_[b]);
    return dot(d, d);
  }

  // The side i of a triangle goes from corner i to the next.
  [[nodiscard]] std::array<double, 3> squared_sides(const VertexTriple& t) const {
    return {squared_distance(t[0], t[1]), squared_distance(t[1], t[2]), squared_distance(t[2], t[0])};
  }

  // The distance of a corner from the longest side; 0 if all corners are one.
  [[nodiscard]] double height(const VertexTriple& c) const {
    const std::array<double, 3> sides = squared_sides(c);
    const double longest = std::sqrt(*std::max_element(sides.begin(), sides.end()));
    const Double3 n = cross(minus(points_[c[1]], points_[c[0]]), minus(points_[c[2]], points_[c[0]]));
    return longest > 0 ? std::hypot(n[0], n[1], n[2]) / longest : 0;
  }

  [[nodiscard]] bool is_thin(std::uint32_t t, int round) const {
    const VertexTriple& c = triangles_[t];
    double reach = 0;
    for (const std::uint32_t corner : c) {
      for (const double x : points_[corner]) reach = std::max(reach, std::abs(x));
    }
    const double unit = rounding_.next(reach, true) - reach;
    return height(c) <= unit * std::ldexp(2, round);
  }

  // Contracts a needle, flips the long side of a cap. False if neither can be done.
  bool remove_thin(std::uint32_t t) {
    if (touched_[t]) return true;
    const VertexTriple c = triangles_[t];
    const std::array<double, 3> sides = squared_sides(c);
    const auto shortest = static_cast<std::size_t>(std::min_element(sides.begin(), sides.end()) - sides.begin());
    const auto longest = static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
    constexpr double kNeedle = 0x1p-80;  // of the squared longest side: a few thousand units in the last place
    if (sides[shortest] > kNeedle * sides[longest]) return flip(t, longest);
    points_[c[shortest]] = points_[c[(shortest + 1) % 3]];
    touched_[t] = true;
    return true;
  }

  bool flip(std::uint32_t t, std::size_t side) {
    const std::uint32_t u = triangles_[t][side];
    const std::uint32_t v = triangles_[t][(side + 1) % 3];
    const std::uint32_t w = triangles_[t][(side + 2) % 3];
    if (neighbours_[pair_key(u, v)].size() != 1 || neighbours_[pair_key(v, u)].size() != 1) return false;
    const std::uint32_t other = neighbours_[pair_key(v, u)][0];
    if (touched_[other]) return true;
    std::uint32_t x = 0;
    for (const std::uint32_t corner : triangles_[other]) {
      if (corner != u && corner != v) x = corner;
    }
    if (x == w || !neighbours_[pair_key(x, w)].empty() || !neighbours_[pair_key(w, x)].empty()) return false;
    flip_of_round_ = std::max(flip_of_round_, height(triangles_[t]));
    triangles_[t] = {u, x, w};
    triangles_[other] = {x, v, w};
    face_of_[t] = face_of_[other];  // of the two, the cap has no area
    touched_[t] = touched_[other] = true;
    return true;
  }

  // Moves the corners by a few units in the last place.
  void shake(std::uint32_t t, int round) {
    if (touched_[t]) return;
    const auto steps = static_cast<unsigned>(1 + round / 2);
    for (const std::uint32_t v : triangles_[t]) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const unsigned count = random_() % (steps + 1);
        const bool up = random_() % 2 == 0;
        // What was no harm to round stays for a while: a side of a box stays flat.
        if (round < kRounds / 2 && exact_rational(points_[v][axis]) == exact_.vertices[v][axis]) continue;
        for (unsigned i = 0; i < count; ++i) points_[v][axis] = rounding_.next(points_[v][axis], up);
      }
    }
  }

  static void drop_unused_vertices(Mesh& mesh) {
    std::vector<std::uint32_t> number(mesh.vertices.size(), 0xffffffffU);
    std::vector<Rational3> used;
    for (const std::uint32_t v : mesh.corners) number[v] = 0;
    for (std::uint32_t v = 0; v < number.size(); ++v) {
      if (number[v] != 0) continue;
      number[v] = static_cast<std::uint32_t>(used.size());
      used.push_back(std::move(mesh.vertices[v]));
    }
    for (std::uint32_t& v : mesh.corners) v = number[v];
    mesh.vertices = std::move(used);
  }

  MendedMesh measured(MendedMesh result) const {
    for (std::size_t v = 0; v < points_.size(); ++v) {
      result.moved += points_[v] != nearest_[v] ? 1 : 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Rational move = exact_rational(points_[v][i]) - exact_.vertices[v][i];
        result.largest_move = std::max(result.largest_move, std::abs(nearest_double(move)));
      }
    }
    result.largest_move += flips_;
    return result;
  }

  const Mesh& exact_;
  const Rounding& rounding_;
  Monitor monitor_;
  std::mt19937 random_;  // the same for the same mesh
  std::vector<Double3> points_;
  std::vector<Double3> nearest_;
  std::vector<VertexTriple> triangles_;
  std::vector<std::uint32_t> face_of_;  // of each triangle: the face of the exact mesh
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> neighbours_;  // by directed side
  std::vector<bool> touched_;                                                 // triangles that this round changed
  double flip_of_round_ = 0;  // height of the highest cap that is flipped in a round: so far a face moves by that
  double flips_ = 0;          // the sum over all rounds
};

double next_double(double x, bool up) { return std::nextafter(x, up ? HUGE_VAL : -HUGE_VAL); }

double next_float(double x, bool up) {
  return static_cast<double>(std::nextafter(static_cast<float>(x), up ? HUGE_VALF : -HUGE_VALF));
}

Rational shortest_decimal(double x) {
  std::string text;
  append_number(text, x);
  Rational value;
  const bool done = parse_number(text, value);
  NEF_ASSERT(done);
  return value;
}

// Everybody reads an integer below 2^53 as it is: another number with no more digits is a whole unit away, or it is no
// integer and needs more.
bool is_short_integer(const Rational& x) {
  return mpz_cmp_ui(x.get_den_mpz_t(), 1) == 0 && mpz_sizeinbase(x.get_num_mpz_t(), 2) <= 53;
}

}  // namespace

Rounding rounding_to(FileNumbers numbers) {
  NEF_ASSERT(numbers != FileNumbers::kNone);
  if (numbers == FileNumbers::kDoubles) return {nearest_double, next_double, {exact_rational}};
  if (numbers == FileNumbers::kDecimals) return {nearest_double, next_double, {shortest_decimal, exact_rational}};
  return {[](const Rational& x) { return static_cast<double>(nearest_float(x)); }, next_float, {exact_rational}};
}

std::string repair_text(const MendedMesh& rounded) {
  if (rounded.moved == 0 && rounded.dropped == 0) return "";
  std::string text = "rounding made the mesh cross or touch itself, which was repaired:";
  if (rounded.moved > 0) text += " " + std::to_string(rounded.moved) + " vertices were moved to nearby numbers";
  if (rounded.moved > 0 && rounded.dropped > 0) text += ",";
  if (rounded.dropped > 0) text += " " + std::to_string(rounded.dropped) + " slivers were removed";
  text += " (off by at most ";
  append_number(text, rounded.largest_move);
  return text + "); write .nef or --exact for exact coordinates";
}

std::string strict_problem(const Mesh& mesh, const Monitor& monitor) { return examine(mesh, monitor).text; }

std::string rounded_problem(const Mesh& exact, const Rounding& rounding, const Monitor& monitor) {
  return Mender(exact, rounding, monitor).problem();
}

bool is_kept(const Rational3& point, const Rounding& rounding, Readers readers) {
  const auto end = readers == Readers::kAll ? rounding.readings.end() : rounding.readings.begin() + 1;
  return std::all_of(point.begin(), point.end(), [&](const Rational& x) {
    const double rounded = rounding.nearest(x);
    if (is_short_integer(x) && rounded == mpz_get_d(x.get_num_mpz_t())) return true;
    return std::isfinite(rounded) &&
           std::all_of(rounding.readings.begin(), end, [&](const auto& reading) { return reading(rounded) == x; });
  });
}

bool are_kept(const Mesh& mesh, const Rounding& rounding) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [&](const Rational3& p) { return is_kept(p, rounding); });
}

MendedMesh round_mesh(const Mesh& exact, const Rounding& rounding, const Monitor& monitor) {
  return Mender(exact, rounding, monitor).run();
}

}  // namespace nef
