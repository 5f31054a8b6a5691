// SPDX-License-Identifier: Apache-2.0
//
// Meshes as they come from the wild: folded edges, polygons back to back, faces doubled, turned, missing, cut open or
// without area, bent faces, vertices twice, numbers of vertices mixed up. On any number of threads a mesh becomes the
// same bytes with the same notes, or is refused in the same words. What is accepted encloses what ray casting counts,
// and has the volume that its faces, all planar, sum up to.
#include <algorithm>
#include <optional>

#include "fuzz/fuzzer.h"
#include "fuzz/fuzzers/sets/face_rings.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "nef/import/repair.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/native/native_binary.h"
#include "nef/mesh/mesh_check.h"

namespace nef::fuzz {
namespace {

class DirtyMesh : private FaceRings {
 public:
  explicit DirtyMesh(Choices& choices) : FaceRings(choices) {}

  Mesh make() {
    for (std::uint32_t parts = 1 + choices_.below(2); parts > 0; --parts) add_part();
    for (std::uint32_t changes = choices_.below(4); changes > 0; --changes) change();
    if (choices_.one_in(4)) scale();
    return mesh();
  }

 private:
  std::uint32_t push(int x, int y, int z) {
    vertices_.push_back({x, y, z});
    return static_cast<std::uint32_t>(vertices_.size() - 1);
  }

  Rational3 shift() { return {choices_.between(-2, 2), choices_.between(-2, 2), choices_.between(-2, 2)}; }

  void add_part() {
    const auto first_vertex = static_cast<std::uint32_t>(vertices_.size());
    const std::size_t first_ring = rings_.size();
    switch (choices_.below(6)) {
      case 0:
        add_tetrahedron();
        break;
      case 1:
        add_box();
        break;
      case 2:
        add_prism(3 + choices_.below(4));
        break;
      case 3:
        add_polygon(3 + choices_.below(3));
        break;
      case 4:
        add_octahedron();
        break;
      default:
        add_soup();
    }
    if (choices_.one_in(3)) {
      for (std::size_t f = first_ring; f < rings_.size(); ++f) std::reverse(rings_[f].begin(), rings_[f].end());
    }
    if (!choices_.one_in(3)) return;
    const Rational3 by = shift();
    for (std::uint32_t v = first_vertex; v < vertices_.size(); ++v) vertices_[v] = plus(vertices_[v], by);
  }

  void add_tetrahedron() {
    const std::uint32_t v = push(0, 0, 0);
    push(2, 0, 0), push(0, 2, 0), push(0, 0, 2);
    rings_.insert(rings_.end(), {{v, v + 2, v + 1}, {v, v + 1, v + 3}, {v, v + 3, v + 2}, {v + 1, v + 2, v + 3}});
  }

  void add_box() {
    const auto v = static_cast<std::uint32_t>(vertices_.size());
    for (int i = 0; i < 8; ++i) push(2 * (i & 1), (i & 2), (i & 4) / 2);
    for (const std::array<std::uint32_t, 4>& side : {std::array<std::uint32_t, 4>{0, 4, 6, 2},
                                                     {1, 3, 7, 5},
                                                     {0, 1, 5, 4},
                                                     {2, 6, 7, 3},
                                                     {0, 2, 3, 1},
                                                     {4, 5, 7, 6}}) {
      rings_.push_back({v + side[0], v + side[1], v + side[2], v + side[3]});
    }
  }

  // Over a polygon that is mostly not convex.
  void add_prism(std::uint32_t n) {
    static constexpr std::array<std::array<int, 2>, 6> kCorners{{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {1, 3}, {0, 4}}};
    const auto v = static_cast<std::uint32_t>(vertices_.size());
    for (const int z : {0, 2}) {
      for (std::uint32_t i = 0; i < n; ++i) push(kCorners[i][0], kCorners[i][1], z);
    }
    FaceRing top;
    FaceRing bottom;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t next = (i + 1) % n;
      rings_.push_back({v + i, v + next, v + n + next, v + n + i});
      top.push_back(v + n + i);
      bottom.insert(bottom.begin(), v + i);
    }
    rings_.push_back(std::move(top));
    rings_.push_back(std::move(bottom));
  }

