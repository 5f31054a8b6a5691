// SPDX-License-Identifier: Apache-2.0
//
// Soups of closed surfaces as bad files have them: faces turned, doubled and missing, vertices and sides cut, corners
// in lines; repaired by each rule, with lids and without. What comes of it is checked against winding numbers in
// fractions of the faces that the repair ends with, lids among them; harmless damage has to leave the union of the
// parts, by the winding numbers of the parts. No vertex may move, and each face that came in has one fate.
#include <algorithm>
#include <array>
#include <set>
#include <variant>

#include "fuzz/fuzzer.h"
#include "fuzz/fuzzers/meshes/soups.h"
#include "fuzz/fuzzers/sets/face_rings.h"
#include "nef/base/counted.h"
#include "nef/import/repair.h"
#include "nef/import/try_from_mesh.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/native/native_binary.h"

namespace nef::fuzz {
namespace {

// A soup that is damaged step by step.
class DamagedSoup : public FaceRings {
 public:
  DamagedSoup(Choices& choices, const Mesh& soup) : FaceRings(choices) {
    vertices_ = soup.vertices;
    for (std::size_t f = 0; f < soup.face_count(); ++f) rings_.emplace_back(soup.face(f).begin(), soup.face(f).end());
  }

  // What no repair takes to mean another set.
  void damage_harmlessly() {
    FaceRing& ring = any_ring();
    const std::uint32_t at = choices_.below(static_cast<std::uint32_t>(ring.size()));
    switch (choices_.below(5)) {
      case 0:  // listed from another corner
        std::rotate(ring.begin(), ring.begin() + at, ring.end());
        break;
      case 1:
        give_own_vertex(ring, at);
        break;
      case 2:
        cut_side(ring, at);
        break;
      case 3:
        add_without_area(ring, at);
        break;
      default:  // a corner twice
        ring.insert(ring.begin() + at, ring[at]);
    }
  }

  void damage() {
    FaceRing& ring = any_ring();
    const std::uint32_t how = choices_.below(5);
    if (how <= kCopyTurned) return damage_whole(how, ring);
    if (how == kCopyTurned + 2) return damage_harmlessly();
    if (rings_.size() < 2) return;
    std::swap(ring, rings_.back());
    rings_.pop_back();
  }
};

bool takes(Crossings rule, int winding) {
  return rule == Crossings::kUnion ? winding > 0 : rule == Crossings::kOdd ? winding % 2 != 0 : winding != 0;
}

class RepairsCase {
 public:
  RepairsCase(const Case& the_case, const Mesh& mesh) : case_(the_case), mesh_(mesh) {
    Choices& choices = case_.choices();
    options_.crossings = choices.element(std::array{Crossings::kUnion, Crossings::kNonzero, Crossings::kOdd});
    options_.close_percent = choices.element(std::array{100, 10, 0});
    options_.record = choices.one_in(2);
    case_.tell(std::string("crossings: ") + name(options_.crossings) +
               ", close: " + std::to_string(static_cast<int>(options_.close_percent)));
    repaired_ = repair_mesh(mesh_, options_);
  }

  void check() const {
    check_same_everywhere();
    check_vertices();
    if (options_.record) check_record();
    if (!repaired_.problem.empty()) {
      Case::require(repaired_.set.is_empty(), "repair: a set, and a problem");
      return case_.count(repaired_.problem == "the faces of the mesh enclose nothing" ? "nothing" : "refused");
    }
    case_.count(repaired_.has_lids ? "closed" : repaired_.resolved ? "resolved" : "repaired");
    const Polyhedron set = case_.valid(repaired_.set, "repair");
    Case::require(set.is_regular(), "regular: the solid is not");
    check_windings(set);
  }

  // The union of the parts, however many of them there are around a point. By kOdd two that are alike are nothing in
  // the file, but copies are dropped first.
  void check_union(const FaceWindings& parts) const {
    if (options_.crossings == Crossings::kOdd) return;
    Case::require(repaired_.problem.empty(), "harmless: refused: " + repaired_.problem);
    for (int i = 0; i < 8; ++i) {
      const Rational3 p = parts.sample(case_.choices());
      const std::optional<int> winding = parts.around(p);
      if (!winding) continue;
      case_.count("points of unions");
      Case::require(contains(repaired_.set, p) == takes(options_.crossings, *winding),
                    "harmless: membership of a point in " + std::to_string(*winding) + " parts");
    }
  }

