// SPDX-License-Identifier: Apache-2.0
//
// Visual hulls of random cameras and polygons: a point belongs to the hull iff every camera sees it, in front of
// itself, in its polygons. Cameras share centres and lines of sight, polygons have holes and islands.
#include <algorithm>
#include <cstdlib>
#include <optional>

#include "apps/visual_hull/visual_hull.h"
#include "fuzz/fuzzer.h"
#include "nef/base/error.h"

namespace nef::fuzz {
namespace {

using Planar = std::array<Rational, 2>;
using PlanarRing = std::vector<Planar>;

int turn(const Planar& a, const Planar& b, const Planar& c) {
  return sgn(Rational((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])));
}

// Andrew's monotone chain; counterclockwise, without straight corners. Fewer than three points if they are collinear.
PlanarRing hull_of(PlanarRing points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  PlanarRing hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = hull.size();
    for (const Planar& p : points) {
      while (hull.size() >= base + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

struct TestView {
  std::array<std::array<Rational, 4>, 3> matrix;
  std::vector<PlanarRing> rings;  // each strictly inside the one before, all convex: solid, hole, island

  [[nodiscard]] Rational row(std::size_t i, const Rational3& p) const {
    return matrix[i][0] * p[0] + matrix[i][1] * p[1] + matrix[i][2] * p[2] + matrix[i][3];
  }
  [[nodiscard]] std::optional<Planar> image(const Rational3& p) const {
    const Rational depth = row(2, p);
    if (depth <= 0) return std::nullopt;
    return Planar{row(0, p) / depth, row(1, p) / depth};
  }

  // 1: strictly inside, 0: on the border, -1: outside.
  [[nodiscard]] int place(const Rational3& p) const {
    const std::optional<Planar> at = image(p);
    if (!at) return row(0, p) == 0 && row(1, p) == 0 && row(2, p) == 0 ? 0 : -1;  // the camera's centre
    int rings_around = 0;
    for (const PlanarRing& ring : rings) {
      int least = 1;
      for (std::size_t i = 0; i < ring.size(); ++i)
        least = std::min(least, turn(ring[i], ring[(i + 1) % ring.size()], *at));
      if (least == 0) return 0;
      rings_around += least > 0 ? 1 : 0;
    }
    return rings_around % 2 == 1 ? 1 : -1;
  }
};

Rational3 random_point(Choices& choices, int span) {
  return {choices.between(-span, span), choices.between(-span, span), choices.between(-span, span)};
}

// A camera that looks roughly at the origin, or stands among the points.
TestView random_view(Choices& choices, const std::vector<Rational3>& centres) {
  TestView view;
  const Rational3 centre = choices.element(centres);
  for (;;) {
    std::array<Rational3, 3> rows;
    for (Rational3& row : rows) row = random_point(choices, 1);
    if (choices.below(4) != 3) {  // forward is towards the origin
      for (std::size_t k = 0; k < 3; ++k) rows[2][k] = -sgn(centre[k]);
    }
    const Rational det = rows[0][0] * (rows[1][1] * rows[2][2] - rows[1][2] * rows[2][1]) -
                         rows[0][1] * (rows[1][0] * rows[2][2] - rows[1][2] * rows[2][0]) +
                         rows[0][2] * (rows[1][0] * rows[2][1] - rows[1][1] * rows[2][0]);
    if (det == 0) {
      // Zeros for ever are what a shrunken case draws.
      rows = {Rational3{1, 0, 0}, Rational3{0, 1, 0}, Rational3{0, 0, centre[2] > 0 ? -1 : 1}};
    }
    for (std::size_t i = 0; i < 3; ++i) {
      view.matrix[i] = {rows[i][0], rows[i][1], rows[i][2], 0};
      for (std::size_t k = 0; k < 3; ++k) view.matrix[i][3] -= rows[i][k] * centre[k];
    }
    return view;
  }
}

// Points of a circle around the image of the origin: enough of them for the way that needs no cones.
PlanarRing round_ring(Choices& choices, const TestView& view) {
  const Planar centre = view.image({0, 0, 0}).value_or(Planar{0, 0});
  const Rational radius = Rational(choices.between(1, 6)) / 6;
  PlanarRing ring;
  for (int k = -12; k <= 12; ++k) {
    const Rational t = Rational(k * std::abs(k)) / 36;
    const Rational length = 1 + t * t;
    ring.push_back(
        {Rational(centre[0] + radius * (1 - t * t) / length), Rational(centre[1] + radius * 2 * t / length)});
  }
  return hull_of(ring);
}

// The images of an object (round ones if it has no points), or any polygon where they are none; perhaps with a hole,
// and an island in it.
void add_rings(Choices& choices, const std::vector<Rational3>& object, TestView& view) {
  PlanarRing seen;
  for (const Rational3& p : object) {
    if (const std::optional<Planar> at = view.image(p)) seen.push_back(*at);
  }
  PlanarRing ring = object.empty() ? round_ring(choices, view) : hull_of(seen);
  if (ring.size() < 3) ring = {{0, 0}, {1, 0}, {0, 1}};
  view.rings.push_back(ring);
  for (std::uint32_t more = choices.below(3); more > 0; --more) {
    Planar centre{0, 0};
    for (const Planar& p : ring) centre[0] += p[0], centre[1] += p[1];
    for (Rational& x : centre) x /= static_cast<long>(ring.size());
    for (Planar& p : ring) {
      for (std::size_t k = 0; k < 2; ++k) p[k] = (p[k] + centre[k]) / 2;
    }
    view.rings.push_back(ring);
  }
}

// The same view with an image that is tiny beside its distance from the corner: doubles tell nothing there.
void shrink_image(Choices& choices, TestView& view) {
  const Rational size = Rational(1) / (Integer(3) << choices.between(20, 90));
  const Planar corner{Rational(choices.between(-3000, 3000)) / 3, Rational(choices.between(-3000, 3000)) / 7};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 4; ++k) view.matrix[i][k] = size * view.matrix[i][k] + corner[i] * view.matrix[2][k];
  }
  for (PlanarRing& ring : view.rings) {
    for (Planar& p : ring) {
      for (std::size_t i = 0; i < 2; ++i) p[i] = size * p[i] + corner[i];
    }
  }
}

nef::visual_hull::Scene scene_of(const std::vector<TestView>& views, int half) {
  nef::visual_hull::Scene scene;
  for (std::size_t i = 0; i < views.size(); ++i) {
    nef::visual_hull::View view;
    view.name = "view" + std::to_string(i);
    view.camera = nef::visual_hull::Camera(view.name, views[i].matrix);
    view.polygons.emplace();
    for (const PlanarRing& ring : views[i].rings) {
      nef::visual_hull::Ring points;
      for (const Planar& p : ring) points.emplace_back(p[0], p[1]);
      view.polygons->push_back(points);
    }
    scene.views.push_back(std::move(view));
  }
  if (half > 0) scene.box = nef::visual_hull::WorldBox{{-half, -half, -half}, {half, half, half}};
  return scene;
}

void tell_scene(const Case& the_case, const std::vector<TestView>& views, int half) {
  the_case.tell(half > 0 ? "box of half size " + std::to_string(half) : std::string("no box"));
  for (const TestView& view : views) {
    std::string line = "P =";
    for (const auto& row : view.matrix) {
      for (const Rational& x : row) line += " " + to_string(x);
    }
    the_case.tell(line);
    for (const PlanarRing& ring : view.rings) {
      line = "  polygon";
      for (const Planar& p : ring) line += " (" + to_string(p[0]) + "," + to_string(p[1]) + ")";
      the_case.tell(line);
    }
  }
}

int place(const std::vector<TestView>& views, int half, const Rational3& p) {
  int result = 1;
  for (const Rational& x : p) {
    if (half > 0) result = std::min(result, half - abs(x) > 0 ? 1 : half - abs(x) == 0 ? 0 : -1);
  }
  for (const TestView& view : views) result = std::min(result, view.place(p));
  return result;
}

std::string point_term(const Rational3& p) {
  return "point(" + to_string(p[0]) + "," + to_string(p[1]) + "," + to_string(p[2]) + ")";
}

void check_points(const Case& the_case, const std::vector<TestView>& views, int half,
                  const nef::visual_hull::Result& result) {
  const int reach = half > 0 ? 2 * half + 1 : 7;
  std::size_t corners = 0;
  for (const TestView& view : views) {
    for (const PlanarRing& ring : view.rings) corners += ring.size();
  }
  // Many corners take long to look at.
  const int step = corners < 100 ? 1 : 3;
  std::uint64_t points = 0;
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -reach; z <= reach; z += step) {
        ++points;
        Rational3 p{Rational(x, 2), Rational(y, 2), Rational(z, 2)};
        for (Rational& value : p) value.canonicalize();
        const int where = place(views, half, p);
        if (result.vanished) {
          Case::require(where < 1, "vanished: but " + point_term(p) + " is inside for all cameras");
        } else {
          Case::require(contains(result.hull, p) == (where >= 0),
                        "membership: of " + point_term(p) + ", want " + (where >= 0 ? "inside" : "outside"));
        }
      }
    }
  }
  the_case.count("points", points);
}

