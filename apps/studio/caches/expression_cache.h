// SPDX-License-Identifier: Apache-2.0
//
// Sets of expressions, computed from what is kept of earlier ones: whoever types or drags changes one set of a text,
// and the others are there. Large sets are kept and changed in tiles, at the cost of what changes.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/program/expression/expression.h"
#include "apps/program/expression/expression_steps.h"
#include "apps/studio/caches/recently_used.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef::studio {

class ExpressionCache {
 public:
  /// Sets with as many vertices are changed in tiles.
  static constexpr std::size_t kLargeSet = 4000;

  /// What tells of a file before it is read: of its name in an expression.
  using StateOfFile = std::function<FileState(const std::string& name)>;

  /// The set, as one of them.
  struct Result {
    std::optional<Polyhedron> whole;
    std::optional<TiledPolyhedron> tiled;
    std::vector<Polyhedron> shapes;  ///< the sets that the operators of the text join
  };

  /// The set of a text, as evaluate_expression makes it; in tiles if the first set of the text is large and bounded,
  /// has no labels, and all that comes after it leaves it bounded, and `tiles` are wanted. `way`: what else than
  /// texts and files decides what is made; sets are found again for the same one. `told` is where `options`
  /// put what they tell of the sets that they make; `messages` gets it once each, whether a set is made now or was
  /// before. Any number of threads may call it. Throws what evaluate_expression does.
  Result evaluate(const std::string& text, const std::string& way, const ExpressionOptions& options, Messages& told,
                  const StateOfFile& state_of_file, bool tiles, Messages& messages);

 private:
  struct Value {
    Polyhedron set;
    Messages messages;
  };
  Value operand(ExpressionSteps& steps, std::size_t i, const std::string& way, const ExpressionOptions& options,
                const std::vector<FileState>& files, Messages& told);
  std::optional<TiledPolyhedron> in_tiles(const ExpressionSteps& steps, const std::vector<Polyhedron>& sets,
                                          const std::vector<std::vector<FileState>>& files, const std::string& way,
                                          const Monitor& monitor);

  RecentlyUsed<std::string, Value> small_{32};
  RecentlyUsed<std::string, Value> large_{3};
  RecentlyUsed<std::string, TiledPolyhedron> tiled_{6};  // by the keys and operations so far
};

}  // namespace nef::studio
