// SPDX-License-Identifier: Apache-2.0
//
// Only the local pyramids are taken from the file: points, directions, circles and marks. The planes of all vertices
// are interned first, then the sphere map of each vertex is drawn anew, and synthesis finds facets, shells and volumes.
// So whatever a file says of these cannot contradict the set; what is read is checked like any other complex. O(n log
// n).
#include <map>
#include <optional>

#include "nef/geometry/plane_finder.h"
#include "nef/io/cgal/cgal_nef3.h"
#include "nef/io/text_cursor.h"
#include "nef/polyhedron.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {
namespace {

using HomogeneousVector = std::array<Rational, 4>;

struct FileVertex {
  std::int64_t svertices = 0, shalfedges = 0, sfaces = 0;  // first of each
  std::int64_t svertex_end = 0, shalfedge_end = 0, sface_end = 0;
  std::int64_t sloop = -2;
  HomogeneousVector point;
  LabelId mark = 0;
};
struct FileSVertex {
  std::int64_t isolated_sface = -2;
  HomogeneousVector direction;
  LabelId mark = 0;
};
struct FileArc {
  std::int64_t twin = 0, source = 0, sface = 0;
  HomogeneousVector circle;
  LabelId mark = 0;
};
struct FileLoop {
  std::int64_t twin = 0, sface = 0;
  HomogeneousVector circle;
  LabelId mark = 0;
};

// The items of a file, each checked to be in range.
class Nef3File {
 public:
  Nef3File(std::string_view text, const std::string& path) : cursor_(text, path) { read(); }

  std::vector<FileVertex> vertices;
  std::vector<FileSVertex> svertices;
  std::vector<FileArc> arcs;
  std::vector<FileLoop> loops;
  std::vector<LabelId> sface_marks;
  LabelId outer = 0;

  [[noreturn]] void fail(FileProblem problem, const std::string& what) const { cursor_.fail(problem, what); }

 private:
  // Commas and braces touch numbers in some files, so words are cut at them.
  std::string_view word() {
    if (rest_.empty()) rest_ = cursor_.word();
    if (rest_.empty()) cursor_.fail(FileProblem::kTruncated, "the file ends early; it is truncated");
    constexpr std::string_view kMarks = "{},|";
    std::size_t length = rest_.find_first_of(kMarks);
    length = length == 0 ? 1 : std::min(length, rest_.size());
    const std::string_view found = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return found;
  }

  void expect(std::string_view wanted) {
    const std::string_view found = word();
    if (found == wanted) return;
    cursor_.fail(FileProblem::kSyntax, "'" + std::string(wanted) + "' should be here, not " + in_quotes(found));
  }

  std::size_t count(std::string_view name) {
    expect(name);
    const std::int64_t value = cursor_.parse_integer(word(), name);
    if (value < 0 || value > 0x3fffffff) cursor_.fail(FileProblem::kWrongCount, "a count is " + std::to_string(value));
    return static_cast<std::size_t>(value);
  }

  std::int64_t integer() { return cursor_.parse_integer(word(), "index"); }

  std::int64_t index(std::size_t limit, const char* what) {
    const std::int64_t value = integer();
    if (value < 0 || static_cast<std::size_t>(value) >= limit) {
      cursor_.fail(FileProblem::kBadIndex, std::string("the ") + what + " " + std::to_string(value) +
                                               " does not exist; there are " + std::to_string(limit));
    }
    return value;
  }

  void range(std::size_t limit, const char* what, std::int64_t& first, std::int64_t& end) {
    first = integer();
    end = integer() + 1;
    if (first == -2 && end == -1) {
      first = end = 0;
    } else if (first < 0 || end < first || end > static_cast<std::int64_t>(limit)) {
      cursor_.fail(FileProblem::kBadIndex, std::string("a vertex has ") + what + " " + std::to_string(first) + " to " +
                                               std::to_string(end - 1) + ", but there are " + std::to_string(limit));
    }
    expect(",");
  }

