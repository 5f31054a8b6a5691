// SPDX-License-Identifier: Apache-2.0
//
// The checksum tells damage. All that reading and using a complex rely on to stay inside its arrays, and to come to an
// end, is checked nevertheless, in one pass over each array: ranges, permutations, and links that must be mutual.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstring>

#include "nef/complex/owners.h"
#include "nef/complex/patterns/pattern_interner.h"
#include "nef/io/file_bytes.h"
#include "nef/io/native/complete_sphere_map.h"
#include "nef/io/native/native_binary.h"
#include "nef/io/native/vertex_keys.h"
#include "nef/synthesis/volume_linking.h"
#include "nef/validation/validate.h"

namespace nef {
namespace {

class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {}

  Polyhedron run(NativeContents contents) {
    const std::uint32_t width = header();
    planes();
    points();
    if (width == 1) sphere_maps<std::uint8_t>();
    if (width == 2) sphere_maps<std::uint16_t>();
    if (width == 4) sphere_maps<std::uint32_t>();
    edges();
    facets();
    isolated_vertices();
    volumes();
    demand(at_ == bytes_.size(), "there is more after its end");
    if (contents == NativeContents::kSet) {
      if (const auto defect = detail::defect_in([this] { detail::check_box(c_); })) corrupt(defect->text());
    }
    return Polyhedron(std::move(c_));
  }

 private:
  [[noreturn]] void corrupt(const std::string& what) const {
    throw FileError(FileProblem::kSyntax, path_ + ": the file is no valid polyhedron: " + what);
  }
  void demand(bool holds, const char* what) const {
    if (!holds) corrupt(what);
  }

  template <typename T>
  Column<T> column(std::size_t count) {
    demand(count <= (bytes_.size() - at_) / sizeof(T), "its numbers of items do not fit its length");
    const char* data = bytes_.data() + at_;
    at_ += count * sizeof(T);
    return Column<T>(data);
  }

  std::uint32_t header() {
    const std::size_t least = kNativeMagic.size() + 14 * sizeof(std::uint32_t) + sizeof(std::uint64_t);
    if (bytes_.size() < least) {
      throw FileError(FileProblem::kTruncated, path_ + ": the file ends early; it is cut off");
    }
    at_ = kNativeMagic.size();
    const auto version = column<std::uint32_t>(1)[0];
    if (version != kNativeBinaryVersion) {
      throw FileError(FileProblem::kUnsupported, path_ + ": the file has version " + std::to_string(version) +
                                                     " of the binary form; this program reads version 1");
    }
    const std::size_t end = bytes_.size() - sizeof(std::uint64_t);
    std::uint64_t checksum = 0;
    std::memcpy(&checksum, bytes_.data() + end, sizeof(checksum));
    if (checksum != XXH3_64bits(bytes_.data(), end)) {
      throw FileError(FileProblem::kSyntax,
                      path_ + ": the file is damaged or cut off: its checksum is not that of its bytes");
    }
    bytes_ = bytes_.substr(0, end);
    const auto width = column<std::uint32_t>(1)[0];
    demand(width == 1 || width == 2 || width == 4, "an index has neither 1, 2 nor 4 bytes");
    const auto counts = column<std::uint32_t>(12);
    std::size_t i = 0;
    for (std::uint32_t* count : {&planes_, &vertices_, &svertices_, &shalfedges_, &sloops_, &sfaces_, &entries_,
                                 &facets_, &cycles_, &isolated_, &shells_, &volumes_}) {
      *count = counts[i++];
      // Every item takes a byte at least, so that nothing larger than the file is ever made.
      demand(*count <= bytes_.size(), "its numbers of items do not fit its length");
    }
    return width;
  }

