// SPDX-License-Identifier: Apache-2.0
//
// The program `fuzz`: random cases against oracles for a given time (docs/reliability.md).
#include <fmt/format.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <list>
#include <random>

#include "fuzz/case_file.h"
#include "fuzz/shrink.h"
#include "nef/io/file_bytes.h"

namespace nef::fuzz {
namespace {

struct Arguments {
  double seconds = 60;
  std::uint64_t seed = 0;
  std::uint64_t cases = ~std::uint64_t{0};
  unsigned jobs = 1;
  std::vector<std::string> only;
  std::string out = ".";
  std::string replay;
  double shrink_seconds = 60;
  bool list = false;
};

const Fuzzer& fuzzer_named(const std::string& name) {
  for (const Fuzzer& fuzzer : fuzzers()) {
    if (fuzzer.name == name) return fuzzer;
  }
  throw InputError("no fuzzer is called '" + name + "' (fuzz --list names them)");
}

std::uint64_t seed_of(const Fuzzer& fuzzer, std::uint64_t seed) {
  for (const char c : fuzzer.name) seed = mixed(seed, static_cast<unsigned char>(c));
  return seed;
}

// Runs slices of all chosen fuzzers, several at a time, until the time is over.
class Run {
 public:
  explicit Run(const Arguments& arguments) : arguments_(arguments) {
    for (const Fuzzer& fuzzer : fuzzers()) {
      const bool chosen = arguments.only.empty() ||
                          std::find(arguments.only.begin(), arguments.only.end(), fuzzer.name) != arguments.only.end();
      if (chosen) turns_.push_back({&fuzzer, 0, {}, 0, {}});
    }
    for (const std::string& name : arguments.only) fuzzer_named(name);
    const double each = arguments.seconds * arguments.jobs / static_cast<double>(turns_.size());
    slice_ = std::clamp(each / 2, 0.5, 20.0);
  }

