// SPDX-License-Identifier: Apache-2.0
//
// The layout is described in native_binary.h. Columns that lie in memory as they are written are copied whole; the
// others are written item by item, one pass over all sphere maps for each column. Numbers that are local to a sphere
// map take one, two or four bytes, by the largest one of the whole set.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

#include "nef/io/native/native_binary.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

static_assert(std::endian::native == std::endian::little, "the columns are copied as they lie in memory");
static_assert(sizeof(mp_limb_t) == 8);

class BinaryWriter {
 public:
  explicit BinaryWriter(const Complex& complex) : c_(complex) {}

  std::string run() {
    text_.reserve(320 * c_.vertex_count() + 128 * c_.planes.size() + 256);
    text_ += kNativeMagic;
    const std::size_t largest = largest_local_number();
    const std::uint32_t width = largest < 0xffU ? 1 : largest < 0xffffU ? 2 : 4;
    put<std::uint32_t>(kNativeBinaryVersion);
    put(width);
    for (const std::size_t count :
         {c_.planes.size(), c_.vertex_count(), std::size_t{c_.svertex_count()}, std::size_t{c_.shalfedge_count()},
          c_.sloops.size(), std::size_t{c_.sface_count()}, entry_count(), c_.facets.size(), c_.cycle_begin.size() - 1,
          c_.isolated_vertices.size(), c_.shells.size(), c_.volumes.size()}) {
      put(static_cast<std::uint32_t>(count));
    }
    numbers(5, c_.planes.size(),
            [this](std::uint32_t row, std::size_t i) { return c_.planes.coefficient(PlaneId::of_row(row), i); });
    numbers(7, c_.points.size(),
            [this](std::uint32_t row, std::size_t i) { return c_.points.coordinate(PointId{row}, i); });
    if (width == 1) sphere_maps<std::uint8_t>();
    if (width == 2) sphere_maps<std::uint16_t>();
    if (width == 4) sphere_maps<std::uint32_t>();
    links();
    put<std::uint64_t>(XXH3_64bits(text_.data(), text_.size()));
    return std::move(text_);
  }

 private:
  template <typename T>
  void put(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    text_.append(bytes, sizeof(T));
  }

