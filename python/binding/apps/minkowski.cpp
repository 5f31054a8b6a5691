// SPDX-License-Identifier: Apache-2.0
//
// The extension module nef._minkowski: the functions of apps/minkowski with their docstrings, which the package
// nef.minkowski re-exports. Arguments are converted while Python's lock is held, and computed with after it is released
// (`call`).
#include "apps/minkowski/minkowski.h"

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/minkowski/in_tiles.h"
#include "apps/minkowski/morphology.h"
#include "apps/minkowski/simplified/simplified_offset.h"

#include "binding/base/arguments.h"
#include "binding/base/bindings.h"
#include "binding/base/errors.h"
#include "binding/base/signatures.h"
#include "nef/distance/distance.h"
#include "nef/polyhedron.h"

namespace nef::python {
namespace {

// What all functions that take sums are told beside their operands.
struct HowToSum {
  unsigned threads = 1;
  py::object progress;
  std::string strategy;
  py::object report;
};

minkowski::UnionStrategy strategy_named(const std::string& name) {
  for (const auto& [known, strategy] : minkowski::kUnionStrategies) {
    if (name == known) return strategy;
  }
  throw InputError("union must be 'auto', 'convolution' or 'queue'");
}

// The keys are those of the program's report.
void fill(const py::object& report, const minkowski::MinkowskiReport& counts) {
  if (report.is_none()) return;
  py::dict found = report;
  py::list strategies;
  for (const minkowski::StrategyChoice& choice : counts.choices) {
    py::dict entry;
    entry["chosen"] = choice.chosen;
    entry["why"] = choice.why;
    if (choice.pairs_of_cells != 0) {
      py::dict estimates;
      estimates["pairs_of_cells"] = choice.pairs_of_cells;
      estimates["convolution_facets"] = choice.convolution_facets;
      entry["estimates"] = estimates;
    }
    strategies.append(entry);
  }
  found["strategies"] = strategies;
  found["cells"] = py::make_tuple(counts.cells_a, counts.cells_b);
  found["pairs"] = counts.pairs;
  py::dict convolution;
  convolution["facets"] = counts.convolution_facets;
  convolution["intervals"] = counts.convolution_intervals;
  convolution["points"] = counts.convolution_points;
  convolution["regions_tested"] = counts.convolution_regions;
  found["convolution"] = convolution;
  found["seconds"] = counts.seconds_total;
}

// compute(options, report) without Python's lock. Each cell of one operand may be combined with each of the other, so
// small ones may take long.
template <typename Compute>
auto with_sums(const HowToSum& how, Compute&& compute) {
  if (!how.report.is_none() && !py::isinstance<py::dict>(how.report))
    throw py::type_error("report must be a dict or None");
  const ProgressFunction told(how.progress);
  minkowski::MinkowskiOptions options;
  options.strategy = strategy_named(how.strategy);
  const auto counts = std::make_shared<minkowski::MinkowskiReport>();
  auto result = call(kSmallCall, [=, threads = how.threads](const Monitor& monitor) {
    const nef::ProgressFunction tell = [&](const char* phase, std::size_t done, std::size_t total) {
      if (told && phase == minkowski::kSumPhase) told(monitor, std::string(phase), done, total);
      monitor.tell_progress(phase, done, total);
    };
    return compute(minkowski::MinkowskiOptions{options.strategy, monitor.on_threads(threads).telling(tell)},
                   counts.get());
  });
  fill(how.report, *counts);
  return result;
}

template <typename Set>
using Binary = Set (*)(const Set&, const Polyhedron&, const minkowski::MinkowskiOptions&, minkowski::MinkowskiReport*);

// A set, in tiles or not.
using AnySet = std::variant<Polyhedron, Tiles>;

// operation(set, options, report) of either; the result is in tiles if the set is.
template <typename Operation>
AnySet of_any(const AnySet& a, const HowToSum& how, const Operation& operation) {
  if (const auto* const tiled = std::get_if<Tiles>(&a)) {
    const TiledPolyhedron& set = *tiled;
    return Tiles(with_sums(how, [=](const auto& options, auto* counts) { return operation(set, options, counts); }),
                 tiled->threads);
  }
  const Polyhedron& set = std::get<Polyhedron>(a);
  return with_sums(how, [=](const auto& options, auto* counts) { return operation(set, options, counts); });
}

auto binary(Binary<Polyhedron> operation, Binary<TiledPolyhedron> in_tiles) {
  return [operation, in_tiles](const AnySet& a, const Polyhedron& b, unsigned threads, const py::object& progress,
                               const std::string& strategy, const py::object& report) {
    struct Either {
      Binary<Polyhedron> operation;
      Binary<TiledPolyhedron> in_tiles;
      Polyhedron b;
      Polyhedron operator()(const Polyhedron& set, const minkowski::MinkowskiOptions& options,
                            minkowski::MinkowskiReport* counts) const {
        return operation(set, b, options, counts);
      }
      TiledPolyhedron operator()(const TiledPolyhedron& set, const minkowski::MinkowskiOptions& options,
                                 minkowski::MinkowskiReport* counts) const {
        return in_tiles(set, b, options, counts);
      }
    };
    return of_any(a, {threads, progress, strategy, report}, Either{operation, in_tiles, b});
  };
}

auto binary(Binary<Polyhedron> operation) {
  return [operation](const Polyhedron& a, const Polyhedron& b, unsigned threads, const py::object& progress,
                     const std::string& strategy, const py::object& report) {
    return with_sums({threads, progress, strategy, report},
                     [=](const auto& options, auto* counts) { return operation(a, b, options, counts); });
  };
}

minkowski::Side side_of(const std::string& name) {
  if (name == "inner") return minkowski::Side::kInner;
  if (name == "outer") return minkowski::Side::kOuter;
  throw InputError("side must be 'inner' or 'outer'");
}

AnySet offset(const AnySet& a, py::handle radius, int detail, const std::string& side, unsigned threads,
              const py::object& progress, const std::string& strategy, const py::object& report) {
  const Rational r = to_rational(radius);
  const minkowski::Side kind = side_of(side);
  return of_any(a, {threads, progress, strategy, report}, [=](const auto& set, const auto& options, auto* counts) {
    return minkowski::offset(set, r, detail, kind, options, counts);
  });
}

py::object simplified_offset(const Polyhedron& a, py::handle radius, std::optional<std::size_t> triangles,
                             std::optional<int> digits, int detail, const std::string& side, unsigned threads,
                             const py::object& progress, const std::string& strategy, const py::object& report) {
  const Rational r = to_rational(radius);
  const minkowski::Side kind = side_of(side);
  if (triangles && *triangles < 4) throw InputError("a solid has at least 4 triangles");
  const minkowski::SimplifiedOffset found =
      with_sums({threads, progress, strategy, report}, [=](const auto& options, auto* counts) {
        return minkowski::simplified_offset(a, r, detail, kind, {triangles, digits}, options, counts);
      });
  warn(found.notes);
  return result_of("SimplifiedOffset", py::make_tuple(found.set, to_fraction(found.error)));
}

Polyhedron ball(py::handle radius, int detail, const std::string& side) {
  return minkowski::to_polyhedron(minkowski::ball_approximation(to_rational(radius), detail, side_of(side)).cell);
}

py::object ball_error(py::handle radius, int detail, const std::string& side) {
  return to_fraction(minkowski::ball_approximation(to_rational(radius), detail, side_of(side)).error);
}

Polyhedron configuration_space(const Polyhedron& robot, const py::iterable& obstacles, const py::object& box,
                               unsigned threads, const py::object& progress, const std::string& strategy,
                               const py::object& report) {
  const std::vector<Polyhedron> around = sets_of(obstacles);
  std::optional<std::array<Rational3, 2>> bounds;
  if (!box.is_none()) bounds = to_corners(box);
  return with_sums({threads, progress, strategy, report}, [=](const auto& options, auto* counts) {
    return minkowski::configuration_space(robot, around, bounds, options, counts);
  });
}

Polyhedron sweep(const Polyhedron& a, py::handle path, unsigned threads, const py::object& progress,
                 const std::string& strategy, const py::object& report) {
  const std::vector<Rational3> points = to_points(path, "a path");
  return with_sums({threads, progress, strategy, report},
                   [=](const auto& options, auto* counts) { return minkowski::sweep(a, points, options, counts); });
}

py::object penetration(const Polyhedron& a, const Polyhedron& b, unsigned threads, const py::object& progress,
                       const std::string& strategy, const py::object& report) {
  const minkowski::Penetration found =
      with_sums({threads, progress, strategy, report},
                [=](const auto& options, auto* counts) { return minkowski::penetration(a, b, options, counts); });
  return result_of("Penetration", py::make_tuple(contact_name(found.kind), from_triple(found.translation),
                                                 to_fraction(found.squared_length)));
}

py::object reach(const Polyhedron& tool, const Polyhedron& part, const py::object& start, unsigned threads,
                 const py::object& progress, const std::string& strategy, const py::object& report) {
  std::optional<Rational3> from;
  if (!start.is_none()) from = to_triple(start, "a start");
  const minkowski::Reach found =
      with_sums({threads, progress, strategy, report},
                [=](const auto& options, auto* counts) { return minkowski::reach(tool, part, from, options, counts); });
  return result_of("Reach", py::make_tuple(found.positions, found.touched, found.untouched));
}

py::object millable(const Polyhedron& part, const Polyhedron& tool, std::optional<int> axes, unsigned threads,
                    const py::object& progress, const std::string& strategy, const py::object& report) {
  if (axes && *axes != 3) throw InputError("axes must be 3, for a tool that comes from above, or None");
  const auto approach = axes ? minkowski::Approach::kFromAbove : minkowski::Approach::kAnywhere;
  const minkowski::Millable found = with_sums(
      {threads, progress, strategy, report},
      [=](const auto& options, auto* counts) { return minkowski::millable(part, tool, approach, options, counts); });
  return result_of("Millable", py::make_tuple(found.shape, found.unreached));
}

Polyhedron component(const Polyhedron& a, const py::object& point) {
  std::optional<Rational3> inside;
  if (!point.is_none()) inside = to_triple(point, "a point");
  return call(items(a), [=](const Monitor& monitor) { return minkowski::component_of(a, inside, monitor); });
}

std::vector<Polyhedron> decompose(const Polyhedron& a) {
  return call(kSmallCall, [a](const Monitor& monitor) {
    std::vector<Polyhedron> cells;
    for (const minkowski::ConvexCell& cell : minkowski::decompose(a, monitor)) {
      monitor.check_interruption();
      cells.push_back(minkowski::to_polyhedron(cell, monitor));
    }
    return cells;
  });
}

void define_module(py::module_& m) {
  m.doc() = "The core of the package nef.minkowski; see there.";
  py::module_::import("nef._nef");
  const auto bind = [&m](const char* name, const auto& operation, const char* text) {
    m.def(name, operation, py::arg("a"), py::arg("b"), py::arg("threads") = 1, py::arg("progress") = py::none(),
          py::arg("union") = "auto", py::arg("report") = py::none(), text);
  };
  bind("sum", binary(nef::minkowski::minkowski_sum, nef::minkowski::minkowski_sum),
       R"(The Minkowski sum { x + y : x in a, y in b } of any two sets, exactly.

Open and closed parts, lower-dimensional parts and cavities count; empty if one is empty. If a is a TiledPolyhedron, the sum
is one, computed region by region; both must be bounded. threads: 0 for as many as the
machine has; the result does not depend on it. progress: a function of (phase, done, total): thousandths of the work done, 1000.
union: how sums are made, 'convolution' (without cells), 'queue' (of sums of cells) or 'auto'; the set is the same. report: a
dict that receives what was chosen and why ('strategies'), and counts, as in the report of the program `minkowski`. Raises UnsupportedError for unbounded operands with too many reflex edges.)");
  bind("erode", binary(nef::minkowski::erode, nef::minkowski::erode),
       R"(The Minkowski difference: the points x for which b, moved by x, lies in a; exactly.

All of space if b is empty. Sets in tiles, threads, progress, union, report, errors: as for sum.)");
  bind("opening", binary(nef::minkowski::opening, nef::minkowski::opening),
       R"(a eroded by b, plus b: the union of all translates of b that lie in a.

Sets in tiles, threads, progress, union, report, errors: as for sum; progress begins again with the second sum. Raises InputError if b is empty.)");
  bind("closing", binary(nef::minkowski::closing, nef::minkowski::closing),
       R"(a plus b, eroded by b: the points that no translate of -b reaches without meeting a.

Sets in tiles, threads, progress, union, report, errors: as for opening.)");
  m.def("offset", &offset, py::arg("a"), py::arg("radius"), py::arg("detail") = 8, py::arg("side") = "outer",
        py::arg("threads") = 1, py::arg("progress") = py::none(), py::arg("union") = "auto",
        py::arg("report") = py::none(),
        R"(The set grown by a ball of the radius, a number; shrunk for a negative one.

The round ball is replaced by a polyhedron, so that the result lies around what the round one would give (side='outer') or
inside of it ('inner'), and is exact for a ball whose radius is off by at most ball_error(abs(radius), detail, s), where s is
`side`, or the other one for a negative radius. detail: from 1 to 64, see ball. Sets in tiles, threads, progress, union, report, errors: as for sum.)");
  m.def(
      "simplified_offset", &simplified_offset, py::arg("a"), py::arg("radius"), py::arg("triangles") = py::none(),
      py::arg("digits") = py::none(), py::arg("detail") = 8, py::arg("side") = "outer", py::arg("threads") = 1,
      py::arg("progress") = py::none(), py::arg("union") = "auto", py::arg("report") = py::none(),
      R"(An offset of about `triangles` triangles, or whose coordinates have at most `digits` decimals: nef.SimplifiedOffset.

It still lies around the offset by the radius (side='outer') or inside of it ('inner'), and inside or around the one by a
radius that differs by at most its `error`; both is checked exactly. triangles, digits: at least one of them. detail, threads,
progress, union, report: as for offset. Raises InputError if the offset has no bounded solid part, or was to be simplified too
much.)");
  m.def("ball", &ball, py::arg("radius"), py::arg("detail") = 8, py::arg("side") = "inner",
        R"(A polyhedral ball about the origin: an octahedron whose edges are split into `detail` parts, from 1 to 64.

side: 'inner' puts all 4 detail^2 + 2 vertices exactly onto the sphere, 'outer' scales that until all facets are outside of it.
Raises InputError unless the radius, a number, is positive.)");
  m.def("ball_error", &ball_error, py::arg("radius"), py::arg("detail") = 8, py::arg("side") = "inner",
        "A bound on how far the surfaces of ball(radius, detail, side) and of the round ball are apart: a Fraction.");
  m.def("sweep", &sweep, py::arg("a"), py::arg("path"), py::arg("threads") = 1, py::arg("progress") = py::none(),
        py::arg("union") = "auto", py::arg("report") = py::none(),
        R"(The region that a set passes over as it moves along a polyline of at least one point.

path: points in rows, in order. threads, progress, union, report, errors: as for sum.)");
  m.def(
      "penetration", &penetration, py::arg("a"), py::arg("b"), py::arg("threads") = 1, py::arg("progress") = py::none(),
      py::arg("union") = "auto", py::arg("report") = py::none(),
      R"(Whether two bounded sets are disjoint, touch or overlap, and the shortest translation of b that makes them touch: nef.Penetration.

The way out if they overlap, to contact if they are disjoint; closures and interiors decide. Exact. threads, progress, union, report: as for
sum. Raises InputError if one is empty, UnsupportedError if one is unbounded.)");
  bind(
      "no_fit", binary(nef::minkowski::no_fit_set),
      R"(All translations of b for which a and b touch without overlap: facets, edges and points, slots that b fits exactly
among them.

threads, progress, union, report, errors: as for sum.)");
  m.def(
      "reach", &reach, py::arg("tool"), py::arg("part"), py::arg("start") = py::none(), py::arg("threads") = 1,
      py::arg("progress") = py::none(), py::arg("union") = "auto", py::arg("report") = py::none(),
      R"(Where a translating tool can go outside of a part, from infinity or from `start`, and what it touches: nef.Reach.

Contact is free, and so are passages as wide as the tool. Both sets must be bounded (UnsupportedError). threads, progress, union, report: as
for sum. Raises InputError if the tool is empty or the start is not free.)");
  m.def("millable", &millable, py::arg("part"), py::arg("tool"), py::arg("axes") = py::none(), py::arg("threads") = 1,
        py::arg("progress") = py::none(), py::arg("union") = "auto", py::arg("report") = py::none(),
        R"(What a tool that moves without turning leaves of a block around a part that it must not cut: nef.Millable.

It comes from outside along any path; axes=3: down the z axis, so what is above it must be free, too. Both sets must be
bounded (UnsupportedError). threads, progress, union, report: as for sum. Raises InputError if the tool has no volume.)");
  m.def("component", &component, py::arg("a"), py::arg("point") = py::none(),
        R"(The connected component of a set that contains a point; empty if the set does not contain it.

Without a point: the component that reaches infinity. Connected means by paths within the set, passages of dimension 1 and 0 included.)");
  m.def(
      "hull",
      [](const nef::Polyhedron& a) {
        return call(items(a), [a](const nef::Monitor& monitor) { return nef::minkowski::hull(a, monitor); });
      },
      py::arg("a"),
      R"(The convex hull of a set, open where the set is: the hull of an open set is open. nef.hull takes points.)");
  m.def("configuration_space", &configuration_space, py::arg("robot"), py::arg("obstacles"),
        py::arg("box") = py::none(), py::arg("threads") = 1, py::arg("progress") = py::none(),
        py::arg("union") = "auto", py::arg("report") = py::none(),
        R"(Where a translating robot may be: the closed set of positions of its reference point, the origin.

robot: a Polyhedron; obstacles: an iterable of these, taken closed; box: two corners that bound the positions, or None. Contact
is free, so passages as narrow as the robot remain, as facets, edges and vertices.)");
  m.def("decompose", &decompose, py::arg("a"),
        R"(Convex sets whose union is exactly a bounded set: its vertical decomposition.

Those of dimension 3 come first; their interiors are disjoint. Raises UnsupportedError for an unbounded set.)");
  m.def(
      "is_convex",
      [](const nef::Polyhedron& a) {
        return call(items(a), [a](const nef::Monitor& monitor) { return nef::minkowski::is_convex(a, monitor); });
      },
      py::arg("a"), "True if a bounded set is convex: a box without one point of an edge is not.");
  m.def(
      "negate",
      [](const nef::Polyhedron& a) {
        return call(items(a), [a](const nef::Monitor& monitor) { return nef::minkowski::negate(a, monitor); });
      },
      py::arg("a"), "The set of all -x with x in a.");
  give_signatures(m);
  explain_arguments(m);
}

}  // namespace
}  // namespace nef::python

PYBIND11_MODULE(_minkowski, m) { nef::python::define_module(m); }
