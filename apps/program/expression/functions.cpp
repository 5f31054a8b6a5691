// SPDX-License-Identifier: Apache-2.0
#include "apps/program/expression/functions.h"

#include <algorithm>
#include <array>

namespace nef {
namespace {

constexpr std::size_t kMany = static_cast<std::size_t>(-1);

constexpr std::array kFunctions{
    Function{"nothing", Term::kNothing, ArgumentShape::kBare, 0, 0, "nothing"},
    Function{"everything", Term::kEverything, ArgumentShape::kBare, 0, 0, "everything"},
    Function{"file", Term::kFile, ArgumentShape::kPath, 0, 0, "file(\"path\")"},
    Function{"box", Term::kBox, ArgumentShape::kNumbers, 6, 6, "box(x0,y0,z0, x1,y1,z1)"},
    Function{"halfspace", Term::kHalfspace, ArgumentShape::kNumbers, 4, 4, "halfspace(a,b,c,d)"},
    Function{"point", Term::kPoint, ArgumentShape::kPoints, 1, 1, "point(x,y,z)"},
    Function{"segment", Term::kSegment, ArgumentShape::kPoints, 2, 2, "segment(x0,y0,z0, x1,y1,z1)"},
    Function{"polyline", Term::kPolyline, ArgumentShape::kPoints, 2, kMany, "polyline(x,y,z, x,y,z, ...)"},
    Function{"hull", Term::kHull, ArgumentShape::kPoints, 0, kMany, "hull(x,y,z, x,y,z, ...) or hull(A, B, ...)"},
    Function{"sphere", Term::kSphere, ArgumentShape::kNumbers, 1, 2, "sphere(r[, corners])"},
    Function{"cylinder", Term::kCylinder, ArgumentShape::kNumbers, 2, 4,
             "cylinder(h, r) or cylinder(h, r0, r1[, corners])"},
    Function{"minkowski", Term::kMinkowski, ArgumentShape::kSets, 2, 2, "minkowski(A, B)"},
    Function{"erode", Term::kErode, ArgumentShape::kSets, 2, 2, "erode(A, B)"},
    Function{"ball", Term::kBall, ArgumentShape::kNumbers, 2, 2, "ball(r, n)"},
    Function{"polygon", Term::kPolygon, ArgumentShape::kRings, 3, kMany, "polygon(x,y,z, x,y,z, x,y,z, ...)"},
    Function{"union", Term::kUnion, ArgumentShape::kSets, 0, kMany, "union(A, B, ...)"},
    Function{"intersection", Term::kIntersection, ArgumentShape::kSets, 0, kMany, "intersection(A, B, ...)"},
    Function{"difference", Term::kDifference, ArgumentShape::kSets, 2, 2, "difference(A, B)"},
    Function{"symdiff", Term::kSymmetricDifference, ArgumentShape::kSets, 2, 2, "symdiff(A, B)"},
    Function{"complement", Term::kComplement, ArgumentShape::kSets, 1, 1, "complement(A)"},
    Function{"interior", Term::kInterior, ArgumentShape::kSets, 1, 1, "interior(A)"},
    Function{"closure", Term::kClosure, ArgumentShape::kSets, 1, 1, "closure(A)"},
    Function{"boundary", Term::kBoundary, ArgumentShape::kSets, 1, 1, "boundary(A)"},
    Function{"exterior", Term::kExterior, ArgumentShape::kSets, 1, 1, "exterior(A)"},
    Function{"regularize", Term::kRegularize, ArgumentShape::kSets, 1, 1, "regularize(A)"},
    Function{"translate", Term::kTranslate, ArgumentShape::kSetAndNumbers, 3, 3, "translate(A, x,y,z)"},
    Function{"scale", Term::kScale, ArgumentShape::kSetAndNumbers, 1, 3, "scale(A, s) or scale(A, sx,sy,sz)"},
    Function{"rotate", Term::kRotate, ArgumentShape::kRotation, 4, 5, "rotate(A, axis, degrees[, tolerance])"},
    Function{"transform", Term::kTransform, ArgumentShape::kSetAndNumbers, 12, 16, "transform(A, 12 or 16 numbers)"},
};

}  // namespace

const Function* find_function(std::string_view name) {
  const auto* function =
      std::find_if(kFunctions.begin(), kFunctions.end(), [name](const Function& f) { return f.name == name; });
  return function == kFunctions.end() ? nullptr : function;
}

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const Function& function : kFunctions) names.emplace_back(function.name);
  return names;
}

}  // namespace nef
