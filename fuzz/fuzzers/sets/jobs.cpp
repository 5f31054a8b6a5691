// SPDX-License-Identifier: Apache-2.0
//
// Jobs on many ranks that are started again: what an earlier run has left is used if, and only if, everything that the
// job reads holds the same bytes. The case knows which files it has named and what it has written to them.
#include <array>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/nef_mpi/piece_list.h"
#include "apps/nef_mpi/work_folder.h"
#include "fuzz/fuzzer.h"
#include "nef/io/file_bytes.h"
#include "tests/support/temporary_folder.h"

namespace nef::fuzz {
namespace {

namespace fs = std::filesystem;

// Names that a careless reader of lists takes for something else.
constexpr std::array kNames{"a.off",     "b #1.off", "c(d).off", "e, f.off",       "g=h;i.off",
                            "sub/j.off", "k'l.off",  "# m.off",  "box(0,0,0).off", "n\\o.off"};

// A box of unit sides, all of one length in bytes.
std::string box_at(std::uint32_t x) {
  std::string text = "OFF\n8 6 0\n";
  for (std::uint32_t k = 0; k < 8; ++k) {
    text += std::to_string(x + (k & 1U)) + " " + std::to_string(k >> 1U & 1U) + " " + std::to_string(k >> 2U) + "\n";
  }
  return text + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
}

class JobCase {
 public:
  explicit JobCase(const Case& the_case) : case_(the_case), choices_(the_case.choices()) {
    fs::create_directory(folder_.file("sub"));
    for (const char* name : kNames) write(name, box_at(0));
    write_list();
  }

  void run() {
    prepare();
    for (std::uint32_t step = 1 + choices_.below(6); step > 0; --step) {
      leave_work();
      const std::map<std::string, std::string> before = read_bytes();
      const std::string expressions_before = expressions_;
      const std::string what = change();
      case_.tell(what);
      prepare();
      const bool same = before == read_bytes() && expressions_before == expressions_;
      const bool kept = fs::exists(folder_.file("out.nef.work/region-0"));
      case_.count(same ? "same" : "changed");
      Case::require(kept || !same, "resume: finished work was thrown away after " + what);
      Case::require(!kept || same, "resume: stale work was kept after " + what);
    }
  }

 private:
  void write(const std::string& name, const std::string& bytes) {
    write_file(folder_.file(name), bytes);
    bytes_[name] = bytes;
  }

  static std::string file(const std::string& name) { return "file(\"" + name + "\")"; }

  std::string named() {
    const std::string name = choices_.element(kNames);
    in_list_.push_back(name);
    return file(name);
  }

  void write_list() {
    list_.clear();
    expressions_.clear();
    in_list_.clear();
    for (std::uint32_t line = 1 + choices_.below(4); line > 0; --line) {
      const std::string comment = "# not " + file(choices_.element(kNames));
      switch (choices_.below(6)) {
        case 0:
          list_ += named();
          break;
        case 1:
          list_ += "translate(" + named() + ", 1/2,0,0) - box(0,0,0, 1,1,1)  " + comment;
          break;
        case 2:
          list_ += "s = " + named() + "; hull(s, " + named() + ")";
          break;
        case 3:
          list_ += "  " + comment;
          break;
        case 4:
          list_ += "box(0,0,0, 1,1,1)";
          break;
        default:
          list_ += "!(" + named() + " * (" + named() + " ^ " + named() + "))\r";
      }
      list_ += "\n";
      const std::string last = list_.substr(list_.rfind('\n', list_.size() - 2) + 1);
      if (!last.starts_with("  #")) expressions_ += last;
    }
    list_ += named() + "\n";
    expressions_ += in_list_.back();
    write_file(folder_.file("list.txt"), list_);
    case_.tell("list: " + list_);
  }

  // What the job reads beside its list.
  [[nodiscard]] std::map<std::string, std::string> read_bytes() const {
    std::map<std::string, std::string> result{{kNames[0], bytes_.at(kNames[0])}};  // which is named beside the list
    for (const std::string& name : in_list_) result[name] = bytes_.at(name);
    return result;
  }

  // The beginning of a run of nef_mpi.
  void prepare() const {
    const mpi::PieceList pieces({folder_.file(kNames[0])}, folder_.file("list.txt"), {});
    const mpi::WorkFolder work(folder_.file("out.nef"));
    work.prepare(pieces.identity());
    for (std::uint32_t i = 0; i < pieces.size(); ++i) static_cast<void>(pieces.set(i, {}));
  }

  void leave_work() const { write_file(folder_.file("out.nef.work/region-0"), "finished"); }

  std::string change() {
    const std::string name = choices_.element(kNames);
    const fs::path path = folder_.file(name);
    const fs::file_time_type time = fs::last_write_time(path);
    switch (choices_.below(5)) {
      case 0:
        write(name, box_at(choices_.below(3)));
        fs::last_write_time(path, time);
        return "replacing " + name + " under its old time";
      case 1:
        write(name, box_at(choices_.below(3)));
        return "replacing " + name;
      case 2:
        fs::last_write_time(path, time + std::chrono::seconds(choices_.below(100)));
        return "touching " + name;
      case 3: {
        const std::string other = choices_.element(kNames);
        std::string bytes = bytes_[name];
        write(name, bytes_[other]);
        write(other, bytes);
        return "exchanging " + name + " and " + other;
      }
      default:
        write_list();
        return "another list";
    }
  }

  const Case& case_;
  Choices& choices_;
  test::TemporaryFolder folder_;
  std::map<std::string, std::string> bytes_;  // of all files
  std::string list_;
  std::string expressions_;  // of the list, without lines that are comments
  std::vector<std::string> in_list_;
};

}  // namespace

void fuzz_jobs(const Case& the_case) { JobCase(the_case).run(); }

}  // namespace nef::fuzz
