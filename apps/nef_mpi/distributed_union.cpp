// SPDX-License-Identifier: Apache-2.0
#include "apps/nef_mpi/distributed_union.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "nef/base/threads/parallel.h"
#include "nef/io/file_bytes.h"
#include "nef/tiles/storage/tile_folder.h"

namespace nef::mpi {
namespace {

constexpr std::uint32_t kBoxesOfATask = 512;

std::string boxes_name(std::size_t task) { return "boxes-" + std::to_string(task); }
std::string region_name(std::size_t region) { return "region-" + std::to_string(region) + ".tiles"; }

// Eight numbers of eight bytes each.
struct OperandRecord {
  Box box;
  std::uint64_t weight = 0;
  std::uint64_t bounded = 0;
};

std::string bytes_of(const std::vector<OperandRecord>& records) {
  std::string bytes(records.size() * sizeof(OperandRecord), '\0');
  std::memcpy(bytes.data(), records.data(), bytes.size());
  return bytes;
}

std::vector<UnionOperand> operands_of(const std::string& bytes) {
  std::vector<OperandRecord> records(bytes.size() / sizeof(OperandRecord));
  std::memcpy(static_cast<void*>(records.data()), bytes.data(), records.size() * sizeof(OperandRecord));
  std::vector<UnionOperand> operands;
  operands.reserve(records.size());
  for (const OperandRecord& r : records) operands.push_back({r.box, r.weight, r.bounded != 0});
  return operands;
}

std::size_t pieces_of_a_region(std::size_t pieces) {
  constexpr std::size_t kMost = 400;  // more, and uniting them one by one takes longer than cutting once more
  constexpr std::size_t kLeast = 32;  // fewer, and most pieces meet several regions
  constexpr std::size_t kTasks = 128;
  return std::clamp<std::size_t>(pieces / kTasks, kLeast, kMost);
}

}  // namespace

void do_tasks(const Environment& mpi, const TaskPhase& phase, const Watcher& watcher) {
  std::vector<std::size_t> todo;
  for (std::size_t i = 0; i < phase.count && mpi.first(); ++i) {
    if (!phase.finished(i)) todo.push_back(i);
  }
  std::size_t so_far = phase.count - todo.size();
  if (mpi.first()) watcher.monitor.tell_progress(phase.name.c_str(), so_far, phase.count);
  const TaskDone done = [&](std::size_t i, const std::string& result, double seconds) {
    phase.done(i, result, seconds);
    watcher.time(phase.name, i, seconds);
    watcher.monitor.tell_progress(phase.name.c_str(), ++so_far, phase.count);
  };
  const std::vector<TaskFailure> failures = deal_tasks(mpi, todo, phase.task, done, phase.needs);
  if (failures.empty()) return;
  std::string text =
      std::to_string(failures.size()) + " of " + std::to_string(phase.count) + " tasks failed (" + phase.name + "): ";
  constexpr std::size_t kNamed = 3;
  for (std::size_t i = 0; i < std::min(kNamed, failures.size()); ++i) {
    text += (i == 0 ? "" : "; ") + phase.name_of_task(failures[i].task) + ": " + failures[i].error;
  }
  if (failures.size() > kNamed) text += "; ...";
  throw TasksFailed(text + "; finished tasks are kept: repair this and run again");
}

MeasuredPieces measure_pieces(const Environment& mpi, const WorkFolder& work, const PieceSource& pieces,
                              const Watcher& watcher) {
  const std::size_t tasks = (pieces.count + kBoxesOfATask - 1) / kBoxesOfATask;
  const auto last = [&](std::size_t task) {
    return std::min<std::uint32_t>(pieces.count, static_cast<std::uint32_t>(task + 1) * kBoxesOfATask);
  };
  const auto measure = [&](std::size_t task) {
    std::vector<OperandRecord> records;
    for (auto i = static_cast<std::uint32_t>(task) * kBoxesOfATask; i < last(task); ++i) {
      const UnionOperand operand = union_operand(pieces.set(i, {}));
      records.push_back({operand.box, operand.weight, operand.bounded ? 1U : 0U});
    }
    return bytes_of(records);
  };
  do_tasks(
      mpi,
      {.name = "boxes of the pieces",
       .count = tasks,
       .finished = [&](std::size_t task) { return work.has(boxes_name(task)); },
       .name_of_task =
           [&](std::size_t task) {
             return "pieces " + std::to_string(task * kBoxesOfATask + 1) + " to " + std::to_string(last(task));
           },
       .task = measure,
       .done = [&](std::size_t task, const std::string& bytes, double) { write_file(work / boxes_name(task), bytes); }},
      watcher);
  std::string bytes;
  if (mpi.first()) {
    for (std::size_t task = 0; task < tasks; ++task) bytes += read_file(work / boxes_name(task));
  }
  mpi.share(bytes);
  return {pieces, operands_of(bytes)};
}

RegionalUnion MeasuredPieces::regions() const {
  std::vector<Box> boxes;
  boxes.reserve(operands.size());
  for (const UnionOperand& operand : operands) boxes.push_back(region_box(operand));
  return {std::move(boxes), pieces_of_a_region(operands.size())};
}

std::vector<TileRef> regions_of_ranks(const Environment& mpi, const WorkFolder& work, std::size_t count,
                                      const std::function<TileRef(std::size_t region)>& compute, const Tiling& tiling,
                                      const Watcher& watcher) {
  do_tasks(mpi,
           {.name = "regions",
            .count = count,
            .finished = [&](std::size_t region) { return work.has(region_name(region) + "/index"); },
            .name_of_task = [](std::size_t region) { return "region " + std::to_string(region + 1); },
            .task =
                [&](std::size_t region) {
                  write_tiles(work / region_name(region), {compute(region), tiling});
                  return std::string();
                }},
           watcher);
  if (!mpi.first()) return {};
  std::vector<TileRef> trees(count);
  parallel_for(count, watcher.monitor, [&](std::size_t region, const Monitor& own) {
    trees[region] = read_tiles(work / region_name(region), tiling.store, own).tree();
  });
  return trees;
}

TiledPolyhedron union_by_regions(const Environment& mpi, const WorkFolder& work, const MeasuredPieces& pieces,
                                 const RegionalUnion& regions, const Tiling& tiling, const Watcher& watcher) {
  const auto unite_region = [&](std::size_t region) {
    std::vector<Polyhedron> sets;
    for (const std::uint32_t piece : regions.pieces_of(region)) sets.push_back(pieces.source.set(piece, {}));
    return regions.unite_in(region, std::move(sets), tiling, {});
  };
  const std::vector<TileRef> trees = regions_of_ranks(mpi, work, regions.region_count(), unite_region, tiling, watcher);
  if (!mpi.first()) return {};
  return {regions.tree(trees), tiling};
}

}  // namespace nef::mpi
