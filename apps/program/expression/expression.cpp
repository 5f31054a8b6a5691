// SPDX-License-Identifier: Apache-2.0
//
// Evaluates syntax trees bottom-up: first the sets that a node is made of, then the node. Errors get the place of their
// node in the text. A chain of different operators (A - B + C * D) is evaluated from left to right in runs of one
// operator, since a run can be computed in any order; `StepSequence` decides whether the runs work in tiles.
#include "apps/program/expression/expression.h"

#include <algorithm>

#include "apps/program/expression/expression_steps.h"
#include "apps/program/expression/scanner.h"
#include "apps/program/expression/syntax_key.h"
#include "apps/program/expression/syntax_tree.h"
#include "nef/construct/round_shapes.h"
#include "nef/tiles/step_sequence.h"

namespace nef {
namespace {

class ExpressionEvaluator {
 public:
  ExpressionEvaluator(std::string_view text, const ExpressionOptions& options) : text_(text), options_(options) {}

  Polyhedron operator()(const SyntaxNode& node) {
    if (node.term == Term::kVariable) return variables_[node.variable];
    if (node.term == Term::kBlock) {
      for (std::size_t i = 0; i + 1 < node.sets.size(); ++i) define(i, (*this)(node.sets[i]));
      return (*this)(node.sets.back());
    }
    std::vector<Polyhedron> sets;
    sets.reserve(node.sets.size());
    for (const SyntaxNode& child : node.sets) sets.push_back((*this)(child));
    return combined(node, sets);
  }

  // The node, of whose sets these are.
  [[nodiscard]] Polyhedron combined(const SyntaxNode& node, std::span<const Polyhedron> sets) const {
    if (node.term == Term::kFile) return file(node);
    const bool is_sum = node.term == Term::kMinkowski || node.term == Term::kErode;
    if ((is_sum && !options_.minkowski) || (node.term == Term::kBall && !options_.ball)) {
      throw ExpressionError(place_in_text(text_, node.offset) + ": Minkowski sums cannot be computed here",
                            node.offset);
    }
    try {
      if (node.term == Term::kMinkowski) return options_.minkowski(sets[0], sets[1], options_.monitor);
      if (node.term == Term::kErode) return erode(sets[0], sets[1]);
      if (node.term == Term::kBall) return options_.ball(node.numbers[0], node.numbers[1], options_.monitor);
      if (node.term == Term::kHullOfSets && options_.hull && !all_bounded(sets)) {
        return options_.hull(united(sets), options_.monitor);
      }
      return make(node, sets);
    } catch (const InputError& error) {
      throw ExpressionError(place_in_text(text_, node.offset) + ": " + error.what(), node.offset);
    }
  }

  // Makes a variable known.
  void define(std::size_t variable, Polyhedron set) {
    if (variables_.size() <= variable) variables_.resize(variable + 1);
    variables_[variable] = std::move(set);
  }

 private:
  // What of A stays when -B moves over what is not in A.
  [[nodiscard]] Polyhedron erode(const Polyhedron& a, const Polyhedron& b) const {
    const Polyhedron mirrored = transform(b, AffineMap::scale({-1, -1, -1}), options_.monitor);
    return complement(options_.minkowski(complement(a), mirrored, options_.monitor));
  }

  static bool all_bounded(std::span<const Polyhedron> sets) {
    return std::all_of(sets.begin(), sets.end(), [](const Polyhedron& set) { return set.is_bounded(); });
  }

  [[nodiscard]] Polyhedron united(std::span<const Polyhedron> sets) const { return unite_all(sets, options_.monitor); }

  [[nodiscard]] Polyhedron polyline(std::span<const Rational3> points) const {
    std::vector<Polyhedron> segments;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      segments.push_back(make_segment(points[i], points[i + 1], options_.monitor));
    }
    return unite_all(segments, options_.monitor);
  }

  [[nodiscard]] Polyhedron file(const SyntaxNode& node) const {
    if (!options_.load) {
      throw ExpressionError(place_in_text(text_, node.offset) + ": files cannot be read here", node.offset);
    }
    return options_.load(node.path, options_.monitor);
  }

