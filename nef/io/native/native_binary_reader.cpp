// SPDX-License-Identifier: Apache-2.0
//
// The checksum tells damage. All that reading and using a complex rely on to stay inside its arrays, and to come to an
// end, is checked nevertheless, in one pass over each array: ranges, permutations, and links that must be mutual.
#include "nef/complex/owners.h"
#include "nef/complex/patterns/pattern_interner.h"
#include "nef/io/native/binary_file.h"
#include "nef/io/native/complete_sphere_map.h"
#include "nef/io/native/native_binary.h"
#include "nef/io/native/vertex_keys.h"
#include "nef/polyhedron.h"
#include "nef/synthesis/volume_linking.h"
#include "nef/validation/validate.h"

namespace nef {
namespace {

class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, const std::string& path, const Monitor& monitor)
      : file_(bytes, path), monitor_(monitor) {}

  Polyhedron run(NativeContents contents) {
    planes();
    points();
    if (file_.width() == 1) sphere_maps<std::uint8_t>();
    if (file_.width() == 2) sphere_maps<std::uint16_t>();
    if (file_.width() == 4) sphere_maps<std::uint32_t>();
    edges();
    facets();
    isolated_vertices();
    volumes();
    file_.demand(file_.at_end(), "there is more after its end");
    if (contents == NativeContents::kSet) {
      if (const auto defect = detail::defect_in([this] { detail::check_box(c_); })) file_.corrupt(defect->text());
    }
    return Polyhedron(std::move(c_));
  }

 private:
  void planes() {
    c_.planes.reserve(n_.planes);
    const auto put = [this](std::size_t row, int lead, PlaneId plane) {
      file_.demand(lead > 0, "a plane has no normal, or one of the wrong sign");
      file_.demand(plane == PlaneId::of_row(static_cast<std::uint32_t>(row)), "a plane occurs twice");
    };
    const auto lead = [](int a, int b, int c) { return a != 0 ? a : b != 0 ? b : c; };
    file_.numbers<5>(
        n_.planes,
        [&](std::size_t row, const std::array<Int128, 5>& n) {
          const int first = lead(sign_of(n[0]), sign_of(n[1]), sign_of(n[2]));
          put(row, first, first > 0 ? c_.planes.intern_primitive(n) : PlaneId());
        },
        [&](std::size_t row, const std::array<mpz_t, 5>& n) {
          const int first = lead(mpz_sgn(n[0]), mpz_sgn(n[1]), mpz_sgn(n[2]));
          const auto intern = [&] {
            return mpz_sgn(n[4]) == 0
                       ? c_.planes.intern_primitive({n[0], n[1], n[2], n[3]})
                       : c_.planes.intern(Integer(n[0]), Integer(n[1]), Integer(n[2]), Integer(n[3]), Integer(n[4]));
          };
          put(row, first, first > 0 ? intern() : PlaneId());
        });
  }

  void points() {
    c_.points.reserve(n_.vertices);
    std::array<Integer, 7> h;
    constexpr const char* kNotPositive = "the denominator of a point is not positive";
    file_.numbers<7>(
        n_.vertices,
        [&](std::size_t, const std::array<Int128, 7>& n) {
          file_.demand(n[3] > 0, kNotPositive);
          c_.points.push_homogeneous(n);
        },
        [&](std::size_t, const std::array<mpz_t, 7>& n) {
          for (std::size_t i = 0; i < 7; ++i) mpz_set(h[i].get_mpz_t(), n[i]);
          file_.demand(h[3] > 0, kNotPositive);
          c_.points.push_homogeneous(h);
        });
  }

  PlaneId plane(std::uint32_t value) const {
    file_.demand(value / 2 < n_.planes, "a plane does not exist");
    return PlaneId{value};
  }

  // The marks in use give label_count.
  LabelId mark(LabelId value) {
    if (value != kOutside && value >= c_.label_count) c_.label_count = static_cast<LabelId>(value + 1);
    return value;
  }

  template <typename W>
  static std::uint32_t local(W value) {
    return value == static_cast<W>(-1) ? kNone : value;
  }

