// SPDX-License-Identifier: Apache-2.0
//
// Assemblies whose parts may turn about the z axis: a block with a pocket one layer high, closed above and below, and
// one or two parts of squares with play in it. The oracle is a grid of positions and angles, in doubles. A set surely
// leaves if it does along grid poses at which it is free although it is enlarged by half of what it moves between two
// of them; and surely does not if it cannot leave along grid poses although it is smaller by the most that it moves to
// the nearest. Steps are sampled.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "apps/planner/assembly/disassembly.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/number/number.h"

namespace nef::fuzz {
namespace {

using planner::PartSet;

// A box, upright, in units of an eighth of a square.
struct Brick {
  std::array<double, 3> low;
  std::array<double, 3> high;
};
using Bricks = std::vector<Brick>;

// Where a set is: turned about the origin, then moved.
struct PlanePose {
  double x = 0;
  double y = 0;
  double z = 0;
  double cosine = 1;
  double sine = 0;
};

// Whether a brick that is turned and moved, larger by a margin, overlaps one at rest by more than rounding.
bool overlap(const Brick& a, const PlanePose& pose, double margin, const Brick& b) {
  constexpr double kRounding = 1e-6;
  if (a.low[2] + pose.z + kRounding >= b.high[2] || a.high[2] + pose.z - kRounding <= b.low[2]) return false;
  const std::array<double, 2> half{(a.high[0] - a.low[0]) / 2 + margin, (a.high[1] - a.low[1]) / 2 + margin};
  if (half[0] <= 0 || half[1] <= 0) return false;
  const double u = (a.high[0] + a.low[0]) / 2;
  const double v = (a.high[1] + a.low[1]) / 2;
  const double x = pose.cosine * u - pose.sine * v + pose.x - (b.high[0] + b.low[0]) / 2;
  const double y = pose.sine * u + pose.cosine * v + pose.y - (b.high[1] + b.low[1]) / 2;
  const std::array<double, 2> other{(b.high[0] - b.low[0]) / 2, (b.high[1] - b.low[1]) / 2};
  const double c = std::fabs(pose.cosine);
  const double s = std::fabs(pose.sine);
  return std::fabs(x) < other[0] + c * half[0] + s * half[1] - kRounding &&
         std::fabs(y) < other[1] + s * half[0] + c * half[1] - kRounding &&
         std::fabs(pose.cosine * x + pose.sine * y) < half[0] + c * other[0] + s * other[1] - kRounding &&
         std::fabs(pose.cosine * y - pose.sine * x) < half[1] + s * other[0] + c * other[1] - kRounding;
}

bool is_free(const Bricks& moving, const PlanePose& pose, double margin, const Bricks& stay) {
  return std::none_of(moving.begin(), moving.end(), [&](const Brick& a) {
    return std::any_of(stay.begin(), stay.end(), [&](const Brick& b) { return overlap(a, pose, margin, b); });
  });
}

constexpr int kSquare = 8;

// Whether a set can leave another one, as far as a grid tells.
class PoseGrid {
 public:
  PoseGrid(Bricks moving, Bricks stay) : moving_(std::move(moving)), stay_(std::move(stay)) {
    std::array<double, 2> low{1e9, 1e9};
    std::array<double, 2> high{-1e9, -1e9};
    for (const Brick& b : moving_) {
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], b.low[k]);
        high[k] = std::max(high[k], b.high[k]);
      }
    }
    middle_ = {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2};
    for (Brick& b : moving_) {
      for (std::size_t k = 0; k < 2; ++k) {
        b.low[k] -= middle_[k];
        b.high[k] -= middle_[k];
      }
    }
    const double reach = std::hypot(high[0] - low[0], high[1] - low[1]) / 2;
    for (const Brick& b : stay_) {
      for (std::size_t k = 0; k < 2; ++k) {
        low_[k] = std::min(low_[k], b.low[k] - reach);
        high_[k] = std::max(high_[k], b.high[k] + reach);
      }
    }
    // Between two grid poses from the nearer one, and from any pose to the nearest one.
    step_margin_ = std::max(kStep, reach * kAngle) / 2;
    cell_margin_ = kStep * std::sqrt(0.5) + reach * kAngle / 2;
  }

  [[nodiscard]] bool surely_leaves() const { return leaves(step_margin_); }
  [[nodiscard]] bool surely_stays() const { return !leaves(-cell_margin_); }

 private:
  static constexpr double kStep = 1;
  static constexpr int kAngles = 48;
  static constexpr double kAngle = 2 * 3.14159265358979 / kAngles;

  [[nodiscard]] PlanePose pose(const std::array<int, 3>& at) const {
    return {middle_[0] + at[0] * kStep, middle_[1] + at[1] * kStep, 0, std::cos(at[2] * kAngle),
            std::sin(at[2] * kAngle)};
  }

  [[nodiscard]] bool leaves(double margin) const {
    const std::array<int, 3> start{0, 0, 0};
    if (!is_free(moving_, pose(start), margin, stay_)) return false;
    std::set<std::array<int, 3>> seen{start};
    std::vector<std::array<int, 3>> stack{start};
    while (!stack.empty()) {
      const std::array<int, 3> at = stack.back();
      stack.pop_back();
      const PlanePose here = pose(at);
      if (here.x < low_[0] || here.x > high_[0] || here.y < low_[1] || here.y > high_[1]) return true;
      // Neighbours across corners, too: a motion may go that way.
      for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dt = -1; dt <= 1; ++dt) {
            if (margin > 0 && std::abs(dx) + std::abs(dy) + std::abs(dt) != 1) continue;
            const std::array<int, 3> next{at[0] + dx, at[1] + dy, (at[2] + dt + kAngles) % kAngles};
            if (!seen.contains(next) && is_free(moving_, pose(next), margin, stay_)) {
              seen.insert(next);
              stack.push_back(next);
            }
          }
        }
      }
    }
    return false;
  }

  Bricks moving_;
  Bricks stay_;
  std::array<double, 2> middle_{};
  std::array<double, 2> low_{1e9, 1e9};
  std::array<double, 2> high_{-1e9, -1e9};
  double step_margin_ = 0;
  double cell_margin_ = 0;
};

