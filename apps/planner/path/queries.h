// SPDX-License-Identifier: Apache-2.0
//
// Many questions about one free space, from a file.
#pragma once

#include <string>
#include <vector>

#include "nef/number/number.h"

namespace nef::planner {

/// From where to where.
struct Query {
  Rational3 start;
  Rational3 goal;
};

/// Six numbers a line, start and goal, separated by blanks or commas; or JSON, a list of objects with start and goal.
/// Numbers are exact, as in scenes. Throws InputError that names file and line, also for a file without queries.
std::vector<Query> read_queries(const std::string& file);

}  // namespace nef::planner
