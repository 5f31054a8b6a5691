// SPDX-License-Identifier: Apache-2.0
//
// The steps of repair/repair_steps.h in their order, lids, and components that are turned by how many others contain
// them. The result is imported once to say whether it bounds a solid, by the rule for crossings if there is one. How
// faces meet is looked for once: what the first look at the mesh has found is used as long as no face has changed.
#include "nef/import/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nef/base/counted.h"
#include "nef/base/error.h"
#include "nef/geometry/ids.h"
#include "nef/import/checked_surface.h"
#include "nef/import/mesh_faces.h"
#include "nef/import/repair/fill.h"
#include "nef/import/repair/lids.h"
#include "nef/import/repair/repair_steps.h"
#include "nef/import/repair/signed_volume.h"
#include "nef/import/repair/turn_components.h"
#include "nef/import/repair/winding_report.h"
#include "nef/number/brief_text.h"

namespace nef {
namespace {

// Whether the rule counts how often faces wind around something.
bool is_signed(Crossings rule) {
  return rule == Crossings::kRefuse || rule == Crossings::kUnion || rule == Crossings::kNonzero;
}

// Nothing can be done to it.
RepairedMesh of_no_faces(const Mesh& mesh) {
  RepairedMesh result;
  result.mesh = mesh;
  try {
    result.set = from_mesh(mesh, {}, &result.notes);
  } catch (const InputError& error) {
    result.problem = error.what();
  }
  return result;
}

class Repairer {
 public:
  /// `contacts` are those of the mesh, if they are known.
  Repairer(const Mesh& mesh, KnownContacts contacts, const RepairOptions& options, const Monitor& monitor)
      : input_(mesh), contacts_(std::move(contacts)), options_(options), monitor_(monitor), faces_(mesh) {}

  RepairedMesh run() {
    const bool was_balanced = becomes_balanced();
    if (!was_balanced) {
      drop_copies(faces_);
      drop_faces_without_area(faces_, monitor_);
      split_sides(faces_, OpenSides::kOdd, monitor_);
    }
    if (!was_balanced || !is_balanced(faces_)) turn_to_neighbours(faces_);
    if (faces_.one_sided != kNone && is_signed(options_.crossings)) return one_sided();
    close_holes();
    if (faces_.is(input_)) {
      result_.mesh = input_;
    } else {
      faces_changed();
    }
    turn_inside_out();
    result_.done = std::move(faces_.done);
    if (faces_.rings.empty()) {
      result_.problem = "no face of the mesh remains";
    } else {
      resolve();
      result_.is_flat = !result_.problem.empty() && result_.holes > 0 && is_flat(faces_, monitor_);
    }
    if (options_.record) record();
    return std::move(result_);
  }

 private:
  // If its faces are turned right, and T-junctions are all that keeps them from being closed, a mesh is closed before
  // copies are looked for, since parts that share faces look like copies.
  bool becomes_balanced() {
    MeshInRepair closed = faces_;
    drop_faces_without_area(closed, monitor_);
    split_sides(closed, OpenSides::kUnbalanced, monitor_);
    if (!is_balanced(closed)) return false;
    faces_ = std::move(closed);
    drop_copies(faces_);
    return true;
  }

  // Winding numbers mean nothing.
  RepairedMesh one_sided() {
    result_.mesh = faces_.mesh();
    result_.done = std::move(faces_.done);
    result_.is_one_sided = true;
    result_.problem = "the surface cannot be oriented: a way around it leads from face " +
                      std::to_string(faces_.one_sided) + " to the other side of that face";
    if (options_.record) record();
    return std::move(result_);
  }

  void faces_changed() {
    result_.mesh = faces_.mesh();
    contacts_.reset();
  }

