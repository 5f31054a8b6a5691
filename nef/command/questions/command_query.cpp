// SPDX-License-Identifier: Apache-2.0
//
// nef locate | ray
#include "nef/base/timing/stopwatch.h"
#include "nef/command/commands.h"
#include "nef/program/numbers.h"
#include "nef/program/tile_flags.h"
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

void add_locate(CLI::App& app, Session& session) {
  CLI::App* command = add_subcommand(app, session, "locate", "Which vertex, edge, facet or volume holds a point?");
  const auto points = std::make_shared<std::vector<std::string>>();
  command->add_option("input", session.input, "The set, as a file")->required();
  command->add_option("points", *points, "Points x,y,z")->required()->type_name("X,Y,Z");
  add_input_flags(command, session);
  command->callback([&session, points] {
    std::vector<Rational3> queries;
    for (const std::string& text : *points) queries.push_back(parse_triple(text, "point"));
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
      if (session.json) {
        session.spent("build", build_s);
        session.spent("op", watch.seconds());
        session.print("locate", {{"points", std::move(results)}});
      }
    });
  });
}

void add_ray(CLI::App& app, Session& session) {
  CLI::App* command = add_subcommand(app, session, "ray", "What does a ray meet first?");
  const auto ray = std::make_shared<std::vector<std::string>>(2);
  command->add_option("input", session.input, "The set, as a file")->required();
  command->add_option("origin", (*ray)[0], "Where the ray begins; not part of it")->required()->type_name("X,Y,Z");
  command->add_option("direction", (*ray)[1], "Where it goes")->required()->type_name("DX,DY,DZ");
  add_input_flags(command, session);
  command->callback([&session, ray] {
    const Rational3 origin = parse_triple((*ray)[0], "origin");
    const Rational3 direction = parse_triple((*ray)[1], "direction");
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
  });
}

}  // namespace

void add_query_commands(CLI::App& app, Session& session) {
  add_locate(app, session);
  add_ray(app, session);
}

}  // namespace nef