  void begin(std::size_t i) {
    const std::int64_t found = integer();
    if (found != static_cast<std::int64_t>(i)) {
      cursor_.fail(FileProblem::kWrongCount, "item " + std::to_string(i) + " should be here, not " +
                                                 std::to_string(found) + "; a count in the head is wrong");
    }
    expect("{");
  }

  HomogeneousVector vector() {
    HomogeneousVector result;
    for (Rational& x : result) cursor_.parse(word(), x, "coordinate on line", cursor_.line());
    return result;
  }

  LabelId end() {
    expect("}");
    return static_cast<LabelId>(index(2, "mark"));
  }

  void skip_item() {
    while (word() != "}") {
    }
    index(2, "mark");
  }

  void read() {
    for (const char* head : {"Selective", "Nef", "Complex"}) {
      if (word() == head) continue;
      cursor_.fail(FileProblem::kSyntax, "a .nef3 file begins with 'Selective Nef Complex', and this one does not");
    }
    if (const std::string_view kernel = word(); kernel != "standard") {
      cursor_.fail(FileProblem::kUnsupported,
                   "the file is of the kernel " + in_quotes(kernel) + "; only the standard kernel is supported");
    }
    const std::size_t vertex_count = count("vertices");
    svertex_count_ = count("halfedges");
    const std::size_t facet_count = count("facets");
    const std::size_t volume_count = count("volumes");
    arc_count_ = count("shalfedges");
    loop_count_ = count("shalfloops");
    sface_count_ = count("sfaces");
    for (std::size_t i = 0; i < vertex_count; ++i) read_vertex(i);
    for (std::size_t i = 0; i < svertex_count_; ++i) read_svertex(i, vertex_count);
    for (std::size_t i = 0; i < facet_count; ++i) {
      begin(i);
      skip_item();
    }
    for (std::size_t i = 0; i < volume_count; ++i) read_volume(i);
    for (std::size_t i = 0; i < arc_count_; ++i) read_arc(i);
    for (std::size_t i = 0; i < loop_count_; ++i) read_loop(i);
    for (std::size_t i = 0; i < sface_count_; ++i) {
      begin(i);
      while (word() != "}") {
      }
      sface_marks.push_back(static_cast<LabelId>(index(2, "mark")));
    }
    expect("/*");
  }

  void read_vertex(std::size_t i) {
    FileVertex& v = vertices.emplace_back();
    begin(i);
    range(svertex_count_, "halfedges", v.svertices, v.svertex_end);
    range(arc_count_, "shalfedges", v.shalfedges, v.shalfedge_end);
    range(sface_count_, "sfaces", v.sfaces, v.sface_end);
    v.sloop = integer();
    if (v.sloop != -2 && (v.sloop < 0 || v.sloop >= static_cast<std::int64_t>(loop_count_))) {
      cursor_.fail(FileProblem::kBadIndex, "the shalfloop " + std::to_string(v.sloop) + " does not exist");
    }
    expect("|");
    v.point = vector();
    if (v.point[3] == 0) cursor_.fail(FileProblem::kSyntax, "the denominator of a vertex is zero");
    v.mark = end();
  }

  void read_svertex(std::size_t i, std::size_t vertex_count) {
    FileSVertex& s = svertices.emplace_back();
    begin(i);
    index(svertex_count_, "halfedge");
    expect(",");
    index(vertex_count, "vertex");
    expect(",");
    const bool isolated = index(2, "flag") == 1;
    const std::int64_t item = index(isolated ? sface_count_ : arc_count_, isolated ? "sface" : "shalfedge");
    if (isolated) s.isolated_sface = item;
    expect("|");
    s.direction = vector();
    if (s.direction[0] == 0 && s.direction[1] == 0 && s.direction[2] == 0) {
      cursor_.fail(FileProblem::kSyntax, "the direction of a halfedge is zero");
    }
    if (s.direction[3] < 0) {
      for (Rational& x : s.direction) x = -x;
    }
    s.mark = end();
  }

  void read_volume(std::size_t i) {
    begin(i);
    std::vector<std::int64_t> shells;
    for (std::string_view found = word(); found != "}"; found = word()) {
      shells.push_back(cursor_.parse_integer(found, "sface"));
    }
    const auto mark = static_cast<LabelId>(index(2, "mark"));
    // Only needed where there are no vertices; old files do not begin with the outer volume.
    if (i == 0) outer = mark;
  }

