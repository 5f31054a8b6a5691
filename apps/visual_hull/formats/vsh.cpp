// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/formats/vsh.h"

#include "apps/visual_hull/scene/scene_number.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/geometry/vectors.h"
#include "nef/io/text_cursor.h"

namespace nef::visual_hull {
namespace {

using nef::dot;
using nef::minus;

class Reader {
 public:
  Reader(const std::string& text, const std::string& file) : cursor_(text, file) {}

  /// The file has shown that it is what its name says: from now on its words may be told.
  void recognized() { quote_ = Quote::kWord; }

  Rational number(const std::string& what) { return scene_number(next(what), where(), what, quote_); }

  Rational3 point(const std::string& what) {
    Rational3 p;
    for (Rational& c : p) c = number(what);
    return p;
  }

  std::size_t count(const std::string& what, std::size_t least) {
    const std::string token(next(what));
    if (token.size() > 7 || token.find_first_not_of("0123456789") != std::string::npos || std::stoul(token) < least) {
      throw nef::InputError(where() + ": " + nef::in_quotes(token) + " is not a " + what + " of at least " +
                            std::to_string(least));
    }
    return std::stoul(token);
  }

  void expect_end() {
    const std::string_view token = cursor_.word();
    if (!token.empty()) {
      throw nef::InputError(where() + ": " + nef::in_quotes(token) + " follows after the last camera");
    }
  }

  [[nodiscard]] std::string where() const { return cursor_.path() + ":" + std::to_string(cursor_.line()); }

 private:
  std::string_view next(const std::string& what) {
    const std::string_view token = cursor_.word();
    if (token.empty()) throw nef::InputError(where() + ": the file ends before the " + what);
    return token;
  }

  nef::TextCursor cursor_;
  Quote quote_ = Quote::kNever;
};

// The normal of the plane through all points, on the side away from the centre.
Rational3 normal_away_from(const std::vector<std::vector<Rational3>>& polygons, const Rational3& centre,
                           const std::string& where) {
  const Rational3& origin = polygons[0][0];
  Rational3 normal = nef::normal_of<Rational>(polygons[0]);
  if (nef::is_zero(normal)) throw nef::InputError(where + ": the points of polygon 1 lie on a line");
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    for (std::size_t i = 0; i < polygons[k].size(); ++i) {
      if (sgn(dot(normal, minus(polygons[k][i], origin))) != 0) {
        throw nef::InputError(where + ": point " + std::to_string(i + 1) + " of polygon " + std::to_string(k + 1) +
                              " is not in the plane of the first three");
      }
    }
  }
  const int side = sgn(dot(normal, minus(origin, centre)));
  if (side == 0) throw nef::InputError(where + ": the plane of the polygons contains the camera's centre");
  if (side < 0) {
    for (Rational& c : normal) c = -c;
  }
  return normal;
}

View make_view(const Rational3& centre, const std::vector<std::vector<Rational3>>& polygons, const std::string& name,
               const std::string& where) {
  const Rational3 normal = normal_away_from(polygons, centre, where);
  // Y is seen at C + s (Y - C), s = h / (n . (Y - C)), h = n . (any point - C) > 0. In homogeneous
  // coordinates that is h (Y - C) + C (n . (Y - C)) with weight n . (Y - C), positive in front.
  const Rational height = dot(normal, minus(polygons[0][0], centre));
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (abs(normal[i]) > abs(normal[axis])) axis = i;
  }
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const Rational nc = dot(normal, centre);
  Matrix34 matrix;
  const auto set_row = [&](std::size_t row, std::size_t coordinate) {
    for (std::size_t j = 0; j < 3; ++j) {
      matrix[row][j] = centre[coordinate] * normal[j] + (j == coordinate ? height : Rational(0));
    }
    matrix[row][3] = -height * centre[coordinate] - centre[coordinate] * nc;
  };
  set_row(0, u);
  set_row(1, v);
  for (std::size_t j = 0; j < 3; ++j) matrix[2][j] = normal[j];
  matrix[2][3] = -nc;

  View view;
  view.name = name;
  view.camera = Camera(name, matrix);
  view.polygons.emplace();
  for (const auto& polygon : polygons) {
    Ring ring;
    for (const Rational3& p : polygon) ring.emplace_back(p[u], p[v]);
    view.polygons->push_back(std::move(ring));
  }
  return view;
}

}  // namespace

Scene read_vsh(const std::string& text, const std::filesystem::path& file) {
  const std::string where = file.string();
  Reader reader(text, where);
  Scene scene;
  scene.format = "polygons in space (.vsh)";
  scene.box.emplace();
  scene.box->low = reader.point("smallest corner of the box");
  scene.box->high = reader.point("largest corner of the box");
  reader.recognized();
  check_box(*scene.box, where);
  const std::size_t cameras = reader.count("number of cameras", 1);
  for (std::size_t c = 0; c < cameras; ++c) {
    const std::string name = std::to_string(c + 1);
    const std::string of = " of camera " + name;
    const Rational3 centre = reader.point("centre" + of);
    const std::size_t count = reader.count("number of polygons" + of, 1);
    std::vector<std::vector<Rational3>> polygons;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t points = reader.count("number of points" + of, 3);
      std::vector<Rational3> polygon;
      for (std::size_t i = 0; i < points; ++i) polygon.push_back(reader.point("points" + of));
      polygons.push_back(std::move(polygon));
    }
    scene.views.push_back(make_view(centre, polygons, name, where + ", camera " + name));
  }
  reader.expect_end();
  return scene;
}

}  // namespace nef::visual_hull
