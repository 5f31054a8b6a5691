// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/linkage/linkage_path.h"

#include <algorithm>
#include <cmath>

#include "apps/program/numbers.h"
#include "apps/program/reports/exact_json.h"
#include "apps/program/reports/json_reader.h"
#include "nef/base/counted.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

std::vector<double> doubles_of(const std::vector<Rational>& numbers, const std::string& where,
                               const std::vector<std::string>& joints) {
  if (numbers.size() != joints.size()) {
    std::string names;
    for (const std::string& joint : joints) names += (names.empty() ? "" : ", ") + joint;
    throw InputError(where + ": expected " + counted(joints.size(), "value", "values") + " (" + names + "), not " +
                     std::to_string(numbers.size()));
  }
  std::vector<double> values;
  for (const Rational& x : numbers) {
    values.push_back(nearest_double(x));
    if (!std::isfinite(values.back())) throw InputError(where + ": a value is too large");
  }
  return values;
}

void check_values(const LinkageChecker& checker, std::span<const std::vector<double>> path) {
  if (path.empty()) throw InputError("a path of a linkage needs one place at least");
  for (const std::vector<double>& values : path) {
    if (values.size() != checker.linkage().dimension()) {
      throw InputError("the linkage has " +
                       counted(checker.linkage().dimension(), "joint with a value", "joints with a value") + ", not " +
                       std::to_string(values.size()));
    }
    if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); })) {
      throw InputError("a value of a joint is not finite");
    }
  }
}

}  // namespace

CertifiedLinkagePath certify(const LinkageChecker& checker, std::span<const std::vector<double>> path,
                             const CheckLimits& limits, const Monitor& monitor) {
  using Status = MotionVerdict::Status;
  check_values(checker, path);
  CertifiedLinkagePath result;
  const std::size_t motions = std::max<std::size_t>(path.size() - 1, 1);
  for (std::size_t i = 0; i < motions; ++i) {
    monitor.tell_progress("certifying motions", i, motions);
    result.motions.push_back(path.size() == 1 ? checker.check(path[0])
                                              : checker.check(path[i], path[i + 1], limits, monitor));
    const Status status = result.motions.back().status;
    if (status == Status::kCollides && !result.blocked) result.blocked = i;
    if (status == Status::kUndecided && result.status == Status::kFree) result.status = Status::kUndecided;
  }
  if (result.blocked) result.status = Status::kCollides;
  return result;
}

std::vector<double> values_at(std::span<const double> from, std::span<const double> to, double parameter) {
  std::vector<double> result;
  for (std::size_t i = 0; i < from.size(); ++i) result.push_back((1 - parameter) * from[i] + parameter * to[i]);
  return result;
}

std::vector<std::vector<double>> read_joint_path(const std::string& file, const std::vector<std::string>& joints) {
  const std::string text = read_file(file);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  std::vector<std::vector<double>> path;
  if (first != std::string::npos && text[first] == '{') {
    const nlohmann::json value = parse_exact_json(text, file);
    const JsonReader root(value, file);
    if (!root.has("path")) root.fail("has no list 'path'");
    path = root["path"].list([&](const JsonReader& values) {
      return doubles_of(values.list(&JsonReader::number_of), values.where(), joints);
    });
  } else {
    for (const auto& [where, numbers] : parse_lines(text, file)) path.push_back(doubles_of(numbers, where, joints));
  }
  if (path.empty()) throw InputError(file + ": contains no values of joints");
  return path;
}

}  // namespace nef::planner