  template <typename W>
  void vertex_records() {
    const auto svertices = file_.column<W>(n_.vertices);
    const auto pairs = file_.column<W>(n_.vertices);
    const auto loop_pairs = file_.column<W>(n_.vertices);
    const auto sfaces = file_.column<W>(n_.vertices);
    const auto marks = file_.column<LabelId>(n_.vertices);
    c_.vertices.reserve(n_.vertices + 1);
    VertexRecord end;
    std::uint64_t total = 0;
    for (std::uint32_t v = 0; v < n_.vertices; ++v) {
      mark_.push_back(mark(marks[v]));
      end.svertices += svertices[v];
      end.shalfedges += 2 * pairs[v];
      end.sloops += 2 * loop_pairs[v];
      end.sfaces += sfaces[v];
      c_.vertices.add(PatternId(), end);
      total += std::uint64_t{svertices[v]} + 2 * std::uint64_t{pairs[v]} + 2 * std::uint64_t{loop_pairs[v]} + sfaces[v];
      // Sums that wrap around would not be what the whole file has.
      file_.demand(total <= std::uint64_t{4} * file_.size() && sfaces[v] > 0,
                   "its vertices have more items than there are");
    }
    file_.demand(end.svertices.index() == n_.svertices && end.shalfedges.index() == n_.shalfedges &&
                     end.sloops == n_.sloops && end.sfaces.index() == n_.sfaces &&
                     total == std::uint64_t{n_.svertices} + n_.shalfedges + n_.sloops + n_.sfaces,
                 "its vertices do not have the items that it contains");
    name_svertex_owners(c_);
    name_pair_owners(c_);
  }

  template <typename W>
  void sphere_maps() {
    vertex_records<W>();
    // In this order, in which they lie in the file.
    const ItemColumns<W> columns{file_.column<std::uint32_t>(n_.svertices),
                                 file_.column<std::uint32_t>(n_.svertices),
                                 file_.column<W>(n_.svertices),
                                 file_.column<W>(n_.svertices),
                                 file_.column<LabelId>(n_.svertices),
                                 file_.column<std::uint32_t>(n_.shalfedges / 2),
                                 file_.column<LabelId>(n_.shalfedges / 2),
                                 file_.column<W>(n_.shalfedges),
                                 file_.column<W>(n_.shalfedges),
                                 file_.column<W>(n_.shalfedges),
                                 file_.column<std::uint32_t>(n_.sloops / 2),
                                 file_.column<LabelId>(n_.sloops / 2),
                                 file_.column<W>(n_.sloops),
                                 file_.column<W>(n_.sfaces),
                                 file_.column<LabelId>(n_.sfaces),
                                 file_.column<std::uint8_t>(n_.entries),
                                 file_.column<W>(n_.entries)};
    c_.shalfedge_plane.pairs().reserve(n_.shalfedges / 2);
    c_.sloops.reserve(n_.sloops);
    PatternInterner interner;
    std::uint64_t entries = 0;  // of the vertices so far
    for (const VertexId v : c_.vertex_ids()) {
      const VertexRecord record = c_.vertices[v];
      const VertexRecord end = c_.vertices[v.next()];
      const bool has_key = keys_.read(columns, record, end, mark_[v.index()], entries, n_.entries);
      if (has_key && take_known(columns, v, entries)) continue;
      map_.clear();
      map_.mark = mark_[v.index()];
      for (const HalfedgeId h : c_.halfedges(v)) take_svertex(columns, h.index());
      for (const SHalfedgeId e : c_.shalfedges(v)) take_shalfedge(columns, e.index());
      for (std::uint32_t i = record.sloops; i < end.sloops; ++i) take_sloop(columns, i);
      for (const SFaceId f : c_.sfaces(v)) take_sface(columns, f.index(), entries);
      if (const char* fault = complete_sphere_map(map_)) file_.corrupt(fault);
      const PatternId pattern = interner.intern(c_.patterns, map_.view(), c_.shalfedge_plane.pairs(), c_.other_planes);
      name_pattern(v, pattern);
      c_.sloops.insert(c_.sloops.end(), map_.sloops.begin(), map_.sloops.end());
      if (has_key) keys_.learn(pattern);
    }
    file_.demand(entries == n_.entries, "its sfaces have fewer entries than there are");
  }

