// SPDX-License-Identifier: Apache-2.0
//
// Reads the text form, which native_format.h describes, word by word. Each map is validated and checked to lie at its
// vertex before it is given to synthesis, which relies on that; what synthesis cannot link is a defect, which is
// reported with the path.
#include "nef/io/native/native_binary.h"
#include "nef/io/native/native_format.h"
#include "nef/io/text_cursor.h"
#include "nef/polyhedron.h"
#include "nef/synthesis/complex_builder.h"
#include "nef/validation/validate.h"

namespace nef {
namespace {

class Reader {
 public:
  Reader(std::string_view text, const std::string& path, const Monitor& monitor)
      : cursor_(text, path), monitor_(monitor) {}

  Polyhedron run() {
    const LabelId outer = header();
    planes();
    for (std::size_t v = 0; v < vertices_; ++v) vertex(v);
    expect("end");
    if (!cursor_.at_end()) corrupt("there is more after the word end");
    std::variant<Complex, Defect> made = builder_.try_finish_unreduced(outer);
    if (const Defect* defect = std::get_if<Defect>(&made)) {
      corrupt("its vertices do not fit together: " + defect->text());
    }
    Complex& complex = std::get<Complex>(made);
    if (complex.volumes[kOuterVolume].mark != outer)
      corrupt("its outer volume is marked otherwise than its vertices say");
    if (const std::string broken = detail::validate_links(complex, monitor_); !broken.empty()) corrupt(broken);
    return Polyhedron(std::move(complex));
  }

 private:
  [[noreturn]] void corrupt(const std::string& what) const {
    cursor_.fail(FileProblem::kSyntax, "the file is not a valid polyhedron: " + what);
  }

  std::string_view word() {
    const std::string_view found = cursor_.word();
    if (found.empty()) cursor_.fail(FileProblem::kTruncated, "the file ends early; it is truncated");
    return found;
  }

  void expect(std::string_view wanted) {
    const std::string_view found = word();
    if (found == wanted) return;
    cursor_.fail(FileProblem::kSyntax,
                 "the word '" + std::string(wanted) + "' should be here, not " + in_quotes(found));
  }

  std::size_t count(std::string_view what) {
    const std::int64_t value = cursor_.integer(what);
    if (value < 0 || value > 0x3fffffff) {
      cursor_.fail(FileProblem::kWrongCount, "the " + std::string(what) + " is " + std::to_string(value));
    }
    return static_cast<std::size_t>(value);
  }

  // An index below `limit`.
  std::uint32_t index(std::string_view found, std::size_t limit, std::string_view what) {
    const std::int64_t value = cursor_.parse_integer(found, what);
    if (value < 0 || static_cast<std::size_t>(value) >= limit) {
      cursor_.fail(FileProblem::kBadIndex, "the " + std::string(what) + " " + std::to_string(value) +
                                               " does not exist; there are " + std::to_string(limit));
    }
    return static_cast<std::uint32_t>(value);
  }
  std::uint32_t index(std::size_t limit, std::string_view what) { return index(word(), limit, what); }
  std::uint32_t optional_index(std::size_t limit, std::string_view what) {
    const std::string_view found = word();
    return found == "-" ? kNone : index(found, limit, what);
  }

  LabelId mark() {
    const std::string_view found = word();
    return found == "*" ? kOutside : static_cast<LabelId>(index(found, kOutside, "mark"));
  }

  PlaneId plane() {
    const std::string_view found = word();
    if (found.size() < 2 || (found[0] != '+' && found[0] != '-')) {
      cursor_.fail(FileProblem::kSyntax, "a plane is written like +3 or -3, not " + in_quotes(found));
    }
    const PlaneId id = planes_[index(found.substr(1), planes_.size(), "plane")];
    return found[0] == '-' ? id.opposite() : id;
  }

  Integer integer(std::string_view what) {
    const std::string_view found = word();
    Integer value;
    const std::string_view digits = found.substr(found[0] == '-' ? 1 : 0);
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) {
      cursor_.fail(FileProblem::kNotANumber,
                   "the " + std::string(what) + " is " + in_quotes(found) + ", not a whole number");
    }
    value.set_str(std::string(found), 10);
    return value;
  }

  LabelId header() {
    const std::string_view magic = cursor_.word();
    if (magic != "nef") {
      cursor_.fail(FileProblem::kSyntax,
                   "a .nef file begins with 'nef 1', and this one does not; CGAL's text format has the "
                   "extension .nef3");
    }
    if (const std::int64_t version = cursor_.integer("version"); version != 1) {
      cursor_.fail(FileProblem::kUnsupported,
                   "the file has version " + std::to_string(version) + " of the format; this program reads version 1");
    }
    expect("planes");
    plane_count_ = count("number of planes");
    expect("vertices");
    vertices_ = count("number of vertices");
    expect("outer");
    return mark();
  }

