// SPDX-License-Identifier: Apache-2.0
//
// Measures of a set with few corners and short coordinates are exact; for others, exact numbers would be long and slow,
// so they are doubles with proven bounds. Whether coordinates are short is decided by their common denominator, which
// bounds the length of exact sums.
#include "apps/program/set_info.h"

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

void add_approximate_volume(Json& info, const Polyhedron& set, const Monitor& monitor) {
  const MeasuredVolume measured = approximate_volume(set, monitor);
  for (const char* key : {"volume", "volume_double", "volume_digits"}) info[key] = nullptr;
  info["volume_double"] = number_or_null(measured.value);
  info["volume_error"] = std::isfinite(measured.value) ? number_or_null(measured.error) : Json(nullptr);
}

void add_approximate_area(Json& info, const Polyhedron& set, const Monitor& monitor) {
  const MeasuredArea measured = approximate_area(set, monitor);
  info["area"] = number_or_null(measured.value);
  info["area_error"] = std::isfinite(measured.value) ? number_or_null(measured.error) : Json(nullptr);
}

Json doubles_json(const std::array<double, 3>& point) {
  Json result = Json::array();
  for (const double x : point) result.push_back(number_or_null(x));
  return result;
}

void add_principal_axes(Json& info, const PrincipalInertia& principal) {
  info["principal_moments"] = principal.moments;
  info["principal_axes"] = principal.axes;
}

void add_exact_moments(Json& info, const Polyhedron& set, const SetInfoOptions& options) {
  const std::optional<Moments> found = moments(set);
  if (!found || found->volume == 0) return;
  const Rational3 centre = *found->centroid();
  info["centroid"] = doubles_json(centre);
  info["centroid_exact"] = exact_or_null(centre, options);
  info["inertia"] = Json::array();
  for (const Rational3& row : found->inertia(centre)) info["inertia"].push_back(doubles_json(row));
  add_principal_axes(info, principal_inertia(*found));
}

void add_approximate_moments(Json& info, const Polyhedron& set, const Monitor& monitor) {
  const std::optional<MeasuredMoments> found = approximate_moments(set, monitor);
  info["centroid_error"] = nullptr;
  info["inertia_error"] = nullptr;
  if (!found) return;
  info["centroid"] = doubles_json(found->centroid);
  info["centroid_error"] = number_or_null(found->centroid_error);
  info["inertia"] = Json::array();
  for (const std::array<double, 3>& row : found->inertia) info["inertia"].push_back(doubles_json(row));
  info["inertia_error"] = number_or_null(found->inertia_error);
  add_principal_axes(info, found->principal);
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

bool has_short_measures(const Polyhedron& set) {
  constexpr std::size_t kFewCorners = 4096;
  constexpr std::size_t kShortBits = 128;
  const Complex& c = set.complex();
  if (c.shalfedge_count() > kFewCorners) return false;
  Integer common = 1;
  for (const VertexId v : c.vertex_ids()) {
    mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), c.points.coordinate(point_of(v), 3));
    if (mpz_sizeinbase(common.get_mpz_t(), 2) > kShortBits) return false;
  }
  return true;
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
  const bool exact = options.exact || (!options.bounds && has_short_measures(set));
  if (exact) {
    add_volume(info, volume(set), options);
    info["area"] = number_or_null(surface_area(set));
  } else {
    add_approximate_volume(info, set, monitor);
    add_approximate_area(info, set, monitor);
  }
  add_box(info, bounding_box(set, monitor), options);
  info["euler_numbers"] = euler_numbers(set);
  info["genus"] = Json::array();
  for (const std::optional<long>& genus : genera(set.complex())) {
    info["genus"].push_back(genus ? Json(*genus) : Json(nullptr));
  }
  if (!options.moments) return info;
  for (const char* key : {"centroid", "centroid_exact", "inertia", "principal_moments", "principal_axes"}) {
    info[key] = nullptr;
  }
  if (exact) {
    add_exact_moments(info, set, options);
  } else {
    add_approximate_moments(info, set, monitor);
  }
  return info;
}

}  // namespace nef
