// SPDX-License-Identifier: Apache-2.0
//
// The validator against complexes that are broken on purpose: every index, mark and plane of a set with items of all
// kinds is changed, one at a time. What it does not report must be another way to say the same, or another set.
#include <catch2/catch.hpp>
#include <functional>
#include <map>

#include "nef/polyhedron.h"
#include "nef/validation/validate.h"
#include "tests/support/literals.h"

namespace nef::test {
namespace {

// A solid with a cavity and a notch, a second one at its edge; a facet, a segment, a point, and single points of
// another mark inside a facet, an edge and a volume; a shell within a shell; optionally unbounded.
Complex specimen(bool unbounded) {
  std::string text =
      "(box(0,0,0,4,4,4) - interior(box(1,1,1,2,2,2)) + box(4,4,0,8,8,4) - box(3,1,3,7/2,2,5)) + "
      "polygon(4,0,2,6,0,2,6,2,2,4,2,2) + point(7,1,1) - point(6,6,4) - point(8,8,2) - point(1/2,1/2,2) + "
      "segment(9,0,0,10,1,1) + (box(-6,-6,-6,-2,-2,-2) - box(-5,-5,-5,-3,-3,-3))";
  if (unbounded) text += " + halfspace(1,1,1,10)";
  return set(text).complex();
}

// Of so many changes one is looked at: a complex has some 20,000, and each takes milliseconds. Prime, so that every
// kind of change has its turn.
#ifdef NEF_SANITIZED
constexpr std::size_t kEvery = 31;
#else
constexpr std::size_t kEvery = 5;
#endif

struct Breaker {
  explicit Breaker(Complex complex) : c(std::move(complex)) {}

  Complex c;
  std::map<std::string, std::size_t> missed;  // changes that were not reported, by field
  std::size_t reported = 0;
  std::size_t changes = 0;
  bool changes_pattern = false;  // that of one vertex, to `map`, whose planes are names
  VertexId changed_vertex{0};
  SphereMapBuffer map{};
  std::function<void()> store{};  // puts back what the complex gave away by value

  void look(const std::string& field) {
    if (changes++ % kEvery != 0) return;
    if (store) store();
    const PatternTable patterns = c.patterns;
    const PatternId old = c.vertices[changed_vertex].pattern;
    if (changes_pattern) c.vertices.set_pattern(changed_vertex, c.patterns.push(map));
    if (validate(c).empty()) {
      ++missed[field];
    } else {
      ++reported;
    }
    if (!changes_pattern) return;
    c.vertices.set_pattern(changed_vertex, old);
    c.patterns = patterns;
  }
  void index(const std::string& field, std::uint32_t& x, std::size_t end) {
    const std::uint32_t old = x;
    for (const std::uint32_t value : {0U, old + 1, old - 1, old ^ 1U, static_cast<std::uint32_t>(end), kNone}) {
      if (value == old) continue;
      x = value;
      look(field);
    }
    x = old;
  }
  template <typename Tag>
  void index(const std::string& field, Id<Tag>& x, std::size_t end) {
    const std::uint32_t old = x.index();
    for (const std::uint32_t value : {0U, old + 1, old - 1, old ^ 1U, static_cast<std::uint32_t>(end), kNone}) {
      if (value == old) continue;
      x = Id<Tag>{value};
      look(field);
    }
    x = Id<Tag>{old};
  }
  void mark(const std::string& field, LabelId& x) {
    const LabelId old = x;
    for (const LabelId value : {LabelId{0}, LabelId{1}, LabelId{2}, kOutside}) {
      if (value == old) continue;
      x = value;
      look(field + (value < 2 ? "" : " out of range"));
    }
    x = old;
  }
  void plane(const std::string& field, PlaneId& x) {
    const PlaneId old = x;
    for (const PlaneId value : {old.opposite(), PlaneId{old.value ^ 2U}, PlaneId{std::uint32_t(2 * c.planes.size())}}) {
      x = value;
      look(field);
    }
    x = old;
  }
  // One plane may have two names.
  void name(const std::string& field, PlaneId& x) {
    const VertexRecord a = c.vertices[changed_vertex];
    const VertexRecord b = c.vertices[changed_vertex.next()];
    std::vector<PlaneId> planes(c.shalfedge_plane.pairs().begin() + pair_of(a.shalfedges),
                                c.shalfedge_plane.pairs().begin() + pair_of(b.shalfedges));
    planes.insert(planes.end(), c.other_planes.begin() + a.other_planes, c.other_planes.begin() + b.other_planes);
    const auto meant = [&planes](PlaneId id) {
      return id.row() < planes.size() ? planes[id.row()].opposite_if(id.flipped()) : PlaneId();
    };
    const PlaneId old = x;
    for (const PlaneId value : {old.opposite(), PlaneId{old.value ^ 2U}, PlaneId{std::uint32_t(2 * planes.size())}}) {
      x = value;
      if (meant(x) != meant(old)) look(field);
    }
    x = old;
  }
  template <typename Index>
  void column(const std::string& field, std::vector<Index>& column, std::size_t end) {
    for (Index& x : column) index(field, x, end);
    column.push_back(Index{0});
    look(field + " too long");
    column.pop_back();
  }

