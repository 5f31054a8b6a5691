// SPDX-License-Identifier: Apache-2.0
//
// First each vertex of an operand notes where its copy is and whether the other operand crosses one of its edges. Then
// four tasks, which write to different places, copy the twins of the first and of the second half of the vertices, and
// the facets of each operand. Last, the facets of both operands are merged in the order of their planes; planes with
// facets of both are listed, since the order of facets in one plane is not known from the operands. What could not be
// copied is listed as loose, and synthesis finds it.
#include "nef/boolean/result/copied_links.h"

#include <algorithm>
#include <functional>

#include "nef/base/threads/parallel.h"

namespace nef {
namespace {

// What became of a vertex of an operand.
struct Copy {
  enum class State : std::uint8_t { kGone, kCrossed, kWhole };  // kCrossed: some of its edges are
  State state = State::kGone;
  VertexId vertex;                    // of the result
  std::uint32_t svertex_shift = 0;    // from its svertices to those of the copy, modulo 2^32
  std::uint32_t shalfedge_shift = 0;  // likewise
};

bool row_less(const Facet& a, const Facet& b) { return a.plane.row() < b.plane.row(); }

class LinkCopier {
 public:
  LinkCopier(const Complex& result, std::span<const VertexRun> runs, const std::array<const Complex*, 2>& operands)
      : c_(result), runs_(runs), operands_(operands) {}

  KnownLinks run(const std::array<std::vector<EdgeContact>, 2>& contacts, const Monitor& monitor) {
    note_copies();
    for (std::size_t x = 0; x < 2; ++x) note_crossed_edges(x, contacts[x]);
    known_.twin.assign(c_.svertex_count(), HalfedgeId());
    const VertexId half{c_.vertex_count() / 2};
    const VertexId end{c_.vertex_count()};
    std::array<KnownLinks, 2> loose;
    KnownLinks second;
    parallel_calls(monitor,
                   {[&](const Monitor&) { copy_twins(VertexId{0}, half, loose[0]); },
                    [&](const Monitor&) { copy_twins(half, end, loose[1]); },
                    [&](const Monitor&) { copy_facets(0, known_); }, [&](const Monitor&) { copy_facets(1, second); }});
    join_facets(second);
    for (const KnownLinks& more : {std::cref(second), std::cref(loose[0]), std::cref(loose[1])}) add_loose(more);
    std::sort(known_.loose_corners.begin(), known_.loose_corners.end());
    return std::move(known_);
  }

 private:
  void note_copies() {
    for (std::size_t x = 0; x < 2; ++x) copies_[x].resize(operands_[x]->vertex_count());
    VertexId vertex{0};
    for (const VertexRun& run : runs_) {
      for (VertexId v = run.first; v < run.first + run.count; ++v, ++vertex) {
        if (run.origin == VertexRun::kNew) continue;
        const VertexRecord& from = operands_[run.origin]->vertices[v];
        const VertexRecord& to = c_.vertices[vertex];
        copies_[run.origin][v] = {Copy::State::kWhole, vertex, to.svertices - from.svertices,
                                  to.shalfedges - from.shalfedges};
      }
    }
  }

  void note_crossed_edges(std::size_t x, const std::vector<EdgeContact>& contacts) {
    const Complex& own = *operands_[x];
    crossed_[x].resize(own.svertex_count(), false);
    for (const EdgeContact& contact : contacts) {
      for (const HalfedgeId h : {contact.edge, own.twin[contact.edge]}) {
        crossed_[x][h] = true;
        Copy& copy = copies_[x][own.source(h)];
        if (copy.state == Copy::State::kWhole) copy.state = Copy::State::kCrossed;
      }
    }
  }

  void add_loose(const KnownLinks& more) {
    const auto append = [](auto& all, const auto& some) { all.insert(all.end(), some.begin(), some.end()); };
    append(known_.loose_vertices, more.loose_vertices);
    append(known_.loose_corners, more.loose_corners);
    append(known_.loose_isolated, more.loose_isolated);
  }

