// SPDX-License-Identifier: Apache-2.0
//
// All options are declared here. A task is named by one option, or is the sum; `check` refuses every combination that
// does not mean anything with a message that says why.
#include "apps/minkowski/command/arguments.h"

#include <algorithm>
#include <array>

#include "apps/program/common_options.h"
#include "nef/base/error.h"
#include "nef/base/text/word_list.h"
#include "nef/io/polyhedron_file.h"

namespace nef::minkowski {
namespace {

std::vector<std::string> strategy_names() {
  std::vector<std::string> names;
  for (const auto& [name, strategy] : kUnionStrategies) names.emplace_back(name);
  return names;
}

// The options that name a task, and whether they are given.
struct TaskOption {
  Task task;
  std::string option;
  bool given;
};

std::vector<TaskOption> task_options(const Arguments& a) {
  return {{Task::kErode, "--erode", a.erode},
          {Task::kOpen, "--open", a.open},
          {Task::kClose, "--close", a.close},
          {Task::kOffset, "--offset", !a.offset.empty()},
          {Task::kSweep, "--sweep", !a.sweep.empty()},
          {Task::kHull, "--hull", a.hull},
          {Task::kNoFit, "--no-fit", a.no_fit},
          {Task::kPenetration, "--penetration", a.penetration},
          {Task::kReach, "--reach", a.reach},
          {Task::kMillable, "--millable", a.millable},
          {Task::kConfigurationSpace, "--configuration-space", a.configuration_space},
          {Task::kDecompose, "--decompose", a.decompose}};
}

void declare_tasks(CLI::App& app, Arguments& a) {
  app.add_flag("--erode", a.erode, "A eroded by B: all x for which B moved by x lies in A");
  app.add_flag("--open", a.open, "The opening of A by B: all of A that B covers as it moves within A");
  app.add_flag("--close", a.close, "The closing of A by B: A + B, eroded by B");
  app.add_option("--offset", a.offset,
                 "R or R,N: grow A by a ball of radius R, or shrink it if R < 0; the result contains the exact answer "
                 "(--outer, default) or lies inside it (--inner); N: how fine the ball is (8), see --ball")
      ->type_name("R[,N]");
  app.add_flag("--inner", a.inner, "With --offset, --ball: the result lies inside that of a round ball");
  app.add_flag("--outer", a.outer, "With --offset, --ball: the result contains that of a round ball");
  app.add_option(
         "--decimate", a.decimate,
         "With --offset: a result of about N triangles, which still contains the exact answer, or lies inside it "
         "(--inner); how far from it at most is reported")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{4}, std::size_t{1} << 40U));
  app.add_option("--digits", a.digits,
                 "With --offset: a result whose coordinates have at most N decimals, within bounds as with --decimate")
      ->type_name("N")
      ->check(CLI::Range(0, 300));
  app.add_option("--sweep", a.sweep,
                 "Points x,y,z: the region that A sweeps as it moves along the polyline through them")
      ->expected(-1)
      ->type_name("X,Y,Z");
  app.add_flag("--hull", a.hull, "The convex hull of A");
  app.add_flag("--penetration", a.penetration,
               "Report whether A and B are disjoint, touch or overlap, and the shortest translation of B to contact");
  app.add_flag("--no-fit", a.no_fit, "The translations of B for which it touches A without overlap");
  app.add_flag("--reach", a.reach,
               "TOOL PART: the free positions of the tool (its origin) that are connected to the outside");
  app.add_option("--from", a.from, "x,y,z, with --reach: the positions connected to this one instead")
      ->type_name("X,Y,Z");
  app.add_option("--touched", a.touched, "With --reach: file for the part of the boundary that the tool can touch")
      ->type_name("FILE");
  app.add_option("--untouched", a.untouched,
                 "With --reach: file for the part of the boundary that the tool cannot touch")
      ->type_name("FILE");
  app.add_option("--labels", a.labels,
                 "With --reach: mesh file for the part's whole boundary, its faces in two groups, touched and "
                 "untouched (groups in OBJ, colours in OFF, PLY and GLB). With --millable: for what the tool leaves "
                 "beyond the part, in groups region1, region2, ... by descending volume")
      ->type_name("FILE");
  app.add_flag("--millable", a.millable,
               "PART TOOL: the shape that remains of a block around the part when the tool has removed all it can "
               "without cutting into the part");
  app.add_option("--axes", a.axes,
                 "3, with --millable: the tool comes down the z axis, so the space above it must be free")
      ->check(CLI::IsMember({3}));
  app.add_flag("--decompose", a.decompose, "Write the convex cells of A, to one mesh file or into a directory");
  app.add_option("--format", a.format,
                 "Format of cells in a directory: that of a mesh (default: off), or nef (exact, with marks)")
      ->check(CLI::IsMember(file_extensions()));
  app.add_flag("--configuration-space", a.configuration_space, "Free positions of a robot among obstacles");
  app.add_option("--robot", a.robot, "The robot; its reference point is the origin")->type_name("FILE");
  app.add_option("--obstacles", a.obstacles, "The obstacles")->expected(-1)->type_name("FILE");
  app.add_option("--box", a.box, "x0,y0,z0,x1,y1,z1: bounds of the reference point")->type_name("BOX");
}