  void sphere_items() {
    for (VertexId id{0}; id.index() < c.vertices.size(); ++id) {
      VertexRecord v = c.vertices[id];
      store = [this, id, &v] { c.vertices.set(id, v); };
      index("begin of svertices", v.svertices, c.svertex_count());
      index("begin of shalfedges", v.shalfedges, c.shalfedge_count());
      index("begin of sloops", v.sloops, c.sloops.size());
      index("begin of sfaces", v.sfaces, c.sface_count());
      index("begin of other planes", v.other_planes, c.other_planes.size());
      std::exchange(store, {})();
    }
    for (const VertexId v : c.vertex_ids()) {
      const PatternId old = c.vertices[v].pattern;
      for (const PatternId none : {PatternId(), PatternId{c.patterns.size()}}) {
        c.vertices.set_pattern(v, none);
        look("pattern");
      }
      c.vertices.set_pattern(v, old);
      change_pattern(v);
    }
    for (PlaneId& p : c.shalfedge_plane.pairs()) plane("plane of a shalfedge", p);
    for (PlaneId& p : c.other_planes) plane("plane of an svertex", p);
    for (SLoop& l : c.sloops) {
      plane("plane of a sloop", l.plane);
      index("sface of a sloop", l.sface, c.sface_count());
      mark("mark of a sloop", l.mark);
    }
  }

  void change_pattern(VertexId v) {
    map.assign(c.patterns.view(c.vertices[v].pattern));
    changed_vertex = v;
    changes_pattern = true;
    mark("mark of a vertex", map.mark);
    for (SVertex& s : map.svertices) {
      name("name of a plane of an svertex", s.p);
      name("name of a plane of an svertex", s.q);
      index("out of an svertex", s.out, map.shalfedges.size());
      if (s.out == kNone) index("sface of an svertex", s.sface, map.sfaces.size());
      mark("mark of an svertex", s.mark);
    }
    for (SHalfedge& e : map.shalfedges) {
      plane("name of the plane of a shalfedge", e.plane);
      index("source", e.source, map.svertices.size());
      index("next", e.next, map.shalfedges.size());
      index("prev", e.prev, map.shalfedges.size());
      index("sface of a shalfedge", e.sface, map.sfaces.size());
      mark("mark of a shalfedge", e.mark);
    }
    for (SFace& f : map.sfaces) {
      index("entries of an sface", f.entries, map.entries.size());
      index("number of entries", f.entry_count, map.entries.size());
      mark("mark of an sface", f.mark);
    }
    for (SFaceEntry& e : map.entries) index("entry", e.index, map.shalfedges.size());
    changes_pattern = false;
  }