  // Of vertices first .. last - 1 of the result: twins into known_, what is to be found into `loose`.
  void copy_twins(VertexId first, VertexId last, KnownLinks& loose) {
    VertexId vertex{0};  // the first one of a run
    for (const VertexRun& run : runs_) {
      const VertexId end = std::min(last, vertex + run.count);
      for (VertexId w = std::max(first, vertex); w < end; ++w) {
        if (run.origin == VertexRun::kNew) {
          add_new(w, loose);
        } else {
          copy_twins_of(run.origin, run.first + (w - vertex), w, loose);
        }
      }
      vertex += run.count;
    }
  }

  void add_new(VertexId vertex, KnownLinks& loose) const {
    const VertexRecord& first = c_.vertices[vertex];
    const VertexRecord& last = c_.vertices[vertex.next()];
    if (first.svertices < last.svertices) loose.loose_vertices.push_back(vertex);
    for (const SHalfedgeId e : c_.shalfedges(vertex)) {
      if (!c_.shalfedge_plane[e].flipped()) loose.loose_corners.push_back(e);
    }
    if (first.sloops < last.sloops) loose.loose_isolated.push_back(vertex);
  }

  void copy_twins_of(std::size_t x, VertexId v, VertexId vertex, KnownLinks& loose) {
    const Complex& own = *operands_[x];
    const bool may_be_crossed = copies_[x][v].state == Copy::State::kCrossed;
    bool all = true;
    HalfedgeId to = c_.vertices[vertex].svertices;
    for (const HalfedgeId h : own.halfedges(v)) {
      const HalfedgeId other = own.twin[h];
      const Copy& end = copies_[x][own.source(other)];
      const bool kept = end.state != Copy::State::kGone && !(may_be_crossed && crossed_[x][h]);
      if (kept) known_.twin[to] = other + end.svertex_shift;
      ++to;
      all = all && kept;
    }
    if (!all) loose.loose_vertices.push_back(vertex);
  }

  // In the order of their planes.
  void copy_facets(std::size_t x, KnownLinks& to) const {
    if (!copied(x)) return;
    // Those of the second operand will follow the others.
    for (std::size_t y = x; y < 2; ++y) {
      if (!copied(y)) continue;
      to.facets.reserve(to.facets.capacity() + operands_[y]->facets.size());
      to.cycle_begin.reserve(to.cycle_begin.capacity() + operands_[y]->cycle_begin.size());
      to.corners.reserve(to.corners.capacity() + operands_[y]->corners.size());
    }
    for (const Facet& facet : operands_[x]->facets) copy_facet(x, facet, to);
    // Planes of the second operand may have got names out of order.
    if (!std::is_sorted(to.facets.begin(), to.facets.end(), row_less)) {
      std::stable_sort(to.facets.begin(), to.facets.end(), row_less);
    }
  }

  // Appends those of the second operand to known_.
  void join_facets(const KnownLinks& second) {
    if (second.facets.empty()) return;
    const auto middle = static_cast<std::ptrdiff_t>(known_.facets.size());
    const auto cycles = static_cast<std::uint32_t>(known_.cycle_begin.size() - 1);
    const auto inside = static_cast<std::uint32_t>(known_.isolated_vertices.size());
    const auto corners = static_cast<std::uint32_t>(known_.corners.size());
    for (Facet facet : second.facets) {
      facet.first_cycle = CycleId{facet.first_cycle.index() + cycles};
      facet.first_isolated += inside;
      known_.facets.push_back(facet);
    }
    for (std::size_t i = 1; i < second.cycle_begin.size(); ++i) {
      known_.cycle_begin.push_back(second.cycle_begin[CycleId{i}] + corners);
    }
    known_.corners.insert(known_.corners.end(), second.corners.begin(), second.corners.end());
    known_.isolated_vertices.insert(known_.isolated_vertices.end(), second.isolated_vertices.begin(),
                                    second.isolated_vertices.end());
    merge(middle);
  }

