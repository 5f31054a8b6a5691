// SPDX-License-Identifier: Apache-2.0
//
// nef transform
#include <map>

#include "apps/nef/command/commands.h"
#include "apps/program/expression/expression.h"
#include "apps/program/numbers.h"

namespace nef {
namespace {

AffineMap scale_map(const std::string& text) {
  const std::vector<Rational> n = parse_numbers(text, "--scale");
  if (n.size() == 1) return AffineMap::scale({n[0], n[0], n[0]});
  if (n.size() == 3) return AffineMap::scale({n[0], n[1], n[2]});
  throw InputError("--scale: expected one factor or three instead of '" + text + "'");
}

// x|y|z,DEGREES[,TOLERANCE] or a,b,c,DEGREES[,TOLERANCE]
AffineMap rotation_map(const std::string& text) {
  Rational3 axis;
  std::string rest = text;
  std::size_t letters = 0;
  if (text.size() > 1 && text[1] == ',' && text[0] >= 'x' && text[0] <= 'z') {
    axis[static_cast<std::size_t>(text[0] - 'x')] = 1;
    rest = text.substr(2);
    letters = 3;
  }
  const auto refuse = [&text] {
    throw InputError("--rotate: expected AXIS,DEGREES[,TOLERANCE] with an axis x, y, z or a,b,c instead of '" + text +
                     "'");
  };
  if (letters == 0 && rest.find(',') == std::string::npos) refuse();
  const std::vector<Rational> n = parse_numbers(rest, "--rotate");
  const std::size_t count = n.size() + letters;
  if (count != 4 && count != 5) refuse();
  const std::size_t degrees = 3 - letters;
  if (letters == 0) axis = {n[0], n[1], n[2]};
  if (count == 4) return AffineMap::rotate(axis, nearest_double(n[degrees]));
  return AffineMap::rotate(axis, nearest_double(n[degrees]), nearest_double(n[degrees + 1]));
}

AffineMap translation_map(const std::string& text) { return AffineMap::translate(parse_triple(text, "--translate")); }

AffineMap matrix_map(const std::string& text) { return affine_map_of(parse_numbers(text, "--matrix")); }

// The steps in the order in which they are given.
using MapSteps = std::vector<AffineMap>;

void add_transform_options(CLI::App& command, Session&, MapSteps& steps) {
  const auto step = [&](const std::string& flag, const std::string& type, AffineMap (*make)(const std::string&),
                        const std::string& text) {
    // One text for each occurrence, so that steps may be repeated.
    command
        .add_option_function<std::string>(
            flag, [&steps, make](const std::string& value) { steps.push_back(make(value)); }, text)
        ->type_name(type)
        ->trigger_on_parse();
  };
  step("--translate", "X,Y,Z", translation_map, "Move by a vector");
  step("--scale", "S|SX,SY,SZ", scale_map, "Scale about the origin");
  step("--rotate", "AXIS,DEGREES[,TOLERANCE]", rotation_map,
       "Rotate about an axis (x, y, z or a,b,c) through the origin by an exact rotation whose angle is within the "
       "tolerance (1e-9 degrees)");
  step("--matrix", "NUMBERS", matrix_map, "12 or 16 numbers: the rows of a 3x4 or 4x4 matrix, separated by commas");
}

void run_transform(Session& session, const MapSteps& steps) {
  AffineMap map = AffineMap::identity();
  for (const AffineMap& step : steps) map = step.after(map);
  const Polyhedron set = session.load(session.input);
  finish(session, "transform",
         measure(1, session.monitor, [&](const Monitor& monitor) { return transform(set, map, monitor); }));
}

}  // namespace

Commands transform_commands() {
  return {with_flags<MapSteps>({.name = "transform",
                                .description = "Apply an affine map; its steps are applied in the order given",
                                .output = Output::kOptional},
                               add_transform_options, run_transform)};
}

}  // namespace nef
