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

std::string bytes_of(const std::vector<Box>& boxes) {
  std::string bytes(boxes.size() * sizeof(Box), '\0');
  std::memcpy(bytes.data(), boxes.data(), bytes.size());
  return bytes;
}

std::vector<Box> boxes_of(const std::string& bytes) {
  std::vector<Box> boxes(bytes.size() / sizeof(Box));
  std::memcpy(static_cast<void*>(boxes.data()), bytes.data(), boxes.size() * sizeof(Box));
  return boxes;
}

std::vector<Box> find_boxes(const Environment& mpi, const WorkFolder& work, const PieceSource& pieces,
                            const Watcher& watcher) {
  const std::size_t tasks = (pieces.count + kBoxesOfATask - 1) / kBoxesOfATask;
  const auto last = [&](std::size_t task) {
    return std::min<std::uint32_t>(pieces.count, static_cast<std::uint32_t>(task + 1) * kBoxesOfATask);
  };
  do_tasks(
      mpi, "boxes of the pieces", tasks, [&](std::size_t task) { return work.has(boxes_name(task)); },
      [&](std::size_t task) {
        return "pieces " + std::to_string(task * kBoxesOfATask + 1) + " to " + std::to_string(last(task));
      },
      [&](std::size_t task) {
        std::vector<Box> boxes;
        for (auto i = static_cast<std::uint32_t>(task) * kBoxesOfATask; i < last(task); ++i) {
          boxes.push_back(piece_box(pieces.set(i)));
        }
        return bytes_of(boxes);
      },
      [&](std::size_t task, const std::string& bytes, double) { write_file(work / boxes_name(task), bytes); }, watcher);
  std::string bytes;
  if (mpi.first()) {
    for (std::size_t task = 0; task < tasks; ++task) bytes += read_file(work / boxes_name(task));
  }
  mpi.share(bytes);
  return boxes_of(bytes);
}

}  // namespace

void do_tasks(const Environment& mpi, const std::string& phase, std::size_t count,
              const std::function<bool(std::size_t)>& finished, const std::function<std::string(std::size_t)>& name,
              const Task& task, const TaskDone& done, const Watcher& watcher) {
  std::vector<std::size_t> todo;
  for (std::size_t i = 0; i < count && mpi.first(); ++i) {
    if (!finished(i)) todo.push_back(i);
  }
  std::size_t so_far = count - todo.size();
  if (mpi.first()) watcher.progress(phase, so_far, count);
  const std::vector<TaskFailure> failures =
      deal_tasks(mpi, todo, task, [&](std::size_t i, const std::string& result, double seconds) {
        done(i, result, seconds);
        watcher.time(phase, i, seconds);
        watcher.progress(phase, ++so_far, count);
      });
  if (failures.empty()) return;
  std::string text =
      std::to_string(failures.size()) + " of " + std::to_string(count) + " tasks failed (" + phase + "): ";
  constexpr std::size_t kNamed = 3;
  for (std::size_t i = 0; i < std::min(kNamed, failures.size()); ++i) {
    text += (i == 0 ? "" : "; ") + name(failures[i].task) + ": " + failures[i].error;
  }
  if (failures.size() > kNamed) text += "; ...";
  throw TasksFailed(text + "; what is finished is kept: mend this and run again");
}

std::size_t pieces_of_a_region(std::uint32_t pieces) {
  constexpr std::size_t kMost = 400;  // more, and uniting them one by one takes longer than cutting once more
  constexpr std::size_t kLeast = 32;  // fewer, and most pieces meet several regions
  constexpr std::size_t kTasks = 128;
  return std::clamp<std::size_t>(pieces / kTasks, kLeast, kMost);
}

TiledPolyhedron distributed_union(const Environment& mpi, const WorkFolder& work, const PieceSource& pieces,
                                  const Tiling& tiling, const Watcher& watcher) {
  const RegionalUnion regions(find_boxes(mpi, work, pieces, watcher), pieces_of_a_region(pieces.count));
  Tiling of_a_task = tiling;
  of_a_task.threads = 1;
  do_tasks(
      mpi, "regions", regions.region_count(),
      [&](std::size_t region) { return work.has(region_name(region) + "/index"); },
      [](std::size_t region) { return "region " + std::to_string(region + 1); },
      [&](std::size_t region) {
        std::vector<Polyhedron> sets;
        for (const std::uint32_t piece : regions.pieces_of(region)) sets.push_back(pieces.set(piece));
        write_tiles(work / region_name(region), {regions.unite_in(region, std::move(sets), of_a_task), of_a_task});
        return std::string();
      },
      [](std::size_t, const std::string&, double) {}, watcher);
  if (!mpi.first()) return {};
  std::vector<TileRef> trees(regions.region_count());
  parallel_for(trees.size(), tiling.threads, [&](std::size_t region) {
    trees[region] = read_tiles(work / region_name(region), tiling.store).tree();
  });
  return {regions.tree(trees), tiling};
}

}  // namespace nef::mpi
