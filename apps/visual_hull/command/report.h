// SPDX-License-Identifier: Apache-2.0
//
// What a run says about itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/program/session.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/construct/construct.h"

namespace nef::visual_hull {

/// What a report has of a hull beside what all have (see nef::Session::print): `views` (contours, holes, vertices, cone
/// facets), `box`, `result` (the keys of nef::set_info), `verify` if it was done, `suspects` (names) and measures in
/// `views` if views were compared, `dropped`, `pieces` (volumes) if there are several, `cpu` (processor seconds of each
/// phase).
nef::Json make_report(const Result& result, bool exact_volume = false);

/// Tells the session what each phase of the work took.
void tell_phases(nef::Session& session, const Result& result);

/// Why there is no hull, as one line.
std::string vanished_text(const Result& result);

/// What the comparison of the views has come to, as notes: the guilty view and those that were left out, or the first
/// three without a verdict. Nothing if the views were not compared or have no inconsistency.
std::vector<std::string> verdict_lines(const Result& result);

/// What has become of the cameras: one line, then one for each view that was found at fault. Nothing if they were not
/// refined.
std::vector<std::string> refinement_lines(const Result& result);

/// A line a view, best suspects first: residual R, fall D, removed U, relative d, score S.
std::vector<std::string> suspects_table(const Result& result);

/// What to do about views whose frames cut their silhouettes, where that was taken for background; nothing if there is
/// none.
std::optional<std::string> cut_note(const Result& result);

/// One line about the hull, for people.
std::string summary(const Result& result, const nef::Monitor& monitor = {});

}  // namespace nef::visual_hull
