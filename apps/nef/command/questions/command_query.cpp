// SPDX-License-Identifier: Apache-2.0
//
// nef locate | ray
#include "apps/nef/command/commands.h"
#include "apps/program/numbers.h"
#include "apps/program/tile_flags.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/query/location_name.h"
#include "nef/tiles/storage/tile_folder.h"

namespace nef {
namespace {

Json location_json(const Session& session, const Rational3& point, const Location& location) {
  return {{"point", point_json(point)},
          {"kind", location_name(location.kind)},
          {"index", names_tile_folder(session.input) ? Json() : Json(location.index)},
          {"selected", location.mark != 0}};
}

// What is in tiles is asked there; items have no numbers then.
template <typename Ask>
auto ask(Session& session, Ask&& question) {
  if (names_tile_folder(session.input)) {
    return question(load_tiled(session, session.input, choose_tiles({}, session, session.input).tiling));
  }
  return question(session.load(session.input));
}

void prepare(const Polyhedron& set) { static_cast<void>(set.queries()); }
void prepare(const TiledPolyhedron&) {}

std::string location_text(const Location& location) {
  return std::string(location_name(location.kind)) + ", " + (location.mark != 0 ? "selected" : "not selected");
}

using Words = std::vector<std::string>;

void run_locate(Session& session, const Words& points) {
  std::vector<Rational3> queries;
  for (const std::string& text : points) queries.push_back(parse_triple(text, "point"));
  ask(session, [&](const auto& set) {
    const Stopwatch build;
    prepare(set);
    const double build_s = build.seconds();
    const Stopwatch watch;
    Json results = Json::array();
    for (const Rational3& point : queries) {
      const Location location = locate(set, point);
      results.push_back(location_json(session, point, location));
      session.say(point_text(point) + ": " + location_text(location));
    }
    if (!session.json) return;
    session.spent("build", build_s);
    session.spent("op", watch.seconds());
    session.print("locate", {{"points", std::move(results)}});
  });
}

void run_ray(Session& session, const std::array<std::string, 2>& ray) {
  const Rational3 origin = parse_triple(ray[0], "origin");
  const Rational3 direction = parse_triple(ray[1], "direction");
  ask(session, [&](const auto& set) {
    const Stopwatch watch;
    const std::optional<RayHit> hit = shoot_ray(set, origin, direction);
    if (session.json) {
      session.spent("op", watch.seconds());
      session.print("ray", {{"hit", hit ? location_json(session, hit->point, hit->location) : Json()}});
    } else {
      session.say(hit ? point_text(hit->point) + ": " + location_text(hit->location) : "nothing");
    }
  });
}

}  // namespace

Commands query_commands() {
  return {with_flags<Words>(
              {.name = "locate", .description = "Which vertex, edge, facet or volume contains a point?"},
              [](CLI::App& command, Session&, Words& points) {
                command.add_option("points", points, "Points x,y,z")->required()->type_name("X,Y,Z");
              },
              run_locate),
          with_flags<std::array<std::string, 2>>(
              {.name = "ray", .description = "What does a ray meet first?"},
              [](CLI::App& command, Session&, std::array<std::string, 2>& ray) {
                command.add_option("origin", ray[0], "Where the ray begins; not part of it")
                    ->required()
                    ->type_name("X,Y,Z");
                command.add_option("direction", ray[1], "Where it goes")->required()->type_name("DX,DY,DZ");
              },
              run_ray)};
}

}  // namespace nef