  void read_arc(std::size_t i) {
    FileArc& e = arcs.emplace_back();
    begin(i);
    e.twin = index(arc_count_, "shalfedge");
    expect(",");
    integer();
    expect(",");
    integer();
    expect(",");
    e.source = index(svertex_count_, "halfedge");
    expect(",");
    e.sface = index(sface_count_, "sface");
    while (word() != "|") {
    }
    e.circle = vector();
    e.mark = end();
  }

  void read_loop(std::size_t i) {
    FileLoop& l = loops.emplace_back();
    begin(i);
    l.twin = index(loop_count_, "shalfloop");
    expect(",");
    l.sface = index(sface_count_, "sface");
    while (word() != "|") {
    }
    l.circle = vector();
    l.mark = end();
  }

  TextCursor cursor_;
  std::string_view rest_;
  std::size_t svertex_count_ = 0, arc_count_ = 0, loop_count_ = 0, sface_count_ = 0;
};

// Draws the sphere map of each vertex anew from directions, circles and marks.
class Builder {
 public:
  Builder(const Nef3File& file, const Monitor& monitor) : file_(file), builder_(planes_, monitor) {}

  std::variant<Complex, Defect> run() {
    // Directions keep a pointer to the planes: these are all interned before the first drawing.
    for (const FileVertex& v : file_.vertices) intern_planes(v);
    arc_at_ = loop_at_ = svertex_at_ = 0;
    for (std::size_t i = 0; i < file_.vertices.size(); ++i) draw(i);
    return builder_.try_finish(file_.outer);
  }

 private:
  static Rational3 point_of(const FileVertex& v) {
    return {v.point[0] / v.point[3], v.point[1] / v.point[3], v.point[2] / v.point[3]};
  }

  PlaneId plane_through(const Rational3& point, const Rational3& normal) {
    if (is_zero(normal)) file_.fail(FileProblem::kSyntax, "the normal of a circle is zero");
    return nef::plane_through(planes_, normal, point);
  }

  void intern_planes(const FileVertex& v) {
    const Rational3 point = point_of(v);
    for (std::int64_t e = v.shalfedges; e < v.shalfedge_end; ++e) {
      const HomogeneousVector& c = file_.arcs[static_cast<std::size_t>(e)].circle;
      arc_planes_.push_back(plane_through(point, {c[0], c[1], c[2]}));
    }
    if (v.sloop >= 0) {
      const HomogeneousVector& c = file_.loops[static_cast<std::size_t>(v.sloop)].circle;
      loop_planes_.push_back(plane_through(point, {c[0], c[1], c[2]}));
    }
    for (std::int64_t s = v.svertices; s < v.svertex_end; ++s) {
      // Two planes through the edge; simplification replaces them by those of facets where there are any.
      const HomogeneousVector& h = file_.svertices[static_cast<std::size_t>(s)].direction;
      const Rational3 d{h[0], h[1], h[2]};
      const Rational3 n = across(d);
      // With m = d x n, n x m = d (n . n) - n (d . n) is a positive multiple of d.
      line_planes_.push_back({plane_through(point, n), plane_through(point, cross(d, n))});
    }
  }

  void draw(std::size_t index) {
    const FileVertex& v = file_.vertices[index];
    drawing_.clear();
    drawing_.centre = v.mark;
    const auto face_mark = [&](std::int64_t sface) { return file_.sface_marks[static_cast<std::size_t>(sface)]; };
    if (v.sfaces == v.sface_end) file_.fail(FileProblem::kSyntax, "vertex " + std::to_string(index) + " has no sface");
    drawing_.background = face_mark(v.sfaces);
    for (std::int64_t s = v.svertices; s < v.svertex_end; ++s) {
      const FileSVertex& from = file_.svertices[static_cast<std::size_t>(s)];
      const auto [p, q] = line_planes_[svertex_at_++];
      Arrangement::Node node;
      node.direction = Direction::cross(planes_, p, q);
      node.mark = from.mark;
      node.around = from.isolated_sface >= 0 ? face_mark(from.isolated_sface) : LabelId{0};
      drawing_.nodes.push_back(std::move(node));
    }
    draw_arcs(v, index);
    if (v.sloop >= 0) {
      const FileLoop& loop = file_.loops[static_cast<std::size_t>(v.sloop)];
      const FileLoop& twin = file_.loops[static_cast<std::size_t>(loop.twin)];
      drawing_.circle = {true, loop_planes_[loop_at_++], loop.mark, face_mark(loop.sface), face_mark(twin.sface)};
    }
    builder_.add(point_of(v), drawing_);
  }

