// SPDX-License-Identifier: Apache-2.0
#include "nef/boolean/copied_links.h"

#include <algorithm>

namespace nef {
namespace {

// What became of a vertex of an operand.
struct Copy {
  enum class State : std::uint8_t { kGone, kCrossed, kWhole };  // kCrossed: some of its edges are
  State state = State::kGone;
  std::uint32_t vertex = kNone;       // of the result
  std::uint32_t svertex_shift = 0;    // from its svertices to those of the copy, modulo 2^32
  std::uint32_t shalfedge_shift = 0;  // likewise
};

bool row_less(const Facet& a, const Facet& b) { return a.plane.row() < b.plane.row(); }

class LinkCopier {
 public:
  LinkCopier(const Complex& result, std::span<const VertexRun> runs, const std::array<const Complex*, 2>& operands)
      : c_(result), runs_(runs), operands_(operands) {}

  KnownLinks run(const std::array<std::vector<EdgeContact>, 2>& contacts) {
    note_copies();
    for (std::size_t x = 0; x < 2; ++x) note_crossed_edges(x, contacts[x]);
    copy_twins();
    copy_facets();
    std::sort(known_.loose_corners.begin(), known_.loose_corners.end());
    return std::move(known_);
  }

 private:
  void note_copies() {
    for (std::size_t x = 0; x < 2; ++x) copies_[x].resize(operands_[x]->vertex_count());
    std::uint32_t vertex = 0;
    for (const VertexRun& run : runs_) {
      for (std::uint32_t v = run.first; v < run.first + run.count; ++v, ++vertex) {
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
    crossed_[x].resize(own.svertices.size(), false);
    for (const EdgeContact& contact : contacts) {
      for (const std::uint32_t h : {contact.edge, own.twin[contact.edge]}) {
        crossed_[x][h] = true;
        Copy& copy = copies_[x][own.svertex_owner[h]];
        if (copy.state == Copy::State::kWhole) copy.state = Copy::State::kCrossed;
      }
    }
  }

  void copy_twins() {
    known_.twin.reserve(c_.svertices.size());
    std::uint32_t vertex = 0;
    for (const VertexRun& run : runs_) {
      for (std::uint32_t v = run.first; v < run.first + run.count; ++v, ++vertex) {
        if (run.origin == VertexRun::kNew) {
          add_new(vertex);
        } else {
          copy_twins_of(run.origin, v, vertex);
        }
      }
    }
  }

  void add_new(std::uint32_t vertex) {
    const VertexRecord& first = c_.vertices[vertex];
    const VertexRecord& last = c_.vertices[vertex + 1];
    known_.twin.resize(last.svertices, kNone);
    if (first.svertices < last.svertices) known_.loose_vertices.push_back(vertex);
    for (std::uint32_t e = first.shalfedges; e < last.shalfedges; ++e) {
      if (!c_.shalfedges[e].plane.flipped()) known_.loose_corners.push_back(e);
    }
    if (first.sloops < last.sloops) known_.loose_isolated.push_back(vertex);
  }

  void copy_twins_of(std::size_t x, std::uint32_t v, std::uint32_t vertex) {
    const Complex& own = *operands_[x];
    const bool may_be_crossed = copies_[x][v].state == Copy::State::kCrossed;
    bool loose = false;
    for (std::uint32_t h = own.vertices[v].svertices; h < own.vertices[v + 1].svertices; ++h) {
      const std::uint32_t other = own.twin[h];
      const Copy& end = copies_[x][own.svertex_owner[other]];
      const bool kept = end.state != Copy::State::kGone && !(may_be_crossed && crossed_[x][h]);
      known_.twin.push_back(kept ? other + end.svertex_shift : kNone);
      loose = loose || !kept;
    }
    if (loose) known_.loose_vertices.push_back(vertex);
  }

  void copy_facets() {
    std::size_t facets = 0;
    std::size_t cycles = 0;
    std::size_t corners = 0;
    for (std::size_t x = 0; x < 2; ++x) {
      if (!copied(x)) continue;
      facets += operands_[x]->facets.size();
      cycles += operands_[x]->cycle_begin.size();
      corners += operands_[x]->corners.size();
    }
    known_.facets.reserve(facets);
    known_.cycle_begin.reserve(cycles);
    known_.corners.reserve(corners);
    for (std::size_t x = 0; x < 2; ++x) {
      const auto begin = static_cast<std::ptrdiff_t>(known_.facets.size());
      if (copied(x)) {
        for (const Facet& facet : operands_[x]->facets) copy_facet(x, facet);
      }
      // Planes of the second operand may have got names out of order.
      const auto first = known_.facets.begin() + begin;
      if (!std::is_sorted(first, known_.facets.end(), row_less)) std::stable_sort(first, known_.facets.end(), row_less);
      if (x == 1) merge(begin);
    }
  }

  bool copied(std::size_t x) const {
    return std::any_of(runs_.begin(), runs_.end(), [x](const VertexRun& run) { return run.origin == x; });
  }

  void copy_facet(std::size_t x, const Facet& facet) {
    const Complex& own = *operands_[x];
    const std::vector<Copy>& copies = copies_[x];
    const std::span<const std::uint32_t> corners = own.corners_of(facet);
    const std::span<const std::uint32_t> inside = own.isolated_vertices_of(facet);
    const std::size_t base = known_.corners.size();
    bool whole = true;
    for (const std::uint32_t corner : corners) {
      const Copy& copy = copies[own.shalfedge_owner[corner]];
      whole = copy.state == Copy::State::kWhole;
      if (!whole) break;
      known_.corners.push_back(corner + copy.shalfedge_shift);
    }
    for (const std::uint32_t v : inside) whole = whole && copies[v].state == Copy::State::kWhole;
    if (!whole) {
      known_.corners.resize(base);
      loosen(own, copies, corners, inside);
      return;
    }
    Facet copy;
    copy.plane = c_.shalfedges[known_.corners[base]].plane;
    copy.first_cycle = CycleId{known_.cycle_begin.size() - 1};
    copy.cycle_count = facet.cycle_count;
    copy.first_isolated = static_cast<std::uint32_t>(known_.isolated_vertices.size());
    copy.isolated_count = facet.isolated_count;
    for (const CycleId i : facet.cycles()) {
      const auto size = static_cast<std::uint32_t>(own.corners_of(i).size());
      known_.cycle_begin.push_back(known_.cycle_begin.back() + size);
    }
    for (const std::uint32_t v : inside) known_.isolated_vertices.push_back(copies[v].vertex);
    known_.facets.push_back(copy);
  }

  void loosen(const Complex& own, const std::vector<Copy>& copies, std::span<const std::uint32_t> corners,
              std::span<const std::uint32_t> inside) {
    for (const std::uint32_t corner : corners) {
      const Copy& copy = copies[own.shalfedge_owner[corner]];
      if (copy.state != Copy::State::kGone) known_.loose_corners.push_back(corner + copy.shalfedge_shift);
    }
    for (const std::uint32_t v : inside) {
      if (copies[v].state != Copy::State::kGone) known_.loose_isolated.push_back(copies[v].vertex);
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
  std::array<std::vector<Copy>, 2> copies_;
  std::array<std::vector<bool>, 2> crossed_;  // halfedges
  KnownLinks known_;
};

}  // namespace

KnownLinks copied_links(const Complex& result, std::span<const VertexRun> runs,
                        const std::array<const Complex*, 2>& operands,
                        const std::array<std::vector<EdgeContact>, 2>& contacts) {
  return LinkCopier(result, runs, operands).run(contacts);
}

}  // namespace nef