  // One row of numbers after the other: those of up to two words below 2^127 as such, others as views.
  template <std::size_t kWidth, typename TakeShort, typename TakeLong>
  void numbers(std::size_t rows, TakeShort&& take_short, TakeLong&& take_long) {
    constexpr std::size_t width = kWidth;
    const auto sizes = column<std::int32_t>(width * rows);
    const std::uint64_t limbs = column<std::uint64_t>(1)[0];
    const auto limb = column<mp_limb_t>(limbs);
    std::vector<mp_limb_t> row_limbs;
    std::array<mpz_t, kWidth> values;
    std::array<Int128, kWidth> words{};
    std::array<std::int32_t, kWidth> size{};
    std::uint64_t next = 0;
    for (std::size_t row = 0; row < rows; ++row) {
      std::uint64_t total = 0;
      bool is_short = true;
      for (std::size_t i = 0; i < width; ++i) {
        size[i] = sizes[row * width + i];
        demand(size[i] > -0x40000000 && size[i] < 0x40000000, "a number is too long");
        total += static_cast<std::uint64_t>(size[i] < 0 ? -size[i] : size[i]);
        is_short = is_short && size[i] >= -2 && size[i] <= 2;
      }
      demand(total <= limbs - next, "its numbers are longer than it says");
      if (is_short) {
        std::uint64_t at = next;
        for (std::size_t i = 0; i < width; ++i) {
          const std::int32_t length = size[i] < 0 ? -size[i] : size[i];
          const mp_limb_t low = length > 0 ? limb[at] : 0;
          const mp_limb_t high = length > 1 ? limb[at + 1] : 0;
          at += static_cast<std::uint64_t>(length);
          demand(length == 0 || (length == 1 ? low : high) != 0, "a number begins with zeros");
          is_short = is_short && high >> 63U == 0;
          const auto absolute = static_cast<Int128>(static_cast<Unsigned128>(high) << 64U | low);
          words[i] = size[i] < 0 ? -absolute : absolute;
        }
        if (is_short) {
          next = at;
          take_short(row, words);
          continue;
        }
      }
      row_limbs.resize(total);
      for (std::uint64_t i = 0; i < total; ++i) row_limbs[i] = limb[next + i];
      next += total;
      const mp_limb_t* at = row_limbs.data();
      for (std::size_t i = 0; i < width; ++i) {
        const std::int32_t length = size[i] < 0 ? -size[i] : size[i];
        demand(length == 0 || at[length - 1] != 0, "a number begins with zeros");
        mpz_roinit_n(values[i], at, size[i]);
        at += length;
      }
      take_long(row, values);
    }
    demand(next == limbs, "its numbers are shorter than it says");
  }

