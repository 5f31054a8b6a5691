// SPDX-License-Identifier: Apache-2.0
//
// Each subcommand registers a job when it is parsed; `run` does it on every rank. Rank 0 alone reads what decides the
// tasks and prepares the folder of work (`on_first`, which shares its errors with all), the ranks do the tasks, and
// rank 0 writes the result. A job is named by all that decides its tasks, inputs included: an interrupted run goes on
// only if that is unchanged, and inputs that change during the run are refused.
#include "apps/nef_mpi/run.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <optional>
#include <streambuf>
#include <utility>
#include <vector>

#include "apps/minkowski/command/ball_words.h"
#include "apps/minkowski/sum/regional_sum.h"
#include "apps/nef_mpi/distributed_sum.h"
#include "apps/nef_mpi/distributed_union.h"
#include "apps/nef_mpi/piece_list.h"
#include "apps/program/run_program.h"
#include "apps/program/tile_flags.h"
#include "apps/program/version.h"
#include "apps/visual_hull/command/arguments.h"
#include "apps/visual_hull/command/frames.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/file_bytes.h"
#include "nef/tiles/storage/tile_folder.h"
#include "nef/tiles/tile_tree.h"
#include "nef/version.h"

namespace nef::mpi {
namespace {

// Swallows what ranks other than 0 would print.
class Silence : public std::streambuf {
 protected:
  int_type overflow(int_type c) override { return traits_type::not_eof(c); }
};

// One run on one rank.
class Run {
 public:
  explicit Run(const Environment& mpi) : mpi_(mpi), session_("nef_mpi", std::cout, std::cerr) {}

  void add_commands(CLI::App& app) {
    app.set_version_flag("--version", version_text("nef_mpi"));
    app.require_subcommand(1);
    app.footer(
        "Start with mpirun: mpirun -n 8 nef_mpi union --list pieces.txt -o all.nef. All ranks must see the same "
        "files.\n"
        "Results of finished tasks are kept in OUT.work until the output is written; a stopped run continues from "
        "there\n"
        "when it is started again. The output has the same bytes for any number of ranks.");
    add_union(app);
    add_sum(app);
    add_frames(app);
  }

  // What the subcommand does.
  int run() {
    try {
      return job_();
    } catch (const TasksFailed&) {
      throw;  // all ranks know
    } catch (const std::exception& error) {
      // The others would wait for this rank forever.
      session_.complain("rank " + std::to_string(mpi_.rank()) + ": " + error.what());
      mpi_.abort(kBad);
    }
  }

  void complain(const std::string& line) {
    if (mpi_.first()) session_.complain(line);
  }

 private:
  void add_output(CLI::App* command) {
    add_run_flags(command, session_);
    add_input_flags(command, session_);
    add_output_flags(command, session_)->required();
    add_tile_flags(command, flags_);
    command->add_option("--times", times_, "Write the seconds of each task to a CSV file")->type_name("FILE");
  }

  void add_union(CLI::App& app) {
    CLI::App* command = app.add_subcommand("union", "The union of many sets, region by region");
    command->add_option("pieces", session_.inputs, "Files");
    command->add_option("--list", list_, "File of further pieces, one nef eval expression per line")->type_name("FILE");
    add_output(command);
    command->callback([this] { job_ = [this] { return unite(); }; });
  }

  void add_sum(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("minkowski", "The Minkowski sum of two sets, the first summed part by part, or an offset");
    command->add_option("inputs", session_.inputs, "Files of the two sets; with --offset of one")
        ->required()
        ->expected(1, 2);
    command
        ->add_option("--offset", offset_,
                     "R or R,N: grow the set by a ball of radius R, or shrink it if R < 0, region by region, as "
                     "minkowski --offset does")
        ->type_name("R[,N]");
    command->add_flag("--inner", inner_, "With --offset: the result lies inside that of a round ball, not around it");
    command->add_option("--part", part_, "Vertices of the first set per part, without --offset")
        ->check(CLI::Range(std::size_t{8}, std::size_t{1} << 30U))
        ->capture_default_str();
    add_output(command);
    command->callback([this] { job_ = [this] { return offset_.empty() ? sum() : offset(); }; });
  }

  void add_frames(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("visual_hull", "Visual hulls of all frames of a scene, as visual_hull --frames makes them");
    nef::visual_hull::add_options(*command, hull_);
    command->callback([this] { job_ = [this] { return frames(); }; });
  }