  void draw_arcs(const FileVertex& v, std::size_t index) {
    const std::size_t first = arc_at_;
    const auto local = [&](std::int64_t arc) -> const FileArc& {
      const FileArc& e = file_.arcs[static_cast<std::size_t>(arc)];
      if (arc < v.shalfedges || arc >= v.shalfedge_end || e.source < v.svertices || e.source >= v.svertex_end) {
        file_.fail(FileProblem::kBadIndex, "vertex " + std::to_string(index) + " has items of another vertex");
      }
      return e;
    };
    for (std::int64_t i = v.shalfedges; i < v.shalfedge_end; ++i) {
      const FileArc& e = local(i);
      const FileArc& twin = local(e.twin);
      const PlaneId plane = arc_planes_[first + static_cast<std::size_t>(i - v.shalfedges)];
      ++arc_at_;
      if (twin.twin != i || e.twin == i) {
        file_.fail(FileProblem::kBadIndex, "shalfedge " + std::to_string(i) + " is not the twin of its twin");
      }
      if (e.twin < i) continue;
      check_direction(e.source, plane);
      check_direction(twin.source, plane);
      Arrangement::Arc arc;
      arc.plane = plane;
      arc.source = static_cast<std::uint32_t>(e.source - v.svertices);
      arc.target = static_cast<std::uint32_t>(twin.source - v.svertices);
      arc.mark = e.mark;
      arc.left = file_.sface_marks[static_cast<std::size_t>(e.sface)];
      arc.right = file_.sface_marks[static_cast<std::size_t>(twin.sface)];
      drawing_.arcs.push_back(arc);
    }
  }

  // The direction of a halfedge must lie on the circle of a shalfedge that ends there.
  void check_direction(std::int64_t svertex, PlaneId plane) const {
    const HomogeneousVector& d = file_.svertices[static_cast<std::size_t>(svertex)].direction;
    Rational dot = 0;
    for (std::size_t i = 0; i < 3; ++i) dot += d[i] * planes_.oriented_coefficient(plane, i);
    if (dot != 0) {
      file_.fail(FileProblem::kSyntax, "the direction of halfedge " + std::to_string(svertex) +
                                           " does not lie on the circle of its shalfedge");
    }
  }

  const Nef3File& file_;
  PlaneTable planes_;
  ComplexBuilder builder_;
  std::vector<PlaneId> arc_planes_;  // in the order of vertices
  std::vector<PlaneId> loop_planes_;
  std::vector<std::pair<PlaneId, PlaneId>> line_planes_;
  std::size_t arc_at_ = 0, loop_at_ = 0, svertex_at_ = 0;
  Arrangement drawing_;
};

}  // namespace

Polyhedron read_nef3(std::string_view text, const std::string& path, const Monitor& monitor) {
  const Nef3File file(text, path);
  std::variant<Complex, Defect> made = Builder(file, monitor).run();
  if (const Defect* defect = std::get_if<Defect>(&made)) {
    file.fail(FileProblem::kSyntax,
              "the file is not a valid polyhedron: its vertices do not fit together: " + defect->text());
  }
  Complex& complex = std::get<Complex>(made);
  if (const std::string broken = validate(complex, monitor); !broken.empty()) {
    file.fail(FileProblem::kSyntax, "the file is not a valid polyhedron: " + broken);
  }
  return Polyhedron(std::move(complex));
}

}  // namespace nef