using Square = std::array<int, 2>;

constexpr int kBlockWidth = 5;  // of the block, in squares

// A pocket of a block of squares: a room, and a way out along one row or column, which may be closed. A part that lies
// across the way has to turn.
std::set<Square> random_room(Choices& choices) {
  const int first = choices.between(2, 3);
  const int second = choices.between(2, 3);
  std::set<Square> result;
  for (int x = 1; x < 1 + first; ++x) {
    for (int y = 1; y < 1 + second; ++y) result.insert({x, y});
  }
  const std::size_t axis = choices.below(2);
  const int row = choices.between(1, axis == 0 ? second : first);
  const int wall = choices.one_in(4) ? 1 : 0;
  for (int i = 1; i < kBlockWidth - wall; ++i) result.insert(axis == 0 ? Square{i, row} : Square{row, i});
  return result;
}

// A part of some squares next to each other inside a pocket, with play.
Bricks random_part(Choices& choices, std::set<Square>& pocket) {
  if (pocket.empty()) return {};
  const int play = choices.between(1, 2);
  std::set<Square> part{*std::next(pocket.begin(), choices.below(static_cast<std::uint32_t>(pocket.size())))};
  for (int more = choices.between(0, 2); more > 0; --more) {
    Square next = *std::next(part.begin(), choices.below(static_cast<std::uint32_t>(part.size())));
    next[choices.below(2)] += choices.below(2) == 0 ? 1 : -1;
    if (pocket.contains(next)) part.insert(next);
  }
  // One brick from a square to itself, or to the next one in either direction.
  Bricks result;
  const auto add = [&](const Square& from, const Square& to) {
    Brick brick{{0, 0, 1}, {0, 0, kSquare - 1}};
    for (std::size_t k = 0; k < 2; ++k) {
      brick.low[k] = kSquare * from[k] + play;
      brick.high[k] = kSquare * (to[k] + 1) - play;
    }
    result.push_back(brick);
  };
  for (const Square& s : part) {
    pocket.erase(s);
    add(s, s);
    for (const Square& next : {Square{s[0] + 1, s[1]}, Square{s[0], s[1] + 1}}) {
      if (part.contains(next)) add(s, next);
    }
  }
  return result;
}

Rational3 corner(const std::array<double, 3>& p) {
  return {exact_rational(p[0]), exact_rational(p[1]), exact_rational(p[2])};
}

Polyhedron solid_of(const Bricks& bricks) {
  std::vector<Polyhedron> boxes;
  for (const Brick& b : bricks) boxes.push_back(make_box(corner(b.low), corner(b.high)));
  return unite_all(boxes);
}

Bricks together(const std::vector<Bricks>& parts, const PartSet& set) {
  Bricks result;
  for (const std::size_t part : set) result.insert(result.end(), parts[part].begin(), parts[part].end());
  return result;
}