  void name_pattern(VertexId v, PatternId pattern) {
    c_.vertices.set_pattern(v, pattern);
    c_.vertices.set_other_planes(v.next(), static_cast<std::uint32_t>(c_.other_planes.size()));
  }

  // The vertex whose key was read, if one like it has been read before.
  template <typename W>
  bool take_known(const ItemColumns<W>& columns, VertexId v, std::uint64_t& entries) {
    const PatternId pattern = keys_.known();
    if (!pattern.valid()) return false;
    const VertexRecord record = c_.vertices[v];
    const VertexRecord end = c_.vertices[v.next()];
    name_pattern(v, pattern);
    for (std::uint32_t i = pair_of(record.shalfedges); i < pair_of(end.shalfedges); ++i) {
      c_.shalfedge_plane.pairs().push_back(plane(columns.plane[i]));
    }
    entries += columns.entries_of(record, end);
    return true;
  }

  template <typename W>
  void take_svertex(const ItemColumns<W>& columns, std::uint32_t i) {
    const PlaneId p = plane(columns.p[i]);
    const PlaneId q = plane(columns.q[i]);
    file_.demand(p.row() != q.row(), "an svertex has one plane twice");
    map_.svertices.push_back(
        {p, q, local(columns.out[i]), local(columns.sface_around[i]), mark(columns.svertex_mark[i])});
  }

  template <typename W>
  void take_shalfedge(const ItemColumns<W>& columns, std::uint32_t i) {
    const PlaneId even = plane(columns.plane[i / 2]);
    map_.shalfedges.push_back({i % 2 == 0 ? even : even.opposite(), columns.source[i], columns.next[i], kNone,
                               columns.sface[i], mark(columns.shalfedge_mark[i / 2])});
  }

  template <typename W>
  void take_sloop(const ItemColumns<W>& columns, std::uint32_t i) {
    const PlaneId even = plane(columns.sloop_plane[i / 2]);
    map_.sloops.push_back(
        {i % 2 == 0 ? even : even.opposite(), columns.sloop_sface[i], mark(columns.sloop_mark[i / 2])});
  }

  // With its entries, which follow the first `entries` ones.
  template <typename W>
  void take_sface(const ItemColumns<W>& columns, std::uint32_t f, std::uint64_t& entries) {
    const std::uint32_t count = columns.entry_count[f];
    map_.sfaces.push_back({static_cast<std::uint32_t>(map_.entries.size()), count, mark(columns.sface_mark[f])});
    file_.demand(count <= n_.entries - entries, "its sfaces have more entries than there are");
    for (const std::uint64_t last = entries + count; entries < last; ++entries) {
      file_.demand(columns.kind[entries] <= 2, "an entry is of no kind");
      map_.entries.push_back({static_cast<SFaceEntry::Kind>(columns.kind[entries]), columns.index[entries]});
    }
  }

  // Edges of no facet are rare.
  [[nodiscard]] bool any_isolated_svertex() const {
    for (std::uint32_t i = 0; i < c_.patterns.size(); ++i) {
      for (const SVertex& s : c_.patterns.svertices(PatternId{i})) {
        if (s.out == kNone) return true;
      }
    }
    return false;
  }

  void edges() {
    const auto twins = file_.column<std::uint32_t>(n_.svertices);
    const bool has_bare_edges = any_isolated_svertex();
    c_.twin.resize(n_.svertices);
    for (const HalfedgeId h : c_.halfedge_ids()) {
      const HalfedgeId t{twins[h.index()]};
      file_.demand(c_.twin.contains(t) && t != h && twins[t.index()] == h.index(),
                   "the two ends of an edge are not mutual");
      file_.demand(!has_bare_edges || (c_.svertex(h).out == kNone) == (c_.svertex(t).out == kNone),
                   "an edge has facets at one end only");
      c_.twin[h] = t;
    }
  }

