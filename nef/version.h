// SPDX-License-Identifier: Apache-2.0
//
// The version of the suite, for compilers, CMake, packages and scripts: the only place that states it (recipes in
// packaging/ repeat it, and scripts/checks/check_sources.py compares them).
#pragma once

/// The version as text, three numbers with dots: of the headers that a program is compiled with. CONTRIBUTING.md, "What
/// is stable", says what may change between versions.
#define NEF_VERSION "1.0.0"
