// SPDX-License-Identifier: Apache-2.0
//
// Sets in tiles under steps, with cuts through whatever lies there: boxes, flat and empty ones, and half-spaces, open
// and closed, on a grid. A point is in the set iff the steps say so, by arithmetic on the primitives; and the file of
// the glued set is that of the plain operations, byte for byte.
#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/io/native/native_binary.h"
#include "nef/operation/canonical_order.h"
#include "nef/tiles/import/mesh_tiles.h"
#include "nef/tiles/import/union_in_tiles.h"
#include "nef/tiles/storage/tile_store.h"
#include "nef/tiles/tiled_polyhedron.h"
#include "nef/tiles/tree_overlay.h"

namespace nef::fuzz {
namespace {

constexpr int kGrid = 4;  // coordinates are 0 .. kGrid

// An open or closed set a x + b y + c z + d <= 0, or a box; flat where its corners say so.
struct Primitive {
  bool box = true;
  bool open = false;
  std::array<int, 6> n{};

  [[nodiscard]] bool holds(const Rational3& p) const {
    if (!box) {
      const int side = sgn(Rational(n[0] * p[0] + n[1] * p[1] + n[2] * p[2] + n[3]));
      return open ? side < 0 : side <= 0;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (open ? p[i] <= n[i] || p[i] >= n[i + 3] : p[i] < n[i] || p[i] > n[i + 3]) return false;
    }
    return true;
  }
  [[nodiscard]] Polyhedron make() const {
    const Polyhedron closed =
        box ? make_box({n[0], n[1], n[2]}, {n[3], n[4], n[5]}) : make_halfspace(n[0], n[1], n[2], n[3]);
    return open ? interior(closed) : closed;
  }
  [[nodiscard]] std::string text() const {
    std::string result = box ? "box(" : "halfspace(";
    for (std::size_t i = 0; i < (box ? 6U : 4U); ++i) result += (i > 0 ? "," : "") + std::to_string(n[i]);
    return open ? "interior(" + result + "))" : result + ")";
  }
};

Primitive random_primitive(Choices& choices) {
  Primitive result;
  result.box = choices.below(3) != 2;
  result.open = choices.one_in(3);
  if (result.box) {
    for (std::size_t i = 0; i < 3; ++i) {
      result.n[i] = choices.between(0, kGrid);
      result.n[i + 3] = choices.between(result.n[i], kGrid);
    }
    return result;
  }
  for (std::size_t i = 0; i < 3; ++i) result.n[i] = choices.between(-1, 1);
  if (result.n[0] == 0 && result.n[1] == 0 && result.n[2] == 0) result.n[choices.below(3)] = 1;
  result.n[3] = choices.between(-kGrid, kGrid);
  return result;
}

// Beyond all points that are asked for.
const Polyhedron& far_boxes() {
  static const Polyhedron kBoxes = [] {
    std::vector<Polyhedron> boxes;
    for (int i = 0; i < 40; ++i) {
      const int x = 20 + 3 * (i % 4);
      const int y = -10 + 3 * (i / 4 % 5);
      const int z = 3 * (i / 20) - 2;
      boxes.push_back(make_box({x, y, z}, {x + 2, y + 2 + i % 2, z + 2}));
    }
    return unite_all(boxes);
  }();
  return kBoxes;
}

// How tiles are made, and on how many threads.
struct HowToTile : nef::Tiling {
  Monitor monitor;
};

// The left fold of steps, plain, in tiles and point by point.
class Fold {
 public:
  explicit Fold(const HowToTile& tiling) : tiled_(Polyhedron(), tiling), monitor_(tiling.monitor) {}

  void apply(char op, const Fold& other, bool plain_operand) {
    const auto do_it = [op](const auto& a, const auto& b, const Monitor& monitor) {
      return op == '+'   ? unite(a, b, monitor)
             : op == '*' ? intersect(a, b, monitor)
             : op == '-' ? subtract(a, b, monitor)
                         : symmetric_difference(a, b, monitor);
    };
    tiled_ = plain_operand ? do_it(tiled_, other.plain_, monitor_) : do_it(tiled_, other.tiled_, monitor_);
    plain_ = do_it(plain_, other.plain_, {});
    others_.emplace_back(op, other.steps_text(), std::vector<Fold>{other});
  }
  void complement_all() {
    tiled_ = complement(tiled_);
    plain_ = complement(plain_);
    others_.emplace_back('!', std::string(), std::vector<Fold>());
  }
  void cut(const AxisPlane& plane) {
    const auto halves = cut_tree(tiled_.tree(), plane, nef::Tiling{}, {});
    tiled_ = TiledPolyhedron(cut_node(plane, halves[0], halves[1]), tiled_.tiling());
  }
  static Fold of(const Primitive& primitive, const HowToTile& tiling) {
    Fold result(tiling);
    result.primitive_.push_back(primitive);
    result.plain_ = primitive.make();
    result.tiled_ = TiledPolyhedron(result.plain_, tiling, tiling.monitor);
    return result;
  }
  // With much that is far away, as one tile, which steps cut around what they touch.
  static Fold uncut(const Primitive& primitive, const HowToTile& tiling) {
    Fold result = of(primitive, tiling);
    result.plain_ = unite(result.plain_, far_boxes());
    result.tiled_ = TiledPolyhedron(tile_leaf(result.plain_, tiling.store, true), tiling);
    return result;
  }

