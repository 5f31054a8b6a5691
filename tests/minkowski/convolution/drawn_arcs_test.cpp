// SPDX-License-Identifier: Apache-2.0
//
// Arcs and circles drawn at once, against overlays of one after the other.
#include "apps/minkowski/convolution/arrangement/drawn_arcs.h"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "nef/sphere_map/overlay.h"
#include "nef/sphere_map/sphere_geometry.h"
#include "nef/validation/validate.h"

namespace {

using nef::Arrangement;
using nef::Direction;
using nef::LabelFunction;
using nef::LabelId;
using nef::PlaneId;
using nef::PlaneTable;
using nef::SphereMapBuffer;
using nef::SphereOverlay;
using nef::minkowski::DrawnArcs;

// Planes through the origin with small normals, so that arcs often share ends, pass through ends of others, and lie
// upon each other.
struct Planes {
  PlaneTable table;
  std::vector<PlaneId> all;

  explicit Planes(int most) {
    for (int x = -most; x <= most; ++x) {
      for (int y = -most; y <= most; ++y) {
        for (int z = -most; z <= most; ++z) {
          if (x != 0 || y != 0 || z != 0) all.push_back(table.intern(x, y, z, 0));
        }
      }
    }
  }
};

class Drawings {
 public:
  Drawings(unsigned seed, int most) : random_(seed), planes_(most) { at_once_.begin(planes_.table, {}); }

  void add() {
    const PlaneId plane = any_plane();
    const auto mark = static_cast<LabelId>(1 + random_() % 7);
    if (random_() % 4 == 0) {
      at_once_.add_circle(plane, mark);
      next_.assign_circle(plane, mark, 0, 0);
      next_.mark = mark;
      overlay_next();
      return;
    }
    const PlaneId s = any_plane();
    const PlaneId t = random_() % 4 == 0 ? s : any_plane();
    if (s.row() == plane.row() || t.row() == plane.row()) return;
    const DrawnArcs::End source = end(s, plane);
    const DrawnArcs::End target = end(plane, t);
    const bool is_half = same_direction(source.direction, target.direction.negated(), {});
    if (!is_half && orientation_on_circle(planes_.table, plane, source.direction, target.direction, {}) <= 0) {
      return;
    }
    at_once_.add_arc(plane, source, target, mark);
    Arrangement drawing;
    drawing.nodes.resize(2);
    drawing.nodes[0].direction = source.direction;
    drawing.nodes[0].mark = source.mark;
    drawing.nodes[1].direction = target.direction;
    drawing.nodes[1].mark = target.mark;
    drawing.arcs.push_back({plane, 0, 1, mark, 0, 0});
    drawing.centre = mark;
    drawing.sort_around_nodes(planes_.table, {});
    drawing.simplify_and_assemble(planes_.table, next_, {});
    overlay_next();
  }

  void compare() {
    SphereMapBuffer map;
    at_once_.finish(one_by_one_.mark, map);
    REQUIRE(validate(planes_.table, map.view()) == "");
    const LabelFunction differ(8, 8, [](LabelId a, LabelId b) { return static_cast<LabelId>(a ^ b); });
    SphereMapBuffer difference;
    overlay_.overlay(planes_.table, map.view(), one_by_one_.view(), differ, difference, {});
    CHECK(map.svertices.size() == one_by_one_.svertices.size());
    CHECK(map.shalfedges.size() == one_by_one_.shalfedges.size());
    CHECK(map.sfaces.size() == one_by_one_.sfaces.size());
    CHECK(difference.view().trivial());
    CHECK(difference.mark == 0);
    CHECK(difference.sfaces[0].mark == 0);
  }

  [[nodiscard]] bool is_empty() const { return first_; }

 private:
  PlaneId any_plane() { return planes_.all[random_() % planes_.all.size()]; }

  DrawnArcs::End end(PlaneId p, PlaneId q) {
    const auto number = [](PlaneId x) { return std::uint64_t{2} * x.row() + (x.flipped() ? 1 : 0); };
    const std::uint64_t key = random_() % 2 == 0 ? 0 : 1 + 1024 * number(p) + number(q);
    return {Direction::cross(planes_.table, p, q), static_cast<LabelId>(random_() % 8), key};
  }

  void overlay_next() {
    if (first_) {
      one_by_one_ = next_;
    } else {
      const LabelFunction both(8, 8, [](LabelId a, LabelId b) { return static_cast<LabelId>(a | b); });
      SphereMapBuffer result;
      overlay_.overlay(planes_.table, one_by_one_.view(), next_.view(), both, result, {});
      one_by_one_ = result;
    }
    first_ = false;
  }

  std::mt19937 random_;
  Planes planes_;
  DrawnArcs at_once_;
  SphereOverlay overlay_;
  SphereMapBuffer one_by_one_, next_;
  bool first_ = true;
};

TEST_CASE("arcs and circles that are drawn at once are the overlay of all of them") {
  for (unsigned seed = 0; seed < 400; ++seed) {
    CAPTURE(seed);
    Drawings drawings(seed, 1);
    for (unsigned k = 0; k < 2 + seed % 7; ++k) drawings.add();
    if (!drawings.is_empty()) drawings.compare();
  }
}

// Above some number of nodes, equal ones are found in another way.
TEST_CASE("many arcs and circles that are drawn at once are the overlay of all of them") {
  for (unsigned seed = 0; seed < 3; ++seed) {
    CAPTURE(seed);
    Drawings drawings(seed, 2);
    for (unsigned k = 0; k < 24; ++k) drawings.add();
    drawings.compare();
  }
}

}  // namespace
