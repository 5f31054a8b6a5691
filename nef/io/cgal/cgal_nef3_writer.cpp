// SPDX-License-Identifier: Apache-2.0
//
// All links are indices, so one pass over the items, kind by kind, writes the file once two things are known: the
// neighbours of each shalfedge along its facet's boundary, which follow from our cycles of corners, and the first sface
// of each shell. CGAL's shalfedges belong to the facet's other side than ours, hence the opposite halffacets.
#include "nef/base/error.h"
#include "nef/complex/shell_sfaces.h"
#include "nef/geometry/integer_vector.h"
#include "nef/io/cgal/cgal_nef3.h"
#include "nef/io/number_text.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

class Nef3Writer {
 public:
  explicit Nef3Writer(const Complex& complex) : c_(complex) {}

  std::string run() {
    link_facet_cycles();
    const ShellSfaces of_shells(c_);
    for (const ShellId s : c_.shells.ids()) first_sface_.push_back(of_shells.of(s).front());
    head();
    for (const VertexId v : c_.vertex_ids()) vertex(v);
    for (const HalfedgeId h : c_.halfedge_ids()) halfedge(h);
    for (const FacetId f : c_.facets.ids()) {
      halffacet(halffacet_of(f, false));
      halffacet(halffacet_of(f, true));
    }
    for (const VolumeId v : c_.volumes.ids()) volume(v);
    for (const SHalfedgeId e : c_.shalfedge_ids()) shalfedge(e);
    for (std::uint32_t l = 0; l < c_.sloops.size(); ++l) sloop(l);
    for (const VertexId v : c_.vertex_ids()) sfaces(v);
    return std::move(text_ += "/* end Selective Nef complex */\n");
  }

  [[nodiscard]] bool met_other_marks() const { return other_marks_; }

