// SPDX-License-Identifier: Apache-2.0
//
// nef view | picture
#include <cmath>
#include <filesystem>

#include "apps/nef/command/commands.h"
#include "apps/program/numbers.h"
#include "apps/view/glb.h"
#include "apps/view/page.h"
#include "apps/view/picture.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/file_bytes.h"

namespace nef {
namespace {

// Each file as a layer with the file's name.
std::vector<view::Layer> load_layers(Session& session, view::SceneOptions options) {
  std::vector<Polyhedron> sets;
  for (const std::string& path : session.inputs) sets.push_back(session.load(path));
  options.box = view::visible_box(sets);
  std::vector<view::Layer> layers;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    view::Layer& layer = layers.emplace_back();
    layer.name = std::filesystem::path(session.inputs[i]).filename().string();
    layer.scene = view::build_scene(sets[i], options, session.monitor);
  }
  return layers;
}

void report(Session& session, const std::string& command, double view_s, const std::vector<view::Layer>& layers) {
  if (!session.json) return;
  std::size_t triangles = 0;
  for (const view::Layer& layer : layers) triangles += layer.scene.triangles.size();
  session.spent("view", view_s);
  session.print(command, {{"output", session.output}, {"layers", layers.size()}, {"triangles", triangles}});
}

void add_view_output(CLI::App& command, Session& session, const std::string& description) {
  command.add_option("-o,--output", session.output, description)->required()->type_name("FILE");
}

void run_view(Session& session) {
  const std::string extension = lower_extension(session.output);
  if (extension != "html" && extension != "glb") {
    throw InputError(session.output + ": the extension must be .html (a page) or .glb (glTF)");
  }
  const std::vector<view::Layer> layers = load_layers(session, {});
  const Stopwatch watch;
  if (extension == "glb") {
    view::write_glb(layers, session.output);
  } else {
    view::PageOptions options;
    options.title = layers.size() == 1 ? layers[0].name : std::to_string(layers.size()) + " sets";
    view::write_page(layers, session.output, options);
  }
  session.say("wrote " + session.output);
  report(session, "view", watch.seconds(), layers);
}

// "1200x900"
void parse_size(const std::string& text, view::PictureOptions& options) {
  const std::size_t x = text.find('x');
  const auto number = [&text](const std::string& part) {
    if (part.empty() || part.size() > 5 || part.find_first_not_of("0123456789") != std::string::npos) {
      throw InputError("--size: expected WIDTHxHEIGHT, as in 1200x900, instead of '" + text + "'");
    }
    return static_cast<std::uint32_t>(std::stoul(part));
  };
  options.width = number(text.substr(0, x));
  options.height = number(x == std::string::npos ? "" : text.substr(x + 1));
}

// Without --from a section is seen from the side that was cut away, a little from above and aside.
view::Point towards_section(const std::array<Rational, 4>& section) {
  view::Point normal{nearest_double(section[0]), nearest_double(section[1]), nearest_double(section[2])};
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  const view::Point aside{0.3, -0.4, 0.35};
  for (std::size_t i = 0; i < 3; ++i) normal[i] = normal[i] / length + aside[i];
  return normal;
}

struct PictureFlags {
  std::string from;
  std::string size;
  std::string section;
};

void add_picture_options(CLI::App& command, Session& session, PictureFlags& flags) {
  add_view_output(command, session, "The picture (.png)");
  command.add_option("--from", flags.from, "Direction from the centre to the camera")->type_name("X,Y,Z");
  command.add_option("--size", flags.size, "Pixels; 1200x900 if not given")->type_name("WxH");
  command.add_option("--section", flags.section, "Show only ax+by+cz+d <= 0, cut exactly")->type_name("A,B,C,D");
}

void run_picture(Session& session, const PictureFlags& flags) {
  if (lower_extension(session.output) != "png") throw InputError(session.output + ": the extension must be .png");
  view::SceneOptions scene;
  scene.indices = false;
  view::PictureOptions picture;
  if (!flags.size.empty()) parse_size(flags.size, picture);
  if (!flags.section.empty()) scene.section = parse_plane(flags.section, "--section");
  if (!flags.from.empty()) {
    const Rational3 from = parse_triple(flags.from, "--from x,y,z");
    picture.from = {nearest_double(from[0]), nearest_double(from[1]), nearest_double(from[2])};
  } else if (scene.section && ((*scene.section)[0] != 0 || (*scene.section)[1] != 0 || (*scene.section)[2] != 0)) {
    picture.from = towards_section(*scene.section);
  }
  const std::vector<view::Layer> layers = load_layers(session, scene);
  const Stopwatch watch;
  view::write_picture(layers, session.output, picture);
  session.say("wrote " + session.output);
  report(session, "picture", watch.seconds(), layers);
}

}  // namespace

Commands view_commands() {
  Command view{.name = "view",
               .description = "Write a page that shows sets in a browser",
               .operands = "Files of the sets; each becomes a layer",
               .most = kAnyNumber,
               .run = run_view};
  view.add_options = [](CLI::App& command, Session& session) {
    add_view_output(command, session, "The page (.html, self-contained) or a glTF file (.glb)");
  };
  return {std::move(view), with_flags<PictureFlags>({.name = "picture",
                                                     .description = "Draw sets as a PNG picture, without a browser",
                                                     .operands = "Files of the sets",
                                                     .most = kAnyNumber},
                                                    add_picture_options, run_picture)};
}

}  // namespace nef
