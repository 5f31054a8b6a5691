// SPDX-License-Identifier: Apache-2.0
#include "nef/program/set_info.h"

#include <cmath>

namespace nef {

using Json = nlohmann::ordered_json;

namespace {

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json corner_json(const Rational3& point) {
  Json result = Json::array();
  for (const Rational& x : point) result.push_back(number_or_null(nearest_double(x)));
  return result;
}

Json exact_corner_json(const Rational3& point) {
  return Json::array({to_string(point[0]), to_string(point[1]), to_string(point[2])});
}

}  // namespace

Json set_info(const Polyhedron& set, bool with_volume) {
  const Counts count = counts(set);
  Json info;
  info["vertices"] = count.vertices;
  info["edges"] = count.edges;
  info["facets"] = count.facets;
  info["volumes"] = count.volumes;
  info["shells"] = count.shells;
  info["bounded"] = set.is_bounded();
  info["open"] = set.is_open();
  info["closed"] = set.is_closed();
  info["regular"] = set.is_regular();
  const std::optional<Rational> content = with_volume ? volume(set) : std::nullopt;
  info["volume"] = content ? Json(to_string(*content)) : Json(nullptr);
  info["volume_double"] = content ? number_or_null(nearest_double(*content)) : Json(nullptr);
  info["area"] = number_or_null(surface_area(set));
  info["bbox"] = nullptr;
  info["bbox_exact"] = nullptr;
  if (const auto box = bounding_box(set)) {
    info["bbox"] = {corner_json((*box)[0]), corner_json((*box)[1])};
    info["bbox_exact"] = {exact_corner_json((*box)[0]), exact_corner_json((*box)[1])};
  }
  info["euler_numbers"] = euler_numbers(set);
  return info;
}

}  // namespace nef