Task task_of(const Arguments& a) {
  const TaskOption* found = nullptr;
  const std::vector<TaskOption> options = task_options(a);
  for (const TaskOption& option : options) {
    if (!option.given) continue;
    if (found != nullptr)
      throw InputError(found->option + " and " + option.option + " are two tasks: give one of them");
    found = &option;
  }
  return found != nullptr ? found->task : Task::kSum;
}

// Tasks that take A alone.
bool is_unary(Task task) {
  return task == Task::kOffset || task == Task::kSweep || task == Task::kHull || task == Task::kDecompose;
}

bool has_tool(const Arguments& a) { return !a.ball.empty() || !a.box_tool.empty(); }

void check_output(const Arguments& a, Task task) {
  if (task == Task::kPenetration) {
    if (!a.session.output.empty())
      throw InputError("--penetration prints its answer and takes no -o (--report writes it to a file)");
  } else if (a.session.output.empty()) {
    const bool is_bare = task == Task::kSum && a.operands.empty();
    throw InputError(is_bare ? "give two sets and an output: minkowski A B -o OUT (see minkowski --help)"
                             : "no output: name a file with -o");
  }
  if (task != Task::kPenetration && task != Task::kDecompose) a.session.require_output();
  if (!a.format.empty() && task != Task::kDecompose) {
    throw InputError("--format goes with --decompose; -o names a file by its extension");
  }
  if (task != Task::kReach && !(a.from.empty() && a.touched.empty() && a.untouched.empty())) {
    throw InputError("--from, --touched and --untouched go with --reach");
  }
  if (task != Task::kReach && task != Task::kMillable && !a.labels.empty()) {
    throw InputError("--labels goes with --reach and --millable");
  }
  if (task != Task::kOffset && (a.decimate != 0 || a.digits)) {
    throw InputError("--decimate and --digits go with --offset (nef decimate simplifies any solid)");
  }
  if (task != Task::kMillable && a.axes != 0) throw InputError("--axes goes with --millable");
  if (a.inner && a.outer) throw InputError("--inner and --outer exclude each other: give one of them");
  if ((a.inner || a.outer) && task != Task::kOffset && a.ball.empty()) {
    throw InputError("--inner and --outer go with --offset or --ball");
  }
}

void check_tiles(const Arguments& a, Task task) {
  if (a.memory.empty()) return;
  if (a.decimate != 0 || a.digits) {
    throw InputError("--memory and --decimate or --digits exclude each other: what simplifies needs the whole set");
  }
  constexpr std::array<Task, 5> kTiled{Task::kSum, Task::kErode, Task::kOpen, Task::kClose, Task::kOffset};
  if (std::find(kTiled.begin(), kTiled.end(), task) == kTiled.end()) {
    throw InputError("--memory goes with sums, --erode, --open, --close and --offset, not with --" + name(task));
  }
  if (!a.preview.empty()) throw InputError("--memory and --preview exclude each other: a picture needs the whole set");
}