  template <typename T, typename Items, typename Field>
  void column(const Items& items, Field&& field, std::size_t step = 1) {
    const auto first = items.begin();
    for (std::size_t i = 0; i < items.size(); i += step)
      put(static_cast<T>(field(first[static_cast<std::ptrdiff_t>(i)])));
  }
  template <typename Index>
  void column(const std::vector<Index>& values) {
    static_assert(sizeof(Index) == sizeof(std::uint32_t) && std::is_trivially_copyable_v<Index>);
    text_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(std::uint32_t));
  }

  template <typename At>
  void numbers(std::size_t width, std::size_t rows, At&& at) {
    std::uint64_t limbs = 0;
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < width; ++i) {
        const IntegerView value = at(row, i);
        const auto size = static_cast<std::int32_t>(mpz_size(value));
        put(value.sign() < 0 ? -size : size);
        limbs += static_cast<std::uint64_t>(size);
      }
    }
    put(limbs);
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < width; ++i) {
        const IntegerView value = at(row, i);
        text_.append(reinterpret_cast<const char*>(mpz_limbs_read(value)), mpz_size(value) * sizeof(mp_limb_t));
      }
    }
  }

  [[nodiscard]] std::size_t largest_local_number() const {
    std::size_t largest = 0;
    for (const VertexId v : c_.vertex_ids()) {
      const SphereMapView map = c_.sphere_map(v);
      largest = std::max({largest, map.svertices.size(), map.shalfedges.size(), map.sfaces.size(), map.entries.size()});
    }
    return largest;
  }

  [[nodiscard]] std::size_t entry_count() const {
    std::size_t count = 0;
    each_map([&count](const SphereMapView& map) { count += map.entries.size(); });
    return count;
  }

  template <typename W>
  void sphere_maps() {
    const auto counts = [this](auto VertexRecord::*first, std::uint32_t per) {
      for (const VertexId v : c_.vertex_ids()) {
        put(static_cast<W>((c_.vertices[v.next()].*first - c_.vertices[v].*first) / per));
      }
    };
    counts(&VertexRecord::svertices, 1);
    counts(&VertexRecord::shalfedges, 2);
    counts(&VertexRecord::sloops, 2);
    counts(&VertexRecord::sfaces, 1);
    for (const VertexId v : c_.vertex_ids()) put(c_.mark(v));
    svertices<std::uint32_t>([](const SVertex& s) { return s.p.value; });
    svertices<std::uint32_t>([](const SVertex& s) { return s.q.value; });
    svertices<W>([](const SVertex& s) { return s.out; });
    svertices<W>([](const SVertex& s) { return s.out == kNone ? s.sface : kNone; });
    svertices<LabelId>([](const SVertex& s) { return s.mark; });
    column<std::uint32_t>(c_.shalfedge_plane.pairs(), [](PlaneId plane) { return plane.value; });
    shalfedges<LabelId>([](const SHalfedge& e) { return e.mark; }, 2);
    shalfedges<W>([](const SHalfedge& e) { return e.source; });
    shalfedges<W>([](const SHalfedge& e) { return e.next; });
    shalfedges<W>([](const SHalfedge& e) { return e.sface; });
    column<std::uint32_t>(
        c_.sloops, [](const SLoop& l) { return l.plane.value; }, 2);
    column<LabelId>(
        c_.sloops, [](const SLoop& l) { return l.mark; }, 2);
    column<W>(c_.sloops, [](const SLoop& l) { return l.sface; });
    each_map([this](const SphereMapView& map) { column<W>(map.sfaces, [](const SFace& f) { return f.entry_count; }); });
    each_map([this](const SphereMapView& map) { column<LabelId>(map.sfaces, [](const SFace& f) { return f.mark; }); });
    each_entry([this](const SFaceEntry& entry) { put(static_cast<std::uint8_t>(entry.kind)); });
    each_entry([this](const SFaceEntry& entry) { put(static_cast<W>(entry.index)); });
  }

  template <typename Visit>
  void each_map(Visit&& visit) const {
    for (const VertexId v : c_.vertex_ids()) visit(c_.sphere_map(v));
  }

  template <typename T, typename Field>
  void svertices(Field&& field) {
    each_map([&](const SphereMapView& map) { column<T>(map.svertices, field); });
  }
  template <typename T, typename Field>
  void shalfedges(Field&& field, std::size_t step = 1) {
    each_map([&](const SphereMapView& map) { column<T>(map.shalfedges, field, step); });
  }

  // In the order of the sfaces.
  template <typename Visit>
  void each_entry(Visit&& visit) const {
    each_map([&](const SphereMapView& map) {
      for (const SFace& f : map.sfaces) {
        for (const SFaceEntry& entry : map.entries.subspan(f.entries, f.entry_count)) visit(entry);
      }
    });
  }

  void links() {
    column(c_.twin.values());
    for (const CycleId i : c_.cycle_ids()) put(static_cast<std::uint32_t>(c_.corners_of(i).size()));
    column(c_.corners);
    column<std::uint32_t>(c_.facets, [](const Facet& f) { return f.cycle_count; });
    column<std::uint32_t>(c_.facets, [](const Facet& f) { return f.isolated_count; });
    column(c_.isolated_vertices);
    column<std::uint32_t>(c_.sface_shell, [](ShellId s) { return s.index(); });
    column<std::uint32_t>(c_.shells, [](const Shell& s) { return s.volume.index(); });
    column<LabelId>(c_.volumes, [](const Volume& v) { return v.mark; });
  }

  const Complex& c_;
  std::string text_;
};

}  // namespace

std::string native_binary(const Polyhedron& polyhedron) { return BinaryWriter(polyhedron.complex()).run(); }

}  // namespace nef