// The poses of a step, sampled, are free.
bool is_step_free(const std::vector<Bricks>& parts, const planner::DisassemblyStep& step) {
  const Bricks moving = together(parts, step.parts);
  const Bricks stay = together(parts, step.stay);
  struct Sample {
    std::array<double, 3> position;
    double angle;
  };
  std::vector<Sample> ends;
  double px = 0;
  double py = 0;
  if (step.turning) {
    px = nearest_double(step.turning->pivot[0]);
    py = nearest_double(step.turning->pivot[1]);
  }
  for (std::size_t i = 0; i < step.path.size(); ++i) {
    double angle = 0;
    if (step.turning) {
      const auto& q = step.turning->poses[i].quaternion;
      angle = 2 * std::atan2(nearest_double(q[3]), nearest_double(q[0]));
    }
    const Rational3& p = step.path[i];
    if (!ends.empty()) angle = ends.back().angle + std::remainder(angle - ends.back().angle, 2 * 3.14159265358979);
    ends.push_back({{nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])}, angle});
  }
  constexpr int kSamples = 64;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    for (int k = 0; k <= kSamples; ++k) {
      const double t = static_cast<double>(k) / kSamples;
      const double angle = ends[i].angle + t * (ends[i + 1].angle - ends[i].angle);
      std::array<double, 3> at{};
      for (std::size_t c = 0; c < 3; ++c) {
        at[c] = ends[i].position[c] + t * (ends[i + 1].position[c] - ends[i].position[c]);
      }
      const double cosine = std::cos(angle);
      const double sine = std::sin(angle);
      const PlanePose pose{at[0] + px - (cosine * px - sine * py), at[1] + py - (sine * px + cosine * py), at[2],
                           cosine, sine};
      // What turns slower or faster than the samples do is off by little.
      if (!is_free(moving, pose, -1e-3, stay)) return false;
    }
  }
  return true;
}

PartSet parts_of(const PartSet& all, unsigned bits) {
  PartSet result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if ((bits >> i & 1U) != 0) result.push_back(all[i]);
  }
  return result;
}

}  // namespace

void fuzz_turning_assemblies(const Case& the_case) {
  Choices& choices = the_case.choices();
  std::set<Square> pocket = random_room(choices);
  std::vector<Bricks> parts(1);
  for (int x = 0; x < kBlockWidth; ++x) {
    for (int y = 0; y < kBlockWidth; ++y) {
      const double a = kSquare * x;
      const double b = kSquare * y;
      if (!pocket.contains({x, y})) parts[0].push_back({{a, b, 0}, {a + kSquare, b + kSquare, kSquare}});
    }
  }
  const double size = kSquare * kBlockWidth;
  parts[0].push_back({{0, 0, -kSquare}, {size, size, 0}});
  parts[0].push_back({{0, 0, kSquare}, {size, size, 2 * kSquare}});
  for (int count = choices.between(1, 2); count > 0; --count) {
    Bricks part = random_part(choices, pocket);
    if (!part.empty()) parts.push_back(std::move(part));
  }
  if (parts.size() < 2) return;
  planner::Assembly assembly;
  assembly.turning_axis = Rational3{0, 0, 1};
  for (const Bricks& part : parts) {
    assembly.names.push_back(std::to_string(assembly.names.size()));
    std::string text = "part " + assembly.names.back() + ":";
    for (const Brick& b : part) {
      text += " box(";
      for (const double x : b.low) text += std::to_string(static_cast<int>(x)) + ",";
      for (const double x : b.high) text += std::to_string(static_cast<int>(x)) + ",";
      text.back() = ')';
    }
    the_case.tell(text);
    assembly.parts.push_back(solid_of(part));
  }
  const planner::Disassembly answer = planner::take_apart(assembly, {.digits = {}, .max_cells = 60});
  Case::require(!answer.overlap, "overlap: of parts that do not");
  for (const planner::DisassemblyStep& step : answer.steps) {
    the_case.count(step.turning ? "steps that turn" : "steps");
    Case::require(is_step_free(parts, step), "steps: a way that is not free");
    Case::require(!PoseGrid(together(parts, step.parts), together(parts, step.stay)).surely_stays(),
                  "steps: of a set that cannot leave");
  }
  for (const planner::Inseparable& stuck : answer.inseparable) {
    the_case.count("inseparable");
    for (unsigned bits = 2; bits < 1U << stuck.parts.size(); bits += 2) {  // the first part stays
      const PartSet moving = parts_of(stuck.parts, bits);
      const PartSet stay = planner::without(stuck.parts, moving);
      Case::require(!PoseGrid(together(parts, moving), together(parts, stay)).surely_leaves(),
                    "inseparable: a set leaves on the grid");
    }
  }
  the_case.count("undecided", answer.undecided.size());
}

}  // namespace nef::fuzz
