// SPDX-License-Identifier: Apache-2.0
#include "apps/program/set_info.h"
#include "apps/studio/panels/expression_field.h"
#include "apps/studio/panels/panel.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::studio {

PanelResult sets_panel(const Json& request, const PanelContext& context) {
  const Stopwatch watch;
  Messages notes;
  const Polyhedron set = set_of_field(request, "text", context, notes);
  PanelResult result;
  result.report["op_s"] = watch.seconds();
  result.report["result"] = set_info(set, {}, context.monitor);
  result.report["notes"] = notes;
  view::Layer& layer = result.layers.emplace_back();
  layer.name = "result";
  layer.scene = view::build_scene(set, {}, context.monitor);
  result.sets.emplace("result", set);
  return result;
}

}  // namespace nef::studio
