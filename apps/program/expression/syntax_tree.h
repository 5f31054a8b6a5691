// SPDX-License-Identifier: Apache-2.0
//
// An expression after parsing.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nef/number/number.h"

namespace nef {

/// What a node of the tree makes.
enum class Term : std::uint8_t {
  kNothing,
  kVariable,
  kBlock,
  kEverything,
  kFile,
  kBox,
  kHalfspace,
  kPoint,
  kSegment,
  kPolyline,
  kHull,
  kHullOfSets,
  kSphere,
  kCylinder,
  kMinkowski,
  kErode,
  kBall,
  kPolygon,
  kChain,
  kUnion,
  kIntersection,
  kDifference,
  kSymmetricDifference,
  kComplement,
  kInterior,
  kClosure,
  kBoundary,
  kExterior,
  kRegularize,
  kTranslate,
  kScale,
  kRotate,
  kTransform,
};

/// A set, and how it is made from other sets and numbers. A block has the sets of its variables, each of which may use
/// those before it, and then the set that the whole text stands for.
struct SyntaxNode {
  Term term = Term::kNothing;
  std::size_t offset = 0;  ///< bytes before its name or operator
  std::vector<SyntaxNode> sets;
  std::vector<Term> operators;    ///< of a chain: between its sets, done from left to right
  std::vector<Rational> numbers;  ///< all numbers but those of a polygon; a rotation: axis, degrees[, tolerance]
  std::vector<std::vector<Rational3>> rings;  ///< of a polygon; the first one: the points of a hull or segment
  std::string path;                           ///< of a file
  std::size_t variable = 0;                   ///< which one, counted in the order of definitions
};

/// Parses a whole text. Throws ExpressionError.
SyntaxNode parse_expression(std::string_view text);

}  // namespace nef
