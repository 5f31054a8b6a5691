// SPDX-License-Identifier: Apache-2.0
//
// Fields of a page that hold expressions.
#pragma once

#include <string>

#include "apps/studio/panels/panel.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::studio {

/// The set of the expression in a member of a request, as `nef eval` computes it; files are those below the root.
/// Throws FieldError.
Polyhedron set_of_field(const Json& request, const std::string& field, const PanelContext& context, Messages& messages);

/// The same with the shapes that it is made of; the set in tiles, if they are wanted, where ExpressionCache takes them.
ExpressionCache::Result set_and_shapes_of_field(const Json& request, const std::string& field,
                                                const PanelContext& context, bool tiles, Messages& messages);

/// The language of expressions for the editor: {"functions": [{"name", "usage"}], "formats": [extensions that are
/// written], "planners": names of OMPL's planners}.
Json language_json();

}  // namespace nef::studio
