// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/run_state.h"

#include "apps/studio/panels/panels.h"
#include "nef/base/error.h"
#include "nef/io/polyhedron_file.h"

namespace nef::studio {
namespace {

constexpr std::size_t kMostOfState = std::size_t{8} << 20U;

// What the page would ask for, from what it keeps.
Json request_of(const std::string& panel, Json state) {
  if (panel == "planner") state["scene"] = state.value("text", Json());
  const Json questions = state.value("questions", Json());
  if (panel == "sets" && questions.is_object()) state.update(questions.value("request", Json::object()));
  return state;
}

}  // namespace

void run_state(const StudioOptions& options, const std::string& output, std::ostream& out) {
  const RootFolder root(options.root);
  const std::string file = options.files.empty() ? "" : options.files.front();
  if (!file.ends_with(".nefstudio")) throw InputError("--run computes a .nefstudio file; name one");
  const Json state = Json::parse(root.read(file, kMostOfState), nullptr, false);
  if (!state.is_object() || state.value("nefstudio", Json()) != 1)
    throw InputError(file + ": not a state of the studio");
  const std::string name = text_of(state, "panel");
  const auto panel = panels().find(name);
  if (panel == panels().end() || !state.contains(name)) throw InputError(file + ": it has no panel '" + name + "'");
  LoadedFiles files;
  ExpressionCache expressions;
  PieceNumbers numbers;
  TilePieces tiles(numbers);
  SilhouetteCache silhouettes;
  SceneCache scenes(numbers);
  Computation computation(options.limits);
  computation.run(options.threads, [&](const Monitor& monitor) {
    const PanelContext context{root, files, expressions, tiles, silhouettes, scenes, numbers, monitor};
    const PanelResult result = panel->second(request_of(name, state[name]), context);
    if (!output.empty()) {
      const auto set = result.sets.contains("result") ? result.sets.find("result") : result.sets.begin();
      if (set == result.sets.end()) throw InputError(file + ": this panel leaves no set to write");
      PolyhedronWriteOptions how;
      how.monitor = monitor;
      Messages notes;
      set->second.write(output, how, notes);
    }
    out << result.report.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  });
}

}  // namespace nef::studio
