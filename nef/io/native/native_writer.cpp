// SPDX-License-Identifier: Apache-2.0
#include "nef/io/native/native_format.h"
#include "nef/io/number_text.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

class NativeWriter {
 public:
  explicit NativeWriter(const Complex& complex) : c_(complex) {}

  std::string run() {
    text_ = "nef 1\nplanes " + std::to_string(c_.planes.size()) + " vertices " + std::to_string(c_.vertex_count()) +
            " outer";
    mark(c_.volumes[kOuterVolume].mark);
    text_ += '\n';
    for (std::uint32_t row = 0; row < c_.planes.size(); ++row) {
      for (std::size_t i = 0; i < 5; ++i) {
        if (i > 0) text_ += ' ';
        append_integer(text_, c_.planes.coefficient(PlaneId::of_row(row), i));
      }
      text_ += '\n';
    }
    for (const VertexId v : c_.vertex_ids()) vertex(v);
    return std::move(text_ += "end\n");
  }

 private:
  void vertex(VertexId v) {
    const SphereMapView map = c_.sphere_map(v);
    text_ += "vertex";
    for (std::size_t i = 0; i < 7; ++i) {
      text_ += ' ';
      append_integer(text_, c_.points.coordinate(point_of(v), i));
    }
    mark(map.mark);
    for (const std::size_t count :
         {map.svertices.size(), map.shalfedges.size(), map.sloops.size(), map.sfaces.size()}) {
      number(count);
    }
    text_ += '\n';
    for (const SVertex& s : map.svertices) {
      plane(s.p);
      plane(s.q);
      index(s.out);
      index(s.out == kNone ? s.sface : kNone);
      mark(s.mark);
      text_ += '\n';
    }
    for (const SHalfedge& e : map.shalfedges) {
      plane(e.plane);
      for (const std::uint32_t i : {e.source, e.next, e.prev, e.sface}) number(i);
      mark(e.mark);
      text_ += '\n';
    }
    for (const SLoop& l : map.sloops) {
      plane(l.plane);
      number(l.sface);
      mark(l.mark);
      text_ += '\n';
    }
    for (const SFace& f : map.sfaces) sface(map, f);
  }

  void sface(const SphereMapView& map, const SFace& f) {
    mark(f.mark);
    number(f.entry_count);
    for (const SFaceEntry& entry : map.entries.subspan(f.entries, f.entry_count)) {
      text_ += ' ';
      text_ += entry.kind == SFaceEntry::Kind::kCycle ? 'c' : entry.kind == SFaceEntry::Kind::kLoop ? 'l' : 'v';
      append_number(text_, entry.index);
    }
    text_ += '\n';
  }

  void number(std::size_t value) {
    text_ += ' ';
    append_number(text_, value);
  }
  void index(std::uint32_t value) {
    if (value == kNone) {
      text_ += " -";
    } else {
      number(value);
    }
  }
  void plane(PlaneId plane) {
    text_ += plane.flipped() ? " -" : " +";
    append_number(text_, plane.row());
  }
  void mark(LabelId value) {
    if (value == kOutside) {
      text_ += " *";
    } else {
      number(value);
    }
  }

  const Complex& c_;
  std::string text_;
};

}  // namespace

std::string native_text(const Polyhedron& polyhedron) { return NativeWriter(polyhedron.complex()).run(); }

}  // namespace nef