  void planes() {
    c_.planes.reserve(planes_);
    const auto put = [this](std::size_t row, int lead, PlaneId plane) {
      demand(lead > 0, "a plane has no normal, or one of the wrong sign");
      demand(plane == PlaneId{static_cast<std::uint32_t>(2 * row)}, "a plane occurs twice");
    };
    const auto lead = [](int a, int b, int c) { return a != 0 ? a : b != 0 ? b : c; };
    const auto sign = [](Int128 value) { return (value > 0) - (value < 0); };
    numbers<5>(
        planes_,
        [&](std::size_t row, const std::array<Int128, 5>& n) {
          const int first = lead(sign(n[0]), sign(n[1]), sign(n[2]));
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
    c_.points.reserve(vertices_);
    std::array<Integer, 7> h;
    constexpr const char* kNotPositive = "the denominator of a point is not positive";
    numbers<7>(
        vertices_,
        [&](std::size_t, const std::array<Int128, 7>& n) {
          demand(n[3] > 0, kNotPositive);
          c_.points.push_homogeneous(n);
        },
        [&](std::size_t, const std::array<mpz_t, 7>& n) {
          for (std::size_t i = 0; i < 7; ++i) mpz_set(h[i].get_mpz_t(), n[i]);
          demand(h[3] > 0, kNotPositive);
          c_.points.push_homogeneous(h);
        });
  }

  PlaneId plane(std::uint32_t value) const {
    demand(value / 2 < planes_, "a plane does not exist");
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
    const auto svertices = column<W>(vertices_);
    const auto pairs = column<W>(vertices_);
    const auto loop_pairs = column<W>(vertices_);
    const auto sfaces = column<W>(vertices_);
    const auto marks = column<LabelId>(vertices_);
    c_.vertices.assign(vertices_ + 1, {});
    std::uint64_t total = 0;
    for (std::uint32_t v = 0; v < vertices_; ++v) {
      const VertexRecord& record = c_.vertices[VertexId{v}];
      mark_.push_back(mark(marks[v]));
      VertexRecord& end = c_.vertices[VertexId{v + 1}];
      end.svertices = record.svertices + svertices[v];
      end.shalfedges = record.shalfedges + 2 * pairs[v];
      end.sloops = record.sloops + 2 * loop_pairs[v];
      end.sfaces = record.sfaces + sfaces[v];
      total += std::uint64_t{svertices[v]} + 2 * std::uint64_t{pairs[v]} + 2 * std::uint64_t{loop_pairs[v]} + sfaces[v];
      // Sums that wrap around would not be what the whole file has.
      demand(total <= std::uint64_t{4} * bytes_.size() && sfaces[v] > 0, "its vertices have more items than there are");
    }
    const VertexRecord& last = c_.vertices.back();
    demand(last.svertices.index() == svertices_ && last.shalfedges == shalfedges_ && last.sloops == sloops_ &&
               last.sfaces.index() == sfaces_ && total == std::uint64_t{svertices_} + shalfedges_ + sloops_ + sfaces_,
           "its vertices have not the items that it holds");
    name_svertex_owners(c_);
    name_pair_owners(c_);
  }

  template <typename W>
  void sphere_maps() {
    vertex_records<W>();
    // In this order, in which they lie in the file.
    const ItemColumns<W> columns{column<std::uint32_t>(svertices_),
                                 column<std::uint32_t>(svertices_),
                                 column<W>(svertices_),
                                 column<W>(svertices_),
                                 column<LabelId>(svertices_),
                                 column<std::uint32_t>(shalfedges_ / 2),
                                 column<LabelId>(shalfedges_ / 2),
                                 column<W>(shalfedges_),
                                 column<W>(shalfedges_),
                                 column<W>(shalfedges_),
                                 column<std::uint32_t>(sloops_ / 2),
                                 column<LabelId>(sloops_ / 2),
                                 column<W>(sloops_),
                                 column<W>(sfaces_),
                                 column<LabelId>(sfaces_),
                                 column<std::uint8_t>(entries_),
                                 column<W>(entries_)};
    c_.shalfedge_plane.pairs().reserve(shalfedges_ / 2);
    c_.sloops.reserve(sloops_);
    PatternInterner interner;
    std::uint64_t entries = 0;  // of the vertices so far
    for (const VertexId v : c_.vertex_ids()) {
      VertexRecord& record = c_.vertices[v];
      VertexRecord& end = c_.vertices[v.next()];
      const bool has_key = keys_.read(columns, record, end, mark_[v.index()], entries, entries_);
      if (has_key && take_known(columns, v, entries)) continue;
      map_.clear();
      map_.mark = mark_[v.index()];
      for (const HalfedgeId h : c_.halfedges(v)) take_svertex(columns, h.index());
      for (std::uint32_t i = record.shalfedges; i < end.shalfedges; ++i) take_shalfedge(columns, i);
      for (std::uint32_t i = record.sloops; i < end.sloops; ++i) take_sloop(columns, i);
      for (const SFaceId f : c_.sfaces(v)) take_sface(columns, f.index(), entries);
      if (const char* fault = complete_sphere_map(map_)) corrupt(fault);
      record.pattern = interner.intern(c_.patterns, map_.view(), c_.shalfedge_plane.pairs(), c_.other_planes);
      end.other_planes = static_cast<std::uint32_t>(c_.other_planes.size());
      c_.sloops.insert(c_.sloops.end(), map_.sloops.begin(), map_.sloops.end());
      if (has_key) keys_.learn(record.pattern);
    }
    demand(entries == entries_, "its sfaces have fewer entries than there are");
  }

  // The vertex whose key was read, if one like it has been read before.
  template <typename W>
  bool take_known(const ItemColumns<W>& columns, VertexId v, std::uint64_t& entries) {
    const PatternId pattern = keys_.known();
    if (!pattern.valid()) return false;
    VertexRecord& record = c_.vertices[v];
    VertexRecord& end = c_.vertices[v.next()];
    record.pattern = pattern;
    end.other_planes = record.other_planes;
    for (std::uint32_t i = record.shalfedges / 2; i < end.shalfedges / 2; ++i) {
      c_.shalfedge_plane.pairs().push_back(plane(columns.plane[i]));
    }
    entries += columns.entries_of(record, end);
    return true;
  }

  template <typename W>
  void take_svertex(const ItemColumns<W>& columns, std::uint32_t i) {
    const PlaneId p = plane(columns.p[i]);
    const PlaneId q = plane(columns.q[i]);
    demand(p.row() != q.row(), "an svertex has one plane twice");
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
    demand(count <= entries_ - entries, "its sfaces have more entries than there are");
    for (const std::uint64_t last = entries + count; entries < last; ++entries) {
      demand(columns.kind[entries] <= 2, "an entry is of no kind");
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
    const auto twins = column<std::uint32_t>(svertices_);
    const bool has_bare_edges = any_isolated_svertex();
    c_.twin.resize(svertices_);
    for (const HalfedgeId h : c_.halfedge_ids()) {
      const HalfedgeId t{twins[h.index()]};
      demand(c_.twin.contains(t) && t != h && twins[t.index()] == h.index(), "the two ends of an edge are not mutual");
      demand(!has_bare_edges || (c_.svertex(h).out == kNone) == (c_.svertex(t).out == kNone),
             "an edge has facets at one end only");
      c_.twin[h] = t;
    }
  }

  void facets() {
    const auto lengths = column<std::uint32_t>(cycles_);
    const auto corners = column<std::uint32_t>(shalfedges_ / 2);
    const auto cycle_counts = column<std::uint32_t>(facets_);
    isolated_counts_ = column<std::uint32_t>(facets_);
    c_.cycle_begin.resize(cycles_ + 1);
    for (const CycleId i : c_.cycle_ids()) {
      const std::uint32_t length = lengths[i.index()];
      demand(length > 0 && length <= shalfedges_ / 2 - c_.cycle_begin[i], "a cycle is empty or too long");
      c_.cycle_begin[i.next()] = c_.cycle_begin[i] + length;
    }
    demand(c_.cycle_begin.back() == shalfedges_ / 2, "some corners are in no cycle");
    c_.corners.resize(shalfedges_ / 2);
    for (std::uint32_t i = 0; i < c_.corners.size(); ++i) {
      c_.corners[i] = corners[i];
      demand(corners[i] < shalfedges_, "a corner does not exist");
    }
    c_.shalfedge_facet.assign(shalfedges_, HalffacetId());
    c_.facets.resize(facets_);
    std::uint32_t first = 0;
    std::uint32_t isolated = 0;
    for (std::uint32_t f = 0; f < facets_; ++f) {
      demand(cycle_counts[f] > 0 && cycle_counts[f] <= cycles_ - first, "a facet has no cycle");
      demand(isolated_counts_[f] <= isolated_ - isolated, "a facet has more isolated vertices than there are");
      Facet& facet = c_.facets[FacetId{f}];
      facet.first_cycle = CycleId{first};
      facet.cycle_count = cycle_counts[f];
      facet.first_isolated = isolated;
      facet.isolated_count = isolated_counts_[f];
      const SHalfedge corner = c_.shalfedge(c_.corners_of(facet.first_cycle).front());
      facet.plane = corner.plane;
      facet.mark = corner.mark;
      demand(!facet.plane.flipped(), "a facet is seen from the wrong side");
      for (const CycleId k : facet.cycles()) check_cycle(FacetId{f}, c_.corners_of(k));
      first += facet.cycle_count;
      isolated += facet.isolated_count;
    }
    demand(first == cycles_ && isolated == isolated_, "some cycles or isolated vertices belong to no facet");
  }

  void check_cycle(FacetId f, std::span<const std::uint32_t> cycle) {
    HalfedgeId arriving = c_.twin[c_.corner_halfedge(cycle.back())];
    for (const std::uint32_t corner : cycle) {
      const SHalfedge e = c_.shalfedge(corner);
      demand(!c_.shalfedge_facet.pairs()[corner / 2].valid(), "a corner belongs to two facets");
      demand(e.plane == c_.facets[f].plane && e.mark == c_.facets[f].mark, "a corner belongs to another facet");
      demand(c_.corner_back_halfedge(corner) == arriving, "a cycle leaves its edges");
      arriving = c_.twin[c_.corner_halfedge(corner)];
      c_.shalfedge_facet.set(corner, halffacet_of(f, false));
    }
  }

  void isolated_vertices() {
    const auto vertices = column<std::uint32_t>(isolated_);
    c_.isolated_vertices.resize(isolated_);
    c_.sloop_facet.assign(sloops_, HalffacetId());
    demand(isolated_ == sloops_ / 2, "the vertices inside facets are not those with sloops");
    for (const FacetId f : c_.facets.ids()) {
      const Facet& facet = c_.facets[f];
      for (std::uint32_t i = facet.first_isolated; i < facet.first_isolated + facet.isolated_count; ++i) {
        const VertexId v{vertices[i]};
        demand(v.index() < vertices_ && c_.vertices[v.next()].sloops == c_.vertices[v].sloops + 2,
               "a vertex inside a facet has no sloop");
        for (std::uint32_t l = c_.vertices[v].sloops; l < c_.vertices[v.next()].sloops; ++l) {
          const SLoop& loop = c_.sloops[l];
          demand(!c_.sloop_facet[l].valid() && loop.plane.row() == facet.plane.row() && loop.mark == facet.mark,
                 "a vertex belongs to another facet");
          c_.sloop_facet[l] = halffacet_of(f, loop.plane.flipped());
        }
        c_.isolated_vertices[i] = v;
      }
    }
  }

  void volumes() {
    const auto shell_of = column<std::uint32_t>(sfaces_);
    const auto volume_of = column<std::uint32_t>(shells_);
    const auto marks = column<LabelId>(volumes_);
    demand(volumes_ > 0, "there is no outer volume");
    c_.volumes.resize(volumes_);
    for (std::uint32_t i = 0; i < volumes_; ++i) {
      c_.volumes[VolumeId{i}].mark = mark(marks[i]);
      demand(i == 0 || marks[i] != kOutside, "only the outer volume is outside");
    }
    c_.shells.resize(shells_);
    for (std::uint32_t s = 0; s < shells_; ++s) {
      const std::uint32_t volume = volume_of[s];
      demand(volume < volumes_ && (s == 0 || volume == volume_of[s - 1] || volume == volume_of[s - 1] + 1),
             "shells of volumes do not follow each other");
      c_.shells[ShellId{s}].volume = VolumeId{volume};
      Volume& owner = c_.volumes[VolumeId{volume}];
      if (owner.shell_count++ == 0) owner.first_shell = ShellId{s};
    }
    demand(shells_ == 0 ? volumes_ == 1 : volume_of[0] == 0 && volume_of[shells_ - 1] + 1 == volumes_,
           "a volume has no boundary");
    fill_shells(shell_of);
    for (Facet& facet : c_.facets) {
      const std::uint32_t corner = c_.corners_of(facet).front();
      facet.volume_above = c_.sface_volume(c_.shalfedge_sface(corner));
      facet.volume_below = c_.sface_volume(c_.shalfedge_sface(corner ^ 1U));
    }
    for (std::uint32_t i = 0; i < c_.patterns.size(); ++i) {
      const SphereMapView map = c_.patterns.view(PatternId{i});
      demand(map.mark != kOutside, "only the outer volume is outside");
      for (const SVertex& s : map.svertices) demand(s.mark != kOutside, "only the outer volume is outside");
    }
    for (const Facet& f : c_.facets) demand(f.mark != kOutside, "only the outer volume is outside");
  }

  void fill_shells(const Column<std::uint32_t>& shell_of) {
    c_.sface_shell.resize(sfaces_);
    std::vector<bool> used(shells_, false);
    SFaceId f{0};
    for (const VertexId v : c_.vertex_ids()) {
      for (const SFace& face : c_.sphere_map(v).sfaces) {
        const ShellId s{shell_of[f.index()]};
        demand(c_.shells.contains(s), "a shell does not exist");
        demand(c_.volumes[c_.shells[s].volume].mark == face.mark, "a volume has two marks");
        used[s.index()] = true;
        c_.sface_shell[f] = s;
        ++f;
      }
    }
    demand(std::find(used.begin(), used.end(), false) == used.end(), "a shell is empty");
  }

  std::string_view bytes_;
  const std::string& path_;
  std::size_t at_ = 0;
  std::uint32_t planes_ = 0;
  std::uint32_t vertices_ = 0;
  std::uint32_t svertices_ = 0;
  std::uint32_t shalfedges_ = 0;
  std::uint32_t sloops_ = 0;
  std::uint32_t sfaces_ = 0;
  std::uint32_t entries_ = 0;
  std::uint32_t facets_ = 0;
  std::uint32_t cycles_ = 0;
  std::uint32_t isolated_ = 0;
  std::uint32_t shells_ = 0;
  std::uint32_t volumes_ = 0;
  std::vector<LabelId> mark_;  // of vertices
  VertexKeys keys_;
  SphereMapBuffer map_;  // of the vertex at hand
  Column<std::uint32_t> isolated_counts_{nullptr};
  Complex c_;
};

}  // namespace

bool is_native_binary(std::string_view bytes) { return bytes.starts_with(kNativeMagic); }

Polyhedron read_native_binary(std::string_view bytes, const std::string& path, NativeContents contents) {
  return BinaryReader(bytes, path).run(contents);
}

}  // namespace nef
