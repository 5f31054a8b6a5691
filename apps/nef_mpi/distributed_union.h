// SPDX-License-Identifier: Apache-2.0
//
// Unions on many ranks.
#pragma once

#include <functional>

#include "apps/nef_mpi/task_dealer.h"
#include "apps/nef_mpi/work_folder.h"
#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/boolean/union_order.h"
#include "nef/tiles/import/union_in_tiles.h"

namespace nef::mpi {

/// Tasks have failed for good, or rank 0 could not begin; thrown on all ranks alike.
class TasksFailed : public InputError {
 public:
  using InputError::InputError;
};

/// What rank 0 is told of a run.
struct Watcher {
  /// How far it has come; what rank 0 does alone is on its threads.
  Monitor monitor;
  /// The seconds of a task.
  std::function<void(const std::string& phase, std::size_t task, double seconds)> time;
};

/// Tasks of one kind.
struct TaskPhase {
  std::string name;
  std::size_t count = 0;
  std::function<bool(std::size_t task)> finished;             ///< asked on rank 0: whether an earlier run has done it
  std::function<std::string(std::size_t task)> name_of_task;  ///< for the user
  Task task;
  TaskDone done = [](std::size_t, const std::string&, double) {};
  TaskNeeds needs = {};
};

/// Collective. Does those tasks that are not finished, and throws TasksFailed, which names tasks that have failed for
/// good: those that are finished stay so.
void do_tasks(const Environment& mpi, const TaskPhase& phase, const Watcher& watcher);

/// Pieces and what rank 0 has found out of them, the same on all ranks.
struct MeasuredPieces {
  PieceSource source;
  std::vector<UnionOperand> operands;  ///< of each piece

  /// The regions for a union in tiles, with so many pieces that there are enough tasks for any number of ranks.
  [[nodiscard]] RegionalUnion regions() const;
};

/// Collective. Makes each piece once, some hundred in a task.
MeasuredPieces measure_pieces(const Environment& mpi, const WorkFolder& work, const PieceSource& pieces,
                              const Watcher& watcher);

/// Collective. What `compute` makes of each region, each a task on one rank, its result in the work folder. On rank 0
/// they come back, in tiles that `tiling.store` reads when they are needed, or that are all in memory if there is none;
/// elsewhere nothing does.
std::vector<TileRef> regions_of_ranks(const Environment& mpi, const WorkFolder& work, std::size_t count,
                                      const std::function<TileRef(std::size_t region)>& compute, const Tiling& tiling,
                                      const Watcher& watcher);

/// Collective. The union of all pieces region by region, each task on one rank, its result in the work folder. On rank
/// 0 the set comes back, in tiles that `tiling.store` reads when they are needed, or that are all in memory if there is
/// none; elsewhere it is empty.
TiledPolyhedron union_by_regions(const Environment& mpi, const WorkFolder& work, const MeasuredPieces& pieces,
                                 const RegionalUnion& regions, const Tiling& tiling, const Watcher& watcher);

/// Collective. The union of all pieces as one complex, up a tree (nef/boolean/union_order.h): first the pieces of
/// neighbourhoods, then two results at a time, each a task on one rank, its result in the work folder until it is
/// used up. Rank 0 does the last union and gets the set; elsewhere it is empty.
Polyhedron union_up_a_tree(const Environment& mpi, const WorkFolder& work, const MeasuredPieces& pieces,
                           const Watcher& watcher);

}  // namespace nef::mpi
