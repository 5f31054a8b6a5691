// SPDX-License-Identifier: Apache-2.0
//
// Coplanar pieces nested in each other: a piece of a plane is divided by slits, gets loops of slits, holes, islands,
// diamonds and isolated points, and so do its parts; in one or two planes, as sheets or as sides of a solid; then walls
// and prisms cut through all of it. Marks and topological operations come midway. The oracle is a tiling.
#include <algorithm>

#include "fuzz/fuzzer.h"
#include "fuzz/tiling.h"
#include "nef/construct/construct.h"

namespace nef::fuzz {
namespace {

constexpr int kWidth = 14;
constexpr int kHeight = 4;
using Marks = Tiling::Marks;
using Ring = std::vector<std::array<int, 2>>;

struct Rectangle {
  int x0, y0, x1, y1;
  [[nodiscard]] int width() const { return x1 - x0; }
  [[nodiscard]] int height() const { return y1 - y0; }
};

Ring ring_of(const Rectangle& r) { return {{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}; }
Ring diamond(int x, int y, int radius) { return {{x, y - radius}, {x + radius, y}, {x, y + radius}, {x - radius, y}}; }

// The prism as the suite makes it, and as text for `nef eval`.
std::vector<Rational3> corners(const Prism& prism) {
  std::vector<Rational3> points;
  for (const std::array<int, 2>& p : prism.base) points.push_back({p[0], p[1], prism.bottom});
  if (prism.top == prism.bottom) return points;
  for (const std::array<int, 2>& p : prism.base) points.push_back({p[0], p[1], prism.top});
  return points;
}

Polyhedron set_of(const Prism& prism) {
  const std::vector<Rational3> points = corners(prism);
  if (points.size() == 1) return make_point(points[0]);
  if (points.size() == 2) return make_segment(points[0], points[1]);
  if (prism.bottom != prism.top) return convex_hull(points);
  const std::vector<std::vector<Rational3>> rings{points};
  return make_polygon(rings);
}

std::string text_of(const Prism& prism) {
  const std::vector<Rational3> points = corners(prism);
  std::string text = points.size() == 1          ? "point("
                     : points.size() == 2        ? "segment("
                     : prism.bottom != prism.top ? "hull("
                                                 : "polygon(";
  for (const Rational3& p : points) {
    text += "(" + to_string(p[0]) + "," + to_string(p[1]) + "," + to_string(p[2]) + "),";
  }
  text.back() = ')';
  return text;
}

// The set as the suite has it, its marks as the tiling has them, and the expression that makes it.
class Scene {
 public:
  Scene(const Case& the_case, const Tiling& tiling) : case_(the_case), tiling_(tiling), marks_(tiling.size(), 0) {}

  [[nodiscard]] const Polyhedron& set() const { return set_; }
  [[nodiscard]] const Marks& marks() const { return marks_; }
  [[nodiscard]] const std::string& text() const { return text_; }

  // op: one of + - * ^
  void combine(char op, const Prism& prism, bool open = false) {
    Polyhedron other = set_of(prism);
    std::string text = text_of(prism);
    if (open) {  // of a prism of full dimension
      other = interior(other);
      text = "interior(" + text + ")";
    }
    const Marks theirs = tiling_.marks_of(prism, open);
    text_ = "(" + text_ + "\n " + op + " " + text + ")";
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      const bool a = marks_[i] != 0;
      const bool b = theirs[i] != 0;
      marks_[i] = (op == '+' ? a || b : op == '-' ? a && !b : op == '*' ? a && b : a != b) ? 1 : 0;
    }
    set_ = op == '+'   ? unite(set_, other)
           : op == '-' ? subtract(set_, other)
           : op == '*' ? intersect(set_, other)
                       : symmetric_difference(set_, other);
    check_validity();
  }

  // 0 .. 5: interior, closure, boundary, exterior, regularize, complement
  void topological(std::uint32_t kind) {
    static constexpr std::array kNames{"interior", "closure", "boundary", "exterior", "regularize", "complement"};
    const Marks closed = tiling_.closure(marks_);
    const Marks inside = flipped(tiling_.closure(flipped(marks_)));
    text_ = kNames[kind] + ("(" + text_ + ")");
    switch (kind) {
      case 0:
        set_ = interior(set_), marks_ = inside;
        break;
      case 1:
        set_ = closure(set_), marks_ = closed;
        break;
      case 2:
        set_ = boundary(set_);
        for (std::size_t i = 0; i < marks_.size(); ++i) marks_[i] = closed[i] != inside[i] ? 1 : 0;
        break;
      case 3:
        set_ = exterior(set_), marks_ = flipped(closed);
        break;
      case 4:
        set_ = regularize(set_), marks_ = tiling_.closure(inside);
        break;
      default:
        set_ = complement(set_), marks_ = flipped(marks_);
        break;
    }
    case_.count("topological operations");
    check_validity();
  }

  // Labels 0 .. 3: new label = table[old][in the prism or not].
  void relabel(const Prism& prism, const std::array<std::array<std::uint8_t, 2>, 4>& table) {
    const Marks theirs = tiling_.marks_of(prism, false);
    for (std::size_t i = 0; i < marks_.size(); ++i) marks_[i] = table[marks_[i]][theirs[i]];
    set_ = overlay(set_, set_of(prism),
                   [&](LabelId a, LabelId b) -> LabelId { return a < 4 && b < 2 ? table[a][b] : LabelId{0}; });
    text_ = "labelled by " + text_of(prism) + ": " + text_;
    case_.count("overlays with labels");
    check_validity();
  }

 private:
  static Marks flipped(Marks marks) {
    for (std::uint8_t& mark : marks) mark = mark == 0 ? 1 : 0;
    return marks;
  }

  void check_validity() {
    case_.count("operations");
    const std::string broken = validate(set_.complex());
    if (!broken.empty()) {
      case_.tell(text_);
      throw Failure("validate: " + broken);
    }
  }

  const Case& case_;
  const Tiling& tiling_;
  Polyhedron set_;
  Marks marks_;
  std::string text_ = "nothing";
};

// Works on a part of the plane at height z, and on what it leaves there.
class Nester {
 public:
  Nester(Choices& choices, Scene& scene, int z) : choices_(choices), scene_(scene), z_(z) {}

