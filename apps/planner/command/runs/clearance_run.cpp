// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/runs/runs.h"

#include <cmath>
#include <sstream>

#include "apps/planner/clearance/widest_robot.h"
#include "nef/number/brief_text.h"

namespace nef::planner {

nlohmann::json make_widest(const Arguments& a, Scene& scene) {
  const Growth growth = a.widest_box ? Growth::kBox : Growth::kScale;
  const Widest widest =
      widest_robot(scene, growth, {parse_rational(a.precision), a.max_cells, a.time}, a.session.monitor);
  nlohmann::json result{{"growth", growth == Growth::kBox ? "box" : "scale"},
                        {"undecided", widest.undecided},
                        {"questions", widest.questions}};
  for (const auto& [key, value] : {std::pair("low", &widest.low), std::pair("high", &widest.high)}) {
    if (!*value) continue;
    result[key] = to_string(**value);
    result[std::string(key) + "_double"] = nearest_double(**value);
  }
  return result;
}

std::string widest_text(const nlohmann::json& widest) {
  std::ostringstream out;
  const auto put = [&](const char* key) {
    out << brief_text(parse_rational(widest[key].get<std::string>())) << " ("
        << widest[std::string(key) + "_double"].get<double>() << ")";
  };
  out << "widest: ";
  if (widest.contains("low")) {
    out << "a path at ";
    put("low");
  } else {
    out << "no path at any size that was tried";
  }
  if (widest.contains("high")) {
    out << ", none at ";
    put("high");
  } else if (!widest["undecided"].get<bool>()) {
    out << ", and at any size that was tried";
  }
  if (widest["undecided"].get<bool>()) out << ", undecided between";
  out << '\n';
  return out.str();
}

}  // namespace nef::planner