  void close_holes() {
    if (options_.fill_holes) {
      const Lids flat = lids_for(faces_.vertices, faces_.rings, LidShape::kFlat, monitor_);
      put_on(faces_, flat);
      faces_.note(flat.holes, "planar hole", "planar holes", "filled");
    }
    if (options_.close_percent <= 0) {
      result_.holes = border_loops(faces_.rings).size();
      return;
    }
    Lids lids = lids_for(faces_.vertices, faces_.rings, LidShape::kAny, monitor_);
    // By the other rules, flat pieces may enclose something together.
    const bool lids_cancel = is_signed(options_.crossings) || options_.crossings == Crossings::kOdd;
    if (lids_cancel && drop_flat_pieces(faces_, lids, monitor_)) {
      lids = lids_for(faces_.vertices, faces_.rings, LidShape::kAny, monitor_);
    }
    result_.holes = lids.holes;
    result_.flat_holes = lids.flat;
    result_.lid_share = lids.share;
    result_.has_lids = lids.holes > 0 && 100 * lids.share <= options_.close_percent;
    if (!result_.has_lids) return;
    put_on(faces_, lids);
    faces_.done.push_back(counted(lids.holes, "hole", "holes") + " closed by lids of " +
                          short_text(100 * lids.share, 2) + " % of the area, " + std::to_string(lids.flat) +
                          " of them flat (a guess)");
  }

  void turn_inside_out() {
    const std::vector<std::vector<std::uint32_t>> components = components_by_sides(faces_);
    // A single one is looked at once, when the rule has resolved it.
    is_single_ = components.size() == 1 && options_.crossings != Crossings::kRefuse;
    if (is_single_ || components.empty()) return;
    if (!contacts_) {
      const MeshSurface surface(result_.mesh, monitor_);
      contacts_ = face_contacts(surface, SurfaceContacts(surface, monitor_));
    }
    const std::size_t turned = turn_components(faces_, components, *contacts_, options_.crossings, monitor_);
    faces_.note(turned, "component", "components", "flipped");
    if (turned > 0) faces_changed();
  }

  void resolve() {
    const bool by_rule = options_.crossings != Crossings::kRefuse;
    const MeshOptions options{.strict = options_.strict, .crossings = options_.crossings, .monitor = monitor_};
    try {
      CheckedSurface checked(result_.mesh, CheckedSurface::Extent::kAll, options_.crossings, monitor_,
                             std::move(contacts_));
      contacts_ = checked.contacts();
      ResolvedMesh resolved =
          resolve_mesh(std::move(checked), options, &result_.notes, by_rule ? Measure::kDoubles : Measure::kNot);
      result_.set = resolved.set;
      if (!by_rule) return;
      if (is_single_ && resolved.inside_out) {
        std::erase(result_.notes, kTurnedOver);
        for (std::uint32_t f = 0; f < faces_.rings.size(); ++f) faces_.turn_over(f);
        result_.mesh = faces_.mesh();
        result_.done.emplace_back("1 component flipped");
      }
      if (note_about(resolved, options_.crossings).empty()) return;
      result_.signed_volume = signed_volume(result_.mesh, monitor_);
      // What counts as if it were turned over has its winding numbers so.
      if (resolved.inside_out && !is_single_) result_.signed_volume.value = -result_.signed_volume.value;
      for (std::string& line : lines_about(resolved, options_.crossings)) result_.done.push_back(std::move(line));
      result_.resolved = std::move(resolved);
    } catch (const RefusedMesh& error) {
      result_.problem = error.problem();
    } catch (const InputError& error) {
      result_.problem = error.what();
    }
  }

  void record() {
    std::vector<FaceFate> by_rule(faces_.rings.size(), FaceFate::kKept);
    if (result_.resolved) {
      by_rule = fates_by_rule(result_.mesh, *contacts_, result_.set, monitor_);
      result_.record.pieces = pieces_of_cut_faces(result_.mesh, by_rule, result_.set, monitor_);
    }
    std::vector<FaceFate>& fates = faces_.fates;
    for (std::uint32_t i = 0; i < faces_.rings.size(); ++i) {
      if (faces_.sources[i] == kNone) {
        result_.record.added.push_back(faces_.rings[i]);
        continue;
      }
      FaceFate& fate = fates[faces_.sources[i]];
      fate = by_rule[i];
      if (fate == FaceFate::kKept && faces_.turned_over[i]) fate = FaceFate::kTurned;
    }
    result_.record.fates = std::move(fates);
    result_.record.fates.resize(result_.record.fates.size() + result_.record.added.size(), FaceFate::kAdded);
  }