  void nest(const Rectangle& r, unsigned depth) {
    if (depth == 0 || r.width() < 1 || r.height() < 1 || steps_ > 40) return;
    switch (choices_.below(9)) {
      case 0:
        return;
      case 1:
      case 2:
        return divide(r, depth);
      case 3:
      case 4:
        return loop_of_slits(r, depth);
      case 5:
        return hole(r, depth);
      case 6:
        return diamond_piece(r, depth);
      case 7:
        flat(choices_.below(2) == 0 ? '-' : '+', {{inner(r.x0, r.x1), inner(r.y0, r.y1)}});
        return nest(r, depth - 1);
      default:
        return corner_cut(r, depth);
    }
  }

 private:
  void flat(char op, Ring base) {
    ++steps_;
    scene_.combine(op, {std::move(base), z_, z_});
  }
  // A number strictly between, if there is one.
  int inner(int low, int high) { return high - low < 2 ? low : choices_.between(low + 1, high - 1); }
  // A rectangle inside, at a distance of mostly 1.
  Rectangle inset(const Rectangle& r) {
    const auto gap = [&] { return static_cast<int>(choices_.below(5) == 4 ? 0 : 1 + choices_.below(2)); };
    Rectangle result{r.x0 + gap(), r.y0 + gap(), r.x1 - gap(), r.y1 - gap()};
    if (result.x0 >= result.x1) result.x0 = r.x0, result.x1 = r.x1;
    if (result.y0 >= result.y1) result.y0 = r.y0, result.y1 = r.y1;
    return result;
  }

