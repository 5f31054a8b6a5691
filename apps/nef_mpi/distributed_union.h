// SPDX-License-Identifier: Apache-2.0
//
// Unions on many ranks.
#pragma once

#include <functional>

#include "apps/nef_mpi/task_dealer.h"
#include "apps/nef_mpi/work_folder.h"
#include "nef/base/error.h"
#include "nef/tiles/import/union_in_tiles.h"

namespace nef::mpi {

/// Tasks have failed for good, or rank 0 could not begin; thrown on all ranks alike.
class TasksFailed : public InputError {
 public:
  using InputError::InputError;
};

/// What rank 0 is told of a run.
struct Watcher {
  /// How far it has come.
  std::function<void(const std::string& phase, std::size_t done, std::size_t total)> progress;
  /// The seconds of a task.
  std::function<void(const std::string& phase, std::size_t task, double seconds)> time;
};

/// Collective. Does those tasks of `count` for which `finished` does not hold on rank 0, and throws TasksFailed, which
/// names the tasks (`name`) if some fail for good: those that are finished stay so.
void do_tasks(const Environment& mpi, const std::string& phase, std::size_t count,
              const std::function<bool(std::size_t)>& finished, const std::function<std::string(std::size_t)>& name,
              const Task& task, const TaskDone& done, const Watcher& watcher);

/// How many pieces a region has, so that there are enough tasks for any number of ranks; the same for all of these.
std::size_t pieces_of_a_region(std::uint32_t pieces);

/// Collective. The union of all pieces: boxes of some pieces at a time, then region by region, each task on one rank,
/// its result in the work folder. On rank 0 the set comes back, in tiles that `tiling.store` reads when they are
/// needed, or that are all in memory if there is none; elsewhere it is empty.
TiledPolyhedron distributed_union(const Environment& mpi, const WorkFolder& work, const PieceSource& pieces,
                                  const Tiling& tiling, const Watcher& watcher);

}  // namespace nef::mpi