 private:
  // Halffacet 2f has the twins of our corners, which go on to the twin of the next; 2f + 1 has the corners, backwards.
  void link_facet_cycles() {
    next_.resize(c_.shalfedge_count());
    prev_.resize(c_.shalfedge_count());
    for (const CycleId i : c_.cycle_ids()) {
      const auto corners = c_.corners_of(i);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const SHalfedgeId here = corners[k];
        const SHalfedgeId ahead = corners[(k + 1) % corners.size()];
        next_[twin_of(here)] = twin_of(ahead);
        prev_[twin_of(ahead)] = twin_of(here);
        next_[ahead] = here;
        prev_[here] = ahead;
      }
    }
  }

  void head() {
    text_ = "Selective Nef Complex\nstandard\n";
    const auto line = [this](const char* name, std::size_t count) {
      text_ += name;
      append_number(text_, count);
      text_ += '\n';
    };
    line("vertices   ", c_.vertex_count());
    line("halfedges  ", c_.svertex_count());
    line("facets     ", 2 * c_.facet_count());
    line("volumes    ", c_.volume_count());
    line("shalfedges ", c_.shalfedge_count());
    line("shalfloops ", c_.sloops.size());
    line("sfaces     ", c_.sface_count());
  }

  void begin(std::size_t index) {
    append_number(text_, index);
    text_ += " {";
  }
  void number(std::int64_t value) {
    text_ += ' ';
    append_number(text_, value);
  }
  void integer(mpz_srcptr value) {
    text_ += ' ';
    append_integer(text_, value);
  }
  void range(std::uint32_t first, std::uint32_t last) {
    number(first == last ? -2 : static_cast<std::int64_t>(first));
    number(first == last ? -2 : static_cast<std::int64_t>(last) - 1);
    text_ += ',';
  }
  void end(LabelId mark) {
    other_marks_ = other_marks_ || mark > 1;
    text_ += mark == 0 ? " } 0\n" : " } 1\n";
  }

  void vertex(VertexId v) {
    const VertexRecord& record = c_.vertices[v];
    const VertexRecord& after = c_.vertices[v.next()];
    begin(v.index());
    range(record.svertices.index(), after.svertices.index());
    range(record.shalfedges.index(), after.shalfedges.index());
    range(record.sfaces.index(), after.sfaces.index());
    number(record.sloops == after.sloops ? -2 : static_cast<std::int64_t>(record.sloops));
    text_ += " |";
    for (std::size_t i = 0; i < 4; ++i) integer(c_.points.coordinate(point_of(v), i));
    end(c_.mark(v));
  }

  void halfedge(HalfedgeId h) {
    const VertexId v = c_.source(h);
    const SVertex& s = c_.svertex(h);
    begin(h.index());
    number(c_.twin[h].index());
    text_ += ',';
    number(v.index());
    text_ += ',';
    if (s.out == kNone) {
      number(1);
      number((c_.vertices[v].sfaces + s.sface).index());
    } else {
      number(0);
      number((c_.vertices.shalfedges(v) + s.out).index());
    }
    text_ += " |";
    for (const Integer& x : primitive(Direction::cross(c_.planes, s.p, s.q).integers())) integer(x.get_mpz_t());
    text_ += " 1";
    end(s.mark);
  }

  void plane(PlaneId plane, bool through_origin) {
    text_ += " |";
    for (std::size_t i = 0; i < 3; ++i) integer(c_.planes.oriented_coefficient(plane, i).get_mpz_t());
    integer(through_origin ? Integer(0).get_mpz_t() : c_.planes.oriented_coefficient(plane, 3).get_mpz_t());
  }

  void halffacet(HalffacetId h) {
    const Facet& facet = c_.facets[facet_of(h)];
    const bool above = !is_below(h);
    begin(h.index());
    number(opposite(h).index());
    text_ += ',';
    for (const CycleId i : facet.cycles()) {
      const SHalfedgeId corner = c_.corners_of(i)[0];
      number((above ? twin_of(corner) : corner).index());
    }
    text_ += " ,";
    for (const VertexId v : c_.isolated_vertices_of(facet)) {
      const VertexRecord& record = c_.vertices[v];
      // As for shalfedges: the sloop on the opposite plane.
      const bool flipped = c_.sloops[record.sloops].plane.flipped();
      number(record.sloops + (flipped == above ? 0U : 1U));
    }
    text_ += " ,";
    number(c_.halffacet_volume(h).index());
    plane(above ? facet.plane : facet.plane.opposite(), false);
    end(facet.mark);
  }

  void volume(VolumeId v) {
    const Volume& volume = c_.volumes[v];
    begin(v.index());
    for (const ShellId s : volume.shells()) number(first_sface_[s].index());
    end(volume.mark);
  }

  void shalfedge(SHalfedgeId e) {
    const VertexRecord& record = c_.vertices[c_.shalfedge_vertex(e)];
    const SHalfedge& s = c_.shalfedge(e);
    begin(e.index());
    const auto item = [this](std::uint32_t value) {
      number(value);
      text_ += ',';
    };
    item(twin_of(e).index());
    item((record.shalfedges + s.prev).index());
    item((record.shalfedges + s.next).index());
    item((record.svertices + s.source).index());
    item((record.sfaces + s.sface).index());
    item(prev_[e].index());
    item(next_[e].index());
    number(opposite(c_.shalfedge_facet[e]).index());
    plane(s.plane, true);
    end(s.mark);
  }

  void sloop(std::uint32_t l) {
    // Sloops come in pairs, one pair for a vertex; both belong to the vertex of the sface of either.
    const SLoop& loop = c_.sloops[l];
    begin(l);
    number(l ^ 1U);
    text_ += ',';
    number((c_.vertices[loop_owner(l)].sfaces + loop.sface).index());
    text_ += ',';
    number(opposite(c_.sloop_facet[l]).index());
    plane(loop.plane, true);
    end(loop.mark);
  }

  // Vertices are visited in order, and so are their sloops.
  VertexId loop_owner(std::uint32_t loop) {
    while (c_.vertices[loop_vertex_.next()].sloops <= loop) ++loop_vertex_;
    return loop_vertex_;
  }

  void sfaces(VertexId v) {
    const SphereMapView map = c_.sphere_map(v);
    const VertexRecord& record = c_.vertices[v];
    for (std::uint32_t i = 0; i < map.sfaces.size(); ++i) {
      const SFace& face = map.sfaces[i];
      begin((record.sfaces + i).index());
      number(v.index());
      const auto list = [&](SFaceEntry::Kind kind, std::uint32_t first) {
        text_ += ',';
        for (const SFaceEntry& entry : map.entries.subspan(face.entries, face.entry_count)) {
          if (entry.kind == kind) number(first + entry.index);
        }
        text_ += ' ';
      };
      list(SFaceEntry::Kind::kCycle, record.shalfedges.index());
      list(SFaceEntry::Kind::kIsolatedVertex, record.svertices.index());
      list(SFaceEntry::Kind::kLoop, record.sloops);
      text_ += ',';
      number(c_.sface_volume(record.sfaces + i).index());
      end(face.mark);
    }
  }

  const Complex& c_;
  std::string text_;
  IndexedVector<SHalfedgeId, SHalfedgeId> next_;  // along a facet's boundary, as CGAL has it
  IndexedVector<SHalfedgeId, SHalfedgeId> prev_;
  IndexedVector<ShellId, SFaceId> first_sface_;
  VertexId loop_vertex_{0};
  bool other_marks_ = false;
};

}  // namespace

std::string nef3_text(const Polyhedron& polyhedron, Messages* messages) {
  if (polyhedron.complex().has_box()) {
    throw UnsupportedError("the set is unbounded, which .nef3 of a standard kernel cannot store; write .nef instead");
  }
  Nef3Writer writer(polyhedron.complex());
  std::string text = writer.run();
  if (writer.met_other_marks() && messages != nullptr) {
    messages->push_back("marks other than 0 and 1 were written as 1; .nef keeps them");
  }
  return text;
}

}  // namespace nef
