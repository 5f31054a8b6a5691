// SPDX-License-Identifier: Apache-2.0
//
// What a panel of the page computes: a request of its script in, a report, things to draw and sets out. A new panel is
// a function of this type and a row in panels.h.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/studio/caches/expression_cache.h"
#include "apps/studio/caches/loaded_files.h"
#include "apps/studio/caches/scene_cache.h"
#include "apps/studio/caches/silhouette_cache.h"
#include "apps/studio/pages/page_table.h"
#include "apps/studio/root/root_folder.h"
#include "apps/studio/tiles/tile_pieces.h"
#include "apps/view/layer.h"
#include "nef/base/monitor.h"

namespace nef::studio {

using Json = nlohmann::ordered_json;

/// What a panel works with.
struct PanelContext {
  const RootFolder& root;
  LoadedFiles& files;
  ExpressionCache& expressions;
  TilePieces& tiles;
  SilhouetteCache& silhouettes;
  SceneCache& scenes;
  PieceNumbers& piece_numbers;
  Monitor monitor;
};

/// What it has found.
struct PanelResult {
  Json report = Json::object();     ///< for the script of the panel
  std::vector<view::Layer> layers;  ///< for the viewer
  std::vector<Piece> pieces;        ///< further ones
  Sets sets;                        ///< what can be exported, by name
};

/// Throws InputError, of a field of the request (FieldError) where there is one.
using Panel = std::function<PanelResult(const Json& request, const PanelContext& context)>;

/// What is wrong with a field of a request, and where in its text.
class FieldError : public InputError {
 public:
  FieldError(std::string field, std::size_t offset, const std::string& what)
      : InputError(what), field_(std::move(field)), offset_(offset) {}
  [[nodiscard]] const std::string& field() const { return field_; }
  /// Bytes of UTF-8 before the place of the error.
  [[nodiscard]] std::size_t offset() const { return offset_; }

 private:
  std::string field_;
  std::size_t offset_;
};

/// The text of a request's member. Throws InputError if it is not there or no text.
std::string text_of(const Json& request, const std::string& member);

/// An expression: {"text", "crossings": the rule for meshes, "part": an expression whose box is wanted, "shapes":
/// whether its shapes are told apart by colour, and what set_questions.h asks}; of these, what is wrong is
/// "question_error" of the report. Sets: "result", "section".
PanelResult sets_panel(const Json& request, const PanelContext& context);
/// Two operands: {"a", "b", "kind", "radius", "splits", "from": where the tool B begins}. Sets: "result"; of a reach
/// "positions", "touched", "untouched".
PanelResult sums_panel(const Json& request, const PanelContext& context);
/// A scene of a visual hull: {"scene": its file, "off": numbers of views, "threshold", "mask", "simplify", "residuals":
/// suspects, too, "colors", "overlay": the number of a view}. Sets: "result".
PanelResult hulls_panel(const Json& request, const PanelContext& context);
/// A scene of the planner: {"scene": what the file says (JSON, or a .cfg file of OMPL.app), "folder": where it is,
/// "start", "goal": numbers as `planner --start` takes them, "moves": translations by the numbers of obstacles, "free":
/// whether free space is wanted, "dragged": whether any path will do, "ompl": a planner to run beside ours, "seconds":
/// its time}. Sets: "robot", and "free space" if it was made.
PanelResult planner_panel(const Json& request, const PanelContext& context);

}  // namespace nef::studio