  // What rank 0 does alone before the others go on; if it fails, all of them hear why.
  void on_first(const std::function<void()>& work) {
    std::string error;
    if (mpi_.first()) {
      try {
        work();
      } catch (const Error& failure) {
        error = failure.what();
      }
    }
    mpi_.share(error);
    if (!error.empty()) throw TasksFailed(error);
  }

  [[nodiscard]] Watcher watcher() {
    return {.monitor = session_.monitor.telling(show_),
            .time = [this](const std::string& phase, std::size_t task, double seconds) {
              times_text_ += phase + "," + std::to_string(task) + "," + std::to_string(seconds) + "\n";
            }};
  }

  // The beginning of a job's text: all that decides which tasks there are, and what they give, but its inputs.
  [[nodiscard]] std::string job(const std::string& name) const {
    return "nef_mpi " NEF_VERSION " " + name + " " + std::to_string(session_.mesh.strict ? 1 : 0) +
           std::to_string(session_.mesh.as_surface ? 1 : 0) + nef::name(session_.mesh.crossings) + " " +
           std::to_string(session_.mesh.close_percent) + " " + flags_.tiles + "\n";
  }

  [[nodiscard]] std::string sum_job() const {
    return job("minkowski " + std::to_string(part_)) + file_identity(session_.inputs[0]) +
           file_identity(session_.inputs[1]);
  }

  // Tasks read their files at different times; a set of old and new ones would be wrong.
  void require_same(const std::string& job_now) const {
    if (job_now != job_text_) {
      throw InputError("an input changed while it was read, so nothing was written; run again");
    }
  }

  // Regions of pieces that meet many of them would repeat each other's work; what bounds memory are regions, though.
  TiledPolyhedron united(const WorkFolder& work, const PieceSource& source) {
    const Tiling tiling = this->tiling();
    const MeasuredPieces pieces = measure_pieces(mpi_, work, source, watcher());
    const RegionalUnion regions = pieces.regions();
    if (regions.is_spread() || !flags_.memory.empty()) {
      return union_by_regions(mpi_, work, pieces, regions, tiling, watcher());
    }
    const Polyhedron whole = union_up_a_tree(mpi_, work, pieces, watcher());
    if (names_tile_folder(session_.output)) return TiledPolyhedron(whole, tiling, session_.monitor);
    return {tile_leaf(whole, nullptr, true), tiling};
  }

  // What tasks make goes to files.
  [[nodiscard]] Tiling tiling() const {
    Tiling result = choose_tiles(flags_, session_, "").tiling;
    if (flags_.tiles == "auto") result.limit = kVerticesOfTileInFile;
    return result;
  }

  int unite() {
    const WorkFolder work(session_.output);
    std::optional<PieceList> pieces;
    on_first([&] {
      session_.require_output();
      pieces.emplace(session_.inputs, list_, session_.mesh);
      if (pieces->size() == 0) throw InputError("no pieces: name files, or give a --list");
      job_text_ = job("union") + pieces->identity();
      work.prepare(job_text_);
    });
    if (!pieces) pieces.emplace(session_.inputs, list_, session_.mesh);
    const PieceSource source{.count = pieces->size(),
                             .set = [&](std::uint32_t i, const Monitor& own) { return pieces->set(i, own); }};
    const Stopwatch watch;
    const TiledPolyhedron set = united(work, source);
    on_first([&] { require_same(job("union") + pieces->identity()); });
    return finish("union", work, set, watch.seconds());
  }

  int sum() {
    const WorkFolder work(session_.output);
    std::vector<Polyhedron> sets;
    on_first([&] {
      session_.require_output();
      if (session_.inputs.size() != 2) throw InputError("give two sets, or one and --offset");
      if (inner_) throw InputError("--inner goes with --offset");
      sets = session_.load_all(session_.inputs);
      if (!sets[0].is_bounded()) {
        throw InputError(session_.inputs[0] +
                         ": unbounded, and only bounded sets are cut into parts; intersect it with a box first");
      }
      job_text_ = sum_job();
      work.prepare(job_text_);
    });
    if (sets.empty()) {
      for (const std::string& path : session_.inputs) sets.push_back(read_file_or_tiles(path, session_.mesh));
    }
    const Stopwatch watch;
    const TiledPolyhedron set = united(work, sums_of_parts(mpi_, work, sets[0], sets[1], part_, watcher()));
    on_first([&] { require_same(sum_job()); });
    return finish("minkowski", work, set, watch.seconds());
  }