  void planes() {
    planes_.reserve(std::min(plane_count_, cursor_.rest().size() / 10));
    for (std::size_t i = 0; i < plane_count_; ++i) {
      std::array<Integer, 5> c;
      for (Integer& value : c) value = integer("coefficient of a plane");
      if (c[0] == 0 && c[1] == 0 && c[2] == 0) {
        cursor_.fail(FileProblem::kSyntax, "the normal of plane " + std::to_string(i) + " is zero");
      }
      planes_.push_back(table_.intern(c[0], c[1], c[2], c[3], c[4]));
    }
  }

  void vertex(std::size_t v) {
    expect("vertex");
    std::array<Integer, 7> coordinates;
    for (Integer& value : coordinates) value = integer("coordinate of a vertex");
    if (coordinates[3] == 0) {
      cursor_.fail(FileProblem::kSyntax, "the denominator of vertex " + std::to_string(v) + " is zero");
    }
    const PointId point = point_.push_homogeneous(coordinates);
    map_.clear();
    map_.mark = mark();
    sphere_map();
    // Before synthesis: it may rely on all of this.
    if (const std::string broken = validate(table_, map_.view(), monitor_); !broken.empty()) {
      corrupt("vertex " + std::to_string(v) + ": " + broken);
    }
    check_planes(point, v);
    builder_.append(point_, point, map_.view());
    point_.pop();
  }

  void check_planes(PointId point, std::size_t v) {
    for_each_plane(map_, [&](PlaneId plane) {
      if (side_of_plane(table_, plane, point_, point, monitor_) == 0) return;
      corrupt("vertex " + std::to_string(v) + " does not lie on its planes");
    });
  }

  void sphere_map() {
    const std::size_t svertices = count("number of svertices");
    const std::size_t shalfedges = count("number of shalfedges");
    const std::size_t sloops = count("number of sloops");
    const std::size_t sfaces = count("number of sfaces");
    for (std::size_t i = 0; i < svertices; ++i) {
      SVertex s;
      s.p = plane();
      s.q = plane();
      s.out = optional_index(shalfedges, "shalfedge");
      s.sface = optional_index(sfaces, "sface");
      s.mark = mark();
      map_.svertices.push_back(s);
    }
    for (std::size_t i = 0; i < shalfedges; ++i) {
      SHalfedge e;
      e.plane = plane();
      e.source = index(svertices, "svertex");
      e.next = index(shalfedges, "shalfedge");
      e.prev = index(shalfedges, "shalfedge");
      e.sface = index(sfaces, "sface");
      e.mark = mark();
      map_.shalfedges.push_back(e);
    }
    for (std::size_t i = 0; i < sloops; ++i) {
      SLoop l;
      l.plane = plane();
      l.sface = index(sfaces, "sface");
      l.mark = mark();
      map_.sloops.push_back(l);
    }
    for (std::size_t i = 0; i < sfaces; ++i) sface(svertices, shalfedges, sloops);
  }

  void sface(std::size_t svertices, std::size_t shalfedges, std::size_t sloops) {
    SFace f;
    f.mark = mark();
    f.entries = static_cast<std::uint32_t>(map_.entries.size());
    f.entry_count = static_cast<std::uint32_t>(count("number of boundary items"));
    for (std::uint32_t i = 0; i < f.entry_count; ++i) {
      const std::string_view item = word();
      const std::string_view rest = item.substr(1);
      SFaceEntry entry;
      if (item[0] == 'c') {
        entry = {SFaceEntry::Kind::kCycle, index(rest, shalfedges, "shalfedge")};
      } else if (item[0] == 'v') {
        entry = {SFaceEntry::Kind::kIsolatedVertex, index(rest, svertices, "svertex")};
      } else if (item[0] == 'l') {
        entry = {SFaceEntry::Kind::kLoop, index(rest, sloops, "sloop")};
      } else {
        cursor_.fail(FileProblem::kSyntax, "a boundary item begins with c, v or l, not " + in_quotes(item));
      }
      map_.entries.push_back(entry);
    }
    map_.sfaces.push_back(f);
  }

  TextCursor cursor_;
  Monitor monitor_;
  std::size_t plane_count_ = 0;
  std::size_t vertices_ = 0;
  std::vector<PlaneId> planes_;  // as numbered in the file
  SphereMapBuffer map_;
  PlaneTable table_;
  PointTable point_;  // the one at hand
  ComplexBuilder builder_{table_, monitor_};
};

}  // namespace

Polyhedron read_native(std::string_view bytes, const std::string& path, const Monitor& monitor) {
  return is_native_binary(bytes) ? read_native_binary(bytes, path, NativeContents::kSet, monitor)
                                 : Reader(bytes, path, monitor).run();
}

}  // namespace nef