  void facets() {
    const auto lengths = file_.column<std::uint32_t>(n_.cycles);
    const auto corners = file_.column<std::uint32_t>(n_.shalfedges / 2);
    const auto cycle_counts = file_.column<std::uint32_t>(n_.facets);
    isolated_counts_ = file_.column<std::uint32_t>(n_.facets);
    c_.cycle_begin.resize(n_.cycles + 1);
    for (const CycleId i : c_.cycle_ids()) {
      const std::uint32_t length = lengths[i.index()];
      file_.demand(length > 0 && length <= n_.shalfedges / 2 - c_.cycle_begin[i], "a cycle is empty or too long");
      c_.cycle_begin[i.next()] = c_.cycle_begin[i] + length;
    }
    file_.demand(c_.cycle_begin.back() == n_.shalfedges / 2, "some corners are in no cycle");
    c_.corners.resize(n_.shalfedges / 2);
    for (std::uint32_t i = 0; i < c_.corners.size(); ++i) {
      c_.corners[i] = SHalfedgeId{corners[i]};
      file_.demand(corners[i] < n_.shalfedges, "a corner does not exist");
    }
    c_.shalfedge_facet.assign(n_.shalfedges, HalffacetId());
    c_.facets.reserve(n_.facets);
    std::uint32_t first = 0;
    std::uint32_t isolated = 0;
    for (std::uint32_t f = 0; f < n_.facets; ++f) {
      file_.demand(cycle_counts[f] > 0 && cycle_counts[f] <= n_.cycles - first, "a facet has no cycle");
      file_.demand(isolated_counts_[f] <= n_.isolated - isolated, "a facet has more isolated vertices than there are");
      Facet facet;
      facet.first_cycle = CycleId{first};
      facet.cycle_count = cycle_counts[f];
      facet.first_isolated = isolated;
      facet.isolated_count = isolated_counts_[f];
      const SHalfedge corner = c_.shalfedge(c_.corners_of(facet.first_cycle).front());
      facet.plane = corner.plane;
      facet.mark = corner.mark;
      file_.demand(!facet.plane.flipped(), "a facet is seen from the wrong side");
      c_.facets.push_back(facet);
      for (const CycleId k : facet.cycles()) check_cycle(FacetId{f}, facet, c_.corners_of(k));
      first += facet.cycle_count;
      isolated += facet.isolated_count;
    }
    file_.demand(first == n_.cycles && isolated == n_.isolated, "some cycles or isolated vertices belong to no facet");
  }

  void check_cycle(FacetId f, const Facet& facet, std::span<const SHalfedgeId> cycle) {
    HalfedgeId arriving = c_.twin[c_.corner_halfedge(cycle.back())];
    for (const SHalfedgeId corner : cycle) {
      const SHalfedge e = c_.shalfedge(corner);
      file_.demand(!c_.shalfedge_facet.pairs()[pair_of(corner)].valid(), "a corner belongs to two facets");
      file_.demand(e.plane == facet.plane && e.mark == facet.mark, "a corner belongs to another facet");
      file_.demand(c_.corner_back_halfedge(corner) == arriving, "a cycle leaves its edges");
      arriving = c_.twin[c_.corner_halfedge(corner)];
      c_.shalfedge_facet.set(corner, halffacet_of(f, false));
    }
  }

