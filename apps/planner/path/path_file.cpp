// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/path/path_file.h"

#include "apps/program/exact_json.h"
#include "apps/program/numbers.h"
#include "nef/io/file_bytes.h"
#include "nef/io/number_text.h"

namespace nef::planner {
namespace {

using nlohmann::json;

// Three numbers a line, or the seven of an SE(3) matrix, whose last four are the rotation.
std::vector<Rational3> points_of_lines(const std::string& text, const std::string& file) {
  std::vector<Rational3> points;
  for (const auto& [where, values] : parse_lines(text, file)) {
    if (values.size() != 3 && values.size() != 7) {
      throw InputError(where + ": expected x y z, or x y z qx qy qz qw, not " + std::to_string(values.size()) +
                       " numbers");
    }
    const bool turned = values.size() == 7 && (values[3] != 0 || values[4] != 0 || values[5] != 0);
    if (turned) throw InputError(where + ": the robot is turned here, and this is about paths of translations");
    points.push_back({values[0], values[1], values[2]});
  }
  return points;
}

}  // namespace

std::string path_text(const ExactPath& path) {
  std::string out;
  for (const Rational3& p : path.points) {
    for (const Rational& x : p) {
      append_number(out, nearest_double(x));
      out += &x == &p.back() ? '\n' : ' ';
    }
  }
  return out;
}

std::string path_matrix(const ExactPath& path, bool se3) {
  std::string out;
  for (const Rational3& p : path.points) {
    for (const Rational& x : p) {
      append_number(out, nearest_double(x));
      out += ' ';
    }
    out += se3 ? "0 0 0 1 \n" : "\n";
  }
  return out + '\n';
}

std::vector<Rational3> read_waypoints(const std::string& file) {
  const std::string text = read_file(file);
  std::vector<Rational3> points;
  if (text[text.find_first_not_of(" \t\r\n")] == '{') {
    const json root = parse_exact_json(text, file);
    if (!root.contains("path") || !root["path"].is_array()) throw InputError(file + ": holds no 'path'");
    for (const json& point : root["path"]) points.push_back(point_of(point, file + ": path"));
  } else {
    points = points_of_lines(text, file);
  }
  if (points.empty()) throw InputError(file + ": holds no way-points");
  return points;
}

}  // namespace nef::planner