  // From both sides.
  void add_polygon(std::uint32_t n) {
    static constexpr std::array<std::array<int, 2>, 5> kCorners{{{0, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}};
    FaceRing ring;
    for (std::uint32_t i = 0; i < n; ++i) ring.push_back(push(kCorners[i][0], kCorners[i][1], 0));
    rings_.push_back(ring);
    std::reverse(ring.begin(), ring.end());
    rings_.push_back(std::move(ring));
  }

  void add_octahedron() {
    const std::uint32_t v = push(2, 0, 0);
    push(0, 2, 0), push(-2, 0, 0), push(0, -2, 0), push(0, 0, 2), push(0, 0, -2);
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t next = (i + 1) % 4;
      rings_.push_back({v + i, v + next, v + 4});
      rings_.push_back({v + next, v + i, v + 5});
    }
  }

  void add_soup() {
    const auto v = static_cast<std::uint32_t>(vertices_.size());
    for (int i = 0; i < 5; ++i) push(choices_.between(0, 2), choices_.between(0, 2), choices_.between(0, 1));
    for (std::uint32_t i = 1 + choices_.below(6); i > 0; --i) {
      rings_.push_back({v + choices_.below(5), v + choices_.below(5), v + choices_.below(5)});
    }
  }

  std::uint32_t any_vertex() { return choices_.below(static_cast<std::uint32_t>(vertices_.size())); }

  void change() {
    if (rings_.empty()) return;
    FaceRing& ring = any_ring();
    const auto size = static_cast<std::uint32_t>(ring.size());
    if (size < 2) return;
    const std::uint32_t at = choices_.below(size);
    const std::uint32_t next = (at + 1) % size;
    const std::uint32_t how = choices_.below(13);
    if (how <= kCopyTurned) return damage_whole(how, ring);
    switch (how) {
      case 3:
        ring.clear();
        break;
      case 4:  // a number mixed up
        ring[at] = any_vertex();
        break;
      case 5:  // a fold that hangs on an edge
        add_fold(ring[at], ring[next], any_vertex());
        break;
      case 6:
        give_own_vertex(ring, at);
        break;
      case 7:
        cut_side(ring, at);
        break;
      case 8:  // out and back
        ring.insert(ring.begin() + at + 1, {any_vertex(), ring[at]});
        break;
      case 9: {
        const std::uint32_t v = any_vertex();
        vertices_[v] = plus(vertices_[v], shift());
        break;
      }
      case 10:
        add_without_area(ring, at);
        break;
      case 11:  // cut in two
        if (size > 3) cut(at);
        break;
      default:  // two sides of one edge
        rings_.push_back({ring[next], ring[at], any_vertex()});
    }
  }

  void add_fold(std::uint32_t u, std::uint32_t v, std::uint32_t w) {
    rings_.push_back({u, v, w});
    rings_.push_back({u, w, v});
  }

  void cut(std::uint32_t at) {
    FaceRing& ring = any_ring();
    if (ring.size() < 4) return;
    std::rotate(ring.begin(), ring.begin() + at % ring.size(), ring.end());
    FaceRing rest(ring.begin() + 2, ring.end());
    rest.push_back(ring[0]);
    ring.resize(3);
    rings_.push_back(std::move(rest));
  }

  // Small integers no more, so that other ways to compute are taken.
  void scale() {
    const Rational by = choices_.below(2) == 0 ? Rational(1, 3) : Rational("36893488147419103233/7");
    const Rational shear = choices_.below(2) == 0 ? Rational(0) : Rational(1, 7);
    for (Rational3& v : vertices_) v = {(v[0] + shear * v[2]) * by, v[1] * by, v[2] * by};
  }
};

// The bytes and notes of a set, or why there is none.
struct Made {
  std::string text;
  Polyhedron set;
  bool accepted = false;