  const Mesh& input_;
  KnownContacts contacts_;  // of result_.mesh
  RepairOptions options_;
  Monitor monitor_;
  MeshInRepair faces_;
  bool is_single_ = false;  // one component, and a rule for crossings
  RepairedMesh result_;
};

}  // namespace

RepairedMesh repair_mesh(const Mesh& mesh, const RepairOptions& options, const Monitor& monitor) {
  if (mesh.face_count() == 0) return of_no_faces(mesh);
  CheckedSurface checked(mesh, CheckedSurface::Extent::kAll, Crossings::kRefuse, monitor);
  KnownContacts contacts = checked.contacts();
  if (!checked.is_refused()) {
    try {
      RepairedMesh sound;
      const MeshOptions as_it_is{.strict = options.strict, .monitor = monitor};
      sound.set = resolve_mesh(std::move(checked), as_it_is, &sound.notes, Measure::kNot).set;
      sound.mesh = mesh;
      if (options.record) sound.record.fates.assign(mesh.face_count(), FaceFate::kKept);
      return sound;
    } catch (const InputError&) {
      // Its components contradict each other.
    }
  }
  return Repairer(mesh, std::move(contacts), options, monitor).run();
}

std::string advice_about(const RepairedMesh& repaired, double close_percent) {
  constexpr const char* kAsSurface = "; --as-surface (surface=True in Python) reads them as a surface";
  if (repaired.problem == kEnclosesNothing) return kAsSurface;
  if (repaired.is_one_sided) {
    return "; --crossings odd or outside (crossings=\"odd\" in Python) selects what it encloses, whatever the "
           "orientation";
  }
  if (repaired.is_flat)
    return std::string("; all faces lie in one plane, so no lid makes them enclose anything") + kAsSurface;
  if (repaired.holes == 0 || repaired.has_lids) return "";
  const std::string holes = repaired.holes == 1 ? "its hole" : "its " + std::to_string(repaired.holes) + " holes";
  if (close_percent <= 0) return "; --close closes " + holes;
  const auto percent = std::min(100.0, std::ceil(100 * repaired.lid_share));
  return "; lids for " + holes + " are more than " + std::to_string(static_cast<int>(close_percent)) +
         " % of the area, --close=" + std::to_string(static_cast<int>(percent)) + " accepts them";
}

Polyhedron repaired_solid(const Mesh& mesh, const MeshOptions& options, Messages* messages) {
  NEF_ASSERT(mesh.face_count() > 0);
  const RepairOptions how{
      .close_percent = options.close_percent, .crossings = options.crossings, .strict = options.strict};
  KnownContacts contacts;
  Messages notes;
  const auto note = [&](const Messages& more) {
    if (messages != nullptr) messages->insert(messages->end(), more.begin(), more.end());
  };
  try {
    CheckedSurface checked(mesh, CheckedSurface::Extent::kAll, options.crossings, options.monitor);
    contacts = checked.contacts();
    Polyhedron set = resolve_mesh(std::move(checked), options, &notes, Measure::kNot).set;
    note(notes);
    return set;
  } catch (const InputError&) {
    // The repair says what is wrong.
  }
  RepairedMesh repaired = Repairer(mesh, std::move(contacts), how, options.monitor).run();
  if (!repaired.problem.empty()) {
    throw InputError(repaired.problem + advice_about(repaired, options.close_percent));
  }
  note(repaired.done);
  note(repaired.notes);
  return std::move(repaired.set);
}

}  // namespace nef
