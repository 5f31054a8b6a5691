// SPDX-License-Identifier: Apache-2.0
//
// nef_arena_runner --request FILE --result FILE [--threads N]: the suite as one of the engines of
// solidean/boolean-benchmark-runners (2026), by its protocol of version 1. A request is a list of runs, each a list of
// operations of which the later ones name the earlier ones by their numbers: load-mesh, boolean-union,
// boolean-intersection, boolean-difference of one, two or more arguments.
//
// Sets stay exact from operation to operation; only the files that each operation writes are rounded. What is measured,
// in milliseconds of the clock: io_ms is reading a file into an indexed mesh, import_ms making a set of it (checked;
// where faces cross, what is enclosed at least once is inside), operation_ms the Boolean, export_ms the boundary as
// triangles and doubles. The file is written after that by write_polyhedron, which repairs what rounding breaks.
#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "nef/io/mesh/mesh_reader.h"
#include "nef/nef.h"

namespace nef::bench {
namespace {

using nlohmann::json;

class Clock {
 public:
  [[nodiscard]] double ms() const { return std::chrono::duration<double, std::milli>(Now::now() - begin_).count(); }

 private:
  using Now = std::chrono::steady_clock;
  Now::time_point begin_ = Now::now();
};

// What the protocol does not know.
class Unsupported : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Run {
 public:
  Run(const json& request, const Monitor& monitor)
      : request_(request), folder_(request.at("out_dir").get<std::string>()), monitor_(monitor) {}

  // Ends at the first operation that fails.
  json result() {
    const Clock clock;
    json result{{"case_id", request_.at("case_id")}, {"status", "success"}, {"ops", json::array()}};
    for (const json& operation : request_.at("operations")) {
      json entry = entry_of(operation);
      const std::string status = entry["status"];
      result["ops"].push_back(std::move(entry));
      if (status == "success") continue;
      result["status"] = status;
      break;
    }
    result["duration_ms"] = clock.ms();
    return result;
  }

 private:
  json entry_of(const json& operation) {
    const Clock clock;
    json entry;
    try {
      sets_.push_back(operation.at("op") == "load-mesh" ? loaded(operation, entry) : combined(operation, entry));
      const std::filesystem::path file = folder_ / ("op_" + std::to_string(sets_.size() - 1) + ".off");
      write_polyhedron(file.string(), sets_.back(), {.monitor = monitor_});
      entry["file"] = file.string();
      entry["status"] = "success";
    } catch (const Unsupported& error) {
      entry["status"] = "unsupported";
      entry["error"] = error.what();
    } catch (const UnsupportedError& error) {
      entry["status"] = "invalid_output";
      entry["error"] = error.what();
    } catch (const Error& error) {
      entry["status"] = "invalid_input";
      entry["error"] = error.what();
    } catch (const std::exception& error) {
      entry["status"] = "crash";
      entry["error"] = error.what();
    }
    entry["debug_total_ms"] = clock.ms();
    return entry;
  }

  [[nodiscard]] Polyhedron loaded(const json& operation, json& entry) const {
    const Clock reading;
    const Mesh mesh = read_mesh(operation.at("path").get<std::string>());
    entry["io_ms"] = reading.ms();
    const Clock importing;
    Polyhedron set = from_mesh(mesh, {.crossings = Crossings::kUnion, .monitor = monitor_});
    entry["import_ms"] = importing.ms();
    return set;
  }

  [[nodiscard]] Polyhedron combined(const json& operation, json& entry) const {
    const std::string name = operation.at("op");
    std::vector<Polyhedron> operands;
    for (const std::size_t i : operation.at("args").get<std::vector<std::size_t>>()) operands.push_back(sets_.at(i));
    if (operands.empty()) throw InputError(name + " needs arguments");
    const Clock operating;
    Polyhedron set = of(name, std::move(operands));
    entry["operation_ms"] = operating.ms();
    const Clock exporting;
    static_cast<void>(to_rounded_mesh(set, {}, monitor_));
    entry["export_ms"] = exporting.ms();
    return set;
  }

  [[nodiscard]] Polyhedron of(const std::string& name, std::vector<Polyhedron> operands) const {
    if (name == "boolean-union") return unite_all(operands, monitor_);
    if (name == "boolean-intersection") return intersect_all(operands, monitor_);
    if (name != "boolean-difference") throw Unsupported("unknown operation " + name);
    Polyhedron first = std::move(operands.front());
    operands.erase(operands.begin());
    return operands.empty() ? first : subtract(first, unite_all(operands, monitor_), monitor_);
  }

  const json& request_;
  std::filesystem::path folder_;
  Monitor monitor_;
  std::vector<Polyhedron> sets_;
};

// A reader never sees half of it.
void write(const std::string& path, const json& result) {
  std::ofstream(path + ".tmp") << result.dump(1) << '\n';
  std::filesystem::rename(path + ".tmp", path);
}

// Exit code 1 if a run failed.
int answer(const std::string& request_file, const std::string& result_file, unsigned threads) {
  const json request = json::parse(std::ifstream(request_file));
  json result{{"kind", request.at("kind")},
              {"version", request.at("version")},
              {"id", request.at("id")},
              {"threads", threads},
              {"runs", json::array()}};
  const Monitor monitor = Monitor().on_threads(threads);
  bool failed = false;
  Clock since_written;
  for (const json& run : request.at("runs")) {
    result["runs"].push_back(Run(run, monitor).result());
    failed = failed || result["runs"].back()["status"] != "success";
    // Whoever watches may end this process, and takes what is there.
    if (since_written.ms() < 10000) continue;
    write(result_file, result);
    since_written = Clock();
  }
  write(result_file, result);
  return failed ? 1 : 0;
}

}  // namespace
}  // namespace nef::bench

int main(int argc, char** argv) {
  std::string request;
  std::string result;
  unsigned threads = 1;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    if (option == "--request") request = argv[i + 1];
    if (option == "--result") result = argv[i + 1];
    if (option == "--threads") threads = static_cast<unsigned>(std::strtoul(argv[i + 1], nullptr, 10));
  }
  if (request.empty() || result.empty() || threads == 0) {
    std::cerr << "Usage: nef_arena_runner --request FILE --result FILE [--threads N]\n";
    return 2;
  }
  try {
    return nef::bench::answer(request, result, threads);
  } catch (const std::exception& error) {
    std::cerr << "nef_arena_runner: " << error.what() << '\n';
    return 1;
  }
}
