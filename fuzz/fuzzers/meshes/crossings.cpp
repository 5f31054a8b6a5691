// SPDX-License-Identifier: Apache-2.0
//
// Soups of closed surfaces that cross, overlap, double and undo each other, and what the rules for crossings make of
// them, against winding numbers in fractions. The sum of winding number times volume has to be the signed volume of the
// faces.
#include <array>

#include "fuzz/fuzzer.h"
#include "fuzz/fuzzers/meshes/soups.h"
#include "nef/base/error.h"
#include "nef/import/resolve_mesh.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/native/native_binary.h"

namespace nef::fuzz {
namespace {

class CrossingsCase {
 public:
  CrossingsCase(const Case& the_case, const Mesh& mesh) : case_(the_case), mesh_(mesh), windings_(mesh) {}

  void run() const {
    const Crossings rule = case_.choices().element(std::array{Crossings::kUnion, Crossings::kNonzero, Crossings::kOdd});
    case_.tell(std::string("crossings: ") + name(rule));
    case_.count(name(rule));
    ResolvedMesh made;
    try {
      made = resolve_mesh(mesh_, {.crossings = rule});
    } catch (const InputError& error) {
      const std::string why = error.what();
      // Faces of two corners at one place are no faces.
      if (why.find("enclose nothing") == std::string::npos) return case_.count("refused");
      case_.count("nothing");
      return check_points(rule, Polyhedron());
    }
    const Polyhedron set = case_.valid(made.set, "resolve_mesh");
    Case::require(set.is_regular(), "regular: the solid is not");
    Case::require(
        native_binary(from_mesh(mesh_, {.crossings = rule, .monitor = Monitor().on_threads(2)})) == native_binary(set),
        "threads: another solid on two");
    check_volumes(rule, made);
    check_points(rule, set);
  }

 private:
  static bool takes(Crossings rule, int winding) {
    return rule == Crossings::kUnion ? winding > 0 : rule == Crossings::kOdd ? winding % 2 != 0 : winding != 0;
  }

  void check_volumes(Crossings rule, const ResolvedMesh& made) const {
    Rational sum;
    Rational taken;
    for (const auto& [winding, entry] : made.volumes) {
      sum += winding * entry.volume;
      if (takes(rule, winding)) taken += entry.volume;
    }
    Case::require(volume(made.set) == taken, "volume: not that of the winding numbers taken");
    if (rule != Crossings::kOdd) Case::require(sum == abs(windings_.volume()), "volume: winding numbers do not add up");
  }

  void check_points(Crossings rule, const Polyhedron& set) const {
    for (int i = 0; i < 8; ++i) {
      const Rational3 p = windings_.sample(case_.choices());
      const std::optional<int> winding = windings_.around(p);
      if (!winding) continue;
      case_.count("points");
      Case::require(contains(set, p) == takes(rule, windings_.volume() < 0 ? -*winding : *winding),
                    "membership: of a point with winding number " + std::to_string(*winding));
    }
  }

  const Case& case_;
  const Mesh& mesh_;
  FaceWindings windings_;
};

}  // namespace

void fuzz_crossings(const Case& the_case) {
  const Mesh mesh = random_soup(the_case.choices(), SoupParts::kAny);
  MeshWriteOptions exact;
  exact.exact = true;
  the_case.tell("OFF:");
  the_case.tell(off_bytes(mesh, exact));
  CrossingsCase(the_case, mesh).run();
}

}  // namespace nef::fuzz
