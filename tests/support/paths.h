// SPDX-License-Identifier: Apache-2.0
//
// Where tests find data and programs. Functions rather than macros, so that the objects of tests are the same in every
// checkout and ccache finds them.
#pragma once

#include <string>

/// The root of the sources, absolute, without a slash at the end.
const std::string& source_folder();

/// The folder of the built programs, likewise.
const std::string& program_folder();