  bool copied(std::size_t x) const {
    return std::any_of(runs_.begin(), runs_.end(), [x](const VertexRun& run) { return run.origin == x; });
  }

  void copy_facet(std::size_t x, const Facet& facet, KnownLinks& to) const {
    const Complex& own = *operands_[x];
    const IndexedVector<VertexId, Copy>& copies = copies_[x];
    const std::span<const SHalfedgeId> corners = own.corners_of(facet);
    const std::span<const VertexId> inside = own.isolated_vertices_of(facet);
    const std::size_t base = to.corners.size();
    bool whole = true;
    for (const SHalfedgeId corner : corners) {
      const Copy& copy = copies[own.shalfedge_vertex(corner)];
      whole = copy.state == Copy::State::kWhole;
      if (!whole) break;
      to.corners.push_back(corner + copy.shalfedge_shift);
    }
    for (const VertexId v : inside) whole = whole && copies[v].state == Copy::State::kWhole;
    if (!whole) {
      to.corners.resize(base);
      loosen(own, copies, corners, inside, to);
      return;
    }
    Facet copy;
    copy.plane = c_.shalfedge_plane[to.corners[base]];
    copy.first_cycle = CycleId{to.cycle_begin.size() - 1};
    copy.cycle_count = facet.cycle_count;
    copy.first_isolated = static_cast<std::uint32_t>(to.isolated_vertices.size());
    copy.isolated_count = facet.isolated_count;
    for (const CycleId i : facet.cycles()) {
      const auto size = static_cast<std::uint32_t>(own.corners_of(i).size());
      to.cycle_begin.push_back(to.cycle_begin.back() + size);
    }
    for (const VertexId v : inside) to.isolated_vertices.push_back(copies[v].vertex);
    to.facets.push_back(copy);
  }

  static void loosen(const Complex& own, const IndexedVector<VertexId, Copy>& copies,
                     std::span<const SHalfedgeId> corners, std::span<const VertexId> inside, KnownLinks& to) {
    for (const SHalfedgeId corner : corners) {
      const Copy& copy = copies[own.shalfedge_vertex(corner)];
      if (copy.state != Copy::State::kGone) to.loose_corners.push_back(corner + copy.shalfedge_shift);
    }
    for (const VertexId v : inside) {
      if (copies[v].state != Copy::State::kGone) to.loose_isolated.push_back(copies[v].vertex);
    }
  }

  // The facets of both operands, sorted by themselves, in the order of planes.
  void merge(std::ptrdiff_t middle) {
    std::vector<Facet>& facets = known_.facets;
    const auto second = facets.begin() + middle;
    if (second == facets.begin() || second == facets.end()) return;
    if (!row_less(*(second - 1), *second)) {
      auto a = facets.begin();
      auto b = second;
      while (a != second && b != facets.end()) {
        if (a->plane.row() == b->plane.row() &&
            (known_.mixed_rows.empty() || known_.mixed_rows.back() != a->plane.row())) {
          known_.mixed_rows.push_back(a->plane.row());
        }
        row_less(*b, *a) ? ++b : ++a;
      }
      std::inplace_merge(facets.begin(), second, facets.end(), row_less);
    }
  }

  const Complex& c_;
  std::span<const VertexRun> runs_;
  std::array<const Complex*, 2> operands_;
  std::array<IndexedVector<VertexId, Copy>, 2> copies_;
  std::array<IndexedVector<HalfedgeId, bool>, 2> crossed_;
  KnownLinks known_;
};

}  // namespace

KnownLinks copied_links(const Complex& result, std::span<const VertexRun> runs,
                        const std::array<const Complex*, 2>& operands,
                        const std::array<std::vector<EdgeContact>, 2>& contacts, const Monitor& monitor) {
  return LinkCopier(result, runs, operands).run(contacts, monitor);
}

}  // namespace nef
