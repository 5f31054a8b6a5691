// SPDX-License-Identifier: Apache-2.0
#include "nef/program/set_info.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "nef/polyhedron.h"
#include "nef/query/measure.h"
#include "nef/query/measures/approximate_volume.h"
#include "nef/query/moments.h"

namespace nef {

using Json = nlohmann::ordered_json;

namespace {

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json doubles_json(const Rational3& point) {
  Json result = Json::array();
  for (const Rational& x : point) result.push_back(number_or_null(nearest_double(x)));
  return result;
}

// The number as text, or null if that is too long.
Json exact_or_null(const std::string& text, const SetInfoOptions& options) {
  return options.exact || text.size() <= kShortNumber ? Json(text) : Json(nullptr);
}

// All three, or null if one is too long.
Json exact_or_null(const Rational3& point, const SetInfoOptions& options) {
  Json result = Json::array();
  for (const Rational& x : point) {
    result.push_back(exact_or_null(to_string(x), options));
    if (result.back().is_null()) return nullptr;
  }
  return result;
}

// Of what is bounded, without the exact volume.
void add_approximate_volume(Json& info, const Polyhedron& set, const Monitor& monitor) {
  const MeasuredVolume measured = approximate_volume(set, 1, monitor);
  info["volume_double"] = number_or_null(measured.value);
  info["volume_error"] = number_or_null(measured.error);
}

// As exact as the volume, which is where the time goes.
void add_area(Json& info, const Polyhedron& set, const SetInfoOptions& options, const Monitor& monitor) {
  if (options.volume || !set.is_bounded()) {
    info["area"] = number_or_null(surface_area(set));
    return;
  }
  const MeasuredArea measured = approximate_area(set, 1, monitor);
  info["area"] = number_or_null(measured.value);
  info["area_error"] = number_or_null(measured.error);
}

void add_moments(Json& info, const Polyhedron& set, const SetInfoOptions& options) {
  for (const char* key : {"centroid", "centroid_exact", "inertia", "principal_moments", "principal_axes"}) {
    info[key] = nullptr;
  }
  const std::optional<Moments> found = moments(set);
  if (!found || found->volume == 0) return;
  const Rational3 centre = *found->centroid();
  info["centroid"] = doubles_json(centre);
  info["centroid_exact"] = exact_or_null(centre, options);
  info["inertia"] = Json::array();
  for (const Rational3& row : found->inertia(centre)) info["inertia"].push_back(doubles_json(row));
  const PrincipalInertia principal = principal_inertia(*found);
  info["principal_moments"] = principal.moments;
  info["principal_axes"] = principal.axes;
}

}  // namespace

void add_volume(Json& info, const std::optional<Rational>& content, const SetInfoOptions& options) {
  for (const char* key : {"volume", "volume_double", "volume_digits"}) info[key] = nullptr;
  if (!content) return;
  const std::string text = to_string(*content);
  info["volume"] = exact_or_null(text, options);
  info["volume_double"] = number_or_null(nearest_double(*content));
  info["volume_digits"] = std::count_if(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

void add_box(Json& info, const std::optional<std::array<Rational3, 2>>& box, const SetInfoOptions& options) {
  info["bbox"] = nullptr;
  info["bbox_exact"] = nullptr;
  if (!box) return;
  info["bbox"] = {doubles_json((*box)[0]), doubles_json((*box)[1])};
  const Json low = exact_or_null((*box)[0], options);
  const Json high = exact_or_null((*box)[1], options);
  if (!low.is_null() && !high.is_null()) info["bbox_exact"] = {low, high};
}

Json set_info(const Polyhedron& set, const SetInfoOptions& options, const Monitor& monitor) {
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
  add_volume(info, options.volume ? volume(set) : std::nullopt, options);
  if (!options.volume && set.is_bounded()) add_approximate_volume(info, set, monitor);
  add_area(info, set, options, monitor);
  add_box(info, bounding_box(set, monitor), options);
  info["euler_numbers"] = euler_numbers(set);
  info["genus"] = Json::array();
  for (const std::optional<long>& genus : genera(set.complex())) {
    info["genus"].push_back(genus ? Json(*genus) : Json(nullptr));
  }
  if (options.moments) add_moments(info, set, options);
  return info;
}

}  // namespace nef