// The hull by the way that was not gone, as far as it can be.
void check_other_way(const Case& the_case, const std::vector<TestView>& views, int half,
                     const nef::visual_hull::Result& result) {
  nef::visual_hull::Options options;
  options.way = result.direct ? nef::visual_hull::Way::kCones : nef::visual_hull::Way::kDirect;
  std::optional<nef::visual_hull::Result> other;
  try {
    other = nef::visual_hull::compute(scene_of(views, half), ".", options);
  } catch (const Error&) {
    Case::require(!result.direct, "refused: by cones");
    the_case.count("not vertex by vertex");
    return;
  }
  the_case.count("both ways");
  other->hull = the_case.valid(other->hull, "the hull of the other way");
  Case::require(equal(other->hull, result.hull), "equality: vertex by vertex and by cones differ");
}

}  // namespace

void fuzz_silhouettes(const Case& the_case) {
  Choices& choices = the_case.choices();
  // Without a box the cones have to bound the scene: more cameras, all around and outside of it.
  const int half = choices.below(2) == 1 ? 0 : choices.between(2, 3);
  const bool is_round = choices.one_in(3);
  std::vector<Rational3> centres;
  for (std::uint32_t i = half > 0 ? 1 + choices.below(3) : 4 + choices.below(3); i > 0; --i) {
    Rational3 centre = random_point(choices, half > 0 ? 1 : 2);
    const int distance = choices.between(half > 0 ? 0 : 3, 6);
    for (Rational& x : centre) {
      x *= distance;
      if (is_round) x += Rational(static_cast<long>(choices.below(97)), 101);  // in general position
    }
    centres.push_back(centre);
  }
  std::vector<Rational3> object;
  for (std::uint32_t i = is_round ? 0 : 4 + choices.below(5); i > 0; --i) object.push_back(random_point(choices, 2));
  std::vector<TestView> views;
  for (std::uint32_t i = half > 0 ? 1 + choices.below(4) : 3 + choices.below(4); i > 0; --i) {
    views.push_back(random_view(choices, is_round ? std::vector{centres[views.size() % centres.size()]} : centres));
    add_rings(choices, object, views.back());
    if (choices.one_in(4)) shrink_image(choices, views.back());
  }
  tell_scene(the_case, views, half);

  nef::visual_hull::Options options;
  nef::visual_hull::Result result;
  try {
    result = nef::visual_hull::compute(scene_of(views, half), ".", options);
  } catch (const Error&) {
    Case::require(half == 0, "refused: a scene with a box");
    the_case.count("unbounded");
    return;
  }
  result.hull = the_case.valid(result.hull, "the hull");
  the_case.count(result.vanished ? "vanished" : result.direct ? "vertex by vertex" : "by cones");
  check_points(the_case, views, half, result);
  if (!result.vanished) check_other_way(the_case, views, half, result);
}

}  // namespace nef::fuzz