  void divide(const Rectangle& r, unsigned depth) {
    const char op = choices_.one_in(4) ? '^' : '-';
    if (r.width() == r.height() && choices_.one_in(3)) {
      flat(op, {{r.x0, r.y0}, {r.x1, r.y1}});
      return nest(r, depth - 1);
    }
    Rectangle low = r;
    Rectangle high = r;
    if (r.width() > r.height()) {
      low.x1 = high.x0 = inner(r.x0, r.x1);
      flat(op, {{low.x1, r.y0}, {low.x1, r.y1}});
    } else {
      low.y1 = high.y0 = inner(r.y0, r.y1);
      flat(op, {{r.x0, low.y1}, {r.x1, low.y1}});
    }
    nest(low, depth - 1);
    nest(high, depth - 1);
  }

  void loop_of_slits(const Rectangle& r, unsigned depth) {
    const Rectangle in = inset(r);
    const Ring ring = ring_of(in);
    const std::uint32_t left_out = choices_.below(8);  // now and then the loop is open
    for (std::size_t i = 0; i < 4; ++i) {
      if (i + 4 != left_out) flat('-', {ring[i], ring[(i + 1) % 4]});
    }
    nest(in, depth - 1);
  }

  void hole(const Rectangle& r, unsigned depth) {
    const Rectangle in = inset(r);
    flat('-', ring_of(in));
    if (choices_.one_in(3)) {  // an open hole: its border comes back
      const Ring ring = ring_of(in);
      for (std::size_t i = 0; i < 4; ++i) flat('+', {ring[i], ring[(i + 1) % 4]});
    }
    if (choices_.below(3) > 0 && in.width() > 2 && in.height() > 2) {
      const Rectangle island = inset(in);
      flat('+', ring_of(island));
      return nest(island, depth - 1);
    }
    nest(in, depth - 1);
  }

  void diamond_piece(const Rectangle& r, unsigned depth) {
    const int radius = std::min(r.width(), r.height()) / 2;
    if (radius < 1) return;
    const int size = choices_.between(1, radius);
    const int x = choices_.between(r.x0 + size, r.x1 - size);
    const int y = choices_.between(r.y0 + size, r.y1 - size);
    const Ring ring = diamond(x, y, size);
    if (choices_.below(2) == 0) {
      for (std::size_t i = 0; i < 4; ++i) flat('-', {ring[i], ring[(i + 1) % 4]});
    } else {
      flat(choices_.element(std::array{'-', '+', '^'}), ring);
    }
    nest({x - size / 2, y - size / 2, x + size / 2, y + size / 2}, depth - 1);
  }

  void corner_cut(const Rectangle& r, unsigned depth) {
    const int size = choices_.between(1, std::min(r.width(), r.height()));
    flat(choices_.element(std::array{'-', '^'}), {{r.x0, r.y0}, {r.x0 + size, r.y0}, {r.x0, r.y0 + size}});
    nest(r, depth - 1);
  }