  friend bool operator==(const Made& a, const Made& b) { return a.text == b.text && a.accepted == b.accepted; }
};

Made made(const Mesh& mesh, const MeshOptions& options) {
  Made result;
  Messages notes;
  try {
    result.set = from_mesh(mesh, options, &notes);
    result.text = native_binary(result.set);
    result.accepted = true;
  } catch (const InputError& error) {
    result.text = error.what();
    Case::require(result.text.find('\n') == std::string::npos && result.text.size() < 600, "message: not one line");
  }
  for (const std::string& note : notes) result.text += "\n" + note;
  return result;
}

class DirtyCase {
 public:
  DirtyCase(const Case& the_case, Mesh mesh) : case_(the_case), mesh_(std::move(mesh)) {}

  void run() {
    const Made on_one = made(mesh_, {});
    for (const unsigned threads : {2U, 4U}) {
      Case::require(made(mesh_, {.monitor = Monitor().on_threads(threads)}) == on_one,
                    "threads: another outcome on several");
    }
    case_.count(on_one.accepted ? "accepted" : "refused");
    check_report(on_one);
    if (on_one.accepted) check_set(on_one.set);
    check_unchecked(on_one);
    switch (case_.choices().below(4)) {
      case 0:
        check_repair(false);
        break;
      case 1:
        check_repair(true);
        break;
      case 2:
        check_as_surface();
        break;
      default:
        break;
    }
  }

 private:
  // What check_mesh calls illegal is refused, whatever the words.
  void check_report(const Made& on_one) const {
    for (const MeshProblem& problem : check_mesh(mesh_)) {
      Case::require(problem.text.find('\n') == std::string::npos, "message: of several lines");
      Case::require(problem.legal || !on_one.accepted, "check: accepted, but " + problem.text);
    }
  }

  // Whoever promises what is not so gets a refusal or something else, but no crash; whoever keeps the promise gets the
  // same set.
  void check_unchecked(const Made& on_one) const {
    const Made unchecked = made(mesh_, {.check = false});
    if (!on_one.accepted) return;
    Case::require(unchecked.accepted, "check = false: refused, but accepted with checks: " + unchecked.text);
    bool contacts = false;
    for (const MeshProblem& problem : check_mesh(mesh_)) {
      contacts = contacts || problem.kind == MeshProblemKind::kTouching;
    }
    Case::require(contacts || unchecked == on_one, "check = false: another set");
  }

  void check_repair(bool fill_holes) const {
    RepairedMesh repaired;
    try {
      repaired = repair_mesh(mesh_, {.fill_holes = fill_holes});
    } catch (const InputError&) {
      return;  // a vertex that does not exist
    }
    Case::require(repaired.problem.find('\n') == std::string::npos, "message: of several lines");
    if (!repaired.problem.empty()) return;
    case_.count("repaired");
    Case::require(made(repaired.mesh, {}).accepted, "repair: what was repaired is refused");
  }

  void check_as_surface() const {
    const Made surface = made(mesh_, {.as_surface = true});
    Case::require(made(mesh_, {.as_surface = true, .monitor = Monitor().on_threads(2)}) == surface,
                  "threads: another surface on several");
    if (surface.accepted) static_cast<void>(case_.valid(surface.set, "as_surface"));
  }

  [[nodiscard]] bool is_planar() const {
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      const Rational3 normal = area(f);
      for (const std::uint32_t v : mesh_.face(f)) {
        if (dot(normal, minus(mesh_.vertices[v], mesh_.vertices[mesh_.face(f)[0]])) != 0) return false;
        if (is_zero(normal)) return false;  // on a line, or folded: left out or not planar, who knows
      }
    }
    return true;
  }

