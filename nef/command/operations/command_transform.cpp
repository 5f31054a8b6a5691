// SPDX-License-Identifier: Apache-2.0
//
// nef transform
#include <map>

#include "nef/command/commands.h"
#include "nef/program/expression/expression.h"
#include "nef/program/numbers.h"

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

AffineMap matrix_map(const std::string& text) { return affine_map_of(parse_numbers(text, "--matrix")); }

}  // namespace

void add_transform_command(CLI::App& app, Session& session) {
  using Make = AffineMap (*)(const std::string&);
  // The texts of each kind of option, and its maker; shared with the callback.
  struct Steps {
    std::map<const CLI::Option*, std::pair<Make, std::vector<std::string>>> of;
  };
  const auto steps = std::make_shared<Steps>();
  CLI::App* command =
      add_subcommand(app, session, "transform", "The image under an affine map; steps are done in the order given");
  command->add_option("input", session.input, "The set, as a file")->required();
  const auto step = [&](const std::string& flag, const std::string& type, Make make, const std::string& text) {
    // One text for each occurrence, so that steps may be repeated.
    CLI::Option* option = command->add_option_function<std::vector<std::string>>(
        flag, [](const std::vector<std::string>&) {}, text);
    option->type_name(type)->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    steps->of[option] = {make, {}};
  };
  step(
      "--translate", "X,Y,Z", [](const std::string& t) { return AffineMap::translate(parse_triple(t, "--translate")); },
      "Move by a vector");
  step("--scale", "S|SX,SY,SZ", scale_map, "Scale about the origin");
  step("--rotate", "AXIS,DEGREES[,TOLERANCE]", rotation_map,
       "Rotate about an axis (x, y, z or a,b,c) through the origin, by an angle within the tolerance (1e-9 degrees), "
       "exactly orthogonally");
  step("--matrix", "NUMBERS", matrix_map, "12 or 16 numbers: the rows of a 3x4 or 4x4 matrix, separated by commas");
  add_input_flags(command, session);
  add_output_flags(command, session);
  command->callback([&session, command, steps] {
    AffineMap map = AffineMap::identity();
    std::map<const CLI::Option*, std::size_t> used;
    for (const CLI::Option* option : command->parse_order()) {
      const auto found = steps->of.find(option);
      if (found == steps->of.end()) continue;
      const std::size_t i = used[option]++;
      if (i < option->results().size()) map = found->second.first(option->results()[i]).after(map);
    }
    const Polyhedron set = session.load(session.input);
    finish(session, "transform",
           measure(1, session.monitor, [&](const Monitor& monitor) { return transform(set, map, monitor); }));
  });
}

}  // namespace nef