  [[nodiscard]] Polyhedron make(const SyntaxNode& node, std::span<const Polyhedron> sets) const {
    const std::vector<Rational>& n = node.numbers;
    switch (node.term) {
      case Term::kNothing:
      case Term::kFile:  // made by file()
        return Polyhedron();
      case Term::kEverything:
        return Polyhedron::everything();
      case Term::kBox:
        return make_box({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, options_.monitor);
      case Term::kHalfspace:
        return make_halfspace(n[0], n[1], n[2], n[3], true, options_.monitor);
      case Term::kPoint:
        return make_point(node.rings[0][0], options_.monitor);
      case Term::kSegment:
        return make_segment(node.rings[0][0], node.rings[0][1], options_.monitor);
      case Term::kPolyline:
        return polyline(node.rings[0]);
      case Term::kHull:
        return convex_hull(node.rings[0], options_.monitor);
      case Term::kHullOfSets:
        return convex_hull_of_sets(sets, options_.monitor);
      case Term::kSphere:
        return sphere(n);
      case Term::kCylinder:
        warn_of_radius(n);
        return make_cylinder(n[0], n[1], n.size() > 2 ? n[2] : n[1], corners_of(n, 3, kMostCornersOfCircle),
                             options_.monitor);
      case Term::kPolygon:
        return make_polygon(node.rings, options_.monitor);
      case Term::kTranslate:
      case Term::kScale:
      case Term::kRotate:
      case Term::kTransform:
        return transform(sets[0], map_of(node), options_.monitor);
      case Term::kChain:
        return chain(node.operators, sets);
      default:
        return combine(node.term, sets);
    }
  }

  [[nodiscard]] Polyhedron sphere(std::span<const Rational> n) const {
    const unsigned corners = corners_of(n, 1, kMostCornersOfBall);
    warn_of_corners(options_, "sphere(" + to_string(n[0]) + ", " + std::to_string(corners) + ")", corners);
    return make_sphere(n[0], corners, options_.monitor);
  }

  // A third number that is far beyond the others is likely meant as corners.
  void warn_of_radius(std::span<const Rational> n) const {
    constexpr int kFewCorners = 8;
    if (n.size() != 3 || !options_.warn || n[2].get_den() != 1 || n[2] < kFewCorners) return;
    if (n[2] <= 4 * n[0] || n[2] <= 4 * n[1]) return;
    const std::string start = "cylinder(" + to_string(n[0]) + ", " + to_string(n[1]) + ", ";
    const std::string third = to_string(n[2]);
    options_.warn(start + third + "): " + third + " is the second radius; for " + third + " corners write " + start +
                  to_string(n[1]) + ", " + third + ")");
  }

  // The number of corners of a round shape, if it is given.
  static unsigned corners_of(std::span<const Rational> numbers, std::size_t at, unsigned most) {
    constexpr unsigned kUsual = 32;
    if (numbers.size() <= at) return kUsual;
    const Rational& n = numbers[at];
    if (n.get_den() != 1 || n < 3 || n > most) {
      throw InputError("the number of corners must be from 3 to " + std::to_string(most));
    }
    return static_cast<unsigned>(n.get_num().get_ui());
  }

  static AffineMap map_of(const SyntaxNode& node) {
    const std::vector<Rational>& n = node.numbers;
    switch (node.term) {
      case Term::kTranslate:
        return AffineMap::translate({n[0], n[1], n[2]});
      case Term::kScale:
        return n.size() == 1 ? AffineMap::scale({n[0], n[0], n[0]}) : AffineMap::scale({n[0], n[1], n[2]});
      case Term::kRotate: {
        const Rational3 axis{n[0], n[1], n[2]};
        const double degrees = nearest_double(n[3]);
        return n.size() == 4 ? AffineMap::rotate(axis, degrees)
                             : AffineMap::rotate(axis, degrees, nearest_double(n[4]));
      }
      default:
        return affine_map_of(n);
    }
  }

  // Runs of one operator at a time; in tiles where these are many and small beside the first set.
  [[nodiscard]] Polyhedron chain(std::span<const Term> operators, std::span<const Polyhedron> sets) const {
    struct Step {
      BooleanOperator op;
      Polyhedron set;
    };
    std::vector<Step> steps;
    for (std::size_t first = 0, last = 0; first < operators.size(); first = last) {
      if (operators[first] == Term::kSymmetricDifference) {
        steps.push_back({BooleanOperator::kSymmetricDifference, sets[++last]});
        continue;
      }
      while (last < operators.size() && operators[last] == operators[first]) ++last;
      const std::span<const Polyhedron> run = sets.subspan(first + 1, last - first);
      if (operators[first] == Term::kIntersection) {
        steps.push_back({BooleanOperator::kIntersection, intersect_all(run, options_.monitor)});
      } else {
        steps.push_back(
            {operators[first] == Term::kUnion ? BooleanOperator::kUnion : BooleanOperator::kDifference, united(run)});
      }
    }
    StepSequence sequence(sets[0], steps.size(), TileUse::kWherePays, Tiling(), options_.monitor);
    for (const Step& step : steps) sequence.apply(step.op, step.set, options_.monitor);
    return sequence.result_in_any_order(options_.monitor);
  }

  [[nodiscard]] Polyhedron combine(Term term, std::span<const Polyhedron> sets) const {
    switch (term) {
      case Term::kUnion:
        return united(sets);
      case Term::kIntersection:
        return intersect_all(sets, options_.monitor);
      case Term::kDifference:
        return subtract(sets[0], united(sets.subspan(1)), options_.monitor);
      case Term::kSymmetricDifference:
        return chain(std::vector<Term>(sets.size() - 1, term), sets);
      case Term::kInterior:
        return interior(sets[0], options_.monitor);
      case Term::kClosure:
        return closure(sets[0], options_.monitor);
      case Term::kBoundary:
        return boundary(sets[0], options_.monitor);
      case Term::kExterior:
        return exterior(sets[0], options_.monitor);
      case Term::kRegularize:
        return regularize(sets[0], options_.monitor);
      default:
        return complement(sets[0]);
    }
  }

  std::string_view text_;
  const ExpressionOptions& options_;
  std::vector<Polyhedron> variables_;
};

BooleanOperator operator_of(Term term) {
  switch (term) {
    case Term::kUnion:
      return BooleanOperator::kUnion;
    case Term::kIntersection:
      return BooleanOperator::kIntersection;
    case Term::kDifference:
      return BooleanOperator::kDifference;
    default:
      return BooleanOperator::kSymmetricDifference;
  }
}

bool is_operation(Term term) {
  return term == Term::kChain || term == Term::kUnion || term == Term::kIntersection || term == Term::kDifference ||
         term == Term::kSymmetricDifference;
}

void collect_files(const SyntaxNode& node, std::vector<std::string>& files) {
  if (node.term == Term::kFile) files.push_back(node.path);
  for (const SyntaxNode& child : node.sets) collect_files(child, files);
}

}  // namespace

Polyhedron evaluate_expression(std::string_view text, const ExpressionOptions& options) {
  return ExpressionEvaluator(text, options)(parse_expression(text));
}

ExpressionSteps::ExpressionSteps(std::string text)
    : text_(std::move(text)), tree_(std::make_shared<const SyntaxNode>(parse_expression(text_))), root_(tree_.get()) {
  if (tree_->term == Term::kBlock) {
    block_ = tree_.get();
    root_ = &block_->sets.back();
  }
}

std::size_t ExpressionSteps::size() const {
  return is_operation(root_->term) && root_->sets.size() > 1 ? root_->sets.size() : 1;
}

const SyntaxNode& ExpressionSteps::node(std::size_t i) const { return size() > 1 ? root_->sets[i] : *root_; }

BooleanOperator ExpressionSteps::operation(std::size_t i) const {
  return operator_of(root_->term == Term::kChain ? root_->operators[i - 1] : root_->term);
}

std::string ExpressionSteps::key(std::size_t i) const { return syntax_key(node(i), block_); }

std::vector<std::string> ExpressionSteps::files(std::size_t i) const {
  std::vector<std::string> files;
  for (const std::size_t v : variables_of(node(i), block_)) collect_files(block_->sets[v], files);
  collect_files(node(i), files);
  return files;
}

bool ExpressionSteps::has_variables(std::size_t i) const { return !variables_of(node(i), block_).empty(); }

Polyhedron ExpressionSteps::set(std::size_t i, const ExpressionOptions& options) {
  ExpressionEvaluator evaluate(text_, options);
  variables_.resize(block_ == nullptr ? 0 : block_->sets.size() - 1);
  for (const std::size_t v : variables_of(node(i), block_)) {
    if (!variables_[v]) variables_[v] = evaluate(block_->sets[v]);
    evaluate.define(v, *variables_[v]);
  }
  return evaluate(node(i));
}

Polyhedron ExpressionSteps::combined(std::span<const Polyhedron> sets, const ExpressionOptions& options) const {
  return size() > 1 ? ExpressionEvaluator(text_, options).combined(*root_, sets) : sets[0];
}

std::vector<std::string> files_of_expression(std::string_view text) {
  std::vector<std::string> files;
  collect_files(parse_expression(text), files);
  return files;
}

bool is_blank_expression(std::string_view text) { return ExpressionScanner(text).peek() == '\0'; }

Polyhedron convex_hull_of_sets(std::span<const Polyhedron> sets, const Monitor& monitor) {
  std::vector<Rational3> points;
  for (const Polyhedron& set : sets) {
    if (!set.is_bounded())
      throw InputError("the hull of an unbounded set cannot be computed; intersect the set with a box first");
    const Complex& c = set.complex();
    for (const VertexId v : c.vertex_ids()) points.push_back(c.points.rational(point_of(v)));
  }
  return convex_hull(points, monitor);
}

AffineMap affine_map_of(std::span<const Rational> n) {
  if (n.size() != 12 && n.size() != 16) {
    throw InputError("a matrix has 12 or 16 numbers (rows of 3x4 or 4x4), not " + std::to_string(n.size()));
  }
  Rational w = 1;
  if (n.size() == 16) {
    w = n[15];
    if (n[12] != 0 || n[13] != 0 || n[14] != 0 || w == 0) {
      throw InputError("the last row of an affine 4x4 matrix is 0,0,0,w with w other than 0");
    }
  }
  AffineMap map;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) map.linear[i][j] = n[4 * i + j] / w;
    map.translation[i] = n[4 * i + 3] / w;
  }
  return map;
}

void warn_of_corners(const ExpressionOptions& options, const std::string& name, unsigned corners) {
  if (corners <= kManyCornersOfBall || !options.warn) return;
  constexpr std::size_t kBytesPerVertex = 390;
  const std::size_t vertices = std::size_t{corners} * (corners / 2);
  const std::size_t megabytes = std::max<std::size_t>(1, vertices * kBytesPerVertex / 1000000);
  options.warn(name + " has " + std::to_string(vertices) + " vertices, which take minutes and " +
               std::to_string(megabytes) +
               " MB or more; 200 corners differ from the ball by about 1/4000 of the radius");
}

}  // namespace nef
