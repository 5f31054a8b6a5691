// SPDX-License-Identifier: Apache-2.0
//
// The expression language: what it makes, and what its errors say.
#include <catch2/catch.hpp>

#include <array>
#include <string>
#include <vector>

#include "apps/program/expression/expression.h"
#include "apps/program/expression/expression_steps.h"
#include "apps/program/numbers.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

Polyhedron eval(const std::string& text) { return evaluate_expression(text); }

// The message of the error that a text gives.
std::string refusal(const std::string& text) {
  try {
    eval(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

bool same(const std::string& a, const std::string& b) { return equal(eval(a), eval(b)); }

}  // namespace

TEST_CASE("long expressions of many operators make no deep trees") {
  std::string text = "point(0,0,0)";
  for (int i = 1; i < 20000; ++i) {
    const std::string p = "point(" + std::to_string(i % 7) + ",0,0)";
    text += (i % 3 == 0 ? " - " : i % 3 == 1 ? " + " : " ^ ") + p;
  }
  // What is left, by replaying the operators.
  std::array<bool, 7> in{true};
  for (int i = 1; i < 20000; ++i) {
    bool& at = in.at(static_cast<std::size_t>(i % 7));
    at = i % 3 == 0 ? false : i % 3 == 1 ? true : !at;
  }
  const Polyhedron set = eval(text);
  for (int x = 0; x < 7; ++x) CHECK(contains(set, {x, 0, 0}) == in.at(static_cast<std::size_t>(x)));
  CHECK(
      equal(evaluate_expression("box(0,0,0,4,1,1) - box(1,0,0,2,1,1) + box(1,0,0,3,1,1) - box(0,0,0,1,1,1)", {}),
            evaluate_expression("((box(0,0,0,4,1,1) - box(1,0,0,2,1,1)) + box(1,0,0,3,1,1)) - box(0,0,0,1,1,1)", {})));
}

TEST_CASE("operators and their precedence") {
  CHECK(eval("nothing").is_empty());
  CHECK(eval(" everything # all there is\n").is_everything());
  CHECK(eval("!nothing").is_everything());
  const std::string a = "box(0,0,0,2,2,2)";
  const std::string b = "box(1,1,1,3,3,3)";
  const std::string c = "box(0,0,0,1,3,3)";
  CHECK(same(a + "+" + b + "*" + c, a + "+(" + b + "*" + c + ")"));
  CHECK_FALSE(same(a + "+" + b + "*" + c, "(" + a + "+" + b + ")*" + c));
  CHECK(same(a + "-" + b + "-" + c, "(" + a + "-" + b + ")-" + c));
  CHECK_FALSE(same(a + "-" + b + "-" + c, a + "-(" + b + "-" + c + ")"));
  CHECK(same(a + "-" + b + "+" + c, "(" + a + "-" + b + ")+" + c));
  CHECK(same("!" + a + "*" + b, b + "-" + a));
  CHECK(same("!!" + a, a));
  CHECK(same(a + "^" + b + "^" + a, b));
  CHECK(volume(eval(a + "+" + b)) == Rational(15));
  CHECK(volume(eval(a + "-" + b)) == Rational(7));
  CHECK(volume(eval(a + "*" + b)) == Rational(1));
  CHECK(volume(eval(a + "^" + b)) == Rational(14));
}

TEST_CASE("functions are the operators by name") {
  const std::string a = "box(0,0,0,2,2,2)";
  const std::string b = "box(1,1,1,3,3,3)";
  CHECK(same("union(" + a + "," + b + ")", a + "+" + b));
  CHECK(same("union()", "nothing"));
  CHECK(same("intersection()", "everything"));
  CHECK(same("intersection(" + a + "," + b + "," + a + ")", a + "*" + b));
  CHECK(same("difference(" + a + "," + b + ")", a + "-" + b));
  CHECK(same("symdiff(" + a + "," + b + ")", a + "^" + b));
  CHECK(same("complement(" + a + ")", "!" + a));
  CHECK(same("closure(interior(" + a + "))", a));
  CHECK(same("exterior(" + a + ")", "!" + a));
  CHECK(same("boundary(" + a + ")", a + "-interior(" + a + ")"));
  CHECK(same("regularize(" + a + "+segment(5,5,5,6,6,6))", a));
}

TEST_CASE("sets of all dimensions") {
  CHECK(same("point(1,2,3)", "box(1,2,3,1,2,3)"));
  CHECK(same("segment(0,0,0, 0,0,1)", "box(0,0,0,0,0,1)"));
  CHECK(same("segment((0,0,0),(0,0,1))", "box(0,0,0,0,0,1)"));
  CHECK(same("polygon(0,0,0, 1,0,0, 1,1,0, 0,1,0)", "box(0,0,0,1,1,0)"));
  CHECK(same("hull(0,0,0, (1,0,0), (0,1,0), 1,1,0)", "box(0,0,0,1,1,0)"));
  CHECK(eval("hull()").is_empty());
  CHECK(surface_area(eval("polygon(0,0,0, 3,0,0, 3,3,0, 0,3,0; 1,1,0, 2,1,0, 2,2,0, 1,2,0)")) == Approx(8));
  CHECK(volume(eval("hull(0,0,0, 1,0,0, 0,1,0, 0,0,1)")) == Rational(1, 6));
  CHECK(
      same("halfspace(1,0,0,-1) * halfspace(-1,0,0,0) * halfspace(0,1,0,-1) * halfspace(0,-1,0,0) *"
           "halfspace(0,0,1,-1) * halfspace(0,0,-1,0)",
           "box(0,0,0,1,1,1)"));
}

TEST_CASE("maps") {
  CHECK(same("translate(box(0,0,0,1,1,1), 1/2,-3,1e1)", "box(1/2,-3,10, 3/2,-2,11)"));
  CHECK(same("scale(box(1,1,1,2,2,2), 0.5)", "box(1/2,1/2,1/2,1,1,1)"));
  CHECK(same("scale(box(1,1,1,2,2,2), 1,2,-3)", "box(1,2,-6,2,4,-3)"));
  CHECK(same("rotate(box(0,0,0,1,2,3), z, 90)", "box(-2,0,0,0,1,3)"));
  CHECK(same("rotate(box(0,0,0,1,2,3), (0,0,1), 90, 0.001)", "box(-2,0,0,0,1,3)"));
  CHECK(same("transform(box(0,0,0,1,1,1), 0,-1,0,0, 1,0,0,0, 0,0,1,5)", "box(-1,0,5,0,1,6)"));
}

TEST_CASE("numbers are exact") {
  CHECK(volume(eval("box(0,0,0, 0.1,0.1,0.1)")) == Rational(1, 1000));
  CHECK(volume(eval("box(0,0,0, 1/3,1/7,1e-30)")) == Rational(1, Integer("21000000000000000000000000000000")));
}

TEST_CASE("numbers are computed, and may stand in brackets") {
  CHECK(same("box([0,0,(2-1)*-1e-1], [1+1,2*3/4,0])", "box(0,0,-0.1, 2,1.5,0) + nothing"));
  CHECK(same("translate(point(0,0,0), [1/3, 2-1, -(1/2)/2])", "point(1/3,1,-1/4)"));
  CHECK(same("hull([0,0,0], [1,0,0], (0,1,0), 1,1,0)", "box(0,0,0,1,1,0)"));
  CHECK(same("rotate(box(0,0,0,1,2,3), [0,0,1], 90)", "box(-2,0,0,0,1,3)"));
  CHECK(refusal("point(1/(2-2),0,0)").rfind("column 8: division by zero", 0) == 0);
  CHECK(refusal("box([0,0,0,1,1,1)").rfind("column 17: expected ']'", 0) == 0);
  CHECK(refusal("point(1+,0,0)").rfind("column 9: expected a number, found ','", 0) == 0);
}

TEST_CASE("variables are sets or numbers") {
  CHECK(same("w = 2; a = box(0,0,0, w,w,w/2);\n# twice\na + translate(a, [0, 0, w - 1])", "box(0,0,0,2,2,2)"));
  CHECK(same("a = box(0,0,0,1,1,1); b = a * interior(a); a - b", "boundary(box(0,0,0,1,1,1))"));
  CHECK(same("a = point(0,0,0); a = a + point(1,0,0); a", "point(0,0,0) + point(1,0,0)"));
  CHECK(same("a = 1; a = point(a,a,a); a", "point(1,1,1)"));
  CHECK(same("n = 3; hull(n,0,0, (0,n,0), 0,0,n)", "hull(3,0,0, 0,3,0, 0,0,3)"));
  // Each is made once: thirty doublings are no billion sets.
  std::string text = "a0 = box(0,0,0,1,1,1);";
  for (int i = 1; i <= 30; ++i) {
    const std::string before = "a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + " = " + before + " + " + before + ";";
  }
  CHECK(same(text + "a30", "box(0,0,0,1,1,1)"));
  CHECK(refusal("a = 1; a") == "column 8: there is no set or function 'a'");
  CHECK(refusal("a = point(0,0,0) a") == "column 18: expected ';' after the value of 'a', found 'a'");
  CHECK(refusal("box = 3; box(0,0,0,box,1,1)") == "column 1: 'box' is a reserved word; choose another name");
  CHECK(refusal("a = b; a") == "column 5: there is no set or function 'b'");
}

TEST_CASE("a text in steps is the same set, and its sets are known again") {
  const std::string definitions = "h = 3; a = box(0,0,0, h,3,3); b = translate(a, 1,1,1); ";
  for (const std::string& text :
       {std::string("box(0,0,0, 2,2,2) - box(1,1,1, 3,3,3) + point(9,9,9) ^ a * b"), std::string("a - b"),
        std::string("difference(a, b)"), std::string("a * b * halfspace(1,0,0,-2)"), std::string("!a"),
        std::string("union()"), std::string("a")}) {
    ExpressionSteps steps(definitions + text);
    std::vector<Polyhedron> sets;
    for (std::size_t i = 0; i < steps.size(); ++i) sets.push_back(steps.set(i));
    CHECK(equal(steps.combined(sets), eval(definitions + text)));
    Polyhedron by_steps = sets[0];
    for (std::size_t i = 1; i < sets.size(); ++i) {
      StepSequence step(by_steps, 1, TileUse::kNever);
      step.apply(steps.operation(i), sets[i]);
      by_steps = step.result();
    }
    CHECK(equal(by_steps, eval(definitions + text)));
  }
  // Alike wherever they stand, and under whatever names their numbers have.
  const ExpressionSteps one("n = 2; s = box(0,0,0, n,1,1); s - point(0,0,0)");
  CHECK(one.key(1) == ExpressionSteps("everything * point(0,0,0)").key(1));
  CHECK(one.key(0) == ExpressionSteps("m = 1; s = box(0,0,0, m + 1,1,1); s * s").key(1));
  CHECK(one.key(0) != ExpressionSteps("n = 3; s = box(0,0,0, n,1,1); s - point(0,0,0)").key(0));
  CHECK(one.key(0) != one.key(1));
  CHECK(ExpressionSteps("file(\"ab\")").key(0) != ExpressionSteps("file(\"a\")").key(0));
  CHECK(ExpressionSteps("s = file(\"x\"); s + file(\"y\")").files(0) == std::vector<std::string>{"x"});
}

TEST_CASE("round shapes, hulls of sets, Minkowski sums") {
  // The prism over a regular polygon, the pyramid over it.
  CHECK(nearest_double(*volume(eval("cylinder(2, 3, 3, 12)"))) == Approx(2 * 27).epsilon(1e-14));
  CHECK(nearest_double(*volume(eval("cylinder(2, 3, 0, 12)"))) == Approx(2 * 27 / 3.0).epsilon(1e-14));
  CHECK(counts(eval("cylinder(1, 1)")).facets == 34);
  CHECK(counts(eval("sphere(1, 6)")).vertices == 18);
  CHECK(refusal("nothing + box(1,1,1,0,0,0)") ==
        "column 11: a box needs its lower corner first: its x goes from 1 to 0");
  CHECK(refusal("box(0,0,0,1,1,-1/3)") == "column 1: a box needs its lower corner first: its z goes from 0 to -1/3");
  CHECK(refusal("sphere(-1)") == "column 1: the radius of a sphere must be positive, not -1");
  CHECK(refusal("sphere(0)") == "column 1: the radius of a sphere must be positive, not 0");
  CHECK(refusal("cylinder(1,0,0)") == "column 1: one radius of a cylinder must be positive");
  CHECK(refusal("cylinder(0,1)") == "column 1: the height of a cylinder must be positive, not 0");
  CHECK(refusal("cylinder(1,1,-2)") == "column 1: the radius of a cylinder must not be negative: -2");
  CHECK(same("box(0,0,0,0,0,1)", "segment(0,0,0,0,0,1)"));
  CHECK(refusal("sphere(1, 2.5)").find("number of corners") != std::string::npos);
  CHECK(same("hull(box(0,0,0,1,1,1), box(3,0,0,4,1,1) + point(2,0,0))", "box(0,0,0,4,1,1)"));
  CHECK(same("hull(interior(box(0,0,0,1,1,1)))", "box(0,0,0,1,1,1)"));
  CHECK(refusal("hull(halfspace(0,0,1,0))").find("unbounded") != std::string::npos);
  CHECK(refusal("nothing + minkowski(nothing, nothing)") == "column 11: Minkowski sums cannot be computed here");
  ExpressionOptions options;
  options.minkowski = [](const Polyhedron& a, const Polyhedron&, const Monitor&) { return a; };
  CHECK(equal(evaluate_expression("minkowski(point(1,2,3), nothing)", options), make_point({1, 2, 3})));
}

TEST_CASE("files come from the caller") {
  ExpressionOptions options;
  std::vector<std::string> asked;
  options.load = [&asked](const std::string& path, const Monitor&) {
    asked.push_back(path);
    return make_point({1, 2, 3});
  };
  const Polyhedron set = evaluate_expression("file(\"a b.off\") + file(\"dir/c.stl\")", options);
  CHECK(asked == std::vector<std::string>{"a b.off", "dir/c.stl"});
  CHECK(equal(set, make_point({1, 2, 3})));
  // Nothing is loaded before the whole text is understood.
  asked.clear();
  CHECK_THROWS_AS(evaluate_expression("file(\"a.off\") + box(1)", options), ExpressionError);
  CHECK(asked.empty());
  CHECK(refusal("file(\"a.off\")") == "column 1: files cannot be read here");
}

TEST_CASE("errors give the column and what was expected") {
  CHECK(refusal("") == "column 1: expected a set, found the end");
  CHECK(refusal("box(0,0,0,1,1,1) box(0,0,0,1,1,1)") ==
        "column 18: expected an operator (+ * - ^) or the end, found 'box'");
  CHECK(refusal("cube(1)") == "column 1: there is no set or function 'cube'; a cube is box(0,0,0, 1,1,1)");
  CHECK(refusal("cone(1, 2)") == "column 1: there is no set or function 'cone'; a cone is cylinder(height, radius, 0)");
  // What the hints say can be computed.
  CHECK(equal(eval("cylinder(1, 1, 0)"), eval("cylinder(1, 1, 0, 32)")));
  for (const std::string name : {"extrude", "linear_extrude"}) {
    CHECK(refusal(name + "(nothing, 2)").find("a prism is minkowski(polygon(") != std::string::npos);
  }
  CHECK(refusal("mirror(nothing)").find("scale(A, -1,1,1) mirrors in x") != std::string::npos);
  CHECK(same("scale(box(1,0,0,2,1,1), -1,1,1)", "box(-2,0,0,-1,1,1)"));
  CHECK(refusal("offset(nothing, 1)").find("minkowski(A, ball(r, 4)) grows A by r") != std::string::npos);
  CHECK(refusal("spere(1)") == "column 1: there is no set or function 'spere'; did you mean 'sphere'?");
  CHECK(refusal("a.off + b.off") == "column 1: there is no set or function 'a'; a file is named by file(\"part.off\")");
  CHECK(refusal("models/a.off") ==
        "column 1: there is no set or function 'models'; a file is named by file(\"part.off\")");
  CHECK(refusal("rotate(z, 90, nothing)") ==
        "column 8: there is no set or function 'z'; the set comes first, as in rotate(A, z, 90)");
  CHECK(refusal("read(\"a.off\")").find("a file is named by file(") != std::string::npos);
  CHECK(refusal("plate = box(0,0,0,1,1,1); plat") ==
        "column 27: there is no set or function 'plat'; did you mean 'plate'?");
  CHECK(refusal("x") == "column 1: there is no set or function 'x'");
  CHECK(refusal("rotate([0,0,30]) box(0,0,0,1,1,1)") ==
        "column 8: expected a set, found '['; the set comes first, as in translate(A, 1,2,3)");
  CHECK(refusal("nothing + \n  (everything") ==
        "line 2, column 14: expected ')' for the '(' at line 2, column 3, found the end");
  CHECK(refusal("box(0,0,0,1,1)").rfind("column 14: expected another number, found ')'", 0) == 0);
  CHECK(refusal("box(0,0,0,1,1,1,1)").rfind("column 17: too many numbers", 0) == 0);
  CHECK(refusal("box(0,0,0,1,1,x)").rfind("column 15: 'x' is not a number", 0) == 0);
  CHECK(refusal("box(0,0,0,1,1,1/0)").rfind("column 15: '1/0' is not a number", 0) == 0);
  CHECK(refusal("point(nan,0,0)").rfind("column 7: 'nan' is not a number", 0) == 0);
  CHECK(refusal("file(a.off)").rfind("column 6: expected '\"'", 0) == 0);
  CHECK(refusal("file(\"a.off)").find("closing") != std::string::npos);
  CHECK(refusal("difference(nothing)").rfind("column 19: expected another set", 0) == 0);
  CHECK(refusal("interior(nothing, nothing)").rfind("column 19: too many arguments", 0) == 0);
  CHECK(refusal("scale(nothing, 1, 2)").rfind("column 20: expected another number", 0) == 0);
  CHECK(refusal("rotate(nothing, w, 2)").rfind("column 17: expected an axis", 0) == 0);
  CHECK(refusal("nothing + scale(everything, 0)").rfind("column 11: ", 0) == 0);
  CHECK(refusal("halfspace(0,0,0,1)").rfind("column 1: ", 0) == 0);
  CHECK(refusal("polygon(0,0,0, 1,0,0, 1,1,0, 0,1,1)").rfind("column 1: ", 0) == 0);
  CHECK(refusal(std::string(100000, '(')).find("nested too deeply") != std::string::npos);
}

TEST_CASE("nested parentheses within the limit are evaluated, and those beyond it are refused on any stack") {
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '(') + "box(0,0,0,1,1,1)" + std::string(depth, ')');
  };
  CHECK(volume(evaluate_expression(nested(990))) == 1);
  CHECK(refusal(nested(1010)).find("nested too deeply") != std::string::npos);
  CHECK(volume(evaluate_expression("box(0,0,0,1,1," + std::string(990, '(') + "1" + std::string(990, ')') + ")")) == 1);
  CHECK(refusal("box(0,0,0,1,1," + std::string(1010, '-') + "1)").find("nested too deeply") != std::string::npos);
}