  // The exit code.
  int run() {
    const std::chrono::time_point end = Clock::now() + std::chrono::duration<double>(arguments_.seconds);
    std::size_t next = 0;
    const auto all_begun = [&] { return next >= turns_.size(); };
    for (;;) {
      const bool more =
          !(all_begun() && Clock::now() >= end) && (arguments_.cases == ~std::uint64_t{0} || !all_begun());
      if (more && workers_.size() < arguments_.jobs) {
        start(turns_[next++ % turns_.size()]);
      } else if (!workers_.empty()) {
        collect();
      } else {
        break;
      }
    }
    report();
    return findings_ == 0 ? 0 : 1;
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Turn {
    const Fuzzer* fuzzer;
    std::uint64_t slices;
    Counters counters;
    double slowest = 0;              // CPU seconds of a case
    std::vector<std::string> kinds;  // of complaints that were reported
  };
  struct Running {
    Turn* turn;
    std::unique_ptr<Worker> worker;
  };

  void start(Turn& turn) {
    constexpr std::uint64_t kCasesOfSlice = std::uint64_t{1} << 32U;
    workers_.push_back({&turn, std::make_unique<Worker>(*turn.fuzzer, seed_of(*turn.fuzzer, arguments_.seed),
                                                        turn.slices++ * kCasesOfSlice, slice_, arguments_.cases)});
  }

  void collect() {
    int status = 0;
    const pid_t pid = waitpid(-1, &status, 0);
    const auto at = std::find_if(workers_.begin(), workers_.end(),
                                 [&](const Running& running) { return running.worker->pid() == pid; });
    if (at == workers_.end()) return;
    const std::optional<Finding> finding = at->worker->ended(status);
    for (const auto& [what, times] : at->worker->counters()) at->turn->counters[what] += times;
    Turn& turn = *at->turn;
    turn.slowest = std::max(turn.slowest, at->worker->slowest());
    workers_.erase(at);
    if (finding) handle(turn, *finding);
  }

  // One case of each kind is made small and kept; more of the same kind would only take time.
  void handle(Turn& turn, const Finding& finding) {
    ++findings_;
    ++turn.counters["failures"];
    const std::string kind = finding.complaint.substr(0, finding.complaint.find(':'));
    if (std::find(turn.kinds.begin(), turn.kinds.end(), kind) != turn.kinds.end()) return;
    turn.kinds.push_back(kind);
    const Finding small = shrunk(*turn.fuzzer, finding, arguments_.shrink_seconds);
    std::filesystem::create_directories(arguments_.out);
    const std::string path = fmt::format("{}/{}-{:016x}.case", arguments_.out, turn.fuzzer->name,
                                         mixed(arguments_.seed, std::hash<std::string>{}(case_text(finding))));
    write_file(path, case_text(small));
    fmt::print("FAILURE ({} choices, {} before shrinking), replay with: fuzz --replay {}\n{}\n", small.choices.size(),
               finding.choices.size(), path, case_text(small));
    std::fflush(stdout);
  }

  void report() const {
    for (const Turn& turn : turns_) {
      std::string line;
      const auto cases = turn.counters.find("cases");
      line += fmt::format("{} cases", cases == turn.counters.end() ? 0 : cases->second);
      for (const auto& [what, times] : turn.counters) {
        if (what != "cases") line += fmt::format(", {} {}", times, what);
      }
      fmt::print("{:12} {}; {:.1f} s at most\n", turn.fuzzer->name, line, turn.slowest);
    }
    fmt::print("fuzz: seed {}, {:.0f} s: {}\n", arguments_.seed, arguments_.seconds,
               findings_ == 0 ? "no failures" : fmt::format("{} failures", findings_));
  }

  const Arguments& arguments_;
  std::vector<Turn> turns_;
  std::list<Running> workers_;
  double slice_ = 1;
  std::size_t findings_ = 0;
};

int replay(const std::string& path) {
  const Finding wanted = read_case(read_file(path), path);
  Worker worker(fuzzer_named(wanted.fuzzer), wanted.choices);
  const std::optional<Finding> finding = worker.wait();
  if (!finding) {
    fmt::print("{}: passes\n", path);
    return 0;
  }
  fmt::print("{}", case_text(*finding));
  return 1;
}

int run(const Arguments& arguments) {
  if (arguments.list) {
    for (const Fuzzer& fuzzer : fuzzers()) fmt::print("{:12} {}\n", fuzzer.name, fuzzer.summary);
    return 0;
  }
  if (!arguments.replay.empty()) return replay(arguments.replay);
  return Run(arguments).run();
}

}  // namespace
}  // namespace nef::fuzz

int main(int argc, char** argv) {
  nef::fuzz::Arguments arguments;
  CLI::App app(
      "Random cases against independent oracles. Exits with 1 if one fails; the smallest such case of each\n"
      "kind is left as a file. A seed fixes the order of cases, the time how many there are.");
  app.add_option("--seconds", arguments.seconds, "for how long")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--seed", arguments.seed, "where to begin (default: random)");
  app.add_option("--cases", arguments.cases, "at most so many of each fuzzer, and then stop");
  app.add_option("--jobs", arguments.jobs, "so many at a time")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--only", arguments.only, "only this fuzzer (may be repeated)");
  app.add_option("--out", arguments.out, "folder for failing cases")->capture_default_str();
  app.add_option("--replay", arguments.replay, "run the case in this file, and nothing else");
  app.add_option("--shrink", arguments.shrink_seconds, "seconds to make a failing case smaller")->capture_default_str();
  app.add_flag("--list", arguments.list, "say which fuzzers there are");
  CLI11_PARSE(app, argc, argv);
  try {
    if (app.count("--seed") == 0) arguments.seed = std::random_device{}();
    return nef::fuzz::run(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "fuzz: {}\n", error.what());
    return 2;
  }
}