  Choices& choices_;
  Scene& scene_;
  int z_;
  int steps_ = 0;
};

Rectangle random_rectangle(Choices& choices, int smallest) {
  const int x = choices.between(1, kWidth - 1 - smallest);
  const int y = choices.between(1, kWidth - 1 - smallest);
  return {x, y, choices.between(x + smallest, kWidth - 1), choices.between(y + smallest, kWidth - 1)};
}

Prism random_prism(Choices& choices) {
  Prism prism;
  if (choices.one_in(3)) {
    const int radius = choices.between(1, (kWidth - 2) / 2);
    prism.base = diamond(choices.between(1 + radius, kWidth - 1 - radius),
                         choices.between(1 + radius, kWidth - 1 - radius), radius);
  } else {
    prism.base = ring_of(random_rectangle(choices, 1));
  }
  prism.bottom = choices.between(1, kHeight - 2);
  prism.top = choices.between(prism.bottom + 1, kHeight - 1);
  return prism;
}

Prism random_wall(Choices& choices) {
  const Rectangle r = random_rectangle(choices, 1);
  Prism wall{{}, choices.between(1, kHeight - 2), kHeight - 1};
  const int diagonal = std::min(r.width(), r.height());
  switch (choices.below(3)) {
    case 0:
      wall.base = {{r.x0, r.y0}, {r.x1, r.y0}};
      break;
    case 1:
      wall.base = {{r.x0, r.y0}, {r.x0, r.y1}};
      break;
    default:
      wall.base = {{r.x0, r.y0}, {r.x0 + diagonal, r.y0 + diagonal}};
      break;
  }
  return wall;
}

void base_and_pieces(Choices& choices, Scene& scene) {
  const Rectangle whole{1, 1, kWidth - 1, kWidth - 1};
  const std::uint32_t base = choices.below(4);
  const int z = 1 + static_cast<int>(choices.below(2));
  if (base < 2) {
    scene.combine('+', {ring_of(whole), z, z});
  } else {
    scene.combine('+', {ring_of(whole), z, z + 1}, base == 3);
  }
  Nester(choices, scene, z).nest(whole, 5);
  if (!choices.one_in(3)) return;
  if (base < 2) scene.combine('+', {ring_of(random_rectangle(choices, 4)), z + 1, z + 1});
  Nester(choices, scene, z + 1).nest(whole, 4);
}

void cut_through(Choices& choices, Scene& scene) {
  for (std::uint32_t i = choices.below(4); i > 0; --i) {
    if (choices.one_in(4)) {
      scene.topological(choices.below(6));
    } else if (choices.one_in(3)) {
      scene.combine(choices.element(std::array{'-', '+', '^'}), random_wall(choices));
    } else {
      scene.combine(choices.element(std::array{'*', '-', '+', '^'}), random_prism(choices), choices.one_in(4));
    }
  }
}

void check_membership(const Case& the_case, const Tiling& tiling, const Scene& scene) {
  // All cells in the planes of the pieces, and some of the others.
  std::uint64_t checked = 0;
  const std::size_t stride = 1 + the_case.choices().below(7);
  for (std::size_t cell = 0; cell < tiling.size(); ++cell) {
    const int layer = tiling.layer(cell);
    if (layer < 1 || layer > 2 * kHeight - 1) continue;
    if ((layer % 2 == 0 ? cell % 2 : cell % (8 + stride)) != 0) continue;
    ++checked;
    const Rational3 p = tiling.point(cell);
    if (locate(scene.set(), p).mark == scene.marks()[cell]) continue;
    the_case.tell(scene.text());
    Case::require(false, "membership: of point(" + to_string(p[0]) + "," + to_string(p[1]) + "," + to_string(p[2]) +
                             "), want " + std::to_string(scene.marks()[cell]));
  }
  the_case.count("points", checked);
}

// What is left of it in a small piece, which moves items into other facets.
void probe(const Case& the_case, const Scene& scene) {
  Choices& choices = the_case.choices();
  Prism small;
  const int z = choices.between(1, kHeight - 1);
  const int x = choices.between(1, kWidth - 1);
  const int y = choices.between(1, kWidth - 1);
  small.base = {{x, y}};
  if (x < kWidth - 1 && y < kWidth - 1 && choices.below(3) != 0) small.base = ring_of({x, y, x + 1, y + 1});
  small.bottom = z;
  small.top = choices.between(z, kHeight - 1);
  Scene part = scene;
  part.combine('*', small);
  const bool any = std::any_of(part.marks().begin(), part.marks().end(), [](std::uint8_t m) { return m != 0; });
  if (part.set().is_empty() == any) {
    the_case.tell(part.text());
    Case::require(false, std::string("emptiness: want ") + (any ? "something" : "the empty set"));
  }
}

}  // namespace

void fuzz_nested(const Case& the_case) {
  Choices& choices = the_case.choices();
  static const Tiling kTiling(kWidth, kHeight);
  Scene scene(the_case, kTiling);
  base_and_pieces(choices, scene);
  cut_through(choices, scene);
  for (int i = 0; i < 3; ++i) probe(the_case, scene);
  if (choices.one_in(5)) {
    std::array<std::array<std::uint8_t, 2>, 4> table{};
    for (auto& row : table) {
      for (std::uint8_t& label : row) label = static_cast<std::uint8_t>(choices.below(4));
    }
    table[0][0] = 0;
    scene.relabel(random_prism(choices), table);
    scene.relabel(random_wall(choices), table);
  }
  check_membership(the_case, kTiling, scene);
}

}  // namespace nef::fuzz
