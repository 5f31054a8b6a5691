// SPDX-License-Identifier: Apache-2.0
//
// A state of the studio computed without a page.
#pragma once

#include <ostream>
#include <string>

#include "apps/studio/studio.h"

namespace nef::studio {

/// Computes the panel that a .nefstudio file shows, as the page would: the report goes to `out` as JSON, and the
/// panel's first set to a file of any format unless its name is empty. The file is the first of `options.files`; what
/// it names is below the root. Limits are those of pages. Throws InputError for a state that cannot be computed.
void run_state(const StudioOptions& options, const std::string& output, std::ostream& out);

}  // namespace nef::studio