  [[nodiscard]] bool holds(const Rational3& p) const {
    bool in = !primitive_.empty() && primitive_[0].holds(p);
    for (const Other& other : others_) {
      const bool b = !other.fold.empty() && other.fold[0].holds(p);
      in = other.op == '+'   ? in || b
           : other.op == '*' ? in && b
           : other.op == '-' ? in && !b
           : other.op == '^' ? in != b
                             : !in;
    }
    return in;
  }
  [[nodiscard]] std::string steps_text() const {
    std::string result = primitive_.empty() ? "nothing" : primitive_[0].text();
    for (const Other& other : others_) {
      result = other.op == '!' ? "!(" + result + ")" : "(" + result + " " + other.op + " " + other.text + ")";
    }
    return result;
  }
  [[nodiscard]] const TiledPolyhedron& tiled() const { return tiled_; }
  [[nodiscard]] const Polyhedron& plain() const { return plain_; }

 private:
  struct Other {
    Other(char symbol, std::string words, std::vector<Fold> folds)
        : op(symbol), text(std::move(words)), fold(std::move(folds)) {}
    char op;
    std::string text;
    std::vector<Fold> fold;  // one, but for a complement
  };

  std::vector<Primitive> primitive_;  // one, or none
  std::vector<Other> others_;
  TiledPolyhedron tiled_;
  Monitor monitor_;
  Polyhedron plain_;
};

void random_cuts(const Case& the_case, Fold& fold) {
  Choices& choices = the_case.choices();
  for (std::uint32_t i = choices.below(3); i > 0; --i) {
    Rational at(choices.between(0, 2 * kGrid), 2);
    at.canonicalize();
    const std::size_t axis = choices.below(3);
    the_case.tell(std::string("cut at ") + "xyz"[axis] + " = " + to_string(at));
    fold.cut(AxisPlane(axis, at));
  }
}

Fold random_fold(const Case& the_case, const HowToTile& tiling, int depth) {
  Choices& choices = the_case.choices();
  const Primitive first = random_primitive(choices);
  const bool uncut = depth == 0 && choices.one_in(3);
  if (uncut) the_case.tell("uncut, with boxes far away");
  Fold result = uncut ? Fold::uncut(first, tiling) : Fold::of(first, tiling);
  if (!uncut) random_cuts(the_case, result);
  for (std::uint32_t i = 1 + choices.below(depth == 0 ? 4 : 2); i > 0; --i) {
    if (choices.one_in(6)) {
      result.complement_all();
    } else {
      const Fold other = depth < 1 && choices.one_in(3) ? random_fold(the_case, tiling, depth + 1)
                                                        : Fold::of(random_primitive(choices), tiling);
      result.apply("+-*^"[choices.below(4)], other, choices.below(2) == 0);
    }
    if (choices.one_in(3)) random_cuts(the_case, result);
  }
  return result;
}

void check(const Case& the_case, const Fold& fold) {
  Choices& choices = the_case.choices();
  const Polyhedron glued = the_case.valid(fold.tiled().polyhedron(), "glued");
  for (int i = 0; i < 60; ++i) {
    Rational3 p;
    const int denominator = choices.below(4) == 0 ? 3 : 2;
    for (Rational& x : p) {
      x = Rational(choices.between(-1, denominator * kGrid + 1), denominator);
      x.canonicalize();
    }
    const std::string where = to_string(p[0]) + "," + to_string(p[1]) + "," + to_string(p[2]);
    Case::require(contains(fold.tiled(), p) == fold.holds(p), "membership in tiles: at " + where);
    Case::require(contains(glued, p) == fold.holds(p), "membership when glued: at " + where);
    the_case.count("points");
  }
  Case::require(native_binary(glued) == native_binary(in_canonical_order(fold.plain())), "bytes: of the glued set");
  Case::require(volume(fold.tiled()) == volume(fold.plain()), "volume: in tiles");
  the_case.count("tiles", fold.tiled().tile_count());
}

// A ray meets in tiles what it meets in the whole.
void check_rays(const Case& the_case, const Fold& fold) {
  Choices& choices = the_case.choices();
  for (int i = 0; i < 12; ++i) {
    Rational3 origin;
    Rational3 direction;
    std::string words;
    for (std::size_t k = 0; k < 3; ++k) {
      origin[k] = Rational(choices.between(-1, 2 * kGrid + 1), 2);
      origin[k].canonicalize();
      direction[k] = choices.between(-2, 2);
      words += (k == 0 ? "" : ",") + to_string(origin[k]) + " + t * " + to_string(direction[k]);
    }
    if (direction[0] == 0 && direction[1] == 0 && direction[2] == 0) direction[0] = 1;
    // All items, those of the set, or those that are no edges.
    const std::uint32_t chosen = choices.below(3);
    const auto accept = [chosen](const Location& at) {
      return chosen == 0 || (chosen == 1 ? at.mark != 0 : at.kind != Location::Kind::kEdge);
    };
    const std::optional<RayHit> there = shoot_ray(fold.tiled(), origin, direction, accept);
    const std::optional<RayHit> whole = shoot_ray(fold.plain(), origin, direction, accept);
    const std::string where = words + ", choice " + std::to_string(chosen);
    Case::require(there.has_value() == whole.has_value(), "rays: whether one meets anything, " + where);
    if (!whole) continue;
    Case::require(there->point == whole->point, "rays: the point, " + where);
    Case::require(there->location.kind == whole->location.kind, "rays: the kind of item, " + where);
    Case::require((there->location.mark != 0) == (whole->location.mark != 0), "rays: the mark, " + where);
    the_case.count("rays that meet something");
  }
}

// What is made of many pieces: the union of primitives, at once and region by region, and the solid of a mesh.
void check_pieces(const Case& the_case, const HowToTile& tiling) {
  Choices& choices = the_case.choices();
  std::vector<Primitive> primitives;
  std::vector<Polyhedron> sets;
  // Sometimes so many that unite_all has tasks and rounds (nef/boolean/union_order.h).
  const std::uint32_t count = choices.one_in(10) ? 130 + choices.below(60) : 1 + choices.below(12);
  for (std::uint32_t i = 0; i < count; ++i) {
    primitives.push_back(random_primitive(choices));
    sets.push_back(primitives.back().make());
    the_case.tell("piece " + primitives.back().text());
  }
  const PieceSource source{.count = static_cast<std::uint32_t>(sets.size()),
                           .set = [&sets](std::uint32_t i, const nef::Monitor&) { return sets[i]; }};
  const TiledPolyhedron united = union_in_tiles(source, tiling, 1 + choices.below(5), tiling.monitor);
  for (int i = 0; i < 30; ++i) {
    Rational3 p;
    for (Rational& x : p) {
      x = Rational(choices.between(-1, 2 * kGrid + 1), 2);
      x.canonicalize();
    }
    const bool wanted =
        std::any_of(primitives.begin(), primitives.end(), [&p](const Primitive& s) { return s.holds(p); });
    Case::require(contains(united, p) == wanted, "membership in a union by regions: at " + to_string(p[0]) + "," +
                                                     to_string(p[1]) + "," + to_string(p[2]));
  }
  const Polyhedron whole = the_case.valid(unite_all(sets), "the union of all");
  const std::string bytes = native_binary(in_canonical_order(whole));
  Case::require(native_binary(united.polyhedron()) == bytes, "bytes: of a union by regions");
  Case::require(native_binary(unite_all(sets, Monitor().on_threads(2))) == native_binary(whole),
                "bytes: of a union on two threads");
  for (std::size_t i = sets.size(); i > 1; --i)
    std::swap(sets[i - 1], sets[choices.below(static_cast<std::uint32_t>(i))]);
  Case::require(native_binary(in_canonical_order(unite_all(sets))) == bytes, "bytes: of a union in another order");
  const Polyhedron solid = regularize(whole);
  if (!solid.is_bounded() || solid.is_empty()) return;
  const TiledPolyhedron pieces =
      tiles_from_mesh(to_mesh(solid).mesh, {.monitor = tiling.monitor}, tiling, nullptr, 1 + choices.below(12));
  Case::require(native_binary(pieces.polyhedron()) == native_binary(in_canonical_order(solid)),
                "bytes: of a mesh that came in by pieces");
  the_case.count("meshes by pieces");
}

}  // namespace

void fuzz_tiles(const Case& the_case) {
  Choices& choices = the_case.choices();
  const std::size_t limit = choices.below(2) == 0 ? 1024 : 16 + choices.below(40);
  HowToTile tiling{{limit}, Monitor().on_threads(1 + choices.below(2))};
  // Next to no memory: every tile goes to a file and comes back.
  if (choices.one_in(4)) tiling.store = std::make_shared<TileStore>(std::filesystem::temp_directory_path(), 1);
  the_case.tell("at most " + std::to_string(tiling.limit) + " vertices in a tile");
  const Fold fold = random_fold(the_case, tiling, 0);
  the_case.tell(fold.steps_text());
  check(the_case, fold);
  check_rays(the_case, fold);
  check_pieces(the_case, tiling);
}

}  // namespace nef::fuzz