 private:
  // Import with lids and repair are one thing, on any number of threads.
  void check_same_everywhere() const {
    const RepairedMesh again = repair_mesh(mesh_, options_, Monitor().on_threads(2));
    Case::require(again.done == repaired_.done && again.problem == repaired_.problem &&
                      native_binary(again.set) == native_binary(repaired_.set),
                  "threads: another repair on two");
    if (options_.close_percent == 0) return;
    if (std::holds_alternative<Polyhedron>(try_from_mesh(mesh_, {.crossings = options_.crossings}))) return;
    const auto read = try_from_mesh(mesh_, {.crossings = options_.crossings, .close_percent = options_.close_percent});
    const Polyhedron* set = std::get_if<Polyhedron>(&read);
    Case::require((set != nullptr) == repaired_.problem.empty(), "import: does not agree with the repair");
    Case::require(set == nullptr || native_binary(*set) == native_binary(repaired_.set), "import: another set");
  }

  void check_vertices() const {
    const std::set<Rational3> known(mesh_.vertices.begin(), mesh_.vertices.end());
    for (const Rational3& v : repaired_.mesh.vertices) Case::require(known.count(v) > 0, "vertices: one moved");
  }

  void check_record() const {
    const FaceRecord& record = repaired_.record;
    Case::require(record.fates.size() == mesh_.face_count() + record.added.size(), "record: not one fate a face");
    const auto is_in_mesh = [](FaceFate fate) { return fate != FaceFate::kCopy && fate != FaceFate::kNoArea; };
    const auto left = std::count_if(record.fates.begin(), record.fates.end(), is_in_mesh);
    const std::size_t flat = static_cast<std::size_t>(left) - repaired_.mesh.face_count();
    const std::string told = " (" + counted(flat, "face", "faces") + ") left out";
    const bool is_told = std::any_of(repaired_.done.begin(), repaired_.done.end(),
                                     [&](const std::string& line) { return line.find(told) != std::string::npos; });
    Case::require(flat == 0 || is_told, "record: other faces than the mesh");
    if (flat > 0) case_.count("flat pieces left out");
    Case::require((record.added.empty()) == !repaired_.has_lids, "record: lids that were not told");
  }

  void check_windings(const Polyhedron& set) const {
    const FaceWindings windings(repaired_.mesh);
    if (repaired_.resolved && options_.crossings != Crossings::kOdd) check_volumes(windings.volume());
    // A mesh that is inside out as a whole counts as if it were turned over.
    const int sign = windings.volume() < 0 ? -1 : 1;
    for (int i = 0; i < 8; ++i) {
      const Rational3 p = windings.sample(case_.choices());
      const std::optional<int> winding = windings.around(p);
      if (!winding) continue;
      case_.count("points");
      Case::require(contains(set, p) == takes(options_.crossings, sign * *winding),
                    "membership: of a point with winding number " + std::to_string(*winding));
    }
  }

  void check_volumes(const Rational& volume) const {
    Rational sum;
    Rational error;
    for (const auto& [winding, entry] : repaired_.resolved->volumes) {
      sum += winding * Rational(entry.measured.value);
      error += std::abs(winding) * Rational(entry.measured.error);
    }
    Case::require(abs(sum - abs(volume)) <= error, "volume: winding numbers do not add up");
    const MeasuredVolume& told = repaired_.signed_volume;
    Case::require(abs(Rational(told.value) - abs(volume)) <= Rational(told.error), "volume: not that of the faces");
  }

  const Case& case_;
  const Mesh& mesh_;
  RepairOptions options_;
  RepairedMesh repaired_;
};

}  // namespace

void fuzz_repairs(const Case& the_case) {
  Choices& choices = the_case.choices();
  const bool harmless = choices.one_in(2);
  const Mesh soup = random_soup(choices, harmless ? SoupParts::kSolid : SoupParts::kAny);
  DamagedSoup damaged(choices, soup);
  for (std::uint32_t i = 1 + choices.below(5); i > 0; --i) {
    if (harmless) {
      damaged.damage_harmlessly();
    } else {
      damaged.damage();
    }
  }
  const Mesh mesh = damaged.mesh();
  MeshWriteOptions exact;
  exact.exact = true;
  the_case.tell("OFF:");
  the_case.tell(off_bytes(mesh, exact));
  const RepairsCase the_repair(the_case, mesh);
  the_repair.check();
  if (harmless) the_repair.check_union(FaceWindings(soup));
}

}  // namespace nef::fuzz
