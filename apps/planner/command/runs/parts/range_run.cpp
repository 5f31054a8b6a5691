// SPDX-License-Identifier: Apache-2.0
//
// One run: read the mechanism, find its range, write the report, pages and glTF files, print a line for each part. The
// report has the ends as exact roots, or as intervals of screws, and as doubles; the text has doubles and the first
// pair of items that touch.
#include "apps/planner/command/runs/runs.h"

#include <algorithm>
#include <iostream>

#include "apps/planner/command/findings.h"
#include "apps/planner/command/runs/parts/range_view.h"
#include "apps/planner/mechanism/range_of_motion.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/timing/time_limit.h"
#include "nef/io/number_text.h"

namespace nef::planner {
namespace {

using nlohmann::json;

const char* joint_text(Joint::Kind kind) {
  return std::array{"hinge", "slider", "screw", "four-bar"}.at(static_cast<std::size_t>(kind));
}

// Some 18 digits beyond the point.
constexpr unsigned kBits = 60;

double measure_of(const QuadraticRoot& value, const Joint& joint) {
  return joint.measure_of(enclosure(value, kBits)[0]);
}

json end_json(const RangeEnd& end, const Mechanism& m) {
  json result;
  result[m.joint.kind() == Joint::Kind::kSlider ? "stroke" : "degrees"] = measure_of(end.value, m.joint);
  if (end.between) {
    result["between"] = {to_string((*end.between)[0]), to_string((*end.between)[1])};
  } else if (end.value.is_rational()) {
    result["value"] = to_string(end.value.rational);
  } else {
    const std::array<Rational, 2> around = enclosure(end.value, kBits);
    result["between"] = {to_string(around[0]), to_string(around[1])};
    result["root"] = {
        {"rational", to_string(end.value.rational)}, {"square", to_string(end.value.square)}, {"sign", end.value.sign}};
  }
  for (const ContactPair& stop : end.stops) {
    result["stops"].push_back({{"moving", stop.moving}, {"fixed", stop.fixed}, {"of_fixed", stop.of_fixed}});
  }
  return result;
}

// The first of them: others are the same contact, seen from other items.
std::string stops_text(const RangeEnd& end, const Mechanism& m) {
  if (end.stops.empty()) return "";
  const ContactPair& stop = end.stops.front();
  std::string text = " (" + stop.moving + " and " + stop.of_fixed + " of " + m.fixed_names[stop.fixed];
  if (end.stops.size() > 1) text += ", " + std::to_string(end.stops.size() - 1) + " more";
  return text + ")";
}

}  // namespace

void print_range(const RangeOfMotion& range, const Mechanism& m) {
  const bool slides = m.joint.kind() == Joint::Kind::kSlider;
  const auto at = [&](const RangeEnd& end) {
    std::string text;
    append_number(text, measure_of(end.value, m.joint));
    return text;
  };
  for (const RangePart& part : range.parts) {
    std::cout << status_name(part.status);
    if (compare(part.from.value, part.to.value) == 0) {
      std::cout << " at " << at(part.from);
    } else {
      std::cout << " from " << at(part.from) << " to " << at(part.to);
    }
    std::cout << (slides ? "" : " degrees") << stops_text(part.from, m);
    if (compare(part.from.value, part.to.value) != 0) std::cout << stops_text(part.to, m);
    std::cout << '\n';
  }
}

json range_json(const RangeOfMotion& range, const Mechanism& m) {
  json result{
      {"mechanism", m.name}, {"joint", joint_text(m.joint.kind())}, {"fixed", m.fixed_names}, {"parts", json::array()}};
  for (const RangePart& part : range.parts) {
    result["parts"].push_back(
        {{"status", status_name(part.status)}, {"from", end_json(part.from, m)}, {"to", end_json(part.to, m)}});
  }
  result["cells"] = range.cells;
  result["events"] = range.events;
  return result;
}

bool is_undecided(const RangeOfMotion& range) {
  return std::any_of(range.parts.begin(), range.parts.end(),
                     [](const RangePart& part) { return part.status == RangeStatus::kUndecided; });
}

int run_range(const Arguments& a, const TimeLimit& limit) {
  const Stopwatch watch;
  const Mechanism mechanism = read_mechanism(a.range, a.session.mesh);
  a.session.note_all(mechanism.messages);
  const double setup_s = watch.seconds();
  RangeOfMotion range;
  try {
    range = range_of_motion(mechanism, limit.monitor());
  } catch (const Interrupted&) {
    range.parts.assign(1, {RangeStatus::kUndecided, {mechanism.low, {}, {}}, {mechanism.high, {}, {}}});
  }
  tell(a, {"range",
           mechanism.name,
           [&] { return range_json(range, mechanism); },
           {{"setup", setup_s, {}}, {"op", watch.seconds() - setup_s, {}}},
           [&] { print_range(range, mechanism); },
           nullptr,
           [&] { return range_layers(range, mechanism); }});
  return is_undecided(range) ? 5 : 0;
}

}  // namespace nef::planner
