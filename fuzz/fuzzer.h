// SPDX-License-Identifier: Apache-2.0
//
// What a fuzzer is: a function that makes one random case, asks the suite, and compares the answer with an oracle that
// shares no code with it.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "fuzz/choices.h"
#include "nef/polyhedron.h"

namespace nef::fuzz {

/// The suite and an oracle disagree. The text begins with what kind of disagreement it is, up to a colon.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where a case says what it is and what it looked at.
class Journal {
 public:
  virtual ~Journal() = default;
  /// Adds a line to the description of the case, fit to be pasted into a test.
  virtual void tell(std::string_view line) = 0;
  /// Counts something that was looked at.
  virtual void count(std::string_view what, std::uint64_t times) = 0;
};

/// One case under way.
class Case {
 public:
  Case(Choices& choices, Journal& journal) : choices_(choices), journal_(journal) {}
  [[nodiscard]] Choices& choices() const { return choices_; }
  void tell(std::string_view line) const { journal_.tell(line); }
  void count(std::string_view what, std::uint64_t times = 1) const { journal_.count(what, times); }

  /// Returns the set after nef::validate; throws Failure if an invariant is broken.
  [[nodiscard]] Polyhedron valid(Polyhedron set, std::string_view what) const;
  /// Throws Failure unless `condition` holds.
  static void require(bool condition, const std::string& complaint) {
    if (!condition) throw Failure(complaint);
  }

 private:
  Choices& choices_;
  Journal& journal_;
};

struct Fuzzer {
  std::string_view name;
  std::string_view summary;      ///< one line
  void (*run)(const Case&);      ///< throws anything if the case fails
  unsigned seconds_a_case = 60;  ///< of CPU; a case that takes longer has failed
};

/// All of them, by name.
std::span<const Fuzzer> fuzzers();

// One a file.
void fuzz_arrangement(const Case& the_case);
void fuzz_nested(const Case& the_case);
void fuzz_voxels(const Case& the_case);
void fuzz_stars(const Case& the_case);
void fuzz_files(const Case& the_case);
void fuzz_crossings(const Case& the_case);
void fuzz_repairs(const Case& the_case);
void fuzz_dirty(const Case& the_case);
void fuzz_written(const Case& the_case);
void fuzz_sums(const Case& the_case);
void fuzz_convolutions(const Case& the_case);
void fuzz_parts(const Case& the_case);
void fuzz_assemblies(const Case& the_case);
void fuzz_turning_assemblies(const Case& the_case);
void fuzz_planning(const Case& the_case);
void fuzz_turning(const Case& the_case);
void fuzz_motions(const Case& the_case);
void fuzz_no_paths(const Case& the_case);
void fuzz_rigid_paths(const Case& the_case);
void fuzz_slots(const Case& the_case);
void fuzz_ranges(const Case& the_case);
void fuzz_visibility(const Case& the_case);
void fuzz_wide(const Case& the_case);
void fuzz_tiles(const Case& the_case);
void fuzz_silhouettes(const Case& the_case);
void fuzz_jobs(const Case& the_case);
void fuzz_image_names(const Case& the_case);

}  // namespace nef::fuzz