TEST_CASE("Balls of many corners are announced before they are computed") {
  std::vector<std::string> warnings;
  ExpressionOptions options;
  options.warn = [&](const std::string& warning) { warnings.push_back(warning); };
  warn_of_corners(options, "sphere(1, 1000)", 1000);
  CHECK(warnings.empty());
  warn_of_corners(options, "sphere(1, 4000)", 4000);
  CHECK(warnings == std::vector<std::string>{
                        "sphere(1, 4000) has 8000000 vertices, which take minutes and 3120 MB or more; 200 corners "
                        "differ from the ball by about 1/4000 of the radius"});
  CHECK_NOTHROW(warn_of_corners({}, "sphere(1, 4000)", 4000));
}

TEST_CASE("lists of numbers") {
  CHECK(parse_triple("1,-2/3,0.5", "point") == Rational3{1, Rational(-2, 3), Rational(1, 2)});
  CHECK(parse_triple(" 1 2 3 ", "point") == Rational3{1, 2, 3});
  CHECK_THROWS_AS(parse_triple("1,2", "point"), InputError);
  CHECK_THROWS_AS(parse_triple("1,2,3,", "point"), InputError);
  CHECK_THROWS_AS(parse_triple("1,,3", "point"), InputError);
  CHECK_THROWS_AS(parse_triple("", "point"), InputError);
}

}  // namespace nef
