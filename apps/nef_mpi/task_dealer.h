// SPDX-License-Identifier: Apache-2.0
//
// Tasks dealt out to the ranks of an MPI run.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace nef::mpi {

/// MPI from its beginning to its end; one in a program. Only the thread that made it may speak to other ranks.
class Environment {
 public:
  /// `alone`: one rank without MPI, for who only asks for help.
  Environment(int& argc, char**& argv, bool alone = false);
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment();

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int ranks() const { return ranks_; }
  [[nodiscard]] bool first() const { return rank_ == 0; }

  /// Collective: every rank gets the text of rank 0.
  void share(std::string& text) const;

  /// Ends the run on all ranks, whatever they do.
  [[noreturn]] void abort(int code) const;

 private:
  bool alone_;
  int rank_ = 0;
  int ranks_ = 1;
};

/// A task that could not be done, however often it was tried.
struct TaskFailure {
  std::size_t task = 0;
  std::string error;
};

/// Does a task on whatever rank; what it returns goes to rank 0. What it throws is its failure.
using Task = std::function<std::string(std::size_t task)>;
/// Told on rank 0, in its main thread, of every task that is done, in any order, and how long that took.
using TaskDone = std::function<void(std::size_t task, const std::string& result, double seconds)>;

/// The tasks whose results a task needs.
using TaskNeeds = std::function<std::vector<std::size_t>(std::size_t task)>;

/// Collective. Does the tasks of `todo`, which counts on rank 0 only, each on one rank, rank 0 among them: whoever is
/// free gets the next one. A task that fails is tried again, on another rank if there is one that asks, `attempts`
/// times in all; the others go on, but those that need it. A task begins when those of `todo` that it needs (`needs`,
/// asked on rank 0 only) are done, and then before others. Returns the failures in the order of the tasks, on every
/// rank. A rank that waits sleeps.
std::vector<TaskFailure> deal_tasks(const Environment& mpi, const std::vector<std::size_t>& todo, const Task& task,
                                    const TaskDone& done, const TaskNeeds& needs = {}, int attempts = 2);

}  // namespace nef::mpi