  // Each rank reads the set; in a folder of tiles, those that its regions need.
  int offset() {
    const WorkFolder work(session_.output);
    std::optional<minkowski::RegionalSum> regions;
    const auto prepare = [&] {
      const auto [radius, splits] = minkowski::parse_ball(offset_, "--offset", 8);
      if (sgn(radius) == 0) throw InputError("--offset 0 leaves the set as it is: give another radius");
      const minkowski::Side side = inner_ ? minkowski::Side::kInner : minkowski::Side::kOuter;
      const TiledPolyhedron set = load_tiled(session_, session_.inputs[0], tiling());
      regions.emplace(set, radius, splits, side, session_.monitor);
    };
    on_first([&] {
      session_.require_output();
      if (session_.inputs.size() != 1) throw InputError("--offset takes one set");
      job_text_ = offset_job();
      prepare();
      work.prepare(job_text_);
    });
    if (!regions) {
      session_.quiet = true;  // rank 0 has said what there is to say
      prepare();
    }
    const Stopwatch watch;
    minkowski::MinkowskiReport report;
    const std::vector<TileRef> trees = regions_of_ranks(
        mpi_, work, regions->region_count(), [&](std::size_t region) { return regions->compute(region, {}, report); },
        tiling(), watcher());
    on_first([&] { require_same(offset_job()); });
    return finish("minkowski", work, mpi_.first() ? regions->whole(trees) : TiledPolyhedron(), watch.seconds());
  }

  [[nodiscard]] std::string offset_job() const {
    return job("offset " + offset_ + (inner_ ? " inner" : "")) + file_identity(session_.inputs[0]);
  }

  int finish(const std::string& command, const WorkFolder& work, const TiledPolyhedron& set, double seconds) {
    if (!mpi_.first()) return kYes;
    if (!times_.empty()) write_file(times_, "phase,task,seconds\n" + times_text_);
    finish_tiled(session_, command, set, seconds, {{"ranks", mpi_.ranks()}});
    work.remove();
    return session_.exit_code;
  }

  int frames() {
    if (hull_.frames.empty())
      throw TasksFailed("visual_hull: frames are what ranks share: give --frames (visual_hull computes a single hull)");
    session_.quiet = session_.quiet || !mpi_.first();
    std::unique_ptr<nef::visual_hull::FrameTasks> tasks;
    std::unique_ptr<nef::visual_hull::FrameRecord> record;
    on_first([&] {
      tasks = std::make_unique<nef::visual_hull::FrameTasks>(hull_);
      record = std::make_unique<nef::visual_hull::FrameRecord>(hull_, *tasks);
      session_.say(tasks->understanding());
    });
    if (!tasks) tasks = std::make_unique<nef::visual_hull::FrameTasks>(hull_);
    do_tasks(mpi_,
             {.name = "frames",
              .count = tasks->size(),
              .finished = [&](std::size_t i) { return record->keep(i); },
              .name_of_task = [&](std::size_t i) { return "frame " + std::to_string(tasks->number(i)); },
              .task = [&](std::size_t i) { return tasks->make(i, {}); },
              .done = [&](std::size_t, const std::string& line, double) { record->add(line); }},
             watcher());
    std::string code = record ? std::to_string(record->finish()) : "";
    mpi_.share(code);
    return std::stoi(code);
  }

  const Environment& mpi_;
  Session session_;
  ProgressFunction show_ = [this](const char* phase, std::size_t done, std::size_t total) {
    session_.show_phase(phase, done, total);
  };
  TileFlags flags_;
  std::string list_;
  std::size_t part_ = 500;
  std::string offset_;
  bool inner_ = false;
  std::string times_;
  std::string times_text_;
  nef::visual_hull::Arguments hull_{session_};
  std::string job_text_;  // on rank 0
  std::function<int()> job_;
};

}  // namespace

int run_command(int argc, char** argv) {
  const bool for_help = std::any_of(argv, argv + argc, [](const std::string& word) {
    return word == "-h" || word == "--help" || word == "--version";
  });
  const Environment mpi(argc, argv, for_help);
  Silence silence;
  std::streambuf* const out = std::cout.rdbuf();
  if (!mpi.first()) std::cout.rdbuf(&silence);
  Run run(mpi);
  CLI::App app("Exact geometry on many ranks: unions, Minkowski sums, visual hulls of video.", "nef_mpi");
  run.add_commands(app);
  const int code = run_program(
      app, argc, argv, [&run] { return run.run(); }, [&run](const std::string& line) { run.complain(line); });
  std::cout.rdbuf(out);
  return code;
}

}  // namespace nef::mpi