  // Twice the vector area.
  [[nodiscard]] Rational3 area(std::size_t face) const {
    const auto ring = mesh_.face(face);
    Rational3 sum;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
      const Rational3 part = cross(minus(mesh_.vertices[ring[i]], mesh_.vertices[ring[0]]),
                                   minus(mesh_.vertices[ring[i + 1]], mesh_.vertices[ring[0]]));
      for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
    }
    return sum;
  }

  // How often the faces wind around a point, by a ray through fans; nothing if the ray meets an edge or the point lies
  // on a face.
  [[nodiscard]] std::optional<int> winding(const Rational3& p) const {
    const Rational3 ray{Rational(1), Rational(13, 101), Rational(7, 89)};
    int sum = 0;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      const auto ring = mesh_.face(f);
      const Rational3 a = minus(mesh_.vertices[ring[0]], p);
      for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        const Rational3 b = minus(mesh_.vertices[ring[i]], p);
        const Rational3 c = minus(mesh_.vertices[ring[i + 1]], p);
        const int volume = sgn(dot(a, cross(b, c)));
        const int first = sgn(dot(ray, cross(a, b)));
        const int second = sgn(dot(ray, cross(b, c)));
        const int third = sgn(dot(ray, cross(c, a)));
        const bool all_up = first >= 0 && second >= 0 && third >= 0;
        const bool all_down = first <= 0 && second <= 0 && third <= 0;
        if (!all_up && !all_down) continue;
        if (first * second * third == 0 || volume == 0) return std::nullopt;
        if (volume == first) sum += first;
      }
    }
    return sum;
  }

  void check_set(const Polyhedron& set) const {
    static_cast<void>(case_.valid(set, "from_mesh"));
    if (!is_planar()) return;
    case_.count("volumes");
    Rational six;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) six += dot(mesh_.vertices[mesh_.face(f)[0]], area(f));
    Case::require(volume(set) == abs(six) / 6, "volume: not that of the faces");
    const int inside = sgn(six);
    for (int i = 0; i < 4; ++i) {
      const std::optional<Rational3> p = sample();
      const std::optional<int> expected = p ? winding(*p) : std::nullopt;
      if (!expected) continue;
      case_.count("points");
      Case::require(*expected == 0 || *expected == inside,
                    "winding: of " + std::to_string(*expected) + " in a mesh that is accepted");
      Case::require(contains(set, *p) == (*expected != 0), "membership: of a point that rays tell");
    }
  }

  // Near three vertices of the mesh.
  [[nodiscard]] std::optional<Rational3> sample() const {
    if (mesh_.vertices.empty()) return std::nullopt;
    Choices& choices = case_.choices();
    Rational3 sum;
    const std::array<Rational, 4> weights{Rational(2, 5), Rational(3, 11), Rational(3, 13), Rational(69, 715)};
    for (const Rational& weight : weights) {
      const Rational3& v = mesh_.vertices[choices.below(static_cast<std::uint32_t>(mesh_.vertices.size()))];
      for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * v[k];
    }
    return sum;
  }

  const Case& case_;
  Mesh mesh_;
};

}  // namespace

void fuzz_dirty(const Case& the_case) {
  Mesh mesh = DirtyMesh(the_case.choices()).make();
  MeshWriteOptions exact;
  exact.exact = true;
  const bool stl = the_case.choices().one_in(4);
  std::string text;
  try {
    text = stl ? stl_bytes(mesh, {}) : off_bytes(mesh, exact);
  } catch (const InputError&) {
    the_case.count("not written");  // polygons that cannot be cut into triangles
    return;
  }
  the_case.tell(stl ? "STL:" : "OFF:");
  the_case.tell(text);
  the_case.count(stl ? "stl" : "off");
  try {
    mesh = stl ? read_stl(text, "dirty.stl") : read_off(text, "dirty.off");
  } catch (const InputError&) {
    the_case.count("unreadable");
    return;
  }
  if (!mesh.corners.empty() && the_case.choices().one_in(40)) {
    the_case.tell("its first corner is a vertex that does not exist");
    mesh.corners[0] = static_cast<std::uint32_t>(mesh.vertices.size());
  }
  DirtyCase(the_case, std::move(mesh)).run();
}

}  // namespace nef::fuzz
