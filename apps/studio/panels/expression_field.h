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

/// The same, in tiles where ExpressionCache takes them.
ExpressionCache::Result set_or_tiles_of_field(const Json& request, const std::string& field,
                                              const PanelContext& context, Messages& messages);

/// The language of expressions for the editor: {"functions": [{"name", "usage"}], "formats": [extensions that are
/// written]}.
Json language_json();

}  // namespace nef::studio