  void isolated_vertices() {
    const auto vertices = file_.column<std::uint32_t>(n_.isolated);
    c_.isolated_vertices.resize(n_.isolated);
    c_.sloop_facet.assign(n_.sloops, HalffacetId());
    file_.demand(n_.isolated == n_.sloops / 2, "the vertices inside facets are not those with sloops");
    for (const FacetId f : c_.facets.ids()) {
      const Facet& facet = c_.facets[f];
      for (std::uint32_t i = facet.first_isolated; i < facet.first_isolated + facet.isolated_count; ++i) {
        const VertexId v{vertices[i]};
        file_.demand(v.index() < n_.vertices && c_.vertices[v.next()].sloops == c_.vertices[v].sloops + 2,
                     "a vertex inside a facet has no sloop");
        for (std::uint32_t l = c_.vertices[v].sloops; l < c_.vertices[v.next()].sloops; ++l) {
          const SLoop& loop = c_.sloops[l];
          file_.demand(!c_.sloop_facet[l].valid() && loop.plane.row() == facet.plane.row() && loop.mark == facet.mark,
                       "a vertex belongs to another facet");
          c_.sloop_facet[l] = halffacet_of(f, loop.plane.flipped());
        }
        c_.isolated_vertices[i] = v;
      }
    }
  }

  void volumes() {
    const auto shell_of = file_.column<std::uint32_t>(n_.sfaces);
    const auto volume_of = file_.column<std::uint32_t>(n_.shells);
    const auto marks = file_.column<LabelId>(n_.volumes);
    file_.demand(n_.volumes > 0, "there is no outer volume");
    c_.volumes.resize(n_.volumes);
    for (std::uint32_t i = 0; i < n_.volumes; ++i) {
      c_.volumes[VolumeId{i}].mark = mark(marks[i]);
      file_.demand(i == 0 || marks[i] != kOutside, "only the outer volume is outside");
    }
    c_.shells.resize(n_.shells);
    for (std::uint32_t s = 0; s < n_.shells; ++s) {
      const std::uint32_t volume = volume_of[s];
      file_.demand(volume < n_.volumes && (s == 0 || volume == volume_of[s - 1] || volume == volume_of[s - 1] + 1),
                   "shells of volumes do not follow each other");
      c_.shells[ShellId{s}].volume = VolumeId{volume};
      Volume& owner = c_.volumes[VolumeId{volume}];
      if (owner.shell_count++ == 0) owner.first_shell = ShellId{s};
    }
    file_.demand(n_.shells == 0 ? n_.volumes == 1 : volume_of[0] == 0 && volume_of[n_.shells - 1] + 1 == n_.volumes,
                 "a volume has no boundary");
    fill_shells(shell_of);
    name_sides_of_facets(c_, monitor_);
    for (std::uint32_t i = 0; i < c_.patterns.size(); ++i) {
      const SphereMapView map = c_.patterns.view(PatternId{i});
      file_.demand(map.mark != kOutside, "only the outer volume is outside");
      for (const SVertex& s : map.svertices) file_.demand(s.mark != kOutside, "only the outer volume is outside");
    }
    for (const Facet& f : c_.facets) file_.demand(f.mark != kOutside, "only the outer volume is outside");
  }

  void fill_shells(const Column<std::uint32_t>& shell_of) {
    c_.sface_shell.resize(n_.sfaces);
    std::vector<bool> used(n_.shells, false);
    SFaceId f{0};
    for (const VertexId v : c_.vertex_ids()) {
      for (const SFace& face : c_.sphere_map(v).sfaces) {
        const ShellId s{shell_of[f.index()]};
        file_.demand(c_.shells.contains(s), "a shell does not exist");
        file_.demand(c_.volumes[c_.shells[s].volume].mark == face.mark, "a volume has two marks");
        used[s.index()] = true;
        c_.sface_shell[f] = s;
        ++f;
      }
    }
    file_.demand(std::find(used.begin(), used.end(), false) == used.end(), "a shell is empty");
  }

  BinaryFile file_;
  Monitor monitor_;
  const BinaryFile::Counts n_ = file_.counts();
  std::vector<LabelId> mark_;  // of vertices
  VertexKeys keys_;
  SphereMapBuffer map_;  // of the vertex at hand
  Column<std::uint32_t> isolated_counts_{nullptr};
  Complex c_;
};

}  // namespace

bool is_native_binary(std::string_view bytes) { return bytes.starts_with(kNativeMagic); }

Polyhedron read_native_binary(std::string_view bytes, const std::string& path, NativeContents contents,
                              const Monitor& monitor) {
  return BinaryReader(bytes, path, monitor).run(contents);
}

}  // namespace nef