  void synthesized_items() {
    column("owner of an svertex", c.svertex_owner.values(), c.vertex_count());
    column("twin", c.twin.values(), c.twin.size());
    column("owner of a pair of shalfedges", c.pair_owner, c.vertex_count());
    column("facet of a shalfedge", c.shalfedge_facet.pairs(), 2 * c.facets.size());
    column("facet of a sloop", c.sloop_facet, 2 * c.facets.size());
    column("shell of an sface", c.sface_shell.values(), c.shells.size());
    for (const FacetId id : c.facets.ids()) {
      Facet f = c.facets[id];
      store = [this, id, &f] { c.facets.set(id, f); };
      plane("plane of a facet", f.plane);
      mark("mark of a facet", f.mark);
      index("first cycle", f.first_cycle, c.cycle_begin.size());
      index("number of cycles", f.cycle_count, c.cycle_begin.size());
      if (f.isolated_count > 0) index("first isolated vertex", f.first_isolated, c.isolated_vertices.size());
      index("number of isolated vertices", f.isolated_count, c.isolated_vertices.size());
      index("volume above", f.volume_above, c.volumes.size());
      index("volume below", f.volume_below, c.volumes.size());
      std::exchange(store, {})();
    }
    column("begin of a cycle", c.cycle_begin.values(), c.corners.size());
    column("corner", c.corners, c.shalfedge_count());
    column("isolated vertex", c.isolated_vertices, c.vertex_count());
    for (Shell& s : c.shells) {
      index("volume of a shell", s.volume, c.volumes.size());
    }
    for (Volume& v : c.volumes) {
      mark("mark of a volume", v.mark);
      index("first shell", v.first_shell, c.shells.size());
      index("number of shells", v.shell_count, c.shells.size());
    }
  }
};

}  // namespace

TEST_CASE("the validator reports every change of an item") {
  for (const bool unbounded : {false, true}) {
    CAPTURE(unbounded);
    Breaker breaker{specimen(unbounded)};
    breaker.sphere_items();
    breaker.synthesized_items();
    CHECK(breaker.reported > 10000 / kEvery);
    // Any shalfedge of an svertex may be the one that it knows, any of a cycle the one by which its sface enters it;
    // and a vertex with the other mark makes another set.
    for (const char* free : {"out of an svertex", "entry", "mark of a vertex"}) breaker.missed.erase(free);
    for (const auto& [field, count] : breaker.missed) {
      CAPTURE(field, count);
      CHECK(count == 0);
    }
    CHECK(validate(breaker.c).empty());
  }
}

TEST_CASE("the validator accepts regions as thin as coordinates are long") {
  const Rational far("1" + std::string(400, '0'));
  const Rational3 apex{1, 1, 1};
  const Rational3 p{1, 2, 2};
  const Rational3 q{1, far, 2};
  const Rational3 r{1, 2, 1};
  const Rational3 s{2, 1, 1};
  const auto triangle = [](const Rational3& a, const Rational3& b, const Rational3& c) {
    return convex_hull(std::vector<Rational3>{a, b, c});
  };
  const Polyhedron fan = unite(unite(triangle(apex, r, p), triangle(apex, q, s)), triangle(apex, s, r));
  CHECK(validate(fan.complex()) == "");
}

TEST_CASE("the validator names the broken invariant and the guilty items") {
  const Complex good = specimen(false);
  const auto broken = [&good](const std::function<void(Complex&)>& change) {
    Complex c = good;
    change(c);
    return validate(c);
  };
  CHECK(broken([](Complex& c) {
          SphereMapBuffer map;
          map.assign(c.patterns.view(c.vertices[VertexId{3}].pattern));
          map.mark = 2;
          c.vertices.set_pattern(VertexId{3}, c.patterns.push(map));
        }) == "marks are below the number of labels, vertex 3");
  CHECK(broken([](Complex& c) { c.svertex_owner[HalfedgeId{0}] = VertexId{1}; }) ==
        "svertices know their vertex, vertex 0");
  CHECK(broken([](Complex& c) { c.twin[HalfedgeId{0}] = HalfedgeId{0}; }) ==
        "twins of halfedges are mutual, halfedge 0");
  CHECK(broken([](Complex& c) { c.points.pop(); }).find("one point for each vertex") == 0);
  CHECK(broken([](Complex& c) { c.corners.pop_back(); }).find("cycle") != std::string::npos);
  CHECK(broken([](Complex& c) {
          std::swap(c.volumes[kOuterVolume].mark, c.volumes[VolumeId{1}].mark);
        }).find("volume") != std::string::npos);
  CHECK(broken([](Complex& c) {
          Facet facet = c.facets[FacetId{2}];
          facet.plane = facet.plane.opposite();
          c.facets.set(FacetId{2}, facet);
        }).find("a facet has an unflipped plane, facet 2") == 0);
  CHECK(broken([](Complex& c) { c.sface_shell[SFaceId{0}] = ShellId(); }).find("sfaces have a shell") == 0);
  CHECK_FALSE(broken([](Complex& c) { ++c.shells[ShellId{1}].volume; }).empty());
}

}  // namespace nef::test
