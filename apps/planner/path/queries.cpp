// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/path/queries.h"

#include "apps/program/numbers.h"
#include "apps/program/reports/exact_json.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

using nlohmann::json;

std::vector<Query> queries_of_json(const std::string& text, const std::string& file) {
  const json root = parse_exact_json(text, file);
  std::vector<Query> queries;
  for (const json& entry : root) {
    const std::string what = file + ": query " + std::to_string(queries.size());
    if (!entry.is_object() || !entry.contains("start") || !entry.contains("goal")) {
      throw InputError(what + R"(: expected {"start": [x, y, z], "goal": [x, y, z]})");
    }
    queries.push_back({point_of(entry["start"], what + ": start"), point_of(entry["goal"], what + ": goal")});
  }
  return queries;
}

std::vector<Query> queries_of_lines(const std::string& text, const std::string& file) {
  std::vector<Query> queries;
  for (const auto& [where, x] : parse_lines(text, file)) {
    if (x.size() != 6) {
      throw InputError(where + ": expected the six coordinates of start and goal, not " + std::to_string(x.size()) +
                       " numbers");
    }
    queries.push_back({{x[0], x[1], x[2]}, {x[3], x[4], x[5]}});
  }
  return queries;
}

}  // namespace

std::vector<Query> read_queries(const std::string& file) {
  const std::string text = read_file(file);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) throw InputError(file + ": contains no queries");
  std::vector<Query> queries = text[first] == '[' ? queries_of_json(text, file) : queries_of_lines(text, file);
  if (queries.empty()) throw InputError(file + ": contains no queries");
  return queries;
}

}  // namespace nef::planner