void check_operands(const Arguments& a, Task task) {
  if (!a.ball.empty() && !a.box_tool.empty()) {
    throw InputError("--ball and --box-tool both replace B: give one of them");
  }
  const bool changes_b = has_tool(a) || a.open_b || a.negate_b || a.hull_b;
  if (task == Task::kConfigurationSpace) {
    if (a.robot.empty()) throw InputError("--configuration-space needs --robot");
    if (a.obstacles.empty()) throw InputError("--configuration-space needs --obstacles (one file or more)");
    if (!a.operands.empty()) throw InputError("--configuration-space takes --robot and --obstacles, not A and B");
    if (changes_b || a.open_a) {
      throw InputError(
          "--configuration-space does not take --ball, --box-tool, --open-a, --open-b, --negate-b or --hull-b");
    }
    return;
  }
  if (!a.robot.empty() || !a.obstacles.empty() || !a.box.empty()) {
    throw InputError("--robot, --obstacles and --box go with --configuration-space");
  }
  if (is_unary(task) && changes_b) {
    throw InputError("--" + name(task) + " takes A alone: remove the options that replace or change B");
  }
  if (task == Task::kReach && (changes_b || a.open_a)) {
    throw InputError("--reach takes a tool and a part: remove the options that replace or change A or B");
  }
  const std::size_t wanted = is_unary(task) || has_tool(a) ? 1 : 2;
  if (a.operands.size() != wanted) {
    throw InputError("give " + std::string(wanted == 1 ? "one operand" : "two operands") + ", not " +
                     std::to_string(a.operands.size()) + " (see minkowski --help)");
  }
}

}  // namespace

void declare(CLI::App& app, Arguments& a) {
  app.add_option("operands", a.operands,
                 "A and B: sets or meshes (" + word_list(file_extensions(), "or") + "), or folders NAME.tiles")
      ->type_name("FILE");
  app.add_option("-o,--output", a.session.output, "Output file; the extension selects the format")->type_name("FILE");
  app.add_flag("--open-a", a.open_a, "Use the interior of A");
  app.add_flag("--open-b", a.open_b, "Use the interior of B");
  app.add_flag("--negate-b", a.negate_b, "Use -B instead of B");
  app.add_flag(
      "--hull-b", a.hull_b,
      "Use the convex hull of B (a superset of B): for solids that are convex up to rounding of their coordinates");
  app.add_option("--ball", a.ball,
                 "R,N: use a ball of radius R as B: an octahedron with edges split into N parts, 4 N^2 + 2 vertices; "
                 "inscribed (--inner, default) or circumscribed (--outer)")
      ->type_name("R,N");
  app.add_option("--box-tool", a.box_tool, "x,y,z: use a box of these extents, centred at the origin, as B")
      ->type_name("X,Y,Z");
  app.add_option("--union", a.union_name,
                 "Algorithm of sums: auto (default), convolution (without cells), queue (of sums of cells)")
      ->check(CLI::IsMember(strategy_names()));
  app.add_option(
         "--memory", a.memory,
         "Memory for tiles, such as 800M or 2G, with sums, --erode, --open, --close and --offset: A is cut into "
         "tiles and summed region by region, tiles beyond it are kept in files beside the output")
      ->type_name("SIZE");
  declare_tasks(app, a);
  add_input_flags(&app, a.session);
  add_file_output_options(app, a.session.exact, a.session.binary, a.session.text);
  add_manifold_option(app, a.session.mesh_file.manifold);
  add_mesh_file_options(app, a.session.mesh_file);
  app.add_option("--report", a.session.report, "Write a JSON report: cells, pairs, times, predicates, memory, result")
      ->type_name("FILE");
  app.add_flag("--exact-volume", a.exact_volume,
               "Report the exact volume of the result, which may have millions of digits");
  app.add_option("--preview", a.preview, "Write pictures (PNG) of the operands and the result into this directory")
      ->type_name("DIR");
  add_run_flags(&app, a.session);
}

std::string name(Task task) {
  for (const TaskOption& option : task_options({})) {
    if (option.task == task) return option.option.substr(2);
  }
  return "sum";
}

Task check(const Arguments& a) {
  const Task task = task_of(a);
  check_output(a, task);
  check_tiles(a, task);
  check_operands(a, task);
  return task;
}

UnionStrategy strategy(const Arguments& arguments) {
  const auto is_named = [&](const auto& entry) { return entry.first == arguments.union_name; };
  return std::find_if(kUnionStrategies.begin(), kUnionStrategies.end(), is_named)->second;
}

}  // namespace nef::minkowski
